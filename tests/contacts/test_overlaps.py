"""Blocks that share volume, and blocks that only seem to."""

from __future__ import annotations

import itertools
import re
from dataclasses import replace

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.arrays import FloatArray, starts
from mbla.contacts import find_contacts, overlap_messages
from mbla.contacts.faces.broad_phase import find_block_pairs
from mbla.contacts.faces.facets import build_facets
from mbla.contacts.overlaps import Overlaps, find_overlaps
from mbla.model.solids.convex import clip_convex, convex_loops
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, polyhedra_from_lists
from tests.contacts.structures import (
    any_rotation,
    blocks_of,
    boxes,
    ground,
    model_of,
    moved,
    prism,
    running_bond,
    section,
)
from tests.contacts.test_shapes import L_OUTLINE, circle, ring


def overlaps_of(polyhedra: Polyhedra, tolerance: float = 1e-3) -> Overlaps:
    blocks = blocks_of(polyhedra)
    return find_overlaps(blocks, build_facets(blocks), find_block_pairs(blocks, tolerance), tolerance)


@pytest.mark.parametrize("turn", [None, any_rotation(4)], ids=["along the axes", "turned"])
@pytest.mark.parametrize("depth", [0.01, 0.1])
def test_boxes_that_overlap(depth: float, turn: np.ndarray | None) -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1 - depth], [1, 1, 2 - depth]))
    found = overlaps_of(moved(pair, turn=turn))
    assert found.pairs.tolist() == [[0, 1]]
    assert found.depths == pytest.approx([depth], rel=1e-9)


def test_overlap_within_the_tolerance_is_none() -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 0.9995], [1, 1, 1.9995]))
    assert len(overlaps_of(pair).pairs) == 0
    assert len(overlaps_of(pair, tolerance=1e-4).pairs) == 1


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_identical_blocks_overlap(scale: float) -> None:
    pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 0], [1, 1, 1]))
    found = overlaps_of(moved(pair, scale=scale, turn=any_rotation()))
    assert found.pairs.tolist() == [[0, 1]]
    assert found.depths == pytest.approx([1.0], rel=1e-9)
    assert found.swallows.tolist() == [True]


@pytest.mark.parametrize(("fixed", "count"), [((0, 1), 0), ((0,), 1), ((), 1)])
def test_blocks_that_do_not_move_may_overlap(fixed: tuple[int, ...], count: int) -> None:
    three = boxes(([0, 0, 0], [1, 1, 1]), ([0.5, 0, 0], [1.5, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    report = find_contacts(model_of(blocks_of(three), fixed=fixed), section()).report
    assert len(report.overlaps) == count
    assert any(notice.identifier == "blocks-overlap" for notice in report.notices) == bool(count)


def test_a_cross_of_two_bars_overlaps() -> None:
    """No corner of either lies in the other."""
    found = overlaps_of(boxes(([-5, -1, -1], [5, 1, 1]), ([-1, -5, -1], [1, 5, 1])))
    assert found.pairs.tolist() == [[0, 1]]


def test_blocks_that_interlock_without_sharing_volume() -> None:
    socket = ring(circle(1.0, 24), circle(2.0, 24), 0, 1)
    for pair in (
        [prism(L_OUTLINE, 0, 1), boxes(([1, 1, 0], [2, 2, 1]))],
        [socket, prism(circle(1.0, 24), 0, 1)],
        [socket, prism(circle(0.9, 24), 0, 1)],
    ):
        assert len(overlaps_of(moved(join_polyhedra(pair), turn=any_rotation())).pairs) == 0


def test_a_plug_too_large_for_its_socket() -> None:
    socket = ring(circle(1.0, 24), circle(2.0, 24), 0, 1)
    found = overlaps_of(join_polyhedra([socket, prism(circle(1.05, 24), 0, 1)]))
    assert found.pairs.tolist() == [[0, 1]]
    # a corner of the plug lies below the middle of a side of the socket's inner polygon, or below its corner
    assert found.depths[0] * np.cbrt(24 * np.sin(np.pi / 12) / 2 * 1.05**2) == pytest.approx(0.05, rel=0.02)


def test_edges_across_each_other_are_no_overlap() -> None:
    """Two tetrahedra separated by no face plane of either, only by a plane along two of their edges."""
    lower: list[list[float]] = [[-1, 0, 0], [1, 0, 0], [0.0, -1, -1.2], [0.0, 1, -1.2]]
    upper: list[list[float]] = [[0, -1, 0.01], [0, 1, 0.01], [-1, 0.0, 1.2], [1, 0.0, 1.2]]
    faces = [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]
    assert len(overlaps_of(polyhedra_from_lists([lower, upper], [faces, faces])).pairs) == 0
    closer = [[x, y, z - 0.2] for x, y, z in upper]
    assert overlaps_of(polyhedra_from_lists([lower, closer], [faces, faces])).pairs.tolist() == [[0, 1]]


def test_a_turned_wall_has_no_overlaps() -> None:
    assert len(overlaps_of(moved(running_bond(6, 6), turn=any_rotation(5))).pairs) == 0


def test_of_blocks_with_a_plane_between_them_neither_need_be_a_closed_solid() -> None:
    """The boxes around them overlap, for they are turned."""
    for gap, unchecked in ((0.0, []), (-0.5, [[0, 1]])):
        pair = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1 + gap], [1, 1, 2 + gap]))
        blocks = blocks_of(moved(pair, turn=any_rotation(4)))
        loops = blocks.loops.copy()
        loops[:4] = loops[4:8]  # one face twice, its opposite missing
        report = find_contacts(model_of(replace(blocks, loops=loops)), section()).report
        assert report.unchecked.tolist() == unchecked


