"""A client of Dask that answers as it is told: what a scheduler or its workers may say, without any of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from types import SimpleNamespace
from typing import Any

import pytest

from mbla.sweeps.engine import connection
from mbla.sweeps.engine.cluster import ClusterEngine
from mbla.sweeps.engine.engine import EngineOptions, engine_for
from mbla.sweeps.engine.on_worker import describe

ADDRESS = "tcp://host:8786"
WORKER = "tcp://worker:1"


@dataclass
class Script:
    """What is answered, and what was asked.

    threads : of the workers at each look, the last for ever
    workers : what each says of itself; an error where asking it failed
    batches : answer to each batch, or the error with which it ended; None for one that is never finished
    refusal : error of connecting
    asked   : names of what was asked for
    options : of the client
    """

    threads: Sequence[int | BaseException] = (1,)
    workers: Mapping[str, Any] = field(default_factory=lambda: {WORKER: describe()})
    batches: Sequence[Mapping[str, Any] | BaseException | None] = ()
    refusal: BaseException | None = None
    asked: list[str] = field(default_factory=list)
    options: dict[str, Any] = field(default_factory=dict)


@dataclass
class ScriptedFuture:
    """A batch that is finished at once, or never."""

    key: str
    answer: Mapping[str, Any] | BaseException | None

    def add_done_callback(self, tell: Callable[[ScriptedFuture], None]) -> None:
        """It is finished already."""
        if self.answer is not None:
            tell(self)

    def result(self, timeout: float) -> Mapping[str, Any]:
        """The answer, or its error."""
        if isinstance(self.answer, BaseException):
            raise self.answer
        assert self.answer is not None
        return self.answer


class ScriptedClient:
    """Stands in for ``distributed.Client``."""

    def __init__(self, script: Script) -> None:
        self.status = "running"
        self.script = script
        self._threads, self._batches = iter(script.threads), iter(script.batches)
        self._last: int | BaseException = 0

    def nthreads(self) -> dict[str, int]:
        """Threads of the one worker."""
        self._last = next(self._threads, self._last)
        if isinstance(self._last, BaseException):
            raise self._last
        return {WORKER: self._last}

    def run(self, function: Callable[[], Any], on_error: str) -> dict[str, Any]:
        """What each worker answers."""
        self.script.asked.append(function.__name__)
        return dict(self.script.workers)

    def submit(self, function: Callable[..., Any], *arguments: Any, key: str, pure: bool) -> ScriptedFuture:
        """Hand over a batch."""
        self.script.asked.append(function.__name__)
        answer = next(self._batches)
        if isinstance(answer, ConnectionAbortedError):
            raise answer
        if isinstance(answer, ConnectionResetError):
            self.status = "closed"
        return ScriptedFuture(key, answer)

    def cancel(self, futures: Sequence[ScriptedFuture], force: bool) -> None:
        """Take batches back."""
        self.script.asked.append(f"cancel {len(futures)}")

    def close(self, timeout: float) -> None:
        """Take leave."""
        self.script.asked.append("close")


def scripted_engine(monkeypatch: pytest.MonkeyPatch, script: Script, **options: Any) -> ClusterEngine:
    """An engine whose client goes by a script."""
    parts = connection.dask_parts()

    def client(address: str, **given: Any) -> ScriptedClient:
        script.options |= {"address": address} | given
        if script.refusal is not None:
            raise script.refusal
        return ScriptedClient(script)

    monkeypatch.setattr(connection, "dask_parts", lambda: SimpleNamespace(**vars(parts) | {"Client": client}))
    chosen: dict[str, Any] = {"scheduler": ADDRESS, "patience": 0.2} | options
    engine = engine_for(EngineOptions(**chosen))
    assert isinstance(engine, ClusterEngine)
    return engine
