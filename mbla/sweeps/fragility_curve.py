"""A lognormal curve through the shares of a sample that reach a limit, over what makes the motion stronger.

The probability at a value x of the parameter is taken as ::

    P(x) = Φ(ln(x/θ) / β)

with the median θ and the dispersion β for which the points found are likeliest (Baker 2015, doi:10.1193/021113EQS025M;
Shinozuka and others 2000, doi:10.1061/(ASCE)0733-9399(2000)126:12(1224)). They exist where a point reaches the limit at
less than another stands at, and the shares grow: else the shares step from 0 to 1, and only between which values is
known. Unknown points are left out.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from scipy.optimize import minimize
from scipy.special import log_ndtr, ndtr

from mbla.arrays import BoolArray, FloatArray
from mbla.results.listing.text import sentence, table
from mbla.results.record.objects import Key
from mbla.sweeps.answers import answers_of, numbers_of
from mbla.sweeps.fragility import Asked, beyond, combinations, plain, reached, short
from mbla.sweeps.tables.sweep_table import SweepTable


def lognormal_fit(x: FloatArray, passing: BoolArray) -> tuple[float, float]:
    """Median, in the unit of x, and dispersion; nan where no such curve is the likeliest.

    x       : (n,) above 0, of every point
    passing : (n,) whether it reaches the limit
    """
    if not passing.any() or passing.all() or not x[~passing].max() > x[passing].min():
        return math.nan, math.nan
    logarithm, sign = np.log(x), np.where(passing, 1.0, -1.0)
    middle, width = float(logarithm.mean()), float(logarithm.std())

    def unlikely(line: FloatArray) -> float:
        return -float(log_ndtr(sign * (line[0] + line[1] * (logarithm - middle) / width)).sum())

    found = minimize(unlikely, np.array([0.0, 1.0]), method="Nelder-Mead", options={"xatol": 1e-9, "fatol": 1e-12})
    offset, slope = found.x
    if not found.success or not slope > 0.0:
        return math.nan, math.nan
    return math.exp(middle - width * float(offset / slope)), width / float(slope)


def probability(x: FloatArray, median: float, dispersion: float) -> FloatArray:
    """Of the curve, at values above 0 of any shape."""
    return np.asarray(ndtr(np.log(x / median) / dispersion))


def fragility_curves(of: SweepTable, asked: Asked) -> list[dict[str, Any]]:
    """A curve for each result, combination of what is neither sample nor ``over``, and limit; none without ``over``.

    Returns objects as ``curve_keys`` describes them.
    """
    if not asked.over:
        return []
    (over,) = (column for column in of.columns if column.name == asked.over)
    x, found = numbers_of(over, of[over.name]), []
    for column in (column for column in of.of_role("result") if asked.result in (column.name, column.path)):
        answers = answers_of(of, column)
        past, unknown = beyond(of, answers)
        values = np.where(answers.good, answers.values, np.nan)
        for at, rows in combinations(of, asked.samples, over.dimension):
            for limit in asked.limits:
                passing = (past | reached(values, limit, upwards=True))[rows]
                known = passing | ~unknown[rows]
                fitted = lognormal_fit(x[rows][known], passing[known])
                one = {"result": column.name, "unit": column.unit, "at": at, "limit": plain(limit), "over": over.name}
                names = ("median", "dispersion")
                one |= {name: None if math.isnan(value) else value for name, value in zip(names, fitted, strict=True)}
                found.append(one | {"points": int(known.sum()), "passing": int(passing.sum())})
    return found


NO_CURVE = (
    "no curve: no point reaches the limit at less than another stands at, or the shares do not grow; more values "
    "between them, or more of the sample, may show one"
)


def curve_lines(found: Sequence[Mapping[str, Any]], of: SweepTable) -> list[str]:
    """A table of the curves."""
    if not found:
        return []
    (over,) = (column for column in of.columns if column.name == found[0]["over"])
    lines = sentence(f"lognormal curves over {over.header}, by likelihood:")
    head = ["result", *found[0]["at"], "limit", "points", "passing", "median", "dispersion"]
    lines += table(head, [_row(one) for one in found])
    return lines + (sentence(NO_CURVE) if any(one["median"] is None for one in found) else [])


def _row(one: Mapping[str, Any]) -> list[str]:
    fitted = ["-" if one[name] is None else f"{one[name]:.4g}" for name in ("median", "dispersion")]
    counts = [str(one["points"]), str(one["passing"])]
    return [one["result"], *map(short, one["at"].values()), short(one["limit"]), *counts, *fitted]


def curve_keys(place: str) -> tuple[Key, ...]:
    """Description of these objects in the list at ``place``."""
    return (
        Key(place, "list", "lognormal curves through the shares that reach a limit, over a parameter"),
        Key(f"{place}[]", "object", "of a result column, a limit and a combination of the other parameters"),
        Key(f"{place}[].result", "string", "the column"),
        Key(f"{place}[].unit", "string", "its unit and that of the limit; empty for plain numbers"),
        Key(f"{place}[].at", "object", "the combination"),
        Key(f"{place}[].at.*", "any", "value of a parameter"),
        Key(f"{place}[].limit", "any", "the limit; falls: that a block of a structure in time falls"),
        Key(f"{place}[].over", "string", "the parameter"),
        Key(f"{place}[].median", "number?", "its value at which half of the sample reaches the limit; null: no curve"),
        Key(f"{place}[].dispersion", "number?", "standard deviation of the logarithm; null: no curve"),
        Key(f"{place}[].points", "integer", "points whose side is known, over all values of the parameter"),
        Key(f"{place}[].passing", "integer", "those that reach the limit"),
    )
