"""The process that solves points: one point, from the task to its outcome; it ends with its parent."""

from __future__ import annotations

import signal
import subprocess
import sys
from contextlib import closing
from pathlib import Path

import pytest

from mbla.errors import UsageError
from mbla.sweeps.engine import child
from mbla.sweeps.engine.child import PointRunner, prepared
from mbla.sweeps.engine.supervised import PACKAGES, SupervisedRunner
from mbla.sweeps.plan import DONE, Task
from tests.sweeps.engine.test_supervised import wait_for
from tests.sweeps.killed_sweeps import runs
from tests.sweeps.small_plan import plan_over

PARENT = """
import sys
from pathlib import Path
from mbla.sweeps.plan import Task
from mbla.sweeps.engine.supervised import SupervisedRunner
from tests.sweeps.small_plan import ROW, plan_over
runner = SupervisedRunner(plan_over(Path(sys.argv[1]), ROW))
runner.run(Task("small", 1, {}))
print(runner._process.pid, flush=True)
runner.run(Task("large", 2, {"parameters.n": 40}))
print("solved")
"""


@pytest.mark.long
def test_it_ends_in_the_middle_of_a_point_when_its_parent_is_killed(tmp_path: Path) -> None:
    command = (sys.executable, "-c", PARENT, str(tmp_path))
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=PACKAGES) as parent:
        assert parent.stdout is not None
        number = int(parent.stdout.readline())
        assert runs(number)
        parent.send_signal(signal.SIGKILL)
        assert parent.stdout.read() == ""  # the large point was not solved yet
    wait_for(lambda: not runs(number))


def test_another_program_refuses(tmp_path: Path) -> None:
    expected = r"^its mbla is .*\+.*, the sweep was planned by 0\.0\.9\+abc$"
    with pytest.raises(UsageError, match=expected):
        prepared(plan_over(tmp_path, program="0.0.9+abc"))


def test_a_base_deck_that_was_changed_is_refused(tmp_path: Path) -> None:
    plan = plan_over(tmp_path)
    deck = Path(plan.deck)
    deck.write_text(deck.read_text(encoding="utf-8").replace("2000", "2001"), encoding="utf-8")
    with pytest.raises(UsageError, match=r"base\.yaml on .* is not the deck that was planned: it, or a file that it"):
        prepared(plan)


def test_a_memory_limit_where_the_system_has_none_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(child, "can_limit", lambda: False)
    prepared(plan_over(tmp_path))
    with pytest.raises(UsageError, match=r"^limits\.memory: .* has no limit on the memory of a process; leave it out$"):
        prepared(plan_over(tmp_path, memory_limit=1e9))


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


@pytest.mark.long
def test_one_that_nobody_asks_ends_and_another_takes_its_place(tmp_path: Path) -> None:
    code = "from mbla.sweeps.engine import child; child.IDLE = 0.1; child.main()"
    with closing(SupervisedRunner(plan_over(tmp_path), (sys.executable, "-c", code))) as runner:
        for number in (1, 2):
            assert runner.run(Task("key", number, {})).state == DONE
            assert runner._process is not None
            runner._process.wait(30)
        assert runner.started == 2
