"""Ways of saying the values of a parameter, each a function of quantiles.

Values of a grid are those at quantiles too: of a range at equal steps from 0 to 1, of a list in the middle of each.

Values are rounded for reading: 0.13, not 0.13000000000000003. ``DIGITS`` significant digits are far
more than any measurement gives, few enough that the rounding of the arithmetic and the last digits of mathematical
libraries, which differ from machine to machine, do not show.

A distribution that is cut off is what remains of the full one, in proportion: with F its distribution function,
x(u) = F⁻¹(F(a) + u (F(b) − F(a))). The logarithm of a lognormal value of mean m and standard deviation s is normal with
variance v = ln(1 + (s/m)²) and mean ln m − v/2.

The surface of a sphere between two elevations is in proportion to the difference of their sines (Archimedes), so that
points with equal steps of the sine have bands of equal area; the golden angle from each to the next spreads them within
the bands (R. Swinbank, R. J. Purser, Fibonacci grids, Q. J. R. Meteorol. Soc. 132, 2006, doi:10.1256/qj.05.227).
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterable, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.deck.suggestions import listed
from mbla.errors import ValueRefused
from mbla.sweeps.design.design import SweepColumn, TurnedVector
from mbla.sweeps.design.directions import FULL_CIRCLE, horizontal, sine_cosine, spatial
from mbla.sweeps.file import content as types
from mbla.sweeps.file.content import Parameter, key_paths, way_of
from mbla.sweeps.plan import Plain

DIGITS = 12
"""significant digits that are kept"""
EXACT_DIGITS = 15
"""decimal digits that every float holds"""
GOLDEN_ANGLE = (3 - math.sqrt(5)) / 2
"""as a share of the full circle"""


class WayError(ValueRefused):
    """The values cannot be formed in this design; the message says why and what helps."""


def columns_of(name: str, parameter: Parameter, unit: str, random: bool) -> tuple[SweepColumn, ...]:
    """The columns that a parameter fills, each of which takes a quantile."""
    of = listed(key_paths(name, parameter), "and")
    around = SweepColumn(name, "degree", f"azimuth of {of}, from +x towards +y", "float", "azimuth", name, random)
    if parameter.sphere is not None:
        words = f"elevation of {of} above the horizon"
        above = replace(around, name=f"{name}_elevation", words=words, role="elevation")
        return replace(around, name=f"{name}_azimuth"), above
    if parameter.horizon is not None:
        return (around,)
    kind = "int" if parameter.whole is not None else "float"
    kind = kind if parameter.values is None else _kind_of(parameter.values)
    shown = "" if kind in ("text", "bool") else unit
    return (SweepColumn(name, shown, f"value of {of}", kind, "parameter", name, random),)


def grid_quantiles(parameter: Parameter) -> FloatArray:
    """The quantiles of a grid, (n_values, n_columns): ends and equal steps of ranges, middles of what is counted."""
    count = types.level_count(parameter) or 1
    middles = (np.arange(count) + 0.5) / count
    if parameter.sphere is not None:
        return np.column_stack([np.mod(np.arange(count) * GOLDEN_ANGLE, 1.0), middles])
    if parameter.values is not None or parameter.whole is not None:
        return middles[:, None]
    turn = parameter.horizon  # the last of a full circle, which is the first once more, is left out
    return np.linspace(0.0, 1.0, count, endpoint=turn is None or turn.end - turn.start != FULL_CIRCLE)[:, None]


Filled = tuple[tuple[Sequence[Plain], ...], Sequence[Plain]]
"""Values for each column of a parameter, and what goes into the deck, one for each position"""


def filled(parameter: Parameter, u: FloatArray, vector: TurnedVector | None) -> Filled:
    """What a parameter has at quantiles (n, n_columns) between 0 and 1.

    vector : of the base deck, which a direction turns; None for everything else

    Raises WayError where the values cannot be had.
    """
    section: Any = getattr(parameter, way_of(parameter))
    if parameter.values is not None:
        kind = _kind_of(section)
        picked = [section[i] for i in np.floor(u[:, 0] * len(section)).astype(int).tolist()]
        return ([_shown(value, kind) for value in picked],), picked
    if parameter.horizon is not None:
        return _horizon(section, u[:, 0], vector)
    if parameter.sphere is not None:
        return _sphere(section, u, vector)
    values = _numbers(section, u[:, 0])
    return (values,), values


def _numbers(section: Any, u: FloatArray) -> Sequence[Plain]:
    """Numbers at quantiles (n,) of a range or a distribution."""
    if isinstance(section, types.LinearRange | types.Uniform):
        return _between(float(section.start), float(section.end), u)
    if isinstance(section, types.LogRange):
        return _log(float(section.start), float(section.end), u)
    if isinstance(section, types.IntegerRange):
        count = section.end - section.start + 1
        integers: list[Plain] = (section.start + np.floor(u * count).astype(np.int64)).tolist()
        return integers
    with np.errstate(over="ignore", invalid="ignore"):  # infinite values are reported with the place in the file
        if isinstance(section, types.Normal):
            values = cut_normal(u, section.mean, section.deviation, section.least, section.greatest)
            return rounded_within(values, section.least, section.greatest)
        if isinstance(section, types.Lognormal):
            return rounded_within(_lognormal(section, u), section.least or 0.0, section.greatest)
        return _triangular(section, u)


# --- rounding ---------------------------------------------------------------------------------------------------------


def rounded_within(values: FloatArray, least: float | None, greatest: float | None) -> list[float]:
    """Each value (n,) to DIGITS significant digits, and none thereby beyond its limits, if any.

    Raises WayError where one is too large for a number.
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
        raise WayError("sweep-values", "has ends that numbers cannot distinguish, or lie too far apart for them")
    of_span = DIGITS - 1 - math.floor(math.log10(abs(end - start)))
    of_size = EXACT_DIGITS - 1 - math.floor(math.log10(max(abs(start), abs(end))))
    values = [round(value, min(of_span, of_size)) for value in (start * (1 - u) + end * u).tolist()]
    return _with_ends(values, start, end, u)


