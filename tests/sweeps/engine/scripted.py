"""A client of Dask that answers as it is told: what a scheduler or its workers may say, without any of them."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

import pytest

from mbla.sweeps.engine import cluster
from mbla.sweeps.engine.cluster import Connection
from mbla.sweeps.engine.engine import EngineOptions
from mbla.sweeps.engine.on_worker import describe

ADDRESS = "tcp://host:8786"
WORKER = "tcp://worker:1"


@dataclass
class Script:
    """What is answered, and what was asked.

    threads : of the workers at each look, the last for ever
    workers : what each says of itself; an error where asking it failed
    refusal : error of connecting
    asked   : names of what was asked for
    options : of the client
    """

    threads: Sequence[int | BaseException] = (1,)
    workers: Mapping[str, Any] = field(default_factory=lambda: {WORKER: describe()})
    refusal: BaseException | None = None
    asked: list[str] = field(default_factory=list)
    options: dict[str, Any] = field(default_factory=dict)


class ScriptedClient:
    """Stands in for ``distributed.Client``."""

    def __init__(self, script: Script) -> None:
        self.status = "running"
        self.script = script
        self._threads = iter(script.threads)
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

    def close(self, timeout: float) -> None:
        """Take leave."""
        self.script.asked.append("close")


def scripted(monkeypatch: pytest.MonkeyPatch, script: Script, **options: Any) -> Connection:
    """A connection whose client goes by a script."""

    def client(address: str, **given: Any) -> ScriptedClient:
        script.options |= {"address": address} | given
        if script.refusal is not None:
            raise script.refusal
        return ScriptedClient(script)

    monkeypatch.setattr(cluster.dask, "Client", client)
    chosen: dict[str, Any] = {"scheduler": ADDRESS, "patience": 0.2} | options
    return Connection(EngineOptions(**chosen))
