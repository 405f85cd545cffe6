"""Surfaces that can crush are divided into parallelograms and triangles, and nothing of them is lost."""

from __future__ import annotations

import numpy as np
import pytest
import shapely

from mbla.contacts.corners import areas_and_centroids, needed_corners
from mbla.contacts.points import in_pieces

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
    areas, centroids = areas_and_centroids(pieces, len(row))
    whole, middle = areas_and_centroids(corners, n)
    assert np.all(areas > 0)
    assert np.bincount(row, areas, n) == pytest.approx(whole, rel=1e-12)
    for axis in (0, 1):
        assert np.bincount(row, areas * centroids[:, axis], n) == pytest.approx(whole * middle[:, axis], rel=1e-12)
    expected = [1 if name == kept else count for name, (_, count) in OUTLINES.items()]
    assert np.bincount(row, minlength=n).tolist() == expected
    assert row.tolist() == sorted(row.tolist())


def test_where_nothing_is_chosen_all_is_left_as_it_is() -> None:
    corners = needed_corners(POLYGONS, 1e-6)
    pieces, row = in_pieces(corners, np.zeros(len(OUTLINES), dtype=bool))
    assert pieces is corners
    assert row.tolist() == list(range(len(OUTLINES)))
