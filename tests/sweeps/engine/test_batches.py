"""How tasks are portioned out, and what is given up."""

from __future__ import annotations

import pytest

from mbla.sweeps.engine.cluster import MOST, Batches
from mbla.sweeps.plan import DONE, Outcome, Task
from tests.sweeps.small_plan import frictions


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
