"""Polygons cut by a line, and their moments: exact.

::

    A, S = ∫ y dA, I = ∫ y yᵀ dA,    y = (y_1, y_2)
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.ragged import next_item, row_sums

MOST, SHARP = 60, 1e-14
"""Steps of Newton's method, and the last of them over the greatest difference of heights."""


def clipped(polygon: FloatArray, heights: FloatArray) -> FloatArray:
    """The part of a polygon (k, 2) where a linear function with these values at its corners, (k,), is positive."""
    corners = []
    for here, there, low, high in zip(polygon, np.roll(polygon, -1, 0), heights, np.roll(heights, -1), strict=True):
        if low > 0.0:
            corners.append(here)
        if (low > 0.0) != (high > 0.0):
            corners.append(here + low / (low - high) * (there - here))
    return np.array(corners).reshape(-1, 2)


def lifted(polygon: FloatArray, heights: FloatArray, volume: float) -> FloatArray:
    """Values at the corners of a polygon, (k,), of a linear function and a constant, the positive part a volume.

    Newton's method for ∫ (h + s)₊ dA, which grows with s ever faster: from above it comes down to the root.
    """
    plane, *_ = np.linalg.lstsq(np.column_stack([np.ones(len(polygon)), polygon]), heights, rcond=None)
    shift = 0.0
    for _ in range(MOST):
        part = clipped(polygon, heights + shift)
        area, *firsts = moments_of(part, np.array([0, len(part)]))[0, :3] if len(part) else np.zeros(3)
        if not area > 0.0:
            break
        by = (volume - float(plane @ [area, *firsts])) / area - shift
        shift += by
        if abs(by) <= SHARP * float(np.ptp(heights)):
            break
    return np.asarray(heights + shift)


def powers(points: FloatArray) -> FloatArray:
    """1, y_1, y_2, y_1², y_1 y_2, y_2² of points, (n, 6)."""
    one, two = points.T
    return np.column_stack([np.ones(len(points)), one, two, one * one, one * two, two * two])


def moments_of(corners: FloatArray, start: IntArray) -> FloatArray:
    """A, S_1, S_2, I_11, I_12, I_22 of polygons, (n, 6): ∫ f dA over the triangles from the origin to each edge."""
    here, there = corners, corners[next_item(start)]
    twice = here[:, 0] * there[:, 1] - there[:, 0] * here[:, 1]
    middle = powers(here) + powers(there) + powers(here + there)
    middle[:, 0], middle[:, 1:3] = 12.0, 2.0 * middle[:, 1:3]
    return row_sums(twice[:, None] / 24.0 * middle, start)


def products_of(moments: FloatArray) -> FloatArray:
    """∫ (1, y_1, y_2)ᵀ(1, y_1, y_2) dA, (n, 3, 3), by moments (n, 6)."""
    return np.asarray(moments[:, [[0, 1, 2], [1, 3, 4], [2, 4, 5]]])
