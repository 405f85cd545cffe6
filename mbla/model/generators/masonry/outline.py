"""Outlines of units that a slope cuts: a piece of a course between two joints, inside sloped ends."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.generators.masonry.stretches import Stretch

SAME_PLACE = 1e-9
"""corners of an outline this close, relative to its extent, are one corner"""


def outline_between(stretch: Stretch, left: float, right: float, low: float, high: float) -> FloatArray:
    """Corners (n, 2) of a unit along the wall and up, counter-clockwise with the wall to the right.

    left, right : joints of the unit; low, high: bed and top of its course
    """
    corners = np.array([[left, low], [right, low], [right, high], [left, high]])
    corners = _left_of(corners, np.array([stretch.left_top, high]), np.array([stretch.left, low]))
    corners = _left_of(corners, np.array([stretch.right, low]), np.array([stretch.right_top, high]))
    apart = np.abs(corners - np.roll(corners, 1, axis=0)).max(axis=1) > SAME_PLACE * np.ptp(corners, axis=0).max()
    found: FloatArray = corners[apart]
    return found


def _left_of(corners: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """The part of a convex outline to the left of the line from start to end."""
    direction = end - start
    side = direction[0] * (corners[:, 1] - start[1]) - direction[1] * (corners[:, 0] - start[0])
    side[np.abs(side) <= SAME_PLACE * np.ptp(corners, axis=0).max() * np.abs(direction).max()] = 0.0
    if (side >= 0).all() or not np.isfinite(side).all():  # blocks as large as that are refused by their coordinates
        return corners
    kept: list[FloatArray] = []
    for a, b, at_a, at_b in zip(corners, np.roll(corners, -1, axis=0), side, np.roll(side, -1), strict=True):
        if at_a >= 0:
            kept.append(a)
        if at_a * at_b < 0:
            kept.append(a + at_a / (at_a - at_b) * (b - a))
    return np.array(kept)


def area(corners: FloatArray) -> float:
    """Area inside an outline."""
    about = corners - corners[0]
    after = np.roll(about, -1, axis=0)
    return float((about[:, 0] * after[:, 1] - about[:, 1] * after[:, 0]).sum() / 2)
