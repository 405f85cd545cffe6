from __future__ import annotations

import numpy as np
import pytest
import shapely
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.contacts.corners import areas_and_centroids, needed_corners
from mbla.contacts.refine import point_areas

L_SHAPE = [[0, 0], [2, 0], [2, 1], [1, 1], [1, 2], [0, 2]]


def shares(*polygons: shapely.Polygon) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Corners, their polygon, their shares, and areas with centroids of polygons."""
    corners = needed_corners(np.array(polygons, dtype=object), 1e-6)
    area, centroid = areas_and_centroids(corners, len(polygons))
    found = point_areas(corners, len(polygons))
    total = np.bincount(corners.polygon_of_corner, weights=found)
    np.testing.assert_allclose(total, area, rtol=1e-12)
    for axis in (0, 1):
        moment = np.bincount(corners.polygon_of_corner, weights=found * corners.points[:, axis])
        np.testing.assert_allclose(moment, area * centroid[:, axis], atol=1e-12)
    assert (found > 0).all()
    return corners.points, corners.polygon_of_corner, found, area


def test_a_rectangle_gives_a_quarter_to_each_corner() -> None:
    _, _, found, _ = shares(shapely.box(0, 0, 3, 0.5))
    np.testing.assert_allclose(found, 0.375, rtol=1e-14)


def test_a_triangle_gives_a_third_to_each_corner() -> None:
    _, _, found, _ = shares(shapely.Polygon([[0, 0], [3, 0], [1, 2]]))
    np.testing.assert_allclose(found, 1.0, rtol=1e-14)


def test_a_regular_polygon_gives_the_same_to_all() -> None:
    angles = np.arange(7) * 2 * np.pi / 7
    _, _, found, area = shares(shapely.Polygon(np.stack([np.cos(angles), np.sin(angles)], axis=1)))
    np.testing.assert_allclose(found, area[0] / 7, rtol=1e-12)


@pytest.mark.parametrize(
    "polygon",
    [
        shapely.Polygon(L_SHAPE),
        shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[1, 1], [2, 1], [2, 2], [1, 2]]]),
        shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[0, 2], [1, 1], [1, 3]]]),
    ],
    ids=["not convex", "with a hole", "hole that touches the outline"],
)
def test_other_polygons(polygon: shapely.Polygon) -> None:
    shares(polygon)


def test_polygons_of_all_kinds_together() -> None:
    ring = shapely.Polygon([[0, 0], [4, 0], [4, 4], [0, 4]], [[[1, 1], [2, 1], [2, 2], [1, 2]]])
    kinds = [shapely.Polygon(L_SHAPE), shapely.box(0, 0, 1, 1), ring, shapely.box(1, 1, 2, 3), shapely.Polygon(L_SHAPE)]
    _, polygon, together, _ = shares(*kinds)
    for i, kind in enumerate(kinds):
        np.testing.assert_allclose(together[polygon == i], shares(kind)[2], rtol=1e-12)


@settings(max_examples=50)
@given(st.integers(0, 10**6), st.integers(4, 30))
def test_random_convex_polygons(seed: int, count: int) -> None:
    points = np.random.default_rng(seed).normal(size=(count, 2))
    shares(shapely.convex_hull(shapely.multipoints(points)))
