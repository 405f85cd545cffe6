"""Ways of saying the values of a parameter; a new one is its two functions and a line in ``WAYS``.

Values are written as a person would write them: 0.13, not 0.13000000000000003. ``DIGITS`` significant digits are far
more than anybody measures, few enough that the rounding of the arithmetic and the last digits of mathematical
libraries, which differ from machine to machine, do not show.

A distribution that is cut off is what remains of the whole one, in proportion: with F its distribution function,
x(u) = F⁻¹(F(a) + u (F(b) − F(a))). The logarithm of a lognormal value of mean m and standard deviation s is normal with
variance v = ln(1 + (s/m)²) and mean ln m − v/2.

The surface of a sphere between two elevations is in proportion to the difference of their sines (Archimedes), so that
points with equal steps of the sine have bands of equal area; the golden angle from each to the next spreads them within
the bands (R. Swinbank, R. J. Purser, Fibonacci grids, Q. J. R. Meteorol. Soc. 132, 2006, doi:10.1256/qj.05.227).
"""

from __future__ import annotations

import json
import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import ValueRefused
from mbla.sweeps.design.design import Vector
from mbla.sweeps.design.directions import FULL_CIRCLE, horizontal, sine_cosine, spatial
from mbla.sweeps.file import content as types
from mbla.sweeps.plan import Plain

DIGITS = 12
"""significant digits that are kept"""
EXACT_DIGITS = 15
"""decimal digits that every float holds"""
GOLDEN_ANGLE = (3 - math.sqrt(5)) / 2
"""as a share of the full circle"""


class WayError(ValueRefused):
    """The values cannot be had in this design; the message says why and what helps."""


@dataclass(frozen=True)
class Form:
    """A column that a parameter fills.

    suffix : after the name of the parameter
    kind   : ``float``, ``int``, ``bool`` or ``text``
    role   : ``parameter``, ``azimuth`` or ``elevation``
    """

    kind: str = "float"
    role: str = "parameter"
    suffix: str = ""


@dataclass(frozen=True)
class Filled:
    """Values of a parameter.

    columns  : values for each of its columns, one for each position
    settings : what goes into the deck, one for each position
    """

    columns: tuple[Sequence[Plain], ...]
    settings: Sequence[Plain]


@dataclass(frozen=True)
class Way:
    """One way of saying values; ``section`` is what the sweep file holds under its key.

    levels : (section, vector) -> values at the positions of a grid, in order; None for distributions
    at     : (section, u, vector) -> values at quantiles u (n, n_quantiles), each in the open interval (0, 1)
    forms  : section -> the columns, each of which takes one quantile where values are drawn

    ``vector`` is that of the base deck which a direction turns; None for everything else.
    """

    levels: Callable[[Any, Vector | None], Filled] | None
    at: Callable[[Any, FloatArray, Vector | None], Filled]
    forms: Callable[[Any], tuple[Form, ...]] = lambda section: (Form(),)


def _plain(values: Sequence[Plain]) -> Filled:
    """Values that fill their one column as they go into the deck."""
    return Filled((values,), values)


# --- rounding ---------------------------------------------------------------------------------------------------------


def rounded(value: float) -> float:
    """A value to DIGITS significant digits."""
    return float(f"{value:.{DIGITS}g}")


def rounded_within(values: Iterable[float], least: float | None, greatest: float | None) -> list[float]:
    """Each value rounded, and none thereby beyond its limits, if any.

    Raises WayError where one is larger than numbers are.
    """
    found = [rounded(float(value)) for value in values]
    if not all(map(math.isfinite, found)):
        raise WayError("sweep-values", "has values beyond what a number holds")
    low, high = -math.inf if least is None else least, math.inf if greatest is None else greatest
    return [min(max(value, low), high) for value in found]


def _decimals_of(start: float, end: float) -> int:
    """Decimal places that give DIGITS significant digits of the span, as far as numbers of that size have them."""
    if start == end or not math.isfinite(end - start):
        raise WayError("sweep-values", "has ends that numbers do not tell apart, or lie too far apart for them")
    of_span = DIGITS - 1 - math.floor(math.log10(abs(end - start)))
    of_size = EXACT_DIGITS - 1 - math.floor(math.log10(max(abs(start), abs(end))))
    return min(of_span, of_size)


def _all_different(values: list[float]) -> list[float]:
    if len(set(values)) < len(values):
        raise WayError(
            "sweep-values", f"has {len(values)} points that numbers do not tell apart: widen the range, or take fewer"
        )
    return values


# --- ranges and lists -------------------------------------------------------------------------------------------------


