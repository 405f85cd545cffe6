"""Processes of points, one for each thread that asks, kept for the next point of the same plan."""

from __future__ import annotations

import platform
import threading
import time
from collections.abc import Mapping

from mbla.errors import LimitError, UsageError
from mbla.sweeps.engine.supervised import StoppedError, SupervisedRunner
from mbla.sweeps.identity import difference, library_versions
from mbla.sweeps.plan import FAILED, Plan, PointOutcome, Task

NOT_BEGUN = "not run: the time limit was over"
"""reason of a point that was not begun"""


class Processes:
    """The processes of some threads of this process.

    until   : time.monotonic() at which a point is stopped in any case and none is begun any more; None for never
    threads : of each process
    """

    def __init__(self, *, until: float | None = None, threads: int = 1) -> None:
        self._until, self._threads = until, threads
        self._runners: dict[int, SupervisedRunner] = {}
        self._lock = threading.Lock()
        self._ended = False

    def run(self, plan: Plan, task: Task) -> PointOutcome:
        """Solve a point in the process of this thread; raises as ``SupervisedRunner.run``."""
        if self._until is not None and time.monotonic() >= self._until:
            return PointOutcome(task.key, FAILED, LimitError.exit_status, NOT_BEGUN, {}, 0, 0.0)
        return self._of_this_thread(plan).run(task)

    def _of_this_thread(self, plan: Plan) -> SupervisedRunner:
        with self._lock:
            if self._ended:
                raise StoppedError
            runner = self._runners.get(threading.get_ident())
            if runner is None or runner.stopped or runner.plan != plan:
                if runner is not None:
                    runner.close()
                runner = SupervisedRunner(plan, until=self._until, threads=self._threads)
                self._runners[threading.get_ident()] = runner
            return runner

    def end(self, plan: Plan | None = None) -> None:
        """End those that solve points of a plan, or all for good; also in the middle of a point."""
        with self._lock:
            self._ended = self._ended or plan is None
            for runner in self._runners.values():
                if plan is None or runner.plan == plan:
                    runner.close()


ON_WORKER = Processes()
"""of a worker of a cluster; a process ends by itself where the client that would end it is gone"""


def run_on_worker(plan: Plan, task: Task, libraries: Mapping[str, str]) -> PointOutcome:
    """Solve a point on a worker of a cluster, which calls this by its import path.

    libraries : versions that the client has

    Raises UsageError where this worker cannot solve points of this plan.
    """
    if words := difference(libraries, library_versions()):
        remedy = "install the same versions in the workers' environment"
        raise UsageError("workers-differ", f"worker on {platform.node()}: {words}; {remedy}")
    try:
        return ON_WORKER.run(plan, task)
    except UsageError as error:
        raise UsageError("worker-refused", f"worker on {platform.node()}: {error}") from error


def end_on_worker(plan: Plan) -> None:
    """End what a worker of a cluster does for a plan."""
    ON_WORKER.end(plan)
