"""Directions over a sphere, or between two elevations of it, of equal share of its surface.

The surface between two elevations is in proportion to the difference of their sines (Archimedes), so that points with
equal steps of the sine have bands of equal area; the golden angle from each to the next spreads them within the bands
(R. Swinbank, R. J. Purser, Fibonacci grids, Q. J. R. Meteorol. Soc. 132, 2006, doi:10.1256/qj.05.227).
"""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.sweeps.design.ways.directions import length_to_turn, sine_cosine, spatial
from mbla.sweeps.design.ways.rounding import rounded, rounded_within
from mbla.sweeps.design.ways.way import Filled, Form, Vector, Way, points_of, register
from mbla.sweeps.file.content import Sphere

TURN = (3 - math.sqrt(5)) / 2
"""golden angle as a share of the full circle"""


def _levels(section: Sphere, vector: Vector | None) -> Filled:
    points = points_of(section)
    order = np.arange(points)
    return _pointed(section, np.mod(order * TURN, 1.0), (order + 0.5) / points, vector)


def _at(section: Sphere, u: FloatArray, vector: Vector | None) -> Filled:
    return _pointed(section, u[:, 0], u[:, 1], vector)


def _pointed(section: Sphere, around: FloatArray, up: FloatArray, vector: Vector | None) -> Filled:
    """Directions at a share of the circle and a share of the surface from the least elevation upwards."""
    low, high = sine_cosine(section.start)[0], sine_cosine(section.end)[0]
    sines = np.clip(low * (1 - up) + high * up, -1.0, 1.0)
    elevations = rounded_within(np.degrees(np.arcsin(sines)).tolist(), section.start, section.end)
    azimuths: Sequence[float] = [rounded(value) for value in (360.0 * around).tolist()]
    size = length_to_turn(vector or (0.0,), section.size)
    both = zip(azimuths, elevations, strict=True)
    return Filled((azimuths, elevations), [list(spatial(azimuth, elevation, size)) for azimuth, elevation in both])


_FORMS = (Form(role="azimuth", suffix="_azimuth"), Form(role="elevation", suffix="_elevation"))
register("sphere", Way(_levels, _at, random=True, forms=lambda section: _FORMS))
