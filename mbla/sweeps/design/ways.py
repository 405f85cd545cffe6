"""Ways of saying the values of a parameter; a new one is a function of quantiles and a line in ``WAYS``.

Values of a grid are those at quantiles too: of a range at equal steps from 0 to 1, of a list in the middle of each.

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
RANGES = ("linear", "log", "horizon")
"""ways whose values in a grid must differ"""
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

    at    : (section, u, vector) -> values at quantiles u (n, n_quantiles), between 0 and 1
    grid  : section -> the quantiles of a grid; None for distributions
    forms : section -> the columns, each of which takes one quantile

    ``vector`` is that of the base deck which a direction turns; None for everything else.
    """

    at: Callable[[Any, FloatArray, Vector | None], Filled]
    grid: Callable[[Any], FloatArray] | None
    forms: Callable[[Any], tuple[Form, ...]] = lambda section: (Form(),)


def _plain(values: Sequence[Plain]) -> Filled:
    """Values that fill their one column as they go into the deck."""
    return Filled((values,), values)


# --- rounding ---------------------------------------------------------------------------------------------------------


def rounded_within(values: FloatArray, least: float | None, greatest: float | None) -> list[float]:
    """Each value (n,) to DIGITS significant digits, and none thereby beyond its limits, if any.

    Raises WayError where one is larger than numbers are.
    """
    if not np.isfinite(values).all():
        raise WayError("sweep-values", "has values beyond what a number holds")
    found = np.array([float(f"{value:.{DIGITS}g}") for value in values])
    clipped: list[float] = (
        np.clip(found, least, greatest).tolist() if (least, greatest) != (None, None) else found.tolist()
    )
    return clipped


def _between(start: float, end: float, u: FloatArray) -> list[float]:
    """Values at shares u (n,) of the range, both ends exact, others to DIGITS digits of the span."""
    if start == end or not math.isfinite(end - start):
        raise WayError("sweep-values", "has ends that numbers do not tell apart, or lie too far apart for them")
    of_span = DIGITS - 1 - math.floor(math.log10(abs(end - start)))
    of_size = EXACT_DIGITS - 1 - math.floor(math.log10(max(abs(start), abs(end))))
    values = [round(value, min(of_span, of_size)) for value in (start * (1 - u) + end * u).tolist()]
    return _with_ends(values, start, end, u)


def _with_ends(values: Sequence[float], start: float, end: float, u: FloatArray) -> list[float]:
    exact = {0.0: start, 1.0: end}
    return [exact.get(share, value) for share, value in zip(u.tolist(), values, strict=True)]


# --- ranges and lists -------------------------------------------------------------------------------------------------


def _steps(section: types.LinearRange | types.LogRange) -> FloatArray:
    return np.linspace(0.0, 1.0, section.points or 2)[:, None]


def _middles(count: int) -> FloatArray:
    return ((np.arange(count) + 0.5) / count)[:, None]


def _linear(section: types.LinearRange | types.Uniform, u: FloatArray, vector: Vector | None) -> Filled:
    return _plain(_between(float(section.start), float(section.end), u[:, 0]))


def _log(section: types.LogRange, u: FloatArray, vector: Vector | None) -> Filled:
    """Equal ratios: every decade equally often."""
    start, end = float(section.start), float(section.end)
    values = 10 ** (math.log10(start) * (1 - u[:, 0]) + math.log10(end) * u[:, 0])
    return _plain(_with_ends(rounded_within(values, min(start, end), max(start, end)), start, end, u[:, 0]))


def _whole(section: types.WholeRange, u: FloatArray, vector: Vector | None) -> Filled:
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


def _list(section: Sequence[Plain], u: FloatArray, vector: Vector | None) -> Filled:
    kind = _kind_of(section)
    picked = [section[i] for i in np.floor(u[:, 0] * len(section)).astype(int).tolist()]
    return Filled(([_shown(value, kind) for value in picked],), picked)


# --- distributions ----------------------------------------------------------------------------------------------------


def cut_normal(u: FloatArray, mean: float, deviation: float, least: float | None, greatest: float | None) -> FloatArray:
    """Values at quantiles u, (n,) as u; from the nearer tail, so that they hold far from the mean too."""
    from scipy.stats import truncnorm  # takes half a second to import, and is for drawn values only

    low = -math.inf if least is None else (least - mean) / deviation
    high = math.inf if greatest is None else (greatest - mean) / deviation
    with np.errstate(over="ignore", invalid="ignore"):  # infinite values are told with the place in the file
        values: FloatArray = mean + deviation * np.asarray(truncnorm.ppf(u, low, high), dtype=float)
    return values