def _steps(start: float, end: float, count: int, whole: int) -> list[float]:
    """The first ``count`` of the values that divide a range into ``whole`` equal steps, both ends exact."""
    places = _decimals_of(start, end)
    values = [round(start * (1 - i / whole) + end * (i / whole), places) for i in range(count)]
    values[0] = start
    if count > whole:
        values[-1] = end
    return _all_different(values)


def _between(start: float, end: float, u: FloatArray) -> list[float]:
    """Values at shares u (n,) of the range."""
    return rounded_within((start * (1 - u) + end * u).tolist(), min(start, end), max(start, end))


def _linear_levels(section: types.LinearRange, vector: Vector | None) -> Filled:
    points = section.points or 0
    return _plain(_steps(float(section.start), float(section.end), points, points - 1))


def _linear_at(section: types.LinearRange | types.Uniform, u: FloatArray, vector: Vector | None) -> Filled:
    return _plain(_between(float(section.start), float(section.end), u[:, 0]))


def _log_between(section: types.LogRange, u: FloatArray) -> list[float]:
    """Values at equal ratios: every decade equally often."""
    start, end = float(section.start), float(section.end)
    values = 10 ** (math.log10(start) * (1 - u) + math.log10(end) * u)
    return rounded_within(values.tolist(), min(start, end), max(start, end))


def _log_levels(section: types.LogRange, vector: Vector | None) -> Filled:
    points = section.points or 0
    values = _log_between(section, np.arange(points) / (points - 1))
    values[0], values[-1] = float(section.start), float(section.end)
    return _plain(_all_different(values))


def _log_at(section: types.LogRange, u: FloatArray, vector: Vector | None) -> Filled:
    return _plain(_log_between(section, u[:, 0]))


def _whole_levels(section: types.WholeRange, vector: Vector | None) -> Filled:
    return _plain(range(section.start, section.end + 1))


def _whole_at(section: types.WholeRange, u: FloatArray, vector: Vector | None) -> Filled:
    count = section.end - section.start + 1
    return _plain((section.start + np.floor(u[:, 0] * count).astype(np.int64)).tolist())


def _kind_of(values: Sequence[Plain]) -> str:
    """Kind of the column: that of all values, ``float`` for whole and broken numbers together, else ``text``."""
    if all(isinstance(value, bool) for value in values):
        return "bool"
    if any(isinstance(value, bool) or not isinstance(value, (int, float)) for value in values):
        return "text"
    return "int" if all(isinstance(value, int) for value in values) else "float"


def _shown(value: Plain, kind: str) -> Plain:
    """A value as its column holds it; what is no text, in a column of text, as JSON."""
    if kind == "float" and isinstance(value, (int, float)):
        return float(value)
    return value if kind != "text" or isinstance(value, str) else json.dumps(value, ensure_ascii=False)


def _list_levels(section: Sequence[Plain], vector: Vector | None) -> Filled:
    kind = _kind_of(section)
    return Filled(([_shown(value, kind) for value in section],), list(section))


def _list_at(section: Sequence[Plain], u: FloatArray, vector: Vector | None) -> Filled:
    levels = _list_levels(section, vector)
    picked = np.floor(u[:, 0] * len(section)).astype(int).tolist()
    return Filled(([levels.columns[0][i] for i in picked],), [levels.settings[i] for i in picked])


# --- distributions ----------------------------------------------------------------------------------------------------


def cut_normal(u: FloatArray, mean: float, deviation: float, least: float | None, greatest: float | None) -> FloatArray:
    """Values at quantiles u, (n,) as u; from the nearer tail, so that they hold far from the mean too."""
    from scipy.stats import truncnorm  # takes half a second to import, and is for drawn values only

    low = -math.inf if least is None else (least - mean) / deviation
    high = math.inf if greatest is None else (greatest - mean) / deviation
    with np.errstate(over="ignore", invalid="ignore"):  # infinite values are told with the place in the file
        values: FloatArray = mean + deviation * np.asarray(truncnorm.ppf(u, low, high), dtype=float)
    return values


def _normal_at(section: types.Normal, u: FloatArray, vector: Vector | None) -> Filled:
    values = cut_normal(u[:, 0], section.mean, section.deviation, section.least, section.greatest)
    return _plain(rounded_within(values.tolist(), section.least, section.greatest))


