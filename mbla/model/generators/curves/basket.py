"""Basket arch of three centres: a flat arc between two sharper ones, with common tangents where they meet.

Half the span a, the rise b, and the angle w of each side arc give k = (1 - sin w)/cos w, the radius of the side arcs
r = (b - k a)/(1 - k) with their centres on the springing line, and that of the middle arc R = r + (a - r)/cos w.
With w = 60 degrees all three arcs have the same angle (the construction named after Huygens).
The parameter is the angle t from the crown of the normal, from -pi/2 to pi/2; along each arc dl = (radius + offset) dt.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray

END = np.pi / 2


@dataclass(frozen=True)
class Basket:
    """Three-centred curve over a span, with a rise [length] and the angle of each side arc [rad]."""

    span: float
    rise: float
    side_angle: float
    crest: None = None

    @property
    def side_radius(self) -> float:
        """Radius of the side arcs [length]; positive where the rise exceeds k a."""
        k = _rise_over_half_span(self.side_angle)
        return (self.rise - k * self.span / 2) / (1 - k)

    @property
    def middle_radius(self) -> float:
        """Radius of the middle arc [length]."""
        return float(self.side_radius + (self.span / 2 - self.side_radius) / np.cos(self.side_angle))

    def divide(self, count: int, offset: float) -> FloatArray:
        """As ``Curve.divide``: lengths grow linearly with the angle along each arc."""
        knots = self._knots()
        lengths = self._from_crown(knots) + offset * knots
        found = np.interp(np.linspace(lengths[0], lengths[-1], count + 1), lengths, knots)
        found[[0, -1]] = knots[[0, -1]]
        return found

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """As ``Curve.points``."""
        side = np.abs(parameters) > END - self.side_angle
        radius = np.where(side, self.side_radius, self.middle_radius)
        x = self.span / 2 + np.where(side, np.sign(parameters) * (self.span / 2 - self.side_radius), 0.0)
        centre = np.stack([x, np.where(side, 0.0, self.rise - self.middle_radius)], axis=1)
        rays = np.stack([np.sin(parameters), _cosine(parameters)], axis=1)
        found = centre[:, None] + (radius[:, None, None] + offsets[..., None]) * rays[:, None, :]
        return np.asarray(found, dtype=np.float64)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.forwards``."""
        return np.stack([_cosine(parameters), -np.sin(parameters)], axis=1)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.lengths``."""
        return np.asarray(self._from_crown(parameters) - self._from_crown(self._knots())[0], dtype=np.float64)

    def _knots(self) -> FloatArray:
        return np.array([-END, self.side_angle - END, END - self.side_angle, END])

    def _from_crown(self, parameters: FloatArray) -> FloatArray:
        """Length from the crown, negative to the left."""
        beyond = np.maximum(np.abs(parameters) - (END - self.side_angle), 0.0)
        length = self.middle_radius * np.abs(parameters) + (self.side_radius - self.middle_radius) * beyond
        return np.asarray(np.sign(parameters) * length, dtype=np.float64)


def _rise_over_half_span(side_angle: float) -> float:
    return float((1 - np.sin(side_angle)) / np.cos(side_angle))


def _cosine(parameters: FloatArray) -> FloatArray:
    """Exactly zero at the springings, whose joints are level."""
    return np.where(np.abs(parameters) == END, 0.0, np.cos(parameters))
