"""How an axle stands, and the level directions along its way and across it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.units import Units


@dataclass(frozen=True)
class Tread:
    """How an axle stands: on a rectangle, a line, a point, or on two wheels that each do.

    contact : sides of the rectangle, along and across the way; 0 for none
    gauge   : distance of two wheels across; 0 for none
    """

    contact: tuple[float, float] = (0.0, 0.0)
    gauge: float = 0.0

    def words(self, units: Units) -> str:
        """Of its wheels, or of its length along the way, for the listing."""
        if self.gauge > 0.0:
            return f" on wheels {self.gauge:.6g} {units.length} apart"
        return f" on {self.contact[0]:.6g} {units.length} along its way" if self.contact[0] > 0.0 else ""

    def places(self, place: FloatArray, along: FloatArray) -> list[FloatArray]:
        """Middles of its wheels, or of itself, (3,) each."""
        half = self.gauge / 2 * across(along)
        return [place - half, place + half] if self.gauge > 0.0 else [place]

    def sides(self, along: FloatArray) -> FloatArray:
        """Of its rectangles, (2, 3)."""
        return np.stack([self.contact[0] * along, self.contact[1] * across(along)])

    def corners(self, place: FloatArray, along: FloatArray) -> FloatArray:
        """Of its rectangles, (n, 4, 3); none of a point, and of a line both ends twice."""
        sides = self.sides(along)
        corners = np.array([[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]]) @ sides
        places = self.places(place, along) if any(self.contact) else []
        return np.array([each + corners for each in places]).reshape(-1, 4, 3)


def across(along: FloatArray) -> FloatArray:
    """The level direction to the left of one, (3,) unit."""
    return np.array([-along[1], along[0], 0.0])


def level(way: Sequence[float] | FloatArray) -> FloatArray:
    """The level direction of a way, (3,) unit; nothing of one that is upright."""
    flat = np.array([way[0], way[1], 0.0])
    flat = flat / (np.abs(flat).max() or 1.0)
    return np.asarray(flat / (np.linalg.norm(flat) or 1.0))
