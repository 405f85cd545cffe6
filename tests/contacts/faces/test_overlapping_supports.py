"""Pieces of contact that two interfaces hold, and blocks between two others."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import Contacts, find_contacts
from mbla.contacts.contacts import ContactsRefused
from mbla.model.model import Ground, Model
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra
from tests.contacts.structures import (
    any_rotation,
    blocks_of,
    boxes,
    contacts_of,
    ground,
    model_of,
    moved,
    profile,
    section,
)
from tests.line import line_of_file, load_factor

BLOCK = ([0, 0, 0], [2, 2, 0.5])
HALF = ([-1, -1, -1], [1, 3, 0])
AMID = ([0.5, 0.5, -1], [1.5, 1.5, 0])
"""Footings under half of the block, and amid its base."""


def found(shapes: Sequence[tuple[Sequence[float], Sequence[float]]], grounds: tuple[Ground, ...]) -> Contacts:
    """Contacts of blocks of which all but the first are fixed."""
    return find_contacts(_model(boxes(*shapes), grounds), section())


def _model(shapes: Polyhedra, grounds: tuple[Ground, ...]) -> Model:
    names = ["block", *["footing"] * (len(shapes) - 1)]
    return model_of(blocks_of(shapes, names), fixed=range(1, len(shapes)), grounds=grounds)


def on(contacts: Contacts) -> list[tuple[int, int, float]]:
    return [(int(a), int(b), round(area, 9)) for (a, b), area in zip(contacts.bodies, contacts.areas, strict=True)]


@pytest.mark.parametrize("count", [2, 3])
def test_a_ground_given_again_holds_nothing(count: int) -> None:
    contacts = found([BLOCK], (ground(),) * count)
    assert on(contacts) == [(1, 0, 4.0)]
    told = [notice.message for notice in contacts.report.notices if notice.identifier == "supports-in-one-plane"]
    assert told[0].startswith("ground and ground hold the same piece of a face of block[0]")


@pytest.mark.parametrize(
    ("footing", "pieces"),
    [
        (HALF, [(0, 1, 2.0), (2, 0, 2.0)]),
        (AMID, [(0, 1, 1.0), (2, 0, 3.0)]),
        (([-1, -1, -1], [3, 3, 0]), [(0, 1, 4.0)]),
    ],
)
def test_a_footing_has_its_piece_and_the_ground_the_rest(
    footing: tuple[list[float], list[float]], pieces: list[tuple[int, int, float]]
) -> None:
    assert on(found([BLOCK, footing], (ground(blocks=[0]),))) == pieces


def test_a_strip_no_wider_than_the_tolerance_is_not_left_over() -> None:
    contacts = found([BLOCK, ([-1, -1, -1], [1.9995, 3, 0])], (ground(),))
    ((*bodies, area),) = on(contacts)
    assert bodies == [0, 1]
    assert area == pytest.approx(1.9995 * 2)


def test_a_wall_and_a_floor_hold_different_faces() -> None:
    contacts = found([BLOCK], (ground(), ground(normal=(1, 0, 0))))
    assert on(contacts) == [(1, 0, 4.0), (2, 0, 1.0)]
    assert not [notice for notice in contacts.report.notices if notice.identifier == "supports-in-one-plane"]


@pytest.mark.parametrize("shapes", [[BLOCK], [BLOCK, HALF]])
def test_different_joints_are_refused(shapes: list[tuple[list[float], list[float]]]) -> None:
    grounds = (ground(), ground(joint="lead"))
    with pytest.raises(ContactsRefused, match=r"by different joints, dry and lead: leave one of them out"):
        found(shapes, grounds)


DECK = """\
mbla: 1
materials: {stone: {density: 2000}}
joints: {mortar: {friction: 0.5, cohesion: 1000, tensile_strength: 400}}
blocks:
  - box: {group: footing, material: stone, min: [-1, -1, -1], max: [1, 3, 0]}
  - box: {group: block, material: stone, min: [0, 0, 0], max: [2, 2, 0.5]}
contacts: {joint: mortar}
supports: [{blocks: footing}, {ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
analysis: {flow_rule: associative}
"""


@pytest.mark.parametrize("height", [0.5, 8.0])
def test_strengths_of_a_face_in_pieces_are_those_of_the_face(height: float) -> None:
    tall, alone = f"blocks.1.box.max.2={height}", ("supports=[{blocks: footing}]", "blocks.0.box.max.0=3")
    assert load_factor(DECK, tall) == pytest.approx(load_factor(DECK, tall, *alone), rel=1e-7)


TABLE = """\
interface,group_a,index_a,group_b,index_b,x,y,z
bed,footing,0,block,0,0,0,0
bed,footing,0,block,0,1,0,0
bed,footing,0,block,0,1,2,0
bed,footing,0,block,0,0,2,0
soil,ground,0,block,0,0,0,0
soil,ground,0,block,0,2,0,0
soil,ground,0,block,0,2,2,0
soil,ground,0,block,0,0,2,0
"""


def test_interfaces_that_a_table_gives_count_once_too(tmp_path: Path) -> None:
    (tmp_path / "joints.csv").write_text(TABLE)
    (tmp_path / "deck.yaml").write_text(DECK)
    line = line_of_file(tmp_path / "deck.yaml", "contacts.table=joints.csv")
    assert on(line.contacts) == [(0, 1, 2.0), (2, 1, 2.0)]


# Thin blocks between others: only they are touched, not what lies behind them.


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


@pytest.mark.parametrize("others", range(7))
def test_a_thin_block_is_between_those_on_one_side_of_it_alone(others: int) -> None:
    """The lower of two plates lies just above the ground: the upper one, behind it, does not hold it off."""
    plates = boxes(([0, 0, 1e-4], [1, 1, 1.5e-4]), ([0, 0, 1.5e-4], [1, 1, 2.5e-4]))
    far_away = [boxes(([10 + 2 * i, 0, 5], [11 + 2 * i, 1, 6])) for i in range(others)]
    contacts = contacts_of(join_polyhedra([plates, *far_away]), grounds=(ground(),), tolerance=1e-2)
    assert pairs(contacts) == [[0, 1], [2 + others, 0]]
