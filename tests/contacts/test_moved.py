"""Contacts of blocks that have moved, and the gaps of their points."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from mbla.assembly import build_assembly
from mbla.contacts.carried import Touching
from mbla.contacts.moved import MovedSearch
from mbla.contacts.search import find_contacts
from mbla.deck import read_deck
from mbla.model import build_model
from mbla.model.model import Model, PrescribedInterfaces
from mbla.model.pose import Pose, paths_of
from tests.contacts.structures import blocks_of, boxes, ground, model_of, section

DECK = """
mbla: 1
materials: {stone: {density: 2000}}
joints: {dry: {friction: 0.6}}
contacts: {joint: dry}
blocks:
  - box: {material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {material: stone, min: [1, 0, 1], max: [2, 1, 2]}
  - box: {material: stone, min: [1, 0, 0], max: [3, 1, 1]}
supports: [{ground: {z: 0}}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""


@pytest.fixture
def searched(tmp_path: Path) -> tuple[Model, MovedSearch]:
    """Two blocks beside each other, 0 and 2, and block 1 on block 2."""
    (path := tmp_path / "deck.yaml").write_text(DECK, encoding="utf-8")
    deck = read_deck(path)
    model = build_model(deck)
    return model, MovedSearch(model, build_assembly(deck, model).contacts, deck.contacts)


def moved(model: Model, shift: list[float], turn: list[float]) -> Pose:
    """Block 1 elsewhere; m, rotation vector."""
    pose = Pose.at_rest(len(model.blocks))
    shifts, rotations = pose.shift.copy(), pose.rotation.copy()
    shifts[1], rotations[1] = shift, paths_of(np.array([turn]))[0][0]
    return Pose(shifts, rotations)


@pytest.mark.parametrize(("along", "faces"), [(3e-4, 0), (0.01, 1)])
def test_faces_beside_a_joint_that_presses_are_no_contact(
    searched: tuple[Model, MovedSearch], along: float, faces: int
) -> None:
    """Block 1 presses on block 2 and slides over block 0: their sides share the overlap, and overlap by the slide."""
    model, search = searched
    found = search.at(moved(model, [-along, 0.0, -1e-5], [0.0, 0.0, 0.0])).contacts
    between = {tuple(pair) for pair in found.bodies.tolist()}
    assert ((0, 1) in between) is (faces > 0)
    assert (np.abs(found.normals[(found.bodies == [0, 1]).all(axis=1)] @ [0.0, 0.0, 1.0]) > 0.99).sum() == faces


def test_gaps_are_distances_from_the_face_of_the_host_wherever_points_slide(
    searched: tuple[Model, MovedSearch],
) -> None:
    """Block 1 stands on an edge at 0.02 rad, then slides by 0.03 m along the face below."""
    model, search = searched
    tilted = moved(model, [0.1, 0.0, 0.0101], [0.0, 0.02, 0.0])
    found = search.at(tilted)
    blocks = model.blocks
    touching = Touching.found(blocks.centroids, blocks.sizes, search.to_corners(found, tilted), found, tilted)
    own = (touching.points.bodies == [1, 2]).all(axis=1)
    assert own.sum() == 4
    slid = replace(tilted, shift=tilted.shift + np.array([0.03, 0.0, 0.0]) * (np.arange(3) == 1)[:, None])
    before, after = (touching.points.at(pose).offsets[own, 0] for pose in (tilted, slid))
    corners = np.array([[1.0, y, 1.0] for y in (0.0, 1.0)] + [[2.0, y, 1.0] for y in (0.0, 1.0)]) - blocks.centroids[1]
    heights = (corners @ tilted.rotation[1].T + blocks.centroids[1] + tilted.shift[1])[:, 2] - 1.0
    assert np.sort(before) == pytest.approx(np.sort(heights), abs=1e-12)
    assert after == pytest.approx(before, abs=1e-12)


def test_joint_laws_of_a_table_hold_wherever_blocks_have_moved() -> None:
    """Two blocks share the end of a long one and stand beside it on the ground; the table has two of the laws."""
    extremes = [
        ([0.0, 0.0, 0.0], [1.0, 2.0, 1.0]),
        ([1.0, 0.0, 0.0], [2.0, 1.0, 1.0]),
        ([1.0, 1.0, 0.0], [2.0, 2.0, 1.0]),
    ]
    model = model_of(blocks_of(boxes(*extremes)), grounds=(ground(),))
    beside = [[[1.0, y, 0.0], [1.0, y + 1.0, 0.0], [1.0, y + 1.0, 1.0], [1.0, y, 1.0]] for y in (0.0, 1.0)]
    below = [[1.0, 1.0, 0.0], [2.0, 1.0, 0.0], [2.0, 2.0, 0.0], [1.0, 2.0, 0.0]]
    given = PrescribedInterfaces(
        bodies=np.array([[0, 1], [0, 2], [3, 2]]),
        normals=np.array([[1.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
        corners=np.array([*beside[0], *beside[1], *below]),
        corner_start=np.array([0, 4, 8, 12]),
        joints=("mortar", "", "lead"),
    )
    model = replace(model, interfaces=given)
    found = MovedSearch(model, find_contacts(model, section()), section()).at(moved(model, [0.01, 0.0, 0.0], [0.0] * 3))
    contacts = found.contacts
    named = [contacts.joint_names[law] for law in contacts.joints]
    laws = dict(zip(map(tuple, contacts.bodies.tolist()), named, strict=True))
    assert laws == {(0, 1): "mortar", (0, 2): "dry", (1, 2): "dry", (3, 0): "dry", (3, 1): "dry", (3, 2): "lead"}