def _with_ends(values: Sequence[float], start: float, end: float, u: FloatArray) -> list[float]:
    exact = {0.0: start, 1.0: end}
    return [exact.get(share, value) for share, value in zip(u.tolist(), values, strict=True)]


# --- ranges and lists -------------------------------------------------------------------------------------------------


def _log(start: float, end: float, u: FloatArray) -> list[float]:
    """Equal ratios: every decade equally often."""
    values = 10 ** (math.log10(start) * (1 - u) + math.log10(end) * u)
    return _with_ends(rounded_within(values, min(start, end), max(start, end)), start, end, u)


def _kind_of(values: Sequence[Plain]) -> str:
    """Kind of the column: that of all values, ``float`` for integers and fractions together, else ``text``."""
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


# --- distributions ----------------------------------------------------------------------------------------------------


def cut_normal(u: FloatArray, mean: float, deviation: float, least: float | None, greatest: float | None) -> FloatArray:
    """Values at quantiles u, (n,) as u; from the nearer tail, so that they hold far from the mean too."""
    from scipy.stats import truncnorm  # takes half a second to import, and is for drawn values only

    low = -math.inf if least is None else (least - mean) / deviation
    high = math.inf if greatest is None else (greatest - mean) / deviation
    return np.asarray(mean + deviation * np.asarray(truncnorm.ppf(u, low, high), dtype=float))


def _lognormal(section: types.Lognormal, u: FloatArray) -> FloatArray:
    variance = 2 * math.log(math.hypot(1.0, section.deviation / section.mean))
    mean = math.log(section.mean) - variance / 2
    least, greatest = (None if end is None else math.log(end) for end in (section.least, section.greatest))
    return np.exp(cut_normal(u, mean, math.sqrt(variance), least, greatest))


def _triangular(section: types.Triangular, u: FloatArray) -> list[float]:
    from scipy.stats import triang

    start, span = float(section.start), float(section.end) - float(section.start)
    values = np.asarray(triang.ppf(u, (section.mode - start) / span, loc=start, scale=span), dtype=float)
    return rounded_within(values, start, float(section.end))


# --- directions -------------------------------------------------------------------------------------------------------


def _length_to_turn(components: Iterable[float], given: float | None) -> float:
    """Length of what is turned: as given, or that of a vector of the base deck; WayError where there is none."""
    size = math.hypot(*components) if given is None else given
    if size == 0:
        words = "turns a vector that has no length in these directions: give its size, or change it in the deck"
        raise WayError("sweep-directions", words)
    if math.isinf(size):
        raise WayError("sweep-directions", "turns a vector that is longer than a number holds")
    return size


def _horizon(section: types.Horizon, u: FloatArray, vector: TurnedVector | None) -> Filled:
    """The horizontal part of a vector is turned, its vertical part stays."""
    along_x, along_y, vertical = map(float, vector or (0.0, 0.0, 0.0))
    size = _length_to_turn((along_x, along_y), section.size)
    azimuths = _between(section.start, section.end, u)
    return (azimuths,), [[*horizontal(azimuth, size), vertical] for azimuth in azimuths]


def _sphere(section: types.Sphere, u: FloatArray, vector: TurnedVector | None) -> Filled:
    """Directions at a share of the circle and a share of the surface from the least elevation upwards."""
    low, high = sine_cosine(section.start)[0], sine_cosine(section.end)[0]
    sines = np.clip(low * (1 - u[:, 1]) + high * u[:, 1], -1.0, 1.0)
    elevations = rounded_within(np.degrees(np.arcsin(sines)), section.start, section.end)
    azimuths = rounded_within(FULL_CIRCLE * u[:, 0], None, None)
    size = _length_to_turn(vector or (0.0,), section.size)
    both = zip(azimuths, elevations, strict=True)
    return (azimuths, elevations), [list(spatial(azimuth, elevation, size)) for azimuth, elevation in both]
