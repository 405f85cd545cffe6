"""Which pairs of blocks and of facets are looked at: those within ten tolerances of each other, and no others."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
import pytest
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.faces.broad_phase import MOST_PAIRS, NEAR_MISS, are_opposite, find_block_pairs, find_facet_pairs
from mbla.contacts.faces.facets import build_facets
from mbla.contacts.faces.narrow_phase import Patches, find_patches, judge
from mbla.contacts.outlines.overlay import Overlays
from mbla.contacts.search import patches_of_prescribed
from mbla.model.model import PrescribedInterfaces
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polyhedra import join_polyhedra
from tests.contacts.structures import blocks_of, boxes, ground, model_of, profile

TOLERANCE = 0.01
CUBE = ((0.0, 0.0, 0.0), (1.0, 1.0, 1.0))
Box = tuple[Sequence[float], Sequence[float]]


def cube_at(corner: Sequence[float] | FloatArray, size: float = 1.0) -> Box:
    least = [float(place) for place in corner]
    return least, [place + size for place in least]


def pairs_of(*extremes: Box) -> IntArray:
    return find_block_pairs(blocks_of(boxes(*extremes)), TOLERANCE)


def facet_pairs(blocks: Blocks, tolerance: float = TOLERANCE) -> list[tuple[list[float], list[float]]]:
    """Normals of the facets that are paired."""
    facets = build_facets(blocks)
    found = find_facet_pairs(blocks, facets, (), NEAR_MISS * tolerance, are_opposite)
    return [(facets.normals[a].round(6).tolist(), facets.normals[b].round(6).tolist()) for a, b in found]


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize(
    ("size", "depth", "deep"), [(1.0, 0.0101, 1), (1.0, 0.0099, 0), (0.5, 0.0051, 1), (0.5, 0.0049, 0)]
)
def test_boxes_share_more_than_the_tolerance_of_the_smaller_block(
    axis: int, size: float, depth: float, deep: int
) -> None:
    corner = np.zeros(3)
    corner[axis] = 1.0 - depth
    for extremes in ((CUBE, cube_at(corner, size)), (cube_at(corner, size), CUBE)):
        assert pairs_of(*extremes).tolist() == [[0, 1]] * deep


def test_crowds_are_refused() -> None:
    near = [cube_at((0.001 * x, 0.0, 0.0)) for x in range(int(math.sqrt(2 * MOST_PAIRS)) + 2)]
    assert len(pairs_of(*near[:2])) == 1
    with pytest.raises(ContactsRefused) as refused:
        pairs_of(*near)
    assert refused.value.message.identifier == "too-many-units"


@pytest.mark.parametrize("axis", [0, 1, 2])
@pytest.mark.parametrize(("gap", "near"), [(-0.0999, True), (0.0999, True), (0.1001, False), (-0.1001, False)])
def test_facets_face_to_face(axis: int, gap: float, near: bool) -> None:
    corner = np.full(3, 0.25)
    corner[axis] = 1.0 + gap
    up = np.eye(3)[axis].tolist()
    found = facet_pairs(blocks_of(boxes(CUBE, cube_at(corner))))
    assert found == ([(up, [-part if part else 0.0 for part in up])] if near else [])


def test_facets_far_from_each_other_are_no_pair_though_each_is_near_the_other_block() -> None:
    """Two blocks with two feet each stand on each other's feet, one pair of them a little higher than the other."""
    feet = [(0, 1), (1, 1), (1, 0), (2, 0), (2, 1.02), (3, 1.02)]
    lower, upper = (
        profile([(0, -1), (3, -1), *feet[::-1]]),
        profile([*feet[:2], (1, 2), (2, 2), *feet[4:], (3, 3), (0, 3)]),
    )
    found = facet_pairs(blocks_of(join_polyhedra([lower, upper])))
    assert found == 2 * [([0.0, 0.0, 1.0], [0.0, 0.0, -1.0])]


# What becomes of common surfaces, by their width, gap and share of the facet; and surfaces that the deck gives.


def patch(width: float, low: float, high: float, coverage: float = 0.1) -> Patches:
    """One surface with a gap from low to high."""
    nothing = np.zeros((1, 2), dtype=np.int64)
    overlays = Overlays(nothing, nothing, np.zeros((1, 3)), np.eye(3)[None], np.ones(1), np.zeros((1, 3)))
    gap = high if high >= -low else low
    middle = np.array([(high + low) / 2])
    polygons = np.array([shapely.box(0, 0, 1, width)], dtype=object)
    return Patches(overlays, polygons, np.array([width]), np.array([gap]), middle, np.array([coverage]))


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize(
    ("width", "gap", "coverage", "verdict"),
    [
        (0.0101, 0.0, 0.1, "contacts"),
        (0.01, 0.01, 0.1, "contacts"),
        (0.0101, 0.009999, 0.1, "contacts"),
        (0.0101, 0.010001, 0.1, "near_misses"),
        (0.0099, 0.009999, 0.1, "slivers"),
        (0.0099, 0.009999, 0.49, "slivers"),
        (0.0099, 0.009999, 0.5, "contacts"),
        (1.01e-5, 0.0, 0.1, "slivers"),
        (1.01e-5, 0.0, 0.5, "contacts"),
        (0.99e-5, 0.0, 0.1, ""),
        (0.99e-5, 0.0, 1.0, ""),
        (0.0101, 0.09999, 0.1, "near_misses"),
        (0.0101, 0.10001, 0.1, ""),
        (0.0099, 0.05, 0.1, ""),
        (0.0099, 0.05, 0.5, "near_misses"),
    ],
)
def test_verdicts(width: float, gap: float, coverage: float, verdict: str, side: float) -> None:
    found = judge(patch(width, side * gap, side * gap, coverage), TOLERANCE)
    lengths = {name: len(getattr(found, name)) for name in ("contacts", "slivers", "near_misses")}
    assert lengths == {name: int(name == verdict) for name in lengths}


