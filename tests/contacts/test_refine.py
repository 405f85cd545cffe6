from __future__ import annotations

import math

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.contacts.corners import areas_and_centroids, needed_corners
from mbla.contacts.point_areas import point_areas
from mbla.contacts.refine import InterfacePoints, interface_points, point_starts
from mbla.errors import Notice
from tests.analytic.cases import ASSOCIATIVE, answer, answers
from tests.contacts.structures import boxes, contacts_of, ground, section
from tests.line import WALL, line_of, load_factor

SQUARE = shapely.box(0, 0, 2, 2)
L_SHAPE = shapely.Polygon([[0, 0], [4, 0], [4, 1], [1, 1], [1, 4], [0, 4]])
WITH_HOLE = shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[1, 1], [2, 1], [2, 2], [1, 2]]])
TOUCHING_HOLE = shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[0, 2], [1, 1], [1, 3]]])
UNIFORM = (math.sqrt(2) + math.log(1 + math.sqrt(2))) / 6
"""Mean distance from the centre of a unit square: torsion under uniform pressure, over μWa."""


def found(refine: int, inset: float, *polygons: shapely.Polygon) -> tuple[InterfacePoints, list[Notice]]:
    """Points of polygons, whose shares add up to the area with its centroid, in the polygon."""
    corners = needed_corners(np.array(polygons, dtype=object), 1e-6)
    area, centroid = areas_and_centroids(corners, len(polygons))
    points, notices = interface_points(corners, centroid, refine, inset)
    np.testing.assert_allclose(np.bincount(points.polygon, points.areas), area, rtol=1e-12)
    for axis in (0, 1):
        moment = np.bincount(points.polygon, points.areas * (points.points - centroid[points.polygon])[:, axis])
        np.testing.assert_allclose(moment, 0.0, atol=1e-11)
    assert (points.areas > 0).all()
    assert (np.diff(points.polygon) >= 0).all()
    everywhere = shapely.points(points.points)
    assert shapely.dwithin(np.array(polygons, dtype=object)[points.polygon], everywhere, 1e-9).all()
    for i, start in enumerate(point_starts(points)[:-1]):
        ring = points.points[start : start + points.outline[i]]
        assert shapely.is_ccw(shapely.linearrings(ring))
    return points, notices


def test_one_point_an_edge_is_the_corners_alone() -> None:
    corners = needed_corners(np.array([L_SHAPE, SQUARE], dtype=object), 1e-6)
    points, _ = interface_points(corners, areas_and_centroids(corners, 2)[1], 1, 0.0)
    np.testing.assert_array_equal(points.points, corners.points)
    np.testing.assert_array_equal(points.areas, point_areas(corners, 2))


@pytest.mark.parametrize("refine", [2, 3, 7])
def test_a_square_has_points_along_its_edges_and_rings_inside(refine: int) -> None:
    points, _ = found(refine, 0.0, SQUARE)
    assert points.outline.tolist() == [4 * refine]
    assert len(points.points) == 2 * refine * (refine + 1) + 1
    levels = np.abs(points.points - 1.0).max(axis=1)
    np.testing.assert_allclose(np.unique(levels.round(9)), np.arange(refine + 1) / refine, atol=1e-9)
    step = np.linalg.norm(np.diff(points.points[: 4 * refine], axis=0), axis=1)
    np.testing.assert_allclose(step, 2 / refine, rtol=1e-12)


@pytest.mark.parametrize("refine", [2, 5])
@pytest.mark.parametrize("polygon", [L_SHAPE, WITH_HOLE, TOUCHING_HOLE], ids=["L", "hole", "hole at the outline"])
def test_surfaces_that_are_not_convex(refine: int, polygon: shapely.Polygon) -> None:
    points, _ = found(refine, 0.0, polygon)
    assert points.outline[0] == refine * (len(polygon.exterior.coords) - 1)
    assert len(np.unique(points.points.round(9), axis=0)) >= len(points.points) - refine


def test_all_kinds_together() -> None:
    kinds = [L_SHAPE, SQUARE, WITH_HOLE, shapely.box(1, 1, 2, 3), L_SHAPE]
    together, _ = found(3, 0.0, *kinds)
    for i, kind in enumerate(kinds):
        alone, _ = found(3, 0.0, kind)
        np.testing.assert_allclose(together.points[together.polygon == i], alone.points, rtol=1e-12)
        np.testing.assert_allclose(together.areas[together.polygon == i], alone.areas, rtol=1e-12)


@settings(deadline=None, max_examples=30)
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
    line = line_of(WALL, "contacts.refine=2", "contacts.inset=0.5")
    corners = line_of(WALL)
    assert plain.outline.tolist() == [4, 4]
    assert section().refine == 1
    np.testing.assert_array_equal(line.contacts.outline, 2 * corners.contacts.outline)
    np.testing.assert_allclose(
        np.bincount(line.contacts.interface_of_point, line.contacts.point_areas), line.contacts.areas, rtol=1e-12
    )
    first = line.contacts.points[:8:2] - line.contacts.centroids[0]
    np.testing.assert_allclose(first, 0.5 * (corners.contacts.points[:4] - corners.contacts.centroids[0]), atol=1e-12)


def torsion(*overrides: str) -> float:
    """Couple that a square block bears, over μWa."""
    return answer("torque", *overrides).load_factor / 0.6


def test_more_points_do_not_lower_torsion_under_associative_flow() -> None:
    """The program may load the corners alone."""
    for refine in (1, 4):
        assert torsion(ASSOCIATIVE, f"contacts.refine={refine}") == pytest.approx(1 / math.sqrt(2), rel=1e-7)


def test_more_points_lower_torsion_without_dilatancy() -> None:
    """In the gravity state all points bear the same, and turning changes no normal force: λ is their mean distance."""
    values = []
    for refine in (1, 3, 8):
        points, _ = found(refine, 0.0, shapely.box(-0.5, -0.5, 0.5, 0.5))
        values.append(torsion("analysis.scheme=proximal", "analysis.range=false", f"contacts.refine={refine}"))
        assert values[-1] == pytest.approx(np.linalg.norm(points.points, axis=1).mean(), rel=1e-6)
    assert values[0] > values[1] > values[2] > UNIFORM
    assert values[2] < 1.08 * UNIFORM


def test_inset_gives_a_square_its_torsion_under_uniform_pressure_at_a_price_in_rocking() -> None:
    share = 1 - UNIFORM * math.sqrt(2)
    assert torsion(ASSOCIATIVE, f"contacts.inset={share!r}") == pytest.approx(UNIFORM, rel=1e-7)
    exact = {case.name: case.load_factor for case in answers("block_rocking", ASSOCIATIVE)}
    for case in answers("block_rocking", ASSOCIATIVE, f"contacts.inset={share!r}"):
        assert case.load_factor == pytest.approx((1 - share) * exact[case.name], rel=1e-7)


def test_more_points_do_not_change_a_wall_under_associative_flow() -> None:
    assert load_factor(WALL, "contacts.refine=3") == pytest.approx(load_factor(WALL), rel=1e-7)
