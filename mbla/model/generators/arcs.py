"""Circular intrados of arches, vaults and domes.

With r the radius and a half the angle of embrace, the springings lie a span s = 2 r sin a apart; the rise over half the
span is the tangent of a/2. The centre lies r cos a below the springings.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray


@dataclass(frozen=True)
class Arc:
    """Radius [length], half angle of embrace [rad], height of the centre over the springings [length]."""

    radius: float
    half_angle: float
    centre: float

    def points(self, radius: float, angles: FloatArray) -> FloatArray:
        """Points (n, 2) at a radius and at angles from the crown: to the side of the middle, over the springings."""
        return np.stack([radius * np.sin(angles), self.centre + radius * np.cos(angles)], axis=1)


def arc_of(span: float, rise: float | None, embrace: float | None) -> Arc:
    """A semicircle, or the segment with that rise, or with that angle of embrace in degrees."""
    if rise is not None:
        half_angle = 2 * float(np.arctan2(rise, span / 2))
    else:
        half_angle = float(np.radians(embrace)) / 2 if embrace is not None else np.pi / 2
    radius = span / (2 * float(np.sin(half_angle)))
    centre = 0.0 if rise is embrace is None else -radius * float(np.cos(half_angle))
    return Arc(radius, half_angle, centre)
