"""Curves of arches and vaults: points at offsets, directions along them, division into equal lengths.

A curve C(u) runs in a vertical plane from the left springing to the right one, coordinates (x, z), with unit tangent
T = (c, s) and unit normal N = (-s, c) to the left of the direction of travel, which is outside. The line at the offset
o from it is C + o N. Along it

    dl = (1 + o k) ds,   k the curvature, positive where the curve turns to the right (as an arch does),

so that the length between two parameters is that of the curve itself plus o times the angle it turns by: curves need
their length and their direction only, whatever the thickness of the arch. Equal lengths come from inverting the
monotone function from parameter to length.

*Circle* (semicircular and segmental arches). With r the radius and a the half angle of embrace, the springings lie at z
= 0, a span s = 2 r sin a apart, and the centre at x = s/2, z = -r cos a (above the springings for an embrace beyond 180
degrees). The parameter is the angle t from the crown: x = s/2 + r sin t, z = -r cos a + r cos t, with t from -a to a.

*Basket* of three centres: a flat arc between two sharper ones, with common tangents where they meet. Half the span a,
the rise b, and the angle w of each side arc give k = (1 - sin w)/cos w, the radius of the side arcs r = (b - k a)/(1 -
k) with their centres on the springing line, and that of the middle arc R = r + (a - r)/cos w. With w = 60 degrees all
three arcs have the same angle (the construction named after Huygens). The parameter is the angle t from the crown of
the normal, from -pi/2 to pi/2.

*Ellipse*, its upper half, upright at the springings: x = a + a sin u, z = b cos u with u from -pi/2 to pi/2, half the
span a and the rise b. The length from the crown is a E(u | 1 - b^2/a^2), the incomplete elliptic integral of the second
kind; the curve has turned by atan(b/a tan u).

*Catenary*: the line of thrust of its own weight, where that is the same per length of the line. With the parameter u
from -U to U, x = s/2 + a u and z = a (cosh U - cosh u), where s = 2 a U is the span and the rise f fixes U by f/s =
(cosh U - 1)/(2 U). The length from the crown is a sinh u, and the curve has turned by atan(sinh u).

*Pointed* arch: two arcs with their centres on the springing line, meeting in a kink at the apex. Half the span a and
the rise f give the radius r = (a^2 + f^2)/(2 a); the centres lie r from the far springing, a distance d = r - a beyond
the axis. The line at an offset o is the arc of radius r + o carried on to the axis, where it has turned by acos(d/(r +
o)), more than the curve itself. The parameter is the angle p of the joint over the horizontal: from 0 at the left
springing, 180 degrees at the right one, 90 degrees at the apex, whose joint lies in the plane of symmetry; in between
it jumps on both sides of the apex.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar, TypeAlias

import numpy as np

from mbla.arrays import FloatArray

RIGHT = np.pi / 2
HALVINGS = 60
"""of an interval; more than a double has digits"""
Along: TypeAlias = Callable[[FloatArray], FloatArray]
"""function of parameters (n,), with values (n,)"""


def invert(function: Along, values: FloatArray, low: float, high: float) -> FloatArray:
    """Where an increasing function takes values (n,) between low and high: bisection, all values at once."""
    below, above = np.full(len(values), low), np.full(len(values), high)
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        short = function(middle) < values
        below, above = np.where(short, middle, below), np.where(short, above, middle)
    return np.asarray((below + above) / 2, dtype=np.float64)


@dataclass(frozen=True)
class Smooth:
    """A plane curve from its left springing to its right one; parameters grow on the way, in units of its own.

    ends      : parameters of the springings; of a curve that is its own mirror image -end and end, 0 at the crown
    x, z      : coordinates [length]
    length    : from anywhere on it [length]
    turned    : angle from +x to the direction of travel, to the right [rad]
    symmetric : it is its own mirror image
    crest     : parameter of a kink that points outside, such as the apex of a pointed arch; a smooth curve has none
    """

    ends: tuple[float, float]
    x: Along
    z: Along
    length: Along
    turned: Along
    symmetric: bool = True
    crest: ClassVar[None] = None

    def divide(self, count: int, offset: float) -> FloatArray:
        """Parameters (count + 1,) that divide the line at an offset outside into equal lengths, both ends included.

        Those of a curve that is its own mirror image are so to the last digit.
        """

        def length(parameters: FloatArray) -> FloatArray:
            return np.asarray(self.length(parameters) + offset * self.turned(parameters), dtype=np.float64)

        first, last = length(np.array(self.ends))
        inner = invert(length, first + (last - first) * np.arange(1, count) / count, *self.ends)
        if self.symmetric:
            inner = (inner - inner[::-1]) / 2
        return np.concatenate([self.ends[:1], inner, self.ends[1:]])

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """Points at offsets (n, k) outside, on the joints at parameters (n,), as (n, k, 2)."""
        curve, forwards = np.stack([self.x(parameters), self.z(parameters)], axis=1), self.forwards(parameters)
        outside = np.stack([-forwards[:, 1], forwards[:, 0]], axis=1)
        return np.asarray(curve[:, None, :] + offsets[..., None] * outside[:, None, :], dtype=np.float64)

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """Direction of travel at parameters (n,), unit and at right angles to the joint there, (n, 2)."""
        turned = self.turned(parameters)
        return np.stack([_cosine(turned), -np.sin(turned)], axis=1)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """Length of the curve itself from the left springing to parameters (n,) [length]."""
        return np.asarray(self.length(parameters) - self.length(np.array(self.ends[:1])), dtype=np.float64)


def _cosine(angles: FloatArray) -> FloatArray:
    """Exactly zero at a right angle: joints at springings are level there."""
    return np.where(np.abs(angles) == RIGHT, 0.0, np.cos(angles))


def circle(span: float, half_angle: float) -> Smooth:
    """Arc of a circle over a span [length] with a half angle of embrace [rad]."""
    radius = radius_of(span, half_angle)
    return Smooth(
        (-half_angle, half_angle),
        x=lambda t: span / 2 + radius * np.sin(t),
        z=lambda t: radius * (np.cos(t) - np.cos(half_angle)),
        length=lambda t: radius * t,
        turned=lambda t: t,
    )


def radius_of(span: float, half_angle: float) -> float:
    """Of the circle over a span with a half angle of embrace [length]."""
    return float(span / (2 * np.sin(half_angle)))


def segmental(span: float, rise: float) -> Smooth:
    """Arc of a given rise: half the rise over half the span is the tangent of half the half angle."""
    return circle(span, float(2 * np.arctan2(rise, span / 2)))


def basket(span: float, rise: float, side_angle: float) -> Smooth:
    """Three-centred curve over a span, with a rise [length] and the angle of each side arc [rad]."""
    k = float((1 - np.sin(side_angle)) / np.cos(side_angle))
    sides = (rise - k * span / 2) / (1 - k)  # positive where the rise exceeds k a
    middle = float(sides + (span / 2 - sides) / np.cos(side_angle))

    def beyond(t: FloatArray) -> FloatArray:
        """Angle on a side arc, negative on the left one."""
        return np.asarray(np.sign(t) * np.maximum(np.abs(t) - (RIGHT - side_angle), 0.0))

    return Smooth(
        (-RIGHT, RIGHT),
        x=lambda t: (
            span / 2 + np.where(beyond(t) != 0, np.sign(t) * (span / 2 - sides) + sides * np.sin(t), middle * np.sin(t))
        ),
        z=lambda t: np.where(beyond(t) != 0, sides * _cosine(t), rise - middle + middle * np.cos(t)),
        length=lambda t: middle * t + (sides - middle) * beyond(t),
        turned=lambda t: t,
    )


def ellipse(span: float, rise: float) -> Smooth:
    """Half an ellipse over a span, with a rise [length]."""
    half = span / 2
    ratio = rise / half

    def length(u: FloatArray) -> FloatArray:
        from scipy.special import ellipeinc

        return np.asarray(half * ellipeinc(u, 1 - ratio * ratio), dtype=np.float64)

    return Smooth(
        (-RIGHT, RIGHT),
        x=lambda u: half + half * np.sin(u),
        z=lambda u: rise * _cosine(u),
        length=length,
        turned=lambda u: np.arctan2(rise * np.sin(u), half * _cosine(u)),
    )


def catenary(span: float, rise: float) -> Smooth:
    """Catenary over a span, with a rise [length]."""
    ratio = np.array([2 * rise / span])
    # (cosh u - 1)/u is at least u/2, and more than the ratio at the logarithm below
    most = float(min(2.0 * ratio[0], 2.0 + 2.0 * np.log1p(ratio[0])))
    end = float(invert(lambda u: 2 * np.sinh(u / 2) ** 2 / u, ratio, 0.0, most)[0])
    scale = span / (2 * end)  # radius of curvature at the crown, a
    return Smooth(
        (-end, end),
        x=lambda u: span / 2 * (1 + u / end),
        # cosh U - cosh u, without the loss of digits in a flat one
        z=lambda u: 2 * scale * (np.sinh(end / 2) ** 2 - np.sinh(u / 2) ** 2),
        length=lambda u: scale * np.sinh(u),
        turned=lambda u: np.arctan(np.sinh(u)),
    )


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
        """Parameters (n,) as ``Smooth.divide``; the apex is a joint where the number of voussoirs is even."""
        total = float(np.arccos((self.radius - self.span / 2) / (self.radius + offset)))
        left = 2 * total * np.arange((count + 1) // 2) / count
        return np.concatenate([left, [APEX] if count % 2 == 0 else [], np.pi - left[::-1]])

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """Points (n, k, 2) as ``Smooth.points``; at the apex the offset lines meet."""
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
        """Unit directions (n, 2) as ``Smooth.forwards``; exact at the springings and at the apex."""
        left = parameters < APEX
        turned = np.where(left, parameters, np.pi - parameters)
        up = np.where(parameters == APEX, 0.0, np.cos(turned))
        return np.stack([np.sin(turned), np.where(left, up, -up)], axis=1)

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """Lengths (n,) [length] as ``Smooth.lengths``."""
        half = float(np.arctan2(self.rise, self.radius - self.span / 2))
        turned = np.minimum(np.where(parameters < APEX, parameters, np.pi - parameters), half)
        return np.asarray(self.radius * np.where(parameters < APEX, turned, 2 * half - turned), dtype=np.float64)
