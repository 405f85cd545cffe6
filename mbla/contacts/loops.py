"""Loops of corners in the plane, as arrays."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.ragged import next_item


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
    once: BoolArray = (left | right) & (winding < 3 * np.pi)
    return once


def signed_areas(points: FloatArray, loop_start: IntArray) -> FloatArray:
    """Area within each loop, counter-clockwise positive, (n_loops,); arguments as of :func:`convex_loops`."""
    following = next_item(loop_start)
    cross = points[:, 0] * points[following, 1] - points[:, 1] * points[following, 0]
    areas: FloatArray = np.add.reduceat(cross, loop_start[:-1]) / 2
    return areas
