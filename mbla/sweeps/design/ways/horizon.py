"""Directions around the vertical: the horizontal part of a vector of the deck is turned, its vertical part stays."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.directions import horizontal, length_to_turn
from mbla.sweeps.design.ways.linear import between, steps
from mbla.sweeps.design.ways.way import Filled, Form, Vector, Way, points_of, register
from mbla.sweeps.file.content import Horizon
from mbla.sweeps.file.rules import FULL_CIRCLE


def _levels(section: Horizon, vector: Vector | None) -> Filled:
    """Equal angles; the last of a full circle, which is the first once more, is left out."""
    points, turn = points_of(section), section.end - section.start
    if points == 1:
        azimuths = [float(section.start)]
    else:
        azimuths = steps(section.start, section.end, points, points if turn == FULL_CIRCLE else points - 1)
    return _turned(azimuths, section, vector)


def _at(section: Horizon, u: FloatArray, vector: Vector | None) -> Filled:
    return _turned(between(section.start, section.end, u[:, 0]), section, vector)


def _turned(azimuths: Sequence[float], section: Horizon, vector: Vector | None) -> Filled:
    along_x, along_y, vertical = map(float, vector or (0.0, 0.0, 0.0))
    size = length_to_turn((along_x, along_y), section.size)
    return Filled((azimuths,), [[*horizontal(azimuth, size), vertical] for azimuth in azimuths])


register("horizon", Way(_levels, _at, random=True, forms=lambda section: (Form(role="azimuth"),)))