def _lognormal_at(section: types.Lognormal, u: FloatArray, vector: Vector | None) -> Filled:
    variance = 2 * math.log(math.hypot(1.0, section.deviation / section.mean))
    mean = math.log(section.mean) - variance / 2
    least, greatest = (None if end is None else math.log(end) for end in (section.least, section.greatest))
    with np.errstate(over="ignore", invalid="ignore"):
        values = np.exp(cut_normal(u[:, 0], mean, math.sqrt(variance), least, greatest))
    return _plain(rounded_within(values.tolist(), section.least or 0.0, section.greatest))


def _triangular_at(section: types.Triangular, u: FloatArray, vector: Vector | None) -> Filled:
    from scipy.stats import triang

    start, span = float(section.start), float(section.end) - float(section.start)
    with np.errstate(over="ignore", invalid="ignore"):
        values = np.asarray(triang.ppf(u[:, 0], (section.mode - start) / span, loc=start, scale=span), dtype=float)
    return _plain(rounded_within(values.tolist(), start, float(section.end)))


# --- directions -------------------------------------------------------------------------------------------------------


def _length_to_turn(components: Iterable[float], given: float | None) -> float:
    """Length of what is turned: as given, or that of a vector of the base deck; WayError where there is none."""
    size = math.hypot(*components) if given is None else given
    if size == 0:
        raise WayError(
            "sweep-directions",
            "turns a vector that has no length in these directions: give its size, or change it in the deck",
        )
    if math.isinf(size):
        raise WayError("sweep-directions", "turns a vector that is longer than a number holds")
    return size


def _turned(azimuths: Sequence[float], section: types.Horizon, vector: Vector | None) -> Filled:
    """The horizontal part of a vector is turned, its vertical part stays."""
    along_x, along_y, vertical = map(float, vector or (0.0, 0.0, 0.0))
    size = _length_to_turn((along_x, along_y), section.size)
    return Filled((azimuths,), [[*horizontal(azimuth, size), vertical] for azimuth in azimuths])


def _horizon_levels(section: types.Horizon, vector: Vector | None) -> Filled:
    """Equal angles; the last of a full circle, which is the first once more, is left out."""
    points, turn = section.points or 0, section.end - section.start
    if points == 1:
        return _turned([float(section.start)], section, vector)
    steps = points if turn == FULL_CIRCLE else points - 1
    return _turned(_steps(section.start, section.end, points, steps), section, vector)


def _horizon_at(section: types.Horizon, u: FloatArray, vector: Vector | None) -> Filled:
    return _turned(_between(section.start, section.end, u[:, 0]), section, vector)


def _pointed(section: types.Sphere, around: FloatArray, up: FloatArray, vector: Vector | None) -> Filled:
    """Directions at a share of the circle and a share of the surface from the least elevation upwards."""
    low, high = sine_cosine(section.start)[0], sine_cosine(section.end)[0]
    sines = np.clip(low * (1 - up) + high * up, -1.0, 1.0)
    elevations = rounded_within(np.degrees(np.arcsin(sines)).tolist(), section.start, section.end)
    azimuths = [rounded(value) for value in (FULL_CIRCLE * around).tolist()]
    size = _length_to_turn(vector or (0.0,), section.size)
    both = zip(azimuths, elevations, strict=True)
    return Filled((azimuths, elevations), [list(spatial(azimuth, elevation, size)) for azimuth, elevation in both])


def _sphere_levels(section: types.Sphere, vector: Vector | None) -> Filled:
    points = section.points or 0
    order = np.arange(points)
    return _pointed(section, np.mod(order * GOLDEN_ANGLE, 1.0), (order + 0.5) / points, vector)


def _sphere_at(section: types.Sphere, u: FloatArray, vector: Vector | None) -> Filled:
    return _pointed(section, u[:, 0], u[:, 1], vector)


_AZIMUTH = (Form(role="azimuth"),)
_BOTH_ANGLES = (Form(role="azimuth", suffix="_azimuth"), Form(role="elevation", suffix="_elevation"))

WAYS: dict[str, Way] = {
    "values": Way(_list_levels, _list_at, forms=lambda section: (Form(_kind_of(section)),)),
    "linear": Way(_linear_levels, _linear_at),
    "log": Way(_log_levels, _log_at),
    "whole": Way(_whole_levels, _whole_at, forms=lambda section: (Form("int"),)),
    "normal": Way(None, _normal_at),
    "lognormal": Way(None, _lognormal_at),
    "uniform": Way(None, _linear_at),
    "triangular": Way(None, _triangular_at),
    "horizon": Way(_horizon_levels, _horizon_at, forms=lambda section: _AZIMUTH),
    "sphere": Way(_sphere_levels, _sphere_at, forms=lambda section: _BOTH_ANGLES),
}
"""by the key of a parameter in the sweep file"""
