"""A range in equal ratios; drawn, every decade of it equally often."""

from __future__ import annotations

import math

import numpy as np

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.rounding import rounded_within
from mbla.sweeps.design.ways.way import Filled, Vector, Way, WayError, plain, points_of, register
from mbla.sweeps.file.content import LogRange


def _levels(section: LogRange, vector: Vector | None) -> Filled:
    """Values at equal ratios, both ends exact, those between to 12 significant digits."""
    points = points_of(section)
    values = _between(section, np.arange(points) / (points - 1))
    values[0], values[-1] = float(section.start), float(section.end)
    if len(set(values)) < points:
        raise WayError(
            "sweep-values", f"has {points} points that numbers do not tell apart: widen the range, or take fewer"
        )
    return plain(values)


def _at(section: LogRange, u: FloatArray, vector: Vector | None) -> Filled:
    return plain(_between(section, u[:, 0]))


def _between(section: LogRange, u: FloatArray) -> list[float]:
    start, end = float(section.start), float(section.end)
    values = 10 ** (math.log10(start) * (1 - u) + math.log10(end) * u)
    return rounded_within(values.tolist(), min(start, end), max(start, end))


register("log", Way(_levels, _at, random=False))