def _normal(section: types.Normal, u: FloatArray, vector: Vector | None) -> Filled:
    values = cut_normal(u[:, 0], section.mean, section.deviation, section.least, section.greatest)
    return _plain(rounded_within(values, section.least, section.greatest))


def _lognormal(section: types.Lognormal, u: FloatArray, vector: Vector | None) -> Filled:
    variance = 2 * math.log(math.hypot(1.0, section.deviation / section.mean))
    mean = math.log(section.mean) - variance / 2
    least, greatest = (None if end is None else math.log(end) for end in (section.least, section.greatest))
    with np.errstate(over="ignore", invalid="ignore"):
        values = np.exp(cut_normal(u[:, 0], mean, math.sqrt(variance), least, greatest))
    return _plain(rounded_within(values, section.least or 0.0, section.greatest))


def _triangular(section: types.Triangular, u: FloatArray, vector: Vector | None) -> Filled:
    from scipy.stats import triang

    start, span = float(section.start), float(section.end) - float(section.start)
    with np.errstate(over="ignore", invalid="ignore"):
        values = np.asarray(triang.ppf(u[:, 0], (section.mode - start) / span, loc=start, scale=span), dtype=float)
    return _plain(rounded_within(values, start, float(section.end)))


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


def _around(section: types.Horizon) -> FloatArray:
    """Equal angles; the last of a full circle, which is the first once more, is left out."""
    full = section.end - section.start == FULL_CIRCLE
    return np.linspace(0.0, 1.0, section.points or 1, endpoint=not full)[:, None]


def _horizon(section: types.Horizon, u: FloatArray, vector: Vector | None) -> Filled:
    """The horizontal part of a vector is turned, its vertical part stays."""
    along_x, along_y, vertical = map(float, vector or (0.0, 0.0, 0.0))
    size = _length_to_turn((along_x, along_y), section.size)
    azimuths = _between(section.start, section.end, u[:, 0])
    return Filled((azimuths,), [[*horizontal(azimuth, size), vertical] for azimuth in azimuths])


def _spiral(section: types.Sphere) -> FloatArray:
    points = section.points or 1
    order = np.arange(points)
    return np.column_stack([np.mod(order * GOLDEN_ANGLE, 1.0), (order + 0.5) / points])


def _sphere(section: types.Sphere, u: FloatArray, vector: Vector | None) -> Filled:
    """Directions at a share of the circle and a share of the surface from the least elevation upwards."""
    low, high = sine_cosine(section.start)[0], sine_cosine(section.end)[0]
    sines = np.clip(low * (1 - u[:, 1]) + high * u[:, 1], -1.0, 1.0)
    elevations = rounded_within(np.degrees(np.arcsin(sines)), section.start, section.end)
    azimuths = rounded_within(FULL_CIRCLE * u[:, 0], None, None)
    size = _length_to_turn(vector or (0.0,), section.size)
    both = zip(azimuths, elevations, strict=True)
    return Filled((azimuths, elevations), [list(spatial(azimuth, elevation, size)) for azimuth, elevation in both])


_AZIMUTH = (Form(role="azimuth"),)
_BOTH_ANGLES = (Form(role="azimuth", suffix="_azimuth"), Form(role="elevation", suffix="_elevation"))

WAYS: dict[str, Way] = {
    "values": Way(_list, lambda section: _middles(len(section)), forms=lambda section: (Form(_kind_of(section)),)),
    "linear": Way(_linear, _steps),
    "log": Way(_log, _steps),
    "whole": Way(
        _whole, lambda section: _middles(section.end - section.start + 1), forms=lambda section: (Form("int"),)
    ),
    "normal": Way(_normal, None),
    "lognormal": Way(_lognormal, None),
    "uniform": Way(_linear, None),
    "triangular": Way(_triangular, None),
    "horizon": Way(_horizon, _around, forms=lambda section: _AZIMUTH),
    "sphere": Way(_sphere, _spiral, forms=lambda section: _BOTH_ANGLES),
}
"""by the key of a parameter in the sweep file"""
