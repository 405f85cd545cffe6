"""Normal distribution."""

from __future__ import annotations

import math

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.cut_normal import cut_normal
from mbla.sweeps.design.ways.rounding import rounded_within
from mbla.sweeps.design.ways.way import Filled, Vector, Way, no_levels, plain, register
from mbla.sweeps.file.content import Normal


def _at(section: Normal, u: FloatArray, vector: Vector | None) -> Filled:
    least, greatest = section.least, section.greatest
    values = cut_normal(u[:, 0], section.mean, section.deviation, least, greatest)
    low, high = -math.inf if least is None else least, math.inf if greatest is None else greatest
    return plain(rounded_within(values.tolist(), low, high))


register("normal", Way(no_levels, _at, random=True))
