"""Points in a worker of a cluster, each solved in a supervised process of the worker.

The functions are called by their import path. A worker has a process for each of its threads that ask; it is kept for
the next batch of the same plan. The client ends all of them; where that is gone they end by themselves.
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

ENOUGH = 2.0
"""seconds after which a batch is handed back, what is left of it undone: so much is lost where a worker is killed, and
no worker waits longer than that for one whose points take more than was expected"""
RUNNERS: dict[int, SupervisedRunner] = {}
"""of this worker, by the thread that asks"""


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
    until = time.monotonic() + ENOUGH
    try:
        with suppress(StoppedError):  # nobody waits for these any more
            runner = _runner_of_this_thread(plan)
            for task in tasks:
                outcomes.append(runner.run(task))
                if time.monotonic() > until:
                    break
    except UsageError as error:
        return outcomes, str(error)
    return outcomes, ""


def _runner_of_this_thread(plan: Plan) -> SupervisedRunner:
    """That of the batch before, unless it was of another plan or stopped."""
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
