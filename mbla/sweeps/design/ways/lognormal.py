"""Lognormal distribution by mean m and standard deviation s of the value.

Its logarithm is normal with variance v = ln(1 + (s/m)²) and mean ln m − v/2.
"""

from __future__ import annotations

import math

import numpy as np

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.cut_normal import cut_normal
from mbla.sweeps.design.ways.rounding import rounded_within
from mbla.sweeps.design.ways.way import Filled, Vector, Way, no_levels, plain, register
from mbla.sweeps.file.content import Lognormal


def _at(section: Lognormal, u: FloatArray, vector: Vector | None) -> Filled:
    variance = 2 * math.log(math.hypot(1.0, section.deviation / section.mean))
    mean = math.log(section.mean) - variance / 2
    least = None if section.least is None else math.log(section.least)
    greatest = None if section.greatest is None else math.log(section.greatest)
    with np.errstate(over="ignore", invalid="ignore"):  # told with the other values that are no numbers
        values = np.exp(cut_normal(u[:, 0], mean, math.sqrt(variance), least, greatest))
    high = math.inf if section.greatest is None else section.greatest
    return plain(rounded_within(values.tolist(), section.least or 0.0, high))


register("lognormal", Way(no_levels, _at, random=True))
