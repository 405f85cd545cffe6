"""Where the points of a sweep are solved: processes of this machine, or the workers of a Dask scheduler."""

from __future__ import annotations

import importlib.util
import queue
import threading
import time
from collections.abc import Generator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path

from mbla.errors import LimitError, UsageError
from mbla.sweeps.engine.supervised import StoppedError, SupervisedRunner
from mbla.sweeps.plan import FAILED, Outcome, Plan, Task

NOT_BEGUN = "not run: the time limit was over"
"""reason of a point that was not begun"""
PATIENCE = 60.0
"""seconds to wait for a scheduler and its first worker"""


TLS = {"tls_ca_file": "--tls-ca-file", "tls_client_cert": "--tls-cert", "tls_client_key": "--tls-key"}
"""certificate of the authority, certificate and private key of this client: as Dask calls them, and the options"""


@dataclass(frozen=True)
class EngineOptions:
    """Engine that is requested.

    workers        : processes on this machine
    scheduler      : address of a Dask scheduler, ``tcp://host:port`` or ``tls://host:port``; empty for none
    scheduler_file : file in which a scheduler wrote its address
    tls            : files by their keys in ``TLS``; those of Dask's own configuration where there are none
    patience       : seconds to wait for the scheduler and its first worker, and for another where all are gone
    until          : time.monotonic() at which the points under way are stopped and no further one is begun
    threads        : of each process of this machine
    """

    workers: int = 1
    scheduler: str = ""
    scheduler_file: Path | None = None
    tls: Mapping[str, Path] = field(default_factory=dict)
    patience: float = PATIENCE
    until: float | None = None
    threads: int = 1

    @property
    def cluster(self) -> bool:
        """Whether a scheduler is named."""
        return bool(self.scheduler) or self.scheduler_file is not None


MISSING = "a cluster needs an extra that is not installed: pip install 'mbla[dask]'"


def check_options(options: EngineOptions) -> None:
    """Raises UsageError for what does not go together or is not there, each in a line, and for a missing extra."""
    wrong = []
    if options.workers < 1:
        wrong.append(f"-j {options.workers}: at least 1")
    if options.cluster and options.workers > 1:
        wrong.append("-j is for processes of this machine; with a scheduler its workers are all used")
    if options.scheduler and options.scheduler_file is not None:
        wrong.append("--scheduler and --scheduler-file: one of them says where the scheduler is")
    if options.scheduler and not options.scheduler.startswith(("tcp://", "tls://")):
        wrong.append(f"--scheduler {options.scheduler}: an address is tcp://HOST:PORT or tls://HOST:PORT")
    files = {TLS[key]: path for key, path in options.tls.items()}
    if files and (options.scheduler.startswith("tcp://") or not options.cluster):
        wrong.append(f"{', '.join(files)}: only for a scheduler at a tls:// address")
    if ("--tls-cert" in files) != ("--tls-key" in files):
        wrong.append("--tls-cert and --tls-key belong together")
    wrong += [f"{option} {path}: there is no such file" for option, path in files.items() if not path.is_file()]
    if wrong:
        raise UsageError("sweep-option", "\n".join(wrong))
    if options.cluster and importlib.util.find_spec("distributed") is None:
        raise UsageError("extra-missing", MISSING)


def outcomes_of(options: EngineOptions, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
    """Outcomes in the order in which they are done; one for every task, also where its worker died.

    Closing the iterator stops what is under way.

    Raises
    ------
    UsageError
        no worker can be had, or one has another mbla or reads another base deck
    FileError
        the scheduler is gone
    """
    if options.cluster:
        from mbla.sweeps.engine.cluster import outcomes_of_cluster

        return outcomes_of_cluster(options, plan, tasks)
    return _outcomes_here(options, plan, tasks)


def _outcomes_here(options: EngineOptions, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
    """Tasks are begun in their order by as many processes as are wanted, each with a thread that looks after it."""
    left, lock = iter(tasks), threading.Lock()
    found: queue.SimpleQueue[Outcome | BaseException] = queue.SimpleQueue()

    def work(runner: SupervisedRunner) -> None:
        try:
            while True:
                with lock:
                    task = next(left, None)
                if task is None:
                    return
                late = options.until is not None and time.monotonic() >= options.until
                not_begun = Outcome(task.key, FAILED, LimitError.exit_status, NOT_BEGUN, {}, 0, 0.0)
                found.put(not_begun if late else runner.run(task))
        except StoppedError:  # nothing waits for it any more
            return
        except BaseException as error:
            found.put(error)

    wanted = range(min(options.workers, len(tasks)))
    runners = [SupervisedRunner(plan, until=options.until, threads=options.threads) for _ in wanted]
    threads = [threading.Thread(target=work, args=(runner,), daemon=True) for runner in runners]
    try:
        for thread in threads:
            thread.start()
        for _ in tasks:
            outcome = found.get()
            if isinstance(outcome, BaseException):
                raise outcome
            yield outcome
    finally:
        for runner in runners:
            runner.kill()
        for thread in threads:
            thread.join()
