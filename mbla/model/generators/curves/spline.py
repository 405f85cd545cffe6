"""Smooth curve through given points, such as a measured intrados: a cubic spline over the length of the chords.

The spline has no more than four points to fit at its ends (not-a-knot), fewer where fewer are given. Its length is
integrated by Gauss's rule on panels between the points, the angle by which it has turned is followed from panel to
panel.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.generators.curves.shapes import beside, invert

PANELS = 16
"""between two points; the rule below is then exact to rounding for all but cusps"""
RULE = 12
"""points of Gauss's rule on a panel"""


@dataclass(frozen=True)
class Spline:
    """Smooth curve through points (x, z) [length], at least three, in order from left to right."""

    given: tuple[tuple[float, float], ...]
    crest: None = None

    def divide(self, count: int, offset: float) -> FloatArray:
        """Parameters (n,) as ``Curve.divide``."""

        def length(parameters: FloatArray) -> FloatArray:
            return np.asarray(self.lengths(parameters) + offset * self._turned(parameters), dtype=np.float64)

        low, high = self._ends
        start, total = length(np.array([low, high]))
        inner = invert(length, start + (total - start) * np.arange(1, count) / count, low, high)
        return np.concatenate([[low], inner, [high]])

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """Points (n, k, 2) as ``Curve.points``."""
        return beside(self._spline(parameters), self.forwards(parameters), offsets)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """Unit directions (n, 2) as ``Curve.forwards``."""
        tangents = self._spline(parameters, 1)
        return np.asarray(tangents / np.hypot(tangents[:, :1], tangents[:, 1:]), dtype=np.float64)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """Lengths (n,) [length] as ``Curve.lengths``."""
        panel = self._panel(parameters)
        start = self._nodes[panel]
        return np.asarray(self._length_at_nodes[panel] + self._stretch(start, parameters), dtype=np.float64)

    @cached_property
    def _knots(self) -> FloatArray:
        steps = np.diff(np.array(self.given), axis=0)
        return np.concatenate([[0.0], np.cumsum(np.hypot(steps[:, 0], steps[:, 1]))])

    @cached_property
    def _spline(self) -> Any:
        from scipy.interpolate import CubicSpline

        return CubicSpline(self._knots, np.array(self.given))

    @property
    def _ends(self) -> tuple[float, float]:
        return float(self._nodes[0]), float(self._nodes[-1])

    @cached_property
    def _nodes(self) -> FloatArray:
        fractions = np.arange(PANELS) / PANELS
        inner = self._knots[:-1, None] + np.diff(self._knots)[:, None] * fractions
        return np.append(inner.ravel(), self._knots[-1])

    @cached_property
    def _length_at_nodes(self) -> FloatArray:
        return np.concatenate([[0.0], np.cumsum(self._stretch(self._nodes[:-1], self._nodes[1:]))])

    @cached_property
    def _turned_at_nodes(self) -> FloatArray:
        tangents = self._spline(self._nodes, 1)
        angles = np.unwrap(np.arctan2(tangents[:, 1], tangents[:, 0]))
        return np.asarray(angles[0] - angles, dtype=np.float64)

    def _turned(self, parameters: FloatArray) -> FloatArray:
        """Angle [rad] by which the curve has turned to the right since its start."""
        panel = self._panel(parameters)
        one, other = self._spline(self._nodes[panel], 1), self._spline(parameters, 1)
        across = one[:, 1] * other[:, 0] - one[:, 0] * other[:, 1]
        return np.asarray(self._turned_at_nodes[panel] + np.arctan2(across, (one * other).sum(axis=1)))

    def _panel(self, parameters: FloatArray) -> Any:
        return np.clip(np.searchsorted(self._nodes, parameters, side="right") - 1, 0, len(self._nodes) - 2)

    def _stretch(self, low: FloatArray, high: FloatArray) -> FloatArray:
        """Length between parameters within a panel, (n,)."""
        abscissae, weights = np.polynomial.legendre.leggauss(RULE)
        at = (low + high)[:, None] / 2 + (high - low)[:, None] / 2 * abscissae
        speed = np.linalg.norm(self._spline(at, 1), axis=-1)
        return np.asarray((high - low) / 2 * (speed @ weights), dtype=np.float64)


def through(points: Sequence[Sequence[float]]) -> Spline:
    """Spline through points (x, z)."""
    return Spline(tuple((float(x), float(z)) for x, z in points))
