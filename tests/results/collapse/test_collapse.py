"""What is found once and kept, and the block that falls first."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest

from mbla.results.collapse.collapse import fall_of, kept
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.results import Results
from tests.results.synthetic import tower_results


@dataclass(frozen=True)
class Record:
    value: int


def test_found_once_for_the_same_records_and_anew_for_others() -> None:
    calls = []

    @kept
    def doubled(record: Record, times: int) -> int:
        calls.append(times)
        return times * record.value

    one, equal = Record(3), Record(3)
    assert [doubled(one, 2), doubled(one, 2), doubled(one, 4), doubled(equal, 2)] == [6, 6, 12, 6]
    assert calls == [2, 4, 2]


def test_nothing_is_kept_of_records_that_are_gone() -> None:
    """Their identities are given to others, whose results would be wrong."""

    @kept
    def value(record: Record) -> int:
        return record.value

    found = []
    for number in range(100):
        found.append(value(Record(number)))
    assert found == list(range(100))


# ---  ---------------------------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def mode_between(results: Results, bodies: set[int], motion: np.ndarray) -> int:
    """Mode of the interface of two bodies."""
    contacts = results.contacts
    row = next(i for i, pair in enumerate(contacts.bodies.tolist()) if set(pair) == bodies)
    return int(fall_of(results.assembly, results.cases[0].load_case, motion)[0].interfaces.modes[row])


@pytest.mark.parametrize(
    ("velocity", "mode"),
    [((0, 0, 1), InterfaceMode.OPEN), ((1, 0, 0), InterfaceMode.SLIDE), ((0, 0, 0), InterfaceMode.STICK)],
)
def test_a_block_that_rises_leaves_a_gap_and_one_that_slips_does_not(
    results: Results, velocity: tuple[float, float, float], mode: InterfaceMode
) -> None:
    motion = np.zeros((3, 6))
    motion[1, :3] = velocity
    assert mode_between(results, {0, 1}, motion) == mode


def test_lift_by_sliding_is_no_gap_but_more_is(results: Results) -> None:
    contacts, model = results.contacts, results.model
    row = next(i for i, pair in enumerate(contacts.bodies.tolist()) if set(pair) == {0, 1})
    friction = model.joints[contacts.joint_names[contacts.joints[row]]].friction
    motion = np.zeros((3, 6))
    motion[1, :3] = 1.0, 0.0, friction
    assert mode_between(results, {0, 1}, motion) == InterfaceMode.SLIDE
    motion[1, 2] = friction + 2.0
    assert mode_between(results, {0, 1}, motion) == InterfaceMode.OPEN
