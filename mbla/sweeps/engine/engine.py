"""Where the points of a sweep are solved: threads of this machine, or of the workers of a Dask scheduler.

Either is an executor of ``concurrent.futures``; each of its threads has a process of its own for the points.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Callable, Generator, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, ThreadPoolExecutor, wait
from contextlib import AbstractContextManager, contextmanager
from dataclasses import dataclass
from itertools import islice
from pathlib import Path

from mbla.errors import UsageError
from mbla.sweeps.engine.processes import NOT_BEGUN as NOT_BEGUN
from mbla.sweeps.engine.processes import Processes
from mbla.sweeps.plan import FAILED, Plan, PointOutcome, Task

PATIENCE = 60.0
"""seconds to wait for a scheduler and its first worker"""
WINDOW = 2
"""points under way for each thread: one is solved, the next waits with it"""
GIVEN_UP = "its worker was ended, as was that of each try before; given up"


@dataclass(frozen=True)
class EngineOptions:
    """Engine that is requested.

    workers        : processes on this machine
    scheduler      : address of a Dask scheduler, ``tcp://host:port`` or ``tls://host:port``; empty for none
    scheduler_file : file in which a scheduler wrote its address
    patience       : seconds to wait for the scheduler and its first worker
    until          : time.monotonic() at which the points under way are stopped and no further one is begun
    threads        : of each process of this machine
    """

    workers: int = 1
    scheduler: str = ""
    scheduler_file: Path | None = None
    patience: float = PATIENCE
    until: float | None = None
    threads: int = 1

    @property
    def cluster(self) -> bool:
        """Whether a scheduler is named."""
        return bool(self.scheduler) or self.scheduler_file is not None


@dataclass(frozen=True)
class Pool:
    """What runs points.

    run      : solves a point of a plan in a thread of the executor
    threads  : of the executor; those of a cluster may come and go
    given_up : error of a point whose worker was ended too often
    """

    executor: Executor
    run: Callable[[Plan, Task], PointOutcome]
    threads: Callable[[], int]
    given_up: tuple[type[Exception], ...] = ()


def check_options(options: EngineOptions) -> None:
    """Raises UsageError for what does not go together, each in a line, and for a missing extra."""
    wrong = []
    if options.workers < 1:
        wrong.append(f"-j {options.workers}: at least 1")
    if options.cluster and options.workers > 1:
        wrong.append("-j is for processes of this machine; with a scheduler its workers are all used")
    if options.scheduler and options.scheduler_file is not None:
        wrong.append("--scheduler and --scheduler-file: one of them says where the scheduler is")
    if options.scheduler and not options.scheduler.startswith(("tcp://", "tls://")):
        wrong.append(f"--scheduler {options.scheduler}: an address is tcp://HOST:PORT or tls://HOST:PORT")
    if wrong:
        raise UsageError("sweep-option", "\n".join(wrong))
    if options.cluster and importlib.util.find_spec("distributed") is None:
        words = "a cluster needs an extra that is not installed: pip install 'mbla[dask]'"
        raise UsageError("extra-missing", words)


def outcomes_of(options: EngineOptions, plan: Plan, tasks: Sequence[Task]) -> Generator[PointOutcome, None, None]:
    """Outcomes in the order in which they are done; one for every task, also where its worker died.

    Tasks are begun in their order. Closing the iterator stops what is under way.

    Raises UsageError: no worker can be had, or one has another mbla or reads another base deck. Raises FileError: the
    scheduler is gone.
    """
    left, running = iter(tasks), dict[Future[PointOutcome], Task]()
    with _pool_of(options, plan) as pool:
        while True:
            for task in islice(left, max(WINDOW * max(pool.threads(), 1) - len(running), 0)):
                running[pool.executor.submit(pool.run, plan, task)] = task
            if not running:
                return
            for future in wait(running, return_when=FIRST_COMPLETED).done:
                task = running.pop(future)
                try:
                    outcome = future.result()
                except pool.given_up as error:
                    tries = 1 + int(getattr(error, "allowed_failures", 0))
                    outcome = PointOutcome(task.key, FAILED, 1, GIVEN_UP, {}, tries, 0.0)
                yield outcome


def _pool_of(options: EngineOptions, plan: Plan) -> AbstractContextManager[Pool]:
    if not options.cluster:
        return _pool_here(options)
    from mbla.sweeps.engine.cluster import pool_of_cluster

    return pool_of_cluster(options, plan)


@contextmanager
def _pool_here(options: EngineOptions) -> Iterator[Pool]:
    """Threads of this process; nothing of them is left after the block."""
    processes = Processes(until=options.until, threads=options.threads)
    with ThreadPoolExecutor(options.workers) as executor:
        try:
            yield Pool(executor, processes.run, lambda: options.workers)
        finally:
            executor.shutdown(wait=False, cancel_futures=True)
            processes.end()
