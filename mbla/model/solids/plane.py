"""Computing in planes: axes across a normal, and polygons cut by half-planes, of which the signed integral counts.

And boxes in space that meet: a tree over two axes finds them, the third is compared after.

Sutherland and Hodgman 1974 (doi:10.1145/360767.360802): along each edge a corner inside is kept, and where an edge
crosses the line the crossing is added. All loops of an array have the length of the longest, others repeat their last
corner; repeated corners and edges there and back along the line add nothing to an integral over the loop.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.ragged import chunks
from mbla.process.late import shapely


def unit(direction: Sequence[float] | FloatArray) -> FloatArray:
    """The direction, (3,), at length 1; its largest entry first, so that squares neither overflow nor vanish."""
    vector = np.array(direction, dtype=np.float64)
    vector = vector / np.abs(vector).max()
    return np.asarray(vector / np.linalg.norm(vector))


def plane_axes(normals: FloatArray) -> FloatArray:
    """Two unit vectors across each unit normal, (n, 2, 3), right-handed with it: normal × first = second."""
    away = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    first = np.cross(normals, away)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(normals, first)], axis=1)


def cut(loops: FloatArray, heights: FloatArray) -> FloatArray:
    """What of loops lies where ``heights`` >= 0, (n, m, d) from (n, k, d) and the height of each corner, (n, k).

    Loops of which nothing is left are zero.
    """
    n, k = heights.shape
    after = np.roll(np.arange(k), -1)
    inside = np.greater_equal(heights, 0.0)
    h, h_after = heights, heights[:, after]
    crosses = np.not_equal(inside, np.take(inside, after, axis=1))
    t = h / np.where(crosses, h - h_after, 1.0)
    crossing = loops + t[..., None] * (loops[:, after] - loops)
    corners = np.stack([loops, crossing], axis=2).reshape(n, 2 * k, loops.shape[-1])
    kept = np.stack([inside, crosses], axis=2).reshape(n, 2 * k)
    counts = kept.sum(axis=1)
    column = np.minimum(np.arange(max(int(counts.max(initial=k)), k)), np.maximum(counts, 1)[:, None] - 1)
    source = np.take_along_axis(np.argsort(~kept, axis=1, kind="stable"), column, axis=1)
    found = np.take_along_axis(corners, source[..., None], axis=1)
    return np.where(np.any(kept, axis=1, keepdims=True)[..., None], found, 0.0)


def signed_areas(loops: FloatArray) -> FloatArray:
    """Signed areas of plane loops, (n,) from (n, k, 2)."""
    to = loops - loops[:, :1]
    after = np.roll(to, -1, axis=1)
    return np.asarray((to[..., 0] * after[..., 1] - to[..., 1] * after[..., 0]).sum(axis=1) / 2)


MOST_HITS = 20_000_000
"""rectangles that meet, in memory together, wherever they lie"""


class CrowdedError(Exception):
    """Far more boxes share a point than those of things that lie next to each other; ``box`` has most partners."""

    def __init__(self, box: int) -> None:
        super().__init__(box)
        self.box = box


def meeting_boxes(
    lower: FloatArray, upper: FloatArray, others_lower: FloatArray, others_upper: FloatArray, most: float | None = None
) -> tuple[IntArray, IntArray]:
    """Rows of boxes and of others that share a point, sorted by the first, then by the second; corners (n, 3) each.

    most : the others are the boxes themselves, each pair i < j is given once, and there are hardly more than that

    The tree works on the two axes along which the others are smallest relative to all; the third is compared after.

    Raises CrowdedError where there are more.
    """
    found, number = [np.empty((2, 0), dtype=np.int64)], 0
    if len(lower) and len(others_lower):
        extent = others_upper.max(axis=0) - others_lower.min(axis=0)
        share = np.median(others_upper - others_lower, axis=0) / np.where(extent > 0, extent, 1.0)
        x, y, z = np.argsort(np.where(extent > 0, share, 2.0), kind="stable")
        tree = shapely.STRtree(shapely.box(*others_lower[:, [x, y]].T, *others_upper[:, [x, y]].T))
        rectangles = shapely.box(*lower[:, [x, y]].T, *upper[:, [x, y]].T)
        for rows in chunks(np.full(len(lower), len(others_lower)), MOST_HITS):
            row, other = tree.query(rectangles[rows])
            row += rows.start
            near = (lower[row, z] <= others_upper[other, z]) & (others_lower[other, z] <= upper[row, z])
            found.append(np.stack([row, other])[:, near if most is None else near & (row < other)])
            number += found[-1].shape[1]
            if most is not None and number > most:
                raise CrowdedError(int(np.bincount(found[-1][0]).argmax()))
    row, other = np.concatenate(found, axis=1)
    order = np.lexsort((other, row))
    return row[order], other[order]
