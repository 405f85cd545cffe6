"""Which process a point gets, and what a worker of Dask refuses, with processes that only say so."""

from __future__ import annotations

import time
from pathlib import Path
from typing import ClassVar

import pytest

from mbla.errors import UsageError
from mbla.sweeps.engine import processes
from mbla.sweeps.engine.processes import NOT_BEGUN, Processes, run_on_worker
from mbla.sweeps.engine.supervised import StoppedError
from mbla.sweeps.identity import library_versions
from mbla.sweeps.plan import DONE, FAILED, Plan, PointOutcome, Task
from tests.sweeps.small_plan import frictions, plan_over


class Runner:
    """Stands in for a supervised process."""

    begun: ClassVar[list[Runner]] = []

    def __init__(self, plan: Plan, *, until: float | None, threads: int) -> None:
        self.begun.append(self)
        self.plan, self.stopped = plan, False

    def close(self) -> None:
        """As from another thread."""
        self.stopped = True

    def run(self, task: Task) -> PointOutcome:
        """Solved at once."""
        return PointOutcome(task.key, DONE, 0, "", {}, 1, 0.0)


@pytest.fixture
def begun(monkeypatch: pytest.MonkeyPatch) -> list[Runner]:
    """Those that were begun, none yet."""
    monkeypatch.setattr(processes, "SupervisedRunner", Runner)
    monkeypatch.setattr(Runner, "begun", [])
    return Runner.begun


(TASK,) = frictions(1)


def test_other_libraries_than_those_of_the_client_are_refused(begun: list[Runner], tmp_path: Path) -> None:
    words = rf"^worker on \S+: its numpy is {library_versions()['numpy']}, here it is 0.1; install the same versions"
    with pytest.raises(UsageError, match=words):
        run_on_worker(plan_over(tmp_path), TASK, library_versions() | {"numpy": "0.1"})
    assert run_on_worker(plan_over(tmp_path), TASK, library_versions()).state == DONE
    assert len(begun) == 1


def test_a_process_is_kept_for_the_next_point_of_the_same_plan_only(begun: list[Runner], tmp_path: Path) -> None:
    pool, plan, other = Processes(), plan_over(tmp_path), plan_over(tmp_path, keep="all")
    for each in (plan, plan, other):
        assert pool.run(each, TASK).state == DONE
    first, second = begun
    assert (first.stopped, second.stopped) == (True, False)
    pool.end(plan)
    assert not second.stopped
    pool.end(other)
    assert second.stopped
    pool.run(other, TASK)
    assert len(begun) == 3
    pool.end()
    assert begun[-1].stopped
    with pytest.raises(StoppedError):
        pool.run(other, TASK)


def test_no_point_is_begun_after_the_end_of_the_time(begun: list[Runner], tmp_path: Path) -> None:
    outcome = Processes(until=time.monotonic()).run(plan_over(tmp_path), TASK)
    assert (outcome.state, outcome.exit_code, outcome.reason, outcome.tries) == (FAILED, 7, NOT_BEGUN, 0)
    assert not begun
