"""Triangular distribution: its density rises evenly to the most likely value and falls evenly from it."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.rounding import rounded_within
from mbla.sweeps.design.ways.way import Filled, Vector, Way, no_levels, plain, register
from mbla.sweeps.file.content import Triangular


def _at(section: Triangular, u: FloatArray, vector: Vector | None) -> Filled:
    from scipy.stats import triang  # takes half a second to import, and is for drawn values only

    start, span = float(section.start), float(section.end) - float(section.start)
    with np.errstate(over="ignore", invalid="ignore"):  # what is no number is told with its place in the file
        values = np.asarray(triang.ppf(u[:, 0], (section.mode - start) / span, loc=start, scale=span), dtype=float)
    return plain(rounded_within(values.tolist(), start, float(section.end)))


register("triangular", Way(no_levels, _at, random=True))
