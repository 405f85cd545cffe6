"""One point, from the task to its outcome."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.sweeps.engine.child import PointRunner
from mbla.sweeps.plan import DONE, Task
from tests.sweeps.small_plan import plan_over


def test_result_files_of_points_are_kept_where_that_is_wanted(tmp_path: Path) -> None:
    runner = PointRunner(plan_over(tmp_path, keep="all"))
    assert runner.run(Task("key", 7, {})).state == DONE
    folder = tmp_path / "sweep.out" / "points" / "7"
    assert {"base.h5", "base.sta"} <= {path.name for path in folder.iterdir()}
    assert (folder / "base.sta").read_text(encoding="utf-8").endswith("# push: solved\n")


@pytest.mark.parametrize("solved_before", [0, 1])
def test_a_point_that_runs_out_of_memory_is_tried_without_what_others_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, solved_before: int
) -> None:
    points = PointRunner(plan_over(tmp_path))
    for _ in range(solved_before):
        assert points.run(Task("before", 1, {})).state == DONE
    solve, refusals = points._solve, [MemoryError()]

    def short_of_memory(task: Task) -> object:
        if refusals:
            raise refusals.pop()
        return solve(task)

    monkeypatch.setattr(points, "_solve", short_of_memory)
    outcome = points.run(Task("key", 2, {}))
    assert (outcome.state, outcome.reason) == ((DONE, "") if solved_before else ("failed", "out of memory"))
