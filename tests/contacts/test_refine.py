"""Surfaces that can crush are divided into parallelograms and triangles, and nothing of them is lost.

A block on a ring whose hole touches the block's edge between two corners: every point of it has an area.
"""

from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.contacts.contacts import ContactsRefused
from mbla.contacts.outlines.corners import areas_and_centroids, needed_corners
from mbla.contacts.outlines.points import MOST_PARTS, in_pieces, interface_points
from mbla.contacts.outlines.refine import InterfacePoints
from mbla.deck.sections.contacts import ContactPoints
from mbla.errors import Notice
from tests.contacts.structures import boxes, contacts_of, ground, section
from tests.line import BLOCK, WALL, line_of, load_factor

SQUARE = shapely.box(0, 0, 2, 2)
L_SHAPE = shapely.Polygon([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]])
WITH_HOLE = shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[1, 1], [2, 1], [2, 2], [1, 2]]])
TOUCHING_HOLE = shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[0, 2], [1, 1], [1, 3]]])


def found(refine: int, inset: float, *polygons: shapely.Polygon) -> tuple[InterfacePoints, list[Notice]]:
    """Points of polygons with so many parts an edge."""
    return asked(ContactPoints(per_edge=refine, inset=inset), *polygons)


def asked(points_asked: ContactPoints, *polygons: shapely.Polygon) -> tuple[InterfacePoints, list[Notice]]:
    """Points of polygons, whose shares add up to the area with its centroid, in the polygon."""
    corners = needed_corners(np.array(polygons, dtype=object), 1e-6)
    area, centroid = areas_and_centroids(corners)
    points, notices = interface_points(corners, centroid, np.ones(len(polygons)), points_asked)
    np.testing.assert_allclose(np.bincount(points.polygon, points.areas), area, rtol=1e-12)
    for axis in (0, 1):
        moment = np.bincount(points.polygon, points.areas * (points.points - centroid[points.polygon])[:, axis])
        np.testing.assert_allclose(moment, 0.0, atol=1e-11)
    assert (points.areas > 0).all()
    assert (np.diff(points.polygon) >= 0).all()
    everywhere = shapely.points(points.points)
    assert shapely.dwithin(np.array(polygons, dtype=object)[points.polygon], everywhere, 1e-9).all()
    for i, start in enumerate(np.searchsorted(points.polygon, np.arange(len(points.outline)))):
        ring = points.points[start : start + points.outline[i]]
        assert shapely.is_ccw(shapely.linearrings(ring))
    return points, notices


def test_shares_of_corners() -> None:
    """A quarter of a rectangle, a third of a triangle, the same everywhere in a regular polygon."""
    angles = np.arange(7) * 2 * np.pi / 7
    heptagon = shapely.Polygon(np.stack([np.cos(angles), np.sin(angles)], axis=1))
    for polygon in (shapely.box(0, 0, 3, 0.5), shapely.Polygon([[0, 0], [3, 0], [1, 2]]), heptagon):
        points, _ = found(1, 0.0, polygon)
        np.testing.assert_allclose(points.areas, polygon.area / len(points.areas), rtol=1e-12)


@pytest.mark.parametrize("refine", [2, 3, 7])
def test_a_square_has_points_along_its_edges_and_a_grid_inside(refine: int) -> None:
    points, _ = found(refine, 0.0, SQUARE)
    assert points.outline.tolist() == [4 * refine]
    assert len(points.points) == (refine + 1) ** 2
    for axis in (0, 1):
        levels = np.unique(points.points[:, axis].round(9))
        np.testing.assert_allclose(levels, 2 * np.arange(refine + 1) / refine, atol=1e-9)
    step = np.linalg.norm(np.diff(points.points[: 4 * refine], axis=0), axis=1)
    np.testing.assert_allclose(step, 2 / refine, rtol=1e-12)


@pytest.mark.parametrize("refine", [2, 3, 7])
def test_a_triangle_has_points_along_its_edges_and_rings_inside(refine: int) -> None:
    points, _ = found(refine, 0.0, shapely.Polygon([[0, 0], [3, 0], [0, 3]]))
    assert points.outline.tolist() == [3 * refine]
    assert len(points.points) == 3 * refine * (refine + 1) // 2 + 1
    level = 1 - np.minimum(points.points.min(axis=1), 3 - points.points.sum(axis=1))
    np.testing.assert_allclose(np.unique(level.round(9)), np.arange(refine + 1) / refine, atol=1e-9)


