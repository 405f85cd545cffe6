"""Curves of circular arcs.

*Circle* (semicircular and segmental arches). With r the radius and a the half angle of embrace, the springings lie at z
= 0, a span s = 2 r sin a apart, and the centre at x = s/2, z = -r cos a (above the springings for an embrace beyond 180
degrees). The parameter is the angle t from the crown: x = s/2 + r sin t, z = -r cos a + r cos t, with t from -a to a.

*Basket* of three centres: a flat arc between two sharper ones, with common tangents where they meet. Half the span a,
the rise b, and the angle w of each side arc give k = (1 - sin w)/cos w, the radius of the side arcs r = (b - k a)/(1 -
k) with their centres on the springing line, and that of the middle arc R = r + (a - r)/cos w. With w = 60 degrees all
three arcs have the same angle (the construction named after Huygens). The parameter is the angle t from the crown of
the normal, from -pi/2 to pi/2; along each arc dl = (radius + offset) dt.

*Pointed* arch: two arcs with their centres on the springing line, meeting in a kink at the apex. Half the span a and
the rise f give the radius r = (a^2 + f^2)/(2 a); the centres lie r from the far springing, a distance d = r - a beyond
the axis. The line at an offset o is the arc of radius r + o carried on to the axis, where it has turned by acos(d/(r +
o)), more than the curve itself. The parameter is the angle p of the joint over the horizontal: from 0 at the left
springing, 180 degrees at the right one, 90 degrees at the apex, whose joint lies in the plane of symmetry; in between
it jumps on both sides of the apex.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

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


APEX = np.pi / 2


@dataclass(frozen=True)
class Pointed:
    """Pointed curve over a span, with a rise of more than half of it [length]."""

    span: float
    rise: float
    crest: ClassVar[float] = APEX

    @property
    def radius(self) -> float:
        """[length]."""
        return self.span / 4 + self.rise / self.span * self.rise

    def divide(self, count: int, offset: float) -> FloatArray:
        """As ``Curve.divide``; the apex is a joint where the number of voussoirs is even."""
        whole = float(np.arccos((self.radius - self.span / 2) / (self.radius + offset)))
        left = 2 * whole * np.arange((count + 1) // 2) / count
        return np.concatenate([left, [APEX] if count % 2 == 0 else [], np.pi - left[::-1]])

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """As ``Curve.points``."""
        reach = self.radius + offsets
        left = parameters < APEX
        turned = np.where(left, parameters, np.pi - parameters)[:, None]
        # from the springing: radius - reach cos p, which is exact at p = 0
        x = self.radius - reach * np.cos(turned)
        z = reach * np.sin(turned)
        apex, axis = (parameters == APEX)[:, None], self.radius - self.span / 2
        x = np.where(apex, self.span / 2, np.where(left[:, None], x, self.span - x))
        z = np.where(apex, np.sqrt(np.maximum((reach - axis) * (reach + axis), 0.0)), z)
        return np.stack([x, z], axis=-1)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.forwards``; exact at the springings and at the apex."""
        left = parameters < APEX
        turned = np.where(left, parameters, np.pi - parameters)
        up = np.where(parameters == APEX, 0.0, np.cos(turned))
        return np.stack([np.sin(turned), np.where(left, up, -up)], axis=1)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """As ``Curve.lengths``."""
        half = float(np.arctan2(self.rise, self.radius - self.span / 2))
        turned = np.minimum(np.where(parameters < APEX, parameters, np.pi - parameters), half)
        return np.asarray(self.radius * np.where(parameters < APEX, turned, 2 * half - turned), dtype=np.float64)