def test_an_overlap_is_the_least_distance_that_cures() -> None:
    """A low block beside a high one: they are moved apart sideways, not upwards."""
    low, high = ([0, 0, 0], [0.8, 0.6, 0.4]), ([0.6, 0, 0], [1.2, 0.6, 4])
    found = overlaps_of(moved(boxes(low, high), turn=any_rotation(3)))
    size = np.cbrt(0.8 * 0.6 * 0.4)
    assert found.depths * size == pytest.approx([0.2], rel=1e-9)
    assert len(overlaps_of(boxes(low, ([0.8, 0, 0], [1.4, 0.6, 4]))).pairs) == 0


def test_the_least_distance_across_two_edges() -> None:
    """Two bars, each turned about its axis by 45 degrees, that cross with one edge below the other."""
    half = np.sqrt(0.5)
    diamond = [(half, 0.0), (0.0, half), (-half, 0.0), (0.0, -half)]
    along_x = [[x, y, z] for x in (-3, 3) for y, z in diamond]
    along_y = [[y, x, z + 2 * half - 0.1] for x in (-3, 3) for y, z in diamond]
    sides = [[k, (k + 1) % 4, 4 + (k + 1) % 4, 4 + k] for k in range(4)]
    faces = [[3, 2, 1, 0], [4, 5, 6, 7], *sides]
    found = overlaps_of(polyhedra_from_lists([along_x, along_y], [faces, faces]))
    assert found.depths * np.cbrt(6.0) == pytest.approx([0.1], rel=1e-9)


@pytest.mark.parametrize("turn", [None, any_rotation(4)], ids=["along the axes", "turned"])
def test_the_depth_of_a_block_in_the_corner_of_another(turn: np.ndarray | None) -> None:
    """Below both legs of an L by 0.02: the edge of the block lies below that of the L by the diagonal of both."""
    pair = join_polyhedra([prism(L_OUTLINE, 0, 1), boxes(([0.98, 0.98, 0], [2, 2, 1]))])
    found = overlaps_of(moved(pair, turn=turn))
    assert found.pairs.tolist() == [[0, 1]]
    assert found.depths * 1.02 ** (2 / 3) == pytest.approx([0.02 * np.sqrt(2)], rel=1e-6)


ROW = [([k, 0, 0], [k + 1.02, 1, 1]) for k in range(5)]
"""Each reaches into the next by 0.02."""


def test_overlaps_within_their_tolerance_are_accepted_and_gaps_stay_open() -> None:
    shapes = boxes(*ROW, ([5.03, 0, 0], [6, 1, 1]))
    model = model_of(blocks_of(shapes), grounds=(ground(),))
    refused = find_contacts(model, section()).report
    assert refused.overlaps.tolist() == [[k, k + 1] for k in range(4)]
    (message,) = overlap_messages(model, refused)
    assert message.startswith("4 pairs of blocks overlap, block[0] and block[1] most, by 0.02 m, ")
    words = re.search(r"contacts.overlap_tolerance above ([0-9.]+) if they .*accepts all 4", message)
    assert words is not None
    found = find_contacts(model, section().model_copy(update={"overlap_tolerance": float(words[1])}))
    assert len(found.report.overlaps) == 0
    between = found.bodies[:, 1] < 6
    between &= found.bodies[:, 0] < 6
    assert found.bodies[between].tolist() == [[k, k + 1] for k in range(4)]  # and none across the gap of 0.01
    assert found.gaps[between] == pytest.approx(-0.02)
    assert found.centroids[between, 0] == pytest.approx(np.arange(4) + 1.01)  # midway
    told = {notice.identifier: notice.message for notice in found.report.notices}
    share = 100 * 0.08 / (5 * 1.02 + 0.97)
    assert f"the 0.08 m3 that they share, {share:.2g} % of the volume" in told["overlaps-accepted"]


