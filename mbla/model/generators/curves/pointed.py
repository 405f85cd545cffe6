"""Pointed arch: two arcs with their centres on the springing line, meeting in a kink at the apex. Half the span a and
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