@pytest.mark.parametrize("side", [1.0, -1.0])
@pytest.mark.parametrize("tolerance", [1e-6, 1e-3, 0.1])
def test_a_gap_of_the_tolerance_but_for_rounding_is_a_contact(tolerance: float, side: float) -> None:
    gap = side * (tolerance + 0.9e-12)
    assert len(judge(patch(1.0, gap, gap), tolerance).contacts) == 1


def found_between(*extremes: tuple[list[float], list[float]]) -> Patches:
    blocks = blocks_of(boxes(*extremes))
    return find_patches(blocks, build_facets(blocks), (), TOLERANCE)


@pytest.mark.parametrize("gap", [-0.05, 0.0, 0.05])
def test_measures_of_a_surface(gap: float) -> None:
    """A cube of side 1 on a block of side 2, half of it beyond the edge: lengths relative to the smaller block."""
    found = found_between(([0, 0, 0], [2, 2, 2]), ([1.5, 0.5, 2 + gap], [2.5, 1.5, 3 + gap]))
    assert len(found) == 1
    assert found.gaps == pytest.approx([gap])
    assert found.mid_gaps == pytest.approx([gap])
    assert shapely.area(found.polygons) == pytest.approx([0.5])
    assert found.widths == pytest.approx([0.5])
    assert found.coverage == pytest.approx([0.5])
    assert found.overlays.bodies.tolist() == [[0, 1]]
    assert found.overlays.sizes == pytest.approx([1.0])
    assert found.overlays.origins[0, 2] == pytest.approx(2 + gap / 2)


@pytest.mark.parametrize(("height", "found"), [(0.0, 1), (0.0999, 1), (-0.0999, 1), (0.1001, 0), (-0.1001, 0)])
def test_a_facet_over_the_ground(height: float, found: int) -> None:
    blocks = blocks_of(boxes(([0, 0, height], [1, 1, 1 + height]), ([5, 0, 0], [6, 1, 1])))
    facets = build_facets(blocks)
    patches = find_patches(blocks, facets, (ground(blocks=[1]), ground(blocks=[0])), TOLERANCE)
    assert patches.overlays.bodies.tolist() == [[2, 1], [3, 0]][: 1 + found]
    assert patches.overlays.facets[:, 0].tolist() == [-1, -1][: 1 + found]
    assert patches.coverage == pytest.approx([1.0, 1.0][: 1 + found])
    if found:
        assert patches.gaps == pytest.approx([0.0, height])
        assert patches.overlays.frames[1, 0].tolist() == [0, 0, 1]


def test_surfaces_that_are_given() -> None:
    """A triangle between a block of side 2 and one of side 1, and a square under the latter."""
    blocks = blocks_of(boxes(([0, 0, 0], [2, 2, 2]), ([2, 0, 0], [3, 1, 1])))
    model = model_of(blocks, grounds=(ground(),))
    triangle = [[2.0, 0.0, 0.0], [2.0, 0.6, 0.0], [2.0, 0.0, 0.9]]
    square = [[2.0, 0.0, 0.0], [3.0, 0.0, 0.0], [3.0, 1.0, 0.0], [2.0, 1.0, 0.0]]
    given = PrescribedInterfaces(
        bodies=np.array([[0, 1], [2, 1]]),
        normals=np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]),
        corners=np.array([*triangle, *square]),
        corner_start=np.array([0, 3, 7]),
        joints=("", ""),
    )
    found = patches_of_prescribed(model, given)
    assert len(found) == 2
    assert found.overlays.bodies.tolist() == [[0, 1], [2, 1]]
    assert found.overlays.facets.tolist() == [[-1, -1], [-1, -1]]
    assert found.overlays.sizes == pytest.approx([1.0, 1.0])
    assert found.overlays.origins == pytest.approx(np.array([[2.0, 0.2, 0.3], [2.5, 0.5, 0.0]]))
    assert found.overlays.frames[:, 0] == pytest.approx(given.normals)
    assert found.gaps.tolist() == found.mid_gaps.tolist() == [0.0, 0.0]
    assert not found.overlays.gaps.any()
    assert found.coverage.tolist() == [1.0, 1.0]
    assert shapely.area(found.polygons) == pytest.approx([0.27, 1.0])
    assert found.widths[1] == pytest.approx(1.0)
    flat = shapely.get_coordinates(found.polygons[0])[:3]
    in_space = found.overlays.origins[0] + flat @ found.overlays.frames[0, 1:]
    assert in_space == pytest.approx(np.array(triangle))


@pytest.mark.parametrize("order", [(0, 1), (1, 0)])
@pytest.mark.parametrize("side", range(6))
def test_every_facet_has_a_size(side: int, order: tuple[int, int]) -> None:
    """A cube covered on one side by a face four times as large: all of it, whichever of its facets that is."""
    axis, up = side % 3, side // 3
    least = np.full(3, -0.5)
    least[axis] = 1.0 if up else -2.0
    pair = [([0.0, 0.0, 0.0], [1.0, 1.0, 1.0]), (least.tolist(), (least + 2.0).tolist())]
    found = found_between(*(pair[place] for place in order))
    assert len(found) == 1
    assert found.coverage == pytest.approx([1.0])
