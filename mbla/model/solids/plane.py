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


AT_ONCE = 20_000
"""boxes of which the partners are looked for together"""


def meeting_boxes(
    lower: FloatArray, upper: FloatArray, others_lower: FloatArray, others_upper: FloatArray
) -> tuple[IntArray, IntArray]:
    """Rows of boxes and of others that share a point, sorted by the first, then by the second; corners (n, 3) each."""
    import shapely

    tree = shapely.STRtree(shapely.box(*others_lower[:, :2].T, *others_upper[:, :2].T))
    rectangles = shapely.box(*lower[:, :2].T, *upper[:, :2].T)
    found = [np.empty((2, 0), dtype=np.int64)]
    for begin in range(0, len(lower), AT_ONCE):
        row, other = tree.query(rectangles[begin : begin + AT_ONCE])
        row = row + begin
        near = (lower[row, 2] <= others_upper[other, 2]) & (others_lower[other, 2] <= upper[row, 2])
        found.append(np.stack([row, other])[:, near])
    row, other = np.concatenate(found, axis=1).astype(np.int64)
    order = np.lexsort((other, row))
    return row[order], other[order]
