"""Where on its path a travelling load is worst: the load factor at each of its positions."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.questions.load_factor import LoadFactor


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


@dataclass(frozen=True)
class Travel(LoadFactor):
    """The load factor of one position."""

    position: TravelPosition
    name: ClassVar[str] = "travel"

    @property
    def series(self) -> str:
        """Load case of all positions."""
        return self.position.series
