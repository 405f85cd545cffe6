"""What a worker of Dask makes of points, with processes that only say so."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.errors import UsageError
from mbla.sweeps.engine import on_worker
from mbla.sweeps.engine.on_worker import end_processes, run_point
from mbla.sweeps.identity import library_versions
from mbla.sweeps.plan import DONE, Outcome, Plan, Task
from tests.sweeps.small_plan import frictions, plan_over


class Runner:
    """Stands in for a supervised process."""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.stopped = plan, False

    def kill(self) -> None:
        """As from another thread."""
        self.stopped = True

    def run(self, task: Task) -> Outcome:
        """Solved at once."""
        return Outcome(task.key, DONE, 0, "", {}, 1, 0.0)


@pytest.fixture
def runners(monkeypatch: pytest.MonkeyPatch) -> dict[int, Any]:
    """Those of a worker, none yet."""
    found: dict[int, Any] = {}
    monkeypatch.setattr(on_worker, "SupervisedRunner", Runner)
    monkeypatch.setattr(on_worker, "RUNNERS", found)
    return found


def answer(folder: Path, *, keep: str = "none", **libraries: str) -> str:
    """Key of a point that was solved."""
    (task,) = frictions(1)
    return run_point(plan_over(folder, keep=keep), task, library_versions() | libraries).key


def test_other_libraries_than_those_of_the_client_are_refused(runners: dict[int, Any], tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=f"its numpy is {library_versions()['numpy']}, here it is 0.1"):
        answer(tmp_path, numpy="0.1")


def test_a_process_is_kept_for_the_next_point_of_the_same_plan_only(runners: dict[int, Any], tmp_path: Path) -> None:
    answer(tmp_path)
    (first,) = runners.values()
    answer(tmp_path)
    assert list(runners.values()) == [first]
    answer(tmp_path, keep="all")
    (second,) = runners.values()
    assert (second is first, first.stopped) == (False, True)
    end_processes()
    assert second.stopped
    answer(tmp_path, keep="all")
    assert list(runners.values()) != [second]
