"""Where the points of a sweep are solved: what every engine promises, and the one that solves one after the other."""

from __future__ import annotations

import time
from abc import ABC, abstractmethod
from collections.abc import Generator, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Self

from mbla.errors import LimitError, UsageError
from mbla.sweeps.engine.supervised import SupervisedRunner
from mbla.sweeps.plan import FAILED, Outcome, Plan, Task

NOT_BEGUN = "not run: the time limit was over"
"""reason of a point that was not begun"""
PATIENCE = 60.0
"""seconds to wait for a scheduler and its first worker"""


@dataclass(frozen=True)
class EngineOptions:
    """What engine is wanted.

    workers        : processes on this machine
    scheduler      : address of a Dask scheduler, ``tcp://host:port`` or ``tls://host:port``; empty for none
    scheduler_file : file in which a scheduler wrote its address
    tls_ca_file    : certificate of the authority; Dask's own configuration where these three are None
    tls_cert       : certificate of this client
    tls_key        : its private key
    patience       : seconds to wait for the scheduler and its first worker, and for another where all are gone
    """

    workers: int = 1
    scheduler: str = ""
    scheduler_file: Path | None = None
    tls_ca_file: Path | None = None
    tls_cert: Path | None = None
    tls_key: Path | None = None
    patience: float = PATIENCE

    @property
    def cluster(self) -> bool:
        """Whether a scheduler is named."""
        return bool(self.scheduler) or self.scheduler_file is not None

    @property
    def tls_files(self) -> dict[str, Path]:
        """Files that were named, by their option."""
        files = {"--tls-ca-file": self.tls_ca_file, "--tls-cert": self.tls_cert, "--tls-key": self.tls_key}
        return {option: path for option, path in files.items() if path is not None}


def check_options(options: EngineOptions) -> None:
    """Raises UsageError for what does not go together or is not there; all of it in one line each."""
    wrong = []
    if options.workers < 1:
        wrong.append(f"-j {options.workers}: at least 1")
    if options.cluster and options.workers > 1:
        wrong.append("-j is for processes of this machine; with a scheduler its workers are all used")
    if options.scheduler and options.scheduler_file is not None:
        wrong.append("--scheduler and --scheduler-file: one of them says where the scheduler is")
    if options.scheduler and not options.scheduler.startswith(("tcp://", "tls://")):
        wrong.append(f"--scheduler {options.scheduler}: an address is tcp://HOST:PORT or tls://HOST:PORT")
    files = options.tls_files
    if files and (options.scheduler.startswith("tcp://") or not options.cluster):
        wrong.append(f"{', '.join(files)}: only for a scheduler at a tls:// address")
    if ("--tls-cert" in files) != ("--tls-key" in files):
        wrong.append("--tls-cert and --tls-key belong together")
    wrong += [f"{option} {path}: there is no such file" for option, path in files.items() if not path.is_file()]
    if wrong:
        raise UsageError("sweep-option", "\n".join(wrong))


class Engine(ABC):
    """Hands tasks to workers; a context manager, of which nothing goes on after its block."""

    _outcomes: Generator[Outcome, None, None] | None = None

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, traceback: TracebackType | None
    ) -> None:
        if self._outcomes is not None:
            self._outcomes.close()

    def run(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        """Outcomes in the order in which they are done; one for every task, also where its worker died.

        Closing the iterator stops what is under way.

        Raises
        ------
        UsageError
            no worker can be had, or one has another mbla or reads another base deck
        FileError
            the scheduler is gone
        """
        self._outcomes = self._solved(plan, tasks)
        return self._outcomes

    @abstractmethod
    def _solved(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]: ...


class SerialEngine(Engine):
    """Tasks are done in their order, by one process beside this one."""

    def __init__(self, until: float | None = None, threads: int = 1) -> None:
        """
        Until   : time.monotonic() at which the point under way is stopped and no further one is begun
        threads : of the process of points
        """
        self._until, self._threads = until, threads

    def _solved(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        with SupervisedRunner(plan, until=self._until, threads=self._threads) as runner:
            for task in tasks:
                if self._until is not None and time.monotonic() >= self._until:
                    yield Outcome(task.key, FAILED, LimitError.exit_status, NOT_BEGUN, {}, 0, 0.0)
                else:
                    yield runner.run(task)


def engine_for(options: EngineOptions) -> Engine:
    """The engine; it is started by entering its context.

    Raises
    ------
    UsageError
        options that do not go together, or an extra that is not installed
    """
    check_options(options)
    if options.workers == 1 and not options.cluster:
        return SerialEngine()
    from mbla.sweeps.engine.cluster import ClusterEngine

    return ClusterEngine(options)
