"""What a curve of an arch or a vault offers: points beside it, directions along it, division into equal lengths.

A curve C(u) runs in a vertical plane from the left springing to the right one, coordinates (x, z), with unit tangent
T = (c, s) and unit normal N = (-s, c) to the left of the direction of travel, which is outside. The line at the offset
o beside it is C + o N. Along it

    dl = (1 + o k) ds,   k the curvature, positive where the curve turns to the right (as an arch does),

so that the length between two parameters is that of the curve itself plus o times the angle it turns by: curves need
their length and their direction only, whatever the thickness of the arch. Equal lengths come from inverting the
monotone function from parameter to length.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

import numpy as np

from mbla.arrays import FloatArray


class Curve(Protocol):
    """A plane curve from its left springing to its right one; parameters grow on the way, in units of its own."""

    @property
    def crest(self) -> float | None:
        """Parameter of a kink that points outside, such as the apex of a pointed arch; None for a smooth curve."""
        ...

    def divide(self, count: int, offset: float) -> FloatArray:
        """Parameters (count + 1,) that divide the line at an offset outside into equal lengths, both ends included."""
        ...

    def points(self, parameters: FloatArray, offsets: FloatArray) -> FloatArray:
        """Points at offsets (n, k) on the joints at parameters (n,), as (n, k, 2).

        At a kink the lines beside the curve are carried on until they meet.
        """
        ...

    def forwards(self, parameters: FloatArray) -> FloatArray:
        """Direction of travel at parameters (n,), unit and at right angles to the joint there, (n, 2)."""
        ...

    def lengths(self, parameters: FloatArray) -> FloatArray:
        """Length of the curve itself from the left springing to parameters (n,)."""
        ...


HALVINGS = 60
"""of an interval; more than a double has digits"""


def invert(function: Callable[[FloatArray], FloatArray], values: FloatArray, low: float, high: float) -> FloatArray:
    """Where an increasing function takes values (n,) between low and high: bisection, all values at once."""
    below, above = np.full(len(values), low), np.full(len(values), high)
    for _ in range(HALVINGS):
        middle = (below + above) / 2
        short = function(middle) < values
        below, above = np.where(short, middle, below), np.where(short, above, middle)
    return np.asarray((below + above) / 2, dtype=np.float64)


def beside(points: FloatArray, forwards: FloatArray, offsets: FloatArray) -> FloatArray:
    """Points at offsets (n, k) outside points (n, 2) of a curve with these directions (n, 2), as (n, k, 2)."""
    outside = np.stack([-forwards[:, 1], forwards[:, 0]], axis=1)
    return np.asarray(points[:, None, :] + offsets[..., None] * outside[:, None, :], dtype=np.float64)