@pytest.mark.parametrize("refine", [1, 2, 5])
@pytest.mark.parametrize("polygon", [L_SHAPE, WITH_HOLE, TOUCHING_HOLE], ids=["L", "hole", "hole at the outline"])
def test_surfaces_that_are_not_convex(refine: int, polygon: shapely.Polygon) -> None:
    points, _ = found(refine, 0.0, polygon)
    assert points.outline[0] == refine * (len(polygon.exterior.coords) - 1)
    assert len(np.unique(points.points.round(9), axis=0)) >= len(points.points) - refine


@pytest.mark.parametrize("refine", [2, 7])
def test_areas_add_up_where_a_hole_touches_an_edge_between_its_corners(refine: int) -> None:
    """The edge at x = 0.9: where it is divided by seven, some points on it lie beyond by rounding.

    It is divided on either side of the hole's corner, not whole: such points would have no area.
    """
    polygon = shapely.Polygon([[0, 0], [0.9, 0], [0.9, 4], [0, 4]], [[[0.9, 1.25], [0.45, 3], [0.45, 0.5]]])
    corners = needed_corners(np.array([polygon], dtype=object), 1e-6)
    area, centroid = areas_and_centroids(corners)
    points, _ = interface_points(corners, centroid, np.ones(1), ContactPoints(per_edge=refine))
    assert points.outline.tolist() == [3 * refine + 1]
    assert points.areas.min() > 1e-3 * area[0] / refine**2
    assert points.areas.sum() == pytest.approx(area[0], rel=1e-12)
    assert points.areas @ points.points == pytest.approx(area[0] * centroid[0], rel=1e-12)


@settings(max_examples=30)
@given(st.integers(0, 10**6), st.integers(4, 20), st.integers(1, 6), st.floats(0.0, 0.9))
def test_random_convex_polygons(seed: int, count: int, refine: int, inset: float) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 2))
    _, notices = found(refine, inset, shapely.convex_hull(shapely.multipoints(points)))
    assert notices == []


def test_inset_moves_points_towards_the_centroid_and_leaves_their_shares() -> None:
    before, _ = found(1, 0.0, SQUARE)
    after, _ = found(1, 0.25, SQUARE)
    np.testing.assert_allclose(after.points, 1.0 + 0.75 * (before.points - 1.0))
    np.testing.assert_array_equal(after.areas, before.areas)


def test_where_points_could_leave_the_surface_they_stay_and_a_warning_says_so() -> None:
    before, _ = found(2, 0.0, L_SHAPE, SQUARE, WITH_HOLE)
    after, notices = found(2, 0.5, L_SHAPE, SQUARE, WITH_HOLE)
    still = before.polygon != 1
    np.testing.assert_array_equal(after.points[still], before.points[still])
    assert np.abs(after.points[~still] - 1.0).max() == pytest.approx(0.5)
    assert [notice.identifier for notice in notices] == ["inset-not-applied"]
    assert "2 interfaces" in notices[0].message


def test_the_search_for_contacts_heeds_both_keys() -> None:
    stack = boxes(([0, 0, 0], [1, 1, 1]), ([0, 0, 1], [1, 1, 2]))
    plain = contacts_of(stack, grounds=(ground(),))
    line = line_of(WALL, "contacts.points.per_edge=2", "contacts.points.inset=0.5")
    corners = line_of(WALL)
    assert plain.outline.tolist() == [4, 4]
    assert section().points == ContactPoints()
    np.testing.assert_array_equal(line.contacts.outline, 2 * corners.contacts.outline)
    np.testing.assert_allclose(
        np.bincount(line.contacts.interface_of_point, line.contacts.point_areas), line.contacts.areas, rtol=1e-12
    )
    first = line.contacts.points[:8:2] - line.contacts.centroids[0]
    np.testing.assert_allclose(first, 0.5 * (corners.contacts.points[:4] - corners.contacts.centroids[0]), atol=1e-12)


