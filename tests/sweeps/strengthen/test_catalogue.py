"""Capacities that there are: of a catalogue, and sums of these."""

from __future__ import annotations

from itertools import combinations_with_replacement

import numpy as np
import pytest

from mbla.sweeps.strengthen.catalogue import greatest_there, rounded_up

KIPS = [3 * 4448.2216, 5 * 4448.2216, 8 * 4448.2216]
"""in N: no multiples of anything that a computer writes exactly"""


def one(capacity: float, catalogue: list[float], most: float = np.inf) -> float:
    """What one capacity is rounded up to."""
    return float(rounded_up(np.array([capacity]), catalogue, greatest_there(np.array([most]), catalogue))[0])


def test_up_to_the_greatest_the_next_one_is_taken() -> None:
    capacities = np.array([0.0, 1.0, 10.0, 10.1, 49.9, 50.0])
    found = rounded_up(capacities, [10.0, 20.0, 50.0], np.full(6, np.inf))
    assert found.tolist() == [0.0, 10.0, 10.0, 20.0, 50.0, 50.0]


def test_without_a_catalogue_there_is_any_up_to_the_greatest_allowed() -> None:
    most = np.array([np.inf, 1.0])
    assert greatest_there(most, None).tolist() == most.tolist()
    assert rounded_up(np.array([2.0, 1.0]), None, most) == pytest.approx([2.0, 1.0], rel=1e-3)


@pytest.mark.parametrize(
    ("capacity", "catalogue", "found"),
    [
        (12806, [5000, 10000], 15000),
        (120, [10, 20, 50], 120),
        (12, [6, 10], 12),  # without the greatest
        (81, [9, 10], 81),
        (72, [9, 10], 72),
        (71, [9, 10], 72),
        (30.1, [10], 40),
        (30 * (1 + 1e-9), [10], 30),
    ],
)
def test_above_the_greatest_the_least_sum_is_taken(capacity: float, catalogue: list[float], found: float) -> None:
    assert one(capacity, catalogue) == pytest.approx(found, rel=1e-12)


def test_all_sums_are_those_of_trying_all() -> None:
    sums = sorted({sum(some) for count in range(1, 10) for some in combinations_with_replacement(KIPS, count)})
    needed = np.random.default_rng(1).uniform(KIPS[-1], 3 * KIPS[-1], 50)
    least = [next(each for each in sums if each >= capacity) for capacity in needed]
    greatest = [next(each for each in reversed(sums) if each <= capacity) for capacity in needed]
    assert rounded_up(needed, KIPS, np.full(50, np.inf)) == pytest.approx(least, rel=1e-9)
    assert greatest_there(needed, KIPS) == pytest.approx(greatest, rel=1e-9)


def test_the_greatest_allowed_is_the_greatest_sum_of_what_is_allowed() -> None:
    most = np.array([np.inf, 25.0, 50.0, 120.0, 129.0])
    assert greatest_there(most, [10.0, 20.0, 50.0]).tolist() == [np.inf, 20.0, 50.0, 120.0, 120.0]
    assert greatest_there(np.array([25.0]), [10.0, 30.0]).tolist() == [20.0]


def test_what_is_not_allowed_is_not_taken() -> None:
    assert one(12.0, [10.0, 30.0], 25.0) == 20.0
    assert one(12.0, [5.0, 10.0, 30.0], 25.0) == 15.0
    assert one(99.0, [10.0, 30.0], 25.0) == 20.0
