"""Which pairs of blocks and of facets are looked at: those within ten tolerances of each other, and no others."""

from __future__ import annotations

from collections.abc import Sequence
from importlib import import_module

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.contacts.broad_phase import (
    BlockPairs,
    block_boxes,
    find_block_pairs,
    find_facet_pairs,
    opposite,
)
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.facets import build_facets
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polyhedra import join_polyhedra, polyhedra_from_lists
from tests.contacts.structures import blocks_of, boxes, profile

TOLERANCE = 0.01
CUBE = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
Box = tuple[Sequence[float], Sequence[float]]


def cube_at(corner: Sequence[float] | FloatArray, size: float = 1.0) -> Box:
    least = [float(place) for place in corner]
    return least, [place + size for place in least]


def pairs_of(*extremes: Box) -> BlockPairs:
    return find_block_pairs(blocks_of(boxes(*extremes)), TOLERANCE)


def facet_pairs(blocks: Blocks, tolerance: float = TOLERANCE) -> list[tuple[list[float], list[float]]]:
    """Normals of the facets that are paired."""
    facets = build_facets(blocks)
    found, pair = find_facet_pairs(blocks, facets, find_block_pairs(blocks, tolerance), tolerance)
    assert np.all(np.diff(pair) >= 0)
    return [(facets.normals[a].round(6).tolist(), facets.normals[b].round(6).tolist()) for a, b in found]


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize(
    ("size", "gap", "near"), [(1.0, 0.0999, True), (1.0, 0.1001, False), (0.5, 0.0499, True), (0.5, 0.0501, False)]
)
def test_reach_is_ten_tolerances_of_the_smaller_block(axis: int, size: float, gap: float, near: bool) -> None:
    corner = np.zeros(3)
    corner[axis] = 1.0 + gap
    for extremes in ((CUBE, cube_at(corner, size)), (cube_at(corner, size), CUBE)):
        found = pairs_of(*extremes)
        assert len(found) == near
        if near:
            assert found.blocks.tolist() == [[0, 1]]
            assert found.sizes == pytest.approx([size])
            assert found.box_depths == pytest.approx([-gap])


def test_boxes_overlap_by_the_least_along_an_axis() -> None:
    for offset in ((0.8, 0.5, 0.3), (0.3, 0.8, 0.5), (-0.5, 0.3, -0.8)):
        assert pairs_of(CUBE, cube_at(offset)).box_depths == pytest.approx([0.2])


def test_pairs_are_sorted_and_each_is_there_once() -> None:
    row = [cube_at((float(x), 0.0, 0.0)) for x in (2, 0, 3, 1)]
    assert pairs_of(*row).blocks.tolist() == [[0, 2], [0, 3], [1, 3]]


def test_boxes_of_blocks() -> None:
    lower, upper = block_boxes(blocks_of(boxes(CUBE, ((1, -2, 3), (2, 5, 4)))))
    assert lower.tolist() == [[0, 0, 0], [1, -2, 3]]
    assert upper.tolist() == [[1, 1, 1], [2, 5, 4]]


def test_crowds_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def most_pairs(blocks: int) -> int:
        asked.append(blocks)
        return 2

    monkeypatch.setattr(import_module("mbla.contacts.broad_phase"), "most_pairs", most_pairs)
    near = [cube_at((0.1 * x, 0.0, 0.0)) for x in range(3)]
    assert len(pairs_of(*near[:2])) == 1
    with pytest.raises(ContactsRefused) as refused:
        pairs_of(*near)
    assert refused.value.message.identifier == "too-many-units"
    assert str(refused.value) == (
        "many blocks lie in one place, as block[0]: more than 2 pairs come near each other; no more can be handled"
    )
    assert asked == [2, 3]


@pytest.mark.parametrize(("angle", "faces"), [(0.0, True), (29.9, True), (30.1, False), (90.0, False), (180.0, False)])
def test_facets_that_face_each_other(angle: float, faces: bool) -> None:
    turned = np.radians(angle)
    other = np.array([[np.sin(turned), 0.0, -np.cos(turned)]])
    assert opposite(np.array([[0.0, 0.0, 1.0]]), other).tolist() == [faces]


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize(("gap", "near"), [(-0.0999, True), (0.0999, True), (0.1001, False), (-0.1001, False)])
def test_facets_face_to_face(axis: int, gap: float, near: bool) -> None:
    corner = np.full(3, 0.25)
    corner[axis] = 1.0 + gap
    up = np.eye(3)[axis].tolist()
    found = facet_pairs(blocks_of(boxes(CUBE, cube_at(corner))))
    assert found == ([(up, [-part if part else 0.0 for part in up])] if near else [])


@pytest.mark.parametrize(("aside", "near"), [(1.0999, True), (1.1001, False), (-1.0999, True), (-1.1001, False)])
def test_facets_beside_each_other(aside: float, near: bool) -> None:
    """The upper cube stands beside the lower one's top: its box is near, and so is the top's."""
    found = facet_pairs(blocks_of(boxes(CUBE, cube_at((aside, 0.0, 1.0)))))
    assert (([0.0, 0.0, 1.0], [0.0, 0.0, -1.0]) in found) == near


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_blocks_that_touch_are_looked_at_however_small_the_tolerance(axis: int) -> None:
    up = np.eye(3)[axis]
    found = facet_pairs(blocks_of(boxes(CUBE, cube_at(up))), 1e-20)
    assert found == [(up.tolist(), [-part if part else 0.0 for part in up.tolist()])]


def test_facets_far_from_each_other_are_no_pair_though_each_is_near_the_other_block() -> None:
    """Two blocks with two feet each stand on each other's feet, one pair of them a little higher than the other."""
    feet = [(0, 1), (1, 1), (1, 0), (2, 0), (2, 1.02), (3, 1.02)]
    lower, upper = (
        profile([(0, -1), (3, -1), *feet[::-1]]),
        profile([*feet[:2], (1, 2), (2, 2), *feet[4:], (3, 3), (0, 3)]),
    )
    found = facet_pairs(blocks_of(join_polyhedra([lower, upper])))
    assert found == 2 * [([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])]


def wedge(slope: float, lift: float) -> Blocks:
    """The unit cube, and on it a block with a bottom that rises along x."""
    low, high = 1.0 + lift, 1.0 + lift + slope
    corners = [[0, 0, low], [1, 0, high], [1, 1, high], [0, 1, low], [0, 0, 2.5], [1, 0, 2.5], [1, 1, 2.5], [0, 1, 2.5]]
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
    cube = [[x, y, z] for z in (0, 1) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1))]
    return blocks_of(polyhedra_from_lists([cube, corners], [faces, faces]))


@pytest.mark.parametrize(("lift", "near"), [(-0.3, True), (0.0, True), (0.05, True), (0.3, False), (-0.9, False)])
def test_planes_that_are_not_parallel_are_near_where_they_meet(lift: float, near: bool) -> None:
    """Amid the facets the planes are 0.25 + lift apart; over half a diagonal the slope takes up some 0.35."""
    found = facet_pairs(wedge(0.5, lift))
    assert any(a == [0.0, 0.0, 1.0] and b[2] < -0.8 for a, b in found) == near
