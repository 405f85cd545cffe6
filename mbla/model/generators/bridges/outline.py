"""The upper outline of arches and springers, on which spandrels are built: a chain of chords from left to right."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray

SAME = 1e-12
"""distance of two points, relative to the length of the bridge, that is rounding"""


@dataclass(frozen=True)
class Outline:
    """Heights over x: a chain of points (n, 2) with x that grows from point to point."""

    points: FloatArray

    def heights(self, x: FloatArray) -> FloatArray:
        """At places (n,)."""
        return np.asarray(np.interp(x, self.points[:, 0], self.points[:, 1]), dtype=np.float64)

    def crossings(self, level: float, same: float) -> FloatArray:
        """Where the chain passes a level, ascending; corners within ``same`` [length] of it count as on it."""
        x, above = self.points[:, 0], self.points[:, 1] - level
        above = np.where(np.abs(above) <= same, 0.0, above)
        one, other = above[:-1], above[1:]
        through = np.flatnonzero(one * other < 0)
        share = one[through] / (one[through] - other[through])
        between = x[through] + share * (x[through + 1] - x[through])
        # a corner on the level counts where the chain leaves it upwards or downwards there
        touching = np.flatnonzero((above == 0) & ((np.append(other, 0.0) != 0) | (np.append(0.0, one) != 0)))
        return np.sort(np.concatenate([between, x[touching]]))


def build_outline(chains: list[FloatArray]) -> Outline:
    """From the extrados of each arch and the ends of the bridge, in order; points listed twice count once."""
    points = np.concatenate(chains)
    extent = float(np.ptp(points[:, 0]))
    distinct = np.append(True, np.diff(points[:, 0]) > SAME * extent)
    return Outline(points[distinct])
