"""Convex loops of corners in the plane, and the common part of two, in bulk: Sutherland and Hodgman's clipping.

Faces that match each other have outlines that agree to the last digits but one. General overlay codes may lose such a
common part altogether (GEOS in floating arithmetic returns two points for some pairs of squares that differ by 1e-15);
cutting one polygon by the edge lines of the other is off by rounding at most.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.solids.plane import cut
from mbla.model.solids.ragged import next_item


def convex_loops(points: FloatArray, loop_start: IntArray) -> BoolArray:
    """True for loops that turn one way only and only once around, (n_loops,).

    points     : (n_corners, 2)
    loop_start : (n_loops + 1,)

    Turns below a millionth of the product of the two edges count as straight.
    """
    following = next_item(loop_start)
    edge = points[following] - points
    after = edge[following]
    cross = edge[:, 0] * after[:, 1] - edge[:, 1] * after[:, 0]
    dot = (edge * after).sum(axis=1)
    size = np.hypot(*edge.T) * np.hypot(*after.T)
    turn = np.arctan2(cross, dot)
    first = loop_start[:-1]
    left = np.logical_and.reduceat(cross >= -1e-6 * size, first)
    right = np.logical_and.reduceat(cross <= 1e-6 * size, first)
    winding = np.abs(np.add.reduceat(turn, first))
    return np.asarray((left | right) & (winding < 3 * np.pi))


def signed_areas(points: FloatArray, loop_start: IntArray) -> FloatArray:
    """Area within each loop, counter-clockwise positive, (n_loops,); arguments as of :func:`convex_loops`."""
    following = next_item(loop_start)
    cross = points[:, 0] * points[following, 1] - points[:, 1] * points[following, 0]
    return np.asarray(np.add.reduceat(cross, loop_start[:-1]) / 2)


# Corners handled together: bounds memory to some 200 MB.
_BATCH = 1_000_000


def clip_convex(
    first: FloatArray, first_start: IntArray, second: FloatArray, second_start: IntArray
) -> tuple[FloatArray, IntArray]:
    """Corners of the common part of each pair of convex polygons.

    first, second             : (n_corners, 2) corners in either orientation
    first_start, second_start : (n + 1,)       corners of polygon i are first[first_start[i]:first_start[i + 1]]

    Returns
    -------
    corners : (n_common, 2) counter-clockwise
    start   : (n + 1,)      no corners where there is no common part, one or two where it is a point or a line
    """
    n = len(first_start) - 1
    widths = np.stack([np.diff(first_start), np.diff(second_start)], axis=1)
    counts = np.zeros(n, dtype=np.int64)
    found: list[tuple[IntArray, FloatArray]] = []
    for a, b in np.unique(widths, axis=0):
        group = np.flatnonzero((widths == (a, b)).all(axis=1))
        step = max(int(_BATCH // (a + b)), 1)
        for begin in range(0, len(group), step):
            rows = group[begin : begin + step]
            table, inside = _clip_tables(_table(first, first_start, rows, a), _table(second, second_start, rows, b))
            counts[rows] = inside.sum(axis=1)
            found.append((np.repeat(rows, counts[rows]), table[inside]))
    start = starts(counts)
    corners = np.empty((start[-1], 2))
    for row, points in found:
        # Rows of one table are in ascending order, corners of a row side by side.
        place = np.arange(len(row)) - np.searchsorted(row, row, side="left")
        corners[start[row] + place] = points
    return corners, start


def _table(points: FloatArray, start: IntArray, rows: IntArray, width: int) -> FloatArray:
    """Corners (n_rows, width, 2), counter-clockwise."""
    table = points[start[rows, None] + np.arange(width)]
    relative = table - table[:, :1]
    following = np.roll(relative, -1, axis=1)
    area = (relative[..., 0] * following[..., 1] - relative[..., 1] * following[..., 0]).sum(axis=1)
    clockwise = area < 0
    table[clockwise] = table[clockwise, ::-1]
    return np.asarray(table)


def _clip_tables(subject: FloatArray, window: FloatArray) -> tuple[FloatArray, BoolArray]:
    """Subjects (n, a, 2) cut by every edge line of the windows (n, b, 2).

    Returns corners (n, c, 2), and which of them count: the rest repeat their predecessor or fill empty rows.
    """
    for edge in range(window.shape[1]):
        begin = window[:, edge]
        direction = window[:, (edge + 1) % window.shape[1]] - begin
        relative = subject - begin[:, None]
        side = direction[:, None, 0] * relative[..., 1] - direction[:, None, 1] * relative[..., 0]
        if (side < 0).any():
            subject = cut(subject, side)
    return subject, (subject != np.roll(subject, 1, axis=1)).any(axis=2)