@pytest.mark.parametrize(("key", "accepted"), [("tolerance", 5), ("overlap_tolerance", 4)])
def test_the_tolerance_of_gaps_closes_what_is_open_that_of_overlaps_does_not(key: str, accepted: int) -> None:
    model = model_of(blocks_of(boxes(*ROW, ([5.03, 0, 0], [6, 1, 1]))), fixed=[0])
    found = find_contacts(model, section().model_copy(update={key: 0.03}))
    assert len(found) == accepted
    assert len(found.report.overlaps) == 0


def test_a_block_that_another_reaches_through_is_no_accepted_overlap() -> None:
    """Two plates in one place, thinner than the tolerance of their size."""
    model = model_of(blocks_of(boxes(([0, 0, 0], [1, 1, 0.02]), ([0, 0, 0], [1, 1, 0.02]))), grounds=(ground(),))
    report = find_contacts(model, section().model_copy(update={"overlap_tolerance": 0.1})).report
    assert report.overlaps.tolist() == [[0, 1]]
    assert report.overlap_swallows.tolist() == [True]
    assert "overlap_tolerance" not in overlap_messages(model, report)[0]


# Loops of corners in the plane.


def test_convexity_of_loops() -> None:
    star: list[list[float]] = [[np.cos(k * 4 * np.pi / 5), np.sin(k * 4 * np.pi / 5)] for k in range(5)]
    square: list[list[float]] = [[0, 0], [1, 0], [1, 1], [0, 1]]
    notched: list[list[float]] = [[0, 0], [1, 0], [0.5, 0.5], [1, 1], [0, 1]]
    flat_corner: list[list[float]] = [[0, 0], [0.5, 0], [1, 0], [1, 1], [0, 1]]
    turned = square[::-1]
    twice = [*square[:2], *square[1:]]
    loops = [square, turned, flat_corner, notched, star, twice, twice[::-1]]
    start = np.concatenate([[0], np.cumsum([len(loop) for loop in loops])])
    assert convex_loops(np.concatenate(loops), start).tolist() == [True, True, True, False, False, True, True]


def clip(first: FloatArray, second: FloatArray) -> FloatArray:
    start = np.array([0, len(first)]), np.array([0, len(second)])
    corners, _ = clip_convex(first, start[0], second, start[1])
    return corners


def area(corners: FloatArray) -> float:
    following = np.roll(corners, -1, axis=0)
    return float((corners[:, 0] * following[:, 1] - corners[:, 1] * following[:, 0]).sum() / 2)


SQUARE = np.array([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]])


def shifted(x: float, y: float) -> FloatArray:
    return np.asarray(SQUARE + np.array([x, y]))


def test_squares_that_differ_by_rounding_are_not_lost() -> None:
    """For this pair the general overlay of a library returns two points."""
    first = np.array(
        [
            [-0.2988805948014821, -0.4632796822577667],
            [0.4988542772999263, -0.2347383308309684],
            [0.2988805948014856, 0.4632796822577602],
            [-0.4988542772999304, 0.2347383308309725],
        ]
    )
    second = np.array(
        [
            [0.4988542772999264, -0.2347383308309684],
            [-0.298880594801482, -0.4632796822577667],
            [-0.4988542772999304, 0.2347383308309725],
            [0.2988805948014857, 0.4632796822577602],
        ]
    )
    assert area(clip(first, second)) == pytest.approx(area(first), rel=1e-12)


def convex_polygon(seed: int, corners: int) -> FloatArray:
    rng = np.random.default_rng(seed)
    hull = shapely.convex_hull(shapely.multipoints(rng.normal(size=(corners + 3, 2))))
    return np.asarray(shapely.get_coordinates(hull)[:-1])


@settings(max_examples=60)
@given(st.lists(st.tuples(st.integers(0, 10**6), st.integers(3, 40)), min_size=2, max_size=12))
def test_agrees_with_a_general_overlay(seeds: list[tuple[int, int]]) -> None:
    polygons = [convex_polygon(*seed) for seed in seeds]
    pairs = list(itertools.pairwise(polygons))
    first, second = zip(*pairs, strict=True)
    corners, start = clip_convex(
        np.concatenate(first),
        starts(np.array([len(p) for p in first])),
        np.concatenate(second),
        starts(np.array([len(p) for p in second])),
    )
    for i, (a, b) in enumerate(pairs):
        found = corners[start[i] : start[i + 1]]
        expected = shapely.intersection(shapely.Polygon(a), shapely.Polygon(b)).area
        assert (area(found) if len(found) else 0.0) == pytest.approx(expected, abs=1e-9)
