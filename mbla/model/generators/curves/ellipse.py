"""Upper half of an ellipse, upright at the springings.

x = a + a sin u, z = b cos u with u from -pi/2 to pi/2, half the span a and the rise b. The length from the crown is
a E(u | 1 - b^2/a^2), the incomplete elliptic integral of the second kind; the curve has turned by atan(b/a tan u).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.generators.curves.division import beside, divide_symmetric

END = np.pi / 2


@dataclass(frozen=True)
class Ellipse:
    """Half an ellipse over a span, with a rise [length]."""

    span: float
    rise: float
    crest: None = None

    def divide(self, count: int, offset: float) -> FloatArray:
        """As ``Curve.divide``."""

        def length(parameters: FloatArray) -> FloatArray:
            turned = np.arctan2(self.rise * np.sin(parameters), self.span / 2 * _cosine(parameters))
            return np.asarray(self._from_crown(parameters) + offset * turned, dtype=np.float64)

        return divide_symmetric(length, END, count)

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """As ``Curve.points``."""
        x = self.span / 2 + self.span / 2 * np.sin(parameters)
        curve = np.stack([x, self.rise * _cosine(parameters)], axis=1)
        return beside(curve, self.forwards(parameters), offsets)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.forwards``."""
        tangents = np.stack([self.span / 2 * _cosine(parameters), -self.rise * np.sin(parameters)], axis=1)
        return np.asarray(tangents / np.hypot(tangents[:, :1], tangents[:, 1:]), dtype=np.float64)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.lengths``."""
        return np.asarray(self._from_crown(parameters) + self._from_crown(np.array([END])), dtype=np.float64)

    def _from_crown(self, parameters: FloatArray) -> FloatArray:
        from scipy.special import ellipeinc

        half = self.span / 2
        ratio = self.rise / half
        return np.asarray(half * ellipeinc(parameters, 1 - ratio * ratio), dtype=np.float64)


def _cosine(parameters: FloatArray) -> FloatArray:
    """Exactly zero at the springings, whose joints are level."""
    return np.where(np.abs(parameters) == END, 0.0, np.cos(parameters))
