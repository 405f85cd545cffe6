"""Points in a worker of a cluster, each solved in a supervised process of the worker.

The functions are called by their import path. A worker has a process for each of its threads that ask; it is kept for
the next point of the same plan. The client ends all of them; where that is gone they end by themselves.
"""

from __future__ import annotations

import platform
import threading
from collections.abc import Mapping
from typing import Any

from mbla.errors import UsageError
from mbla.sweeps.engine.supervised import SupervisedRunner
from mbla.sweeps.identity import difference, library_versions, program_identity
from mbla.sweeps.plan import Outcome, Plan, Task

RUNNERS: dict[int, SupervisedRunner] = {}
"""of this worker, by the thread that asks"""


def describe() -> dict[str, Any]:
    """What this worker is: its mbla, the libraries that answers depend on, its machine."""
    return {"program": program_identity(), "libraries": library_versions(), "machine": platform.node()}


def run_point(plan: Plan, task: Task, libraries: Mapping[str, str]) -> Outcome:
    """Solve a point.

    libraries : versions that the client has; a worker that came later may have others

    Raises UsageError where this worker cannot solve points of this plan.
    """
    if words := difference(libraries, library_versions()):
        raise UsageError("workers-differ", words)
    return _runner_of_this_thread(plan).run(task)


def _runner_of_this_thread(plan: Plan) -> SupervisedRunner:
    """That of the point before, unless it was of another plan or stopped."""
    thread = threading.get_ident()
    runner = RUNNERS.get(thread)
    if runner is None or runner.stopped or runner.plan != plan:
        if runner is not None:
            runner.kill()
        runner = RUNNERS[thread] = SupervisedRunner(plan)
    return runner


def end_processes() -> None:
    """End the processes of this worker, also in the middle of a point."""
    for runner in list(RUNNERS.values()):
        runner.kill()
