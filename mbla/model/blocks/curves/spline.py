"""Smooth curve through given points, such as a measured intrados: a cubic spline over the length of the chords.

The spline has no more than four points to fit at its ends (not-a-knot), fewer where fewer are given. Its length is
integrated by Gauss's rule on panels between the points, the angle by which it has turned is followed from panel to
panel.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.blocks.curves.shapes import Smooth

PANELS = 16
"""between two points; the rule below is then exact to rounding for all but cusps"""
RULE = 12
"""points of Gauss's rule on a panel"""


def curve_through(points: Sequence[Sequence[float]]) -> Smooth:
    """Smooth curve through points (x, z) [length], at least three, in order from left to right."""
    from scipy.interpolate import CubicSpline

    given = np.array(points, dtype=np.float64)
    knots = np.append(0.0, np.cumsum(np.hypot(*np.diff(given, axis=0).T)))
    spline = CubicSpline(knots, given)
    nodes = np.append((knots[:-1, None] + np.diff(knots)[:, None] * np.arange(PANELS) / PANELS).ravel(), knots[-1])
    abscissae, weights = np.polynomial.legendre.leggauss(RULE)

    def stretch(low: FloatArray, high: FloatArray) -> FloatArray:
        """Length between parameters within a panel, (n,)."""
        at = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * abscissae
        return np.asarray((high - low) / 2 * (np.linalg.norm(spline(at, 1), axis=-1) @ weights))

    def angle(at: FloatArray) -> FloatArray:
        x, z = spline(at, 1).T
        return np.asarray(-np.arctan2(z, x))

    def panel(at: FloatArray) -> IntArray:
        return np.clip(np.searchsorted(nodes, at, side="right") - 1, 0, len(nodes) - 2)

    lengths = np.append(0.0, np.cumsum(stretch(nodes[:-1], nodes[1:])))
    angles = np.unwrap(angle(nodes))

    def length(at: FloatArray) -> FloatArray:
        return np.asarray(lengths[panel(at)] + stretch(nodes[panel(at)], at))

    def turned(at: FloatArray) -> FloatArray:
        before = angles[panel(at)]
        return np.asarray(before + (angle(at) - before + np.pi) % (2 * np.pi) - np.pi)

    ends = float(knots[0]), float(knots[-1])
    return Smooth(ends, lambda at: spline(at)[:, 0], lambda at: spline(at)[:, 1], length, turned, symmetric=False)