def test_spacing_divides_each_edge_of_a_parallelogram_by_itself() -> None:
    points, _ = asked(ContactPoints(spacing=0.25), shapely.box(0, 0, 2, 0.3))
    assert points.outline.tolist() == [2 * (8 + 2)]
    assert len(points.points) == 9 * 3
    ring = points.points[:20]
    assert np.linalg.norm(np.roll(ring, -1, axis=0) - ring, axis=1).max() <= 0.25 * (1 + 1e-12)


def test_spacing_divides_all_edges_of_other_polygons_by_the_longest() -> None:
    points, _ = asked(ContactPoints(spacing=1.01), L_SHAPE, SQUARE)
    assert points.outline.tolist() == [6 * 4, 4 * 2]


def test_a_spacing_that_gives_too_many_points_is_refused_with_one_that_does_not() -> None:
    with pytest.raises(ContactsRefused, match=r"must be >= 0\.02"):
        asked(ContactPoints(spacing=0.01), shapely.box(0, 0, 4, 1))
    assert asked(ContactPoints(spacing=0.02), shapely.box(0, 0, 4, 0.02))[0].outline.tolist() == [2 * (MOST_PARTS + 1)]


def test_rounding_moves_the_edges_inwards() -> None:
    before, _ = asked(ContactPoints(per_edge=3), shapely.box(0, 0, 2, 1))
    after, notices = asked(ContactPoints(per_edge=3, rounding=0.1), shapely.box(0, 0, 2, 1))
    assert notices == []
    np.testing.assert_allclose(after.points, [0.1, 0.1] + before.points * [1.8 / 2, 0.8], rtol=1e-12)
    np.testing.assert_allclose(after.areas, before.areas, rtol=1e-12)


def test_where_rounding_leaves_nothing_points_stay_and_a_warning_says_so() -> None:
    kinds = (L_SHAPE, shapely.box(0, 0, 4, 0.3), WITH_HOLE)
    before, _ = asked(ContactPoints(per_edge=2), *kinds)
    after, notices = asked(ContactPoints(per_edge=2, rounding=0.2), *kinds)
    np.testing.assert_array_equal(after.points, before.points)
    assert [notice.identifier for notice in notices] == ["rounding-not-applied"]
    assert "3 interfaces" in notices[0].message


def test_rounding_weakens_rocking_by_the_breadth_it_takes() -> None:
    """b = 1, h = 2: (b − 2 d)/h."""
    assert load_factor(BLOCK, "contacts.points.rounding=0.05") == pytest.approx(0.9 / 2, rel=1e-7)


OUTLINES = {
    "rectangle": (shapely.box(0, 0, 2, 1), 1),
    "parallelogram": (shapely.Polygon([[0, 0], [2, 0], [2.5, 1], [0.5, 1]]), 1),
    "triangle": (shapely.Polygon([[0, 0], [2, 0], [0.5, 1]]), 1),
    "trapezium": (shapely.Polygon([[0, 0], [2, 0], [1, 1], [0, 1]]), 2),
    "L": (shapely.Polygon([[0, 0], [2, 0], [2, 1], [1, 1], [1, 3], [0, 3]]), 4),
    "frame": (shapely.box(0, 0, 3, 3) - shapely.box(1, 1, 2, 2), 8),
}
POLYGONS = np.array([polygon for polygon, _ in OUTLINES.values()], dtype=object)


@pytest.mark.parametrize("kept", OUTLINES)
def test_areas_and_first_moments_are_those_of_the_whole(kept: str) -> None:
    corners = needed_corners(POLYGONS, 1e-6)
    chosen = np.array([name != kept for name in OUTLINES])
    pieces, row = in_pieces(corners, chosen)
    n = len(OUTLINES)
    areas, centroids = areas_and_centroids(pieces)
    whole, middle = areas_and_centroids(corners)
    assert np.all(areas > 0)
    assert np.bincount(row, areas, n) == pytest.approx(whole, rel=1e-12)
    for axis in (0, 1):
        assert np.bincount(row, areas * centroids[:, axis], n) == pytest.approx(whole * middle[:, axis], rel=1e-12)
    expected = [1 if name == kept else count for name, (_, count) in OUTLINES.items()]
    assert np.bincount(row, minlength=n).tolist() == expected
    assert row.tolist() == sorted(row.tolist())
