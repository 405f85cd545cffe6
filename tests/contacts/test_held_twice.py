from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.contacts import Contacts, find_contacts
from mbla.contacts.contacts import ContactsRefused
from mbla.model.model import Ground, Model
from mbla.model.solids.polyhedra import Polyhedra
from tests.contacts.structures import blocks_of, boxes, ground, model_of, section
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


@pytest.mark.parametrize("angle", [0.0, 17.0, 80.0])
def test_the_same_in_inclined_planes(angle: float) -> None:
    t = np.radians(angle)
    turn = np.array([[np.cos(t), 0, np.sin(t)], [0, 1, 0], [-np.sin(t), 0, np.cos(t)]])
    shapes = boxes(BLOCK, HALF)
    shapes = replace(shapes, vertices=shapes.vertices @ turn.T)
    contacts = find_contacts(_model(shapes, (ground(normal=(np.sin(t), 0, np.cos(t))),)), section())
    assert on(contacts) == [(0, 1, 2.0), (2, 0, 2.0)]


def test_planes_that_differ_by_less_than_the_tolerance_are_one() -> None:
    contacts = found([BLOCK], (ground(), ground(point=(0, 0, -2e-4), normal=(2e-4, 0, 1))))
    ((*bodies, area),) = on(contacts)
    assert bodies == [1, 0]
    assert area == pytest.approx(4.0)


def test_a_wall_and_a_floor_hold_different_faces() -> None:
    contacts = found([BLOCK], (ground(), ground(normal=(1, 0, 0))))
    assert on(contacts) == [(1, 0, 4.0), (2, 0, 1.0)]
    assert not [notice for notice in contacts.report.notices if notice.identifier == "supports-in-one-plane"]


@pytest.mark.parametrize("shapes", [[BLOCK], [BLOCK, HALF]])
def test_different_joints_are_refused(shapes: list[tuple[list[float], list[float]]]) -> None:
    grounds = (ground(), ground(joint="lead"))
    with pytest.raises(ContactsRefused, match=r"by different joints, dry and lead: leave one of them out"):
        found(shapes, grounds)


def test_an_open_joint_leaves_the_piece_to_the_other_support() -> None:
    model = _model(boxes(BLOCK, HALF), (ground(joint="lead"),))
    with pytest.raises(ContactsRefused, match=r"footing\[0\] and ground hold .* or leave out one of the two"):
        find_contacts(model, section())
    contacts = find_contacts(model, section(overrides=[("block", "footing", "open")]))
    assert on(contacts) == [(2, 0, 4.0)]


def test_a_block_that_can_move_does_not_share_with_a_ground() -> None:
    blocks = blocks_of(boxes(BLOCK, HALF), ["block", "slab"])
    with pytest.raises(ContactsRefused, match=r"slab\[0\] and ground hold .*, slab\[0\] can move: "):
        find_contacts(model_of(blocks, grounds=(ground(blocks=[0]),)), section())


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
