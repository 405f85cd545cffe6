"""Thin blocks between others: only they are touched, not what lies behind them."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.contacts import Contacts
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra
from tests.contacts.structures import any_rotation, boxes, contacts_of, ground, moved, profile

HEIGHTS = (1e-2, 1e-3, 1e-5, 1e-7, 1e-9)


def pairs(contacts: Contacts) -> list[list[int]]:
    return [[int(body) for body in pair] for pair in contacts.bodies]


def said(contacts: Contacts) -> dict[str, str]:
    return {notice.identifier: notice.message for notice in contacts.report.notices}


def on_foot(height: float, side: float = 0.2) -> Polyhedra:
    half = side / 2
    return boxes(([-half, -half, 0], [half, half, height]), ([-0.5, -0.5, height], [0.5, 0.5, 1 + height]))


@pytest.mark.parametrize("height", HEIGHTS)
@pytest.mark.parametrize("side", [0.2, 1.0])
def test_block_on_a_thin_foot_does_not_touch_the_ground(height: float, side: float) -> None:
    contacts = contacts_of(on_foot(height, side), grounds=(ground(),))
    assert pairs(contacts) == [[0, 1], [2, 0]]
    assert contacts.areas == pytest.approx([side**2, side**2])
    assert ("thin-block-between" in said(contacts)) == (height <= 1e-3)


@pytest.mark.parametrize("height", HEIGHTS)
@pytest.mark.parametrize("turned", [False, True])
def test_block_on_a_thin_foot_on_a_block(height: float, turned: bool) -> None:
    below = boxes(([-0.5, -0.5, -1], [0.5, 0.5, 0]))
    pile = join_polyhedra([below, on_foot(height)])
    if turned and height >= 1e-7:  # turned, coordinates are rounded by 1e-16
        pile = moved(pile, turn=any_rotation(3))
    assert pairs(contacts_of(pile, fixed=[0])) == [[0, 1], [1, 2]]


@pytest.mark.parametrize("thickness", [1e-3, 1e-4, 1e-6])
def test_plates_on_each_other_touch_their_neighbours_alone(thickness: float) -> None:
    """Thinner than their own tolerance: the top of one and the bottom of the one below see each other through both."""
    plates = boxes(*(([0, 0, thickness * i], [1, 1, thickness * (i + 1)]) for i in range(6)))
    block = boxes(([0, 0, 6 * thickness], [1, 1, 1 + 6 * thickness]))
    contacts = contacts_of(join_polyhedra([plates, block]), grounds=(ground(),))
    assert pairs(contacts) == [[0, 1], [1, 2], [2, 3], [3, 4], [4, 5], [5, 6], [7, 0]]
    assert contacts.normals == pytest.approx(np.tile([0.0, 0.0, 1.0], (7, 1)))


def test_flange_of_a_thick_block_keeps_its_neighbours_apart() -> None:
    """The third block is thick beside the joint, and only its flange of 1e-4 lies in it."""
    lower, upper = boxes(([0, 0, -1], [1, 1, 0])), boxes(([0, 0, 1e-4], [1, 1, 1]))
    outline = [(-0.5, -1), (0, -1), (0, 0), (0.4, 0), (0.4, 1e-4), (0, 1e-4), (0, 1), (-0.5, 1)]
    contacts = contacts_of(join_polyhedra([lower, upper, profile(outline)]), fixed=[0])
    assert [0, 1] not in pairs(contacts)
    assert "thin-block-between" in said(contacts)


def test_gap_of_rounding_beside_a_block_stays_a_contact() -> None:
    """Two piers, one 1e-4 lower than the other: the lintel rests on both."""
    piers = boxes(([0, 0, 0], [1, 1, 1]), ([1, 0, 0], [2, 1, 1 - 1e-4]))
    contacts = contacts_of(join_polyhedra([piers, boxes(([0, 0, 1], [2, 1, 2]))]), grounds=(ground(),))
    assert [0, 2] in pairs(contacts)
    assert [1, 2] in pairs(contacts)
    assert "thin-block-between" not in said(contacts)


@pytest.mark.parametrize(("depth", "rests_on"), [(0.4, "plate"), (0.6, "ground")])
def test_a_plate_that_has_sunk_into_the_block_above_by_more_than_half_carries_nothing(
    depth: float, rests_on: str
) -> None:
    """Sunk that far it is no block between: what is around it is the ground."""
    thickness = 1e-5
    plate = boxes(([-0.1, -0.1, 0], [0.1, 0.1, thickness]))
    block = boxes(([-0.5, -0.5, (1 - depth) * thickness], [0.5, 0.5, 1]))
    contacts = contacts_of(join_polyhedra([plate, block]), grounds=(ground(),))
    assert pairs(contacts) == ([[0, 1], [2, 0]] if rests_on == "plate" else [[2, 0], [2, 1]])


def test_a_block_that_has_sunk_into_the_ground_by_less_than_the_tolerance_rests_on_it() -> None:
    contacts = contacts_of(boxes(([0, 0, -5e-4], [1, 1, 1])), grounds=(ground(),))
    assert pairs(contacts) == [[1, 0]]
    assert contacts.areas == pytest.approx([1.0])


@pytest.mark.parametrize("scale", [0.01, 1.0, 1000.0])
def test_feet_at_the_edge_of_a_block_hold_it_off_the_ground_in_any_unit(scale: float) -> None:
    block = boxes(([-5, -5, 1e-3], [5, 5, 10]))
    feet = boxes(([3, -1, 0], [5, 1, 1e-3]), ([-5, -1, 0], [-3, 1, 1e-3]))
    contacts = contacts_of(moved(join_polyhedra([block, feet]), scale=scale), grounds=(ground(),))
    assert pairs(contacts) == [[0, 1], [0, 2], [3, 1], [3, 2]]


@pytest.mark.parametrize("others", range(7))
def test_a_thin_block_is_between_those_on_one_side_of_it_alone(others: int) -> None:
    """The lower of two plates lies just above the ground: the upper one, behind it, does not hold it off."""
    plates = boxes(([0, 0, 1e-4], [1, 1, 1.5e-4]), ([0, 0, 1.5e-4], [1, 1, 2.5e-4]))
    far_away = [boxes(([10 + 2 * i, 0, 5], [11 + 2 * i, 1, 6])) for i in range(others)]
    contacts = contacts_of(join_polyhedra([plates, *far_away]), grounds=(ground(),), tolerance=1e-2)
    assert pairs(contacts) == [[0, 1], [2 + others, 0]]


def test_the_pair_farthest_apart_is_told() -> None:
    """A small pair with a wide gap for its size, and a large one with a wider one."""
    small, large = on_foot(2e-3, 0.2), on_foot(1e-3, 0.2)
    both = join_polyhedra([moved(small, scale=0.25), moved(large, shift=[5.0, 0.0, 0.0])])
    told = said(contacts_of(both, grounds=(ground(),), tolerance=4e-3))["thin-block-between"]
    assert told.startswith("2 common surfaces within the tolerance left out")
    assert "ground and block[3] stand 0.001 m, 0.001 of the block size apart on block[2], and others" in told
