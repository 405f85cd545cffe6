"""Triangles in a plane, and how their points may move."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True)
class PlaneMesh:
    """Triangles in a plane.

    points    : (n, 2)
    triangles : (m, 3) points of each, counter-clockwise
    along     : (n, 2) unit direction in which a point on a straight edge of the outline may move and leave it as it is;
                zero at corners and inside
    inside    : (n,) points that are on no edge of the outline, and may move both ways
    """

    points: FloatArray
    triangles: IntArray
    along: FloatArray
    inside: BoolArray

    @property
    def fixed(self) -> BoolArray:
        """Points at corners of the outline, which stay, (n,)."""
        return np.asarray(~self.inside & ~self.along.any(axis=1))

    def areas(self, points: FloatArray) -> FloatArray:
        """Of the triangles, (m,), with their points at other places, (n, 2); negative where one is turned over."""
        return areas_of(self.triangles, points)


def areas_of(triangles: IntArray, points: FloatArray) -> FloatArray:
    """Areas of triangles, (n,), positive counter-clockwise."""
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    return np.asarray(((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]) / 2)
