"""Where a travelling load stands."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray


@dataclass(frozen=True)
class TravelPosition:
    """Where a travelling load, a force or the axles of a vehicle, stands in a load case.

    series    : name of the load case in the deck, which became one for each position
    number    : of the position, from 1; ``count`` of them
    points    : (n_axles, 3) m, where each axle stands, the first one first; off the path straight on from its ends
    distances : (n_axles,) m, of each from the beginning of the path; negative before it
    forces    : (n_axles, 3) N; those that are off the path do not act
    blocks    : (n_axles,) that carry them, or most of them; -1 off the path, and where none does
    spread    : they are shared between blocks, by the width of the axles or by fill
    """

    series: str
    number: int
    count: int
    points: FloatArray
    distances: FloatArray
    forces: FloatArray
    blocks: IntArray
    spread: bool = False

    @property
    def point(self) -> FloatArray:
        """Where the first axle stands, (3,) m."""
        return np.asarray(self.points[0])

    @property
    def distance(self) -> float:
        """Of the first axle from the beginning of the path, m."""
        return float(self.distances[0])

    @property
    def acting(self) -> BoolArray:
        """Axles that are on the path, (n_axles,)."""
        return np.asarray(self.blocks >= 0)

    @property
    def apart(self) -> BoolArray:
        """Axles that act each on a block of its own, (n_axles,)."""
        return self.acting & (not self.spread)

    @property
    def suffix(self) -> str:
        """What the name of its load case has after that of the series: ``@07``."""
        return f"@{self.number:0{len(str(self.count))}d}" if self.count else ""


_NONE = np.zeros((0, 3))
NOWHERE = TravelPosition("", 0, 0, _NONE, np.zeros(0), _NONE, np.zeros(0, dtype=np.int64))
"""of what does not travel"""
