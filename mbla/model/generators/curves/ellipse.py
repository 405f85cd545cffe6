"""Ellipse and catenary.

*Ellipse*, its upper half, upright at the springings: x = a + a sin u, z = b cos u with u from -pi/2 to pi/2, half the
span a and the rise b. The length from the crown is a E(u | 1 - b^2/a^2), the incomplete elliptic integral of the second
kind; the curve has turned by atan(b/a tan u).

*Catenary*: the line of thrust of its own weight, where that is the same per length of the line. With the parameter u
from -U to U, x = s/2 + a u and z = a (cosh U - cosh u), where s = 2 a U is the span and the rise f fixes U by f/s =
(cosh U - 1)/(2 U). The length from the crown is a sinh u, and the curve has turned by atan(sinh u).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.generators.curves.curve import beside, divide_symmetric, invert

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


@dataclass(frozen=True)
class Catenary:
    """Catenary over a span, with a rise [length]."""

    span: float
    rise: float
    crest: None = None

    @cached_property
    def end(self) -> float:
        """Parameter U at the right springing."""
        ratio = np.array([2 * self.rise / self.span])
        # (cosh u - 1)/u is at least u/2, and more than the ratio at the logarithm below
        most = float(min(2.0 * ratio[0], 2.0 + 2.0 * np.log1p(ratio[0])))
        return float(invert(lambda u: 2 * np.sinh(u / 2) ** 2 / u, ratio, 0.0, most)[0])

    @property
    def scale(self) -> float:
        """Radius of curvature at the crown, a [length]."""
        return self.span / (2 * self.end)

    def divide(self, count: int, offset: float) -> FloatArray:
        """As ``Curve.divide``."""

        def length(parameters: FloatArray) -> FloatArray:
            slope = np.sinh(parameters)
            return np.asarray(self.scale * slope + offset * np.arctan(slope), dtype=np.float64)

        return divide_symmetric(length, self.end, count)

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """As ``Curve.points``."""
        x = self.span / 2 * (1 + parameters / self.end)
        # cosh U - cosh u, without the loss of digits in a flat one
        z = 2 * self.scale * (np.sinh(self.end / 2) ** 2 - np.sinh(parameters / 2) ** 2)
        return beside(np.stack([x, z], axis=1), self.forwards(parameters), offsets)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.forwards``."""
        return np.stack([1 / np.cosh(parameters), -np.tanh(parameters)], axis=1)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.lengths``."""
        return np.asarray(self.scale * (np.sinh(parameters) + np.sinh(self.end)), dtype=np.float64)
