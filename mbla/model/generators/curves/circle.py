"""Circular arc: semicircular and segmental arches.

With r the radius and a the half angle of embrace, the springings lie at z = 0, a span s = 2 r sin a apart, and the
centre at x = s/2, z = -r cos a (above the springings for an embrace beyond 180 degrees). The parameter is the angle t
from the crown: x = s/2 + r sin t, z = -r cos a + r cos t, with t from -a to a.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray


@dataclass(frozen=True)
class Circle:
    """Arc of a circle over a span [length] with a half angle of embrace [rad]."""

    span: float
    half_angle: float
    crest: None = None

    @property
    def radius(self) -> float:
        """[length]."""
        return float(self.span / (2 * np.sin(self.half_angle)))

    @property
    def centre(self) -> FloatArray:
        """(x, z) [length]."""
        return np.array([self.span / 2, -self.radius * np.cos(self.half_angle)])

    def divide(self, count: int, offset: float) -> FloatArray:
        """Equal angles are equal lengths at every offset."""
        return np.linspace(-self.half_angle, self.half_angle, count + 1)

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """As ``Curve.points``; the springings of the curve itself are exact."""
        rays = np.stack([np.sin(parameters), np.cos(parameters)], axis=1)
        found = self.centre + (self.radius + offsets[..., None]) * rays[:, None, :]
        for end, springing in ((-self.half_angle, 0.0), (self.half_angle, self.span)):
            found[(parameters == end)[:, None] & (offsets == 0)] = [springing, 0.0]
        return np.asarray(found, dtype=np.float64)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.forwards``."""
        return np.stack([np.cos(parameters), -np.sin(parameters)], axis=1)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.lengths``."""
        return np.asarray(self.radius * (parameters + self.half_angle), dtype=np.float64)


def segmental(span: float, rise: float) -> Circle:
    """Arc of a given rise: half the rise over half the span is the tangent of half the half angle."""
    return Circle(span, float(2 * np.arctan2(rise, span / 2)))
