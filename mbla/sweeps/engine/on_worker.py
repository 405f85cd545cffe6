"""Points in a worker of a cluster, each solved in a supervised process of the worker.

The functions are called by their import path. A worker has as many processes as it has threads that ask; they are kept
for the next batch of the same plan, and ended when none has come for a while or the client says so.
"""

from __future__ import annotations

import platform
import threading
import time
from collections.abc import Mapping, Sequence
from contextlib import suppress
from typing import Any

from mbla.errors import UsageError
from mbla.sweeps.engine.supervised import StoppedError, SupervisedRunner
from mbla.sweeps.identity import difference, library_versions, program_identity
from mbla.sweeps.plan import Outcome, Plan, Task

IDLE = 60.0
"""seconds without a batch after which the processes are ended: their client is gone"""
ENOUGH = 2.0
"""seconds after which a batch is handed back, what is left of it undone: so much is lost where a worker is killed, and
no worker waits longer than that for one whose points take more than was expected"""


class Processes:
    """The processes of this worker."""

    def __init__(self) -> None:
        """None yet."""
        self._lock = threading.Lock()
        self._free: list[SupervisedRunner] = []
        self._busy: list[SupervisedRunner] = []
        self._plan: Plan | None = None
        self._timer: threading.Timer | None = None

    def lend(self, plan: Plan) -> SupervisedRunner:
        """One that no other thread has; those of another plan are ended."""
        with self._lock:
            self._stop_timer()
            if plan != self._plan:
                self._end_free()
                self._plan = plan
            runner = self._free.pop() if self._free else SupervisedRunner(plan)
            self._busy.append(runner)
            return runner

    def give_back(self, runner: SupervisedRunner) -> None:
        """Keep it for the next batch, if that may be of the same plan."""
        with self._lock:
            if runner in self._busy:
                self._busy.remove(runner)
            if runner.plan == self._plan and not runner.stopped:
                self._free.append(runner)
            else:
                runner.__exit__(None, None, None)
            self._start_timer()

    def end(self) -> None:
        """End all of them, also in the middle of a point."""
        with self._lock:
            self._stop_timer()
            for runner in self._busy:
                runner.kill()
            self._end_free()

    def _end_idle(self) -> None:
        with self._lock:
            if not self._busy:
                self._end_free()

    def _end_free(self) -> None:
        for runner in self._free:
            runner.__exit__(None, None, None)
        self._free.clear()

    def _start_timer(self) -> None:
        self._stop_timer()
        self._timer = threading.Timer(IDLE, self._end_idle)
        self._timer.daemon = True
        self._timer.start()

    def _stop_timer(self) -> None:
        if self._timer is not None:
            self._timer.cancel()


PROCESSES = Processes()


def describe() -> dict[str, Any]:
    """What this worker is: its mbla, the libraries that answers depend on, its machine."""
    return {"program": program_identity(), "libraries": library_versions(), "machine": platform.node()}


def run_batch(plan: Plan, tasks: Sequence[Task], libraries: Mapping[str, str]) -> tuple[list[Outcome], str]:
    """Solve points until all are done or enough time is over.

    libraries : versions that the client has; a worker that came later may have others

    Returns
    -------
    tuple
        outcomes of the first tasks; why this worker cannot solve points of this plan, empty where it can
    """
    outcomes: list[Outcome] = []
    if words := difference(libraries, library_versions()):
        return outcomes, words
    runner = PROCESSES.lend(plan)
    until = time.monotonic() + ENOUGH
    try:
        with suppress(StoppedError):  # nobody waits for these any more
            for task in tasks:
                outcomes.append(runner.run(task))
                if time.monotonic() > until:
                    break
    except UsageError as error:
        return outcomes, str(error)
    finally:
        PROCESSES.give_back(runner)
    return outcomes, ""


def end_processes() -> None:
    """End the processes of this worker."""
    PROCESSES.end()
