"""Batches of points: how tasks are portioned out, and what a worker makes of them with processes that only say so."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.errors import UsageError
from mbla.sweeps.engine import on_worker
from mbla.sweeps.engine.cluster import MOST, Batches
from mbla.sweeps.engine.on_worker import end_processes, run_batch
from mbla.sweeps.engine.supervised import StoppedError
from mbla.sweeps.identity import library_versions
from mbla.sweeps.plan import DONE, Outcome, Plan, Task
from tests.sweeps.small_plan import frictions, plan_over


def took(seconds: float) -> Outcome:
    return Outcome("key1", DONE, 0, "", {}, 1, seconds)


@pytest.mark.parametrize(("seconds", "size"), [(0.0, MOST), (0.02, 50), (0.3, 3), (40.0, 1)])
def test_about_a_second(seconds: float, size: int) -> None:
    batches = Batches(frictions(1000))
    assert len(batches.take(4)) == 1
    batches.learn(took(seconds))
    assert len(batches.take(4)) == size


def test_each_task_once_and_in_order_with_small_portions_at_the_end() -> None:
    tasks, batches = frictions(100), Batches(frictions(100))
    batches.learn(took(0.0))
    sizes: list[int] = []
    taken: list[Task] = []
    while batches:
        batch = batches.take(4)
        sizes.append(len(batch))
        taken += batch
    assert tuple(taken) == tasks
    assert sizes[0] == 25
    assert sizes[-1] == 1


def test_after_a_death_points_go_alone_and_are_given_up_at_the_second() -> None:
    batches = Batches(frictions(10))
    batches.learn(took(0.1))
    batch = batches.take(5)
    assert len(batch) == 2
    assert batches.died(batch) == ()
    assert [batches.take(5) for _ in batch] == [(task,) for task in batch]
    assert batches.died(batch[:1]) == batch[:1]
    assert batches.take(5)[0] not in batch


class Runner:
    """Stands in for a supervised process."""

    error: Exception | None = None
    """what the second point comes to"""

    def __init__(self, plan: Plan) -> None:
        self.plan, self.stopped, self.points = plan, False, 0

    def kill(self) -> None:
        """As from another thread."""
        self.stopped = True

    def run(self, task: Task) -> Outcome:
        """Solved at once."""
        self.points += 1
        if self.points == 2 and self.error is not None:
            raise self.error
        return Outcome(task.key, DONE, 0, "", {}, 1, 0.0)


@pytest.fixture
def runners(monkeypatch: pytest.MonkeyPatch) -> dict[int, Any]:
    """Those of a worker, none yet."""
    found: dict[int, Any] = {}
    monkeypatch.setattr(on_worker, "SupervisedRunner", Runner)
    monkeypatch.setattr(on_worker, "RUNNERS", found)
    return found


def answer(folder: Path, *, keep: str = "none", **libraries: str) -> tuple[list[str], str]:
    """Of three points: keys of those that were solved, and the refusal."""
    outcomes, refused = run_batch(plan_over(folder, keep=keep), frictions(3), library_versions() | libraries)
    return [outcome.key for outcome in outcomes], refused


def test_a_batch_is_handed_back_when_enough_time_is_over(
    runners: dict[int, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert answer(tmp_path) == (["key1", "key2", "key3"], "")
    monkeypatch.setattr(on_worker, "ENOUGH", -1.0)
    assert answer(tmp_path) == (["key1"], "")


def test_other_libraries_than_those_of_the_client_are_refused(runners: dict[int, Any], tmp_path: Path) -> None:
    words = f"its numpy is {library_versions()['numpy']}, here it is 0.1"
    assert answer(tmp_path, numpy="0.1") == ([], words)


@pytest.mark.parametrize(
    ("error", "refused"), [(UsageError("deck-changed", "another deck"), "another deck"), (StoppedError(), "")]
)
def test_what_was_solved_before_a_process_refuses_or_is_stopped_is_left(
    runners: dict[int, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: Exception, refused: str
) -> None:
    monkeypatch.setattr(Runner, "error", error)
    assert answer(tmp_path) == (["key1"], refused)


def test_a_process_is_kept_for_the_next_batch_of_the_same_plan_only(runners: dict[int, Any], tmp_path: Path) -> None:
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
