"""Probability that a result lies below a demand, estimated from the random sample of a design.

Of n sample points k lie below the demand. The interval of that probability is that of Clopper and Pearson (1934,
doi:10.1093/biomet/26.4.404), which holds at least the confidence that it is given, whatever n and k: its ends are
quantiles of beta distributions, ::

    lower = I⁻¹(α/2; k, n − k + 1),   upper = I⁻¹(1 − α/2; k + 1, n − k),   α = 1 − confidence.

(The narrower one of Wilson holds it on average only, and fails where k is 0 or 1, which is where safety is judged.) It
is exact for points drawn at random. Points of a Latin hypercube or of a Sobol sequence are not independent; their
fraction mostly scatters less, for a Latin hypercube never notably more (Owen 1997, doi:10.1137/S0036142994277468), so
that the same interval is mostly too wide and nowhere guaranteed.

A structure that does not stand lies below every demand, one that no load brings down above every one. A point without a
verified answer is unknown: it is counted on either side in turn, and the interval holds both.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import betaincinv

from mbla.arrays import FloatArray, IntArray
from mbla.results.listing.text import sentence, table
from mbla.results.record.json_values import number, numbers
from mbla.results.record.keys import Key
from mbla.results.tables.formats import csv_text
from mbla.sweeps.answers import Answers, answers_of
from mbla.sweeps.design.design import SweepColumn, header_of
from mbla.sweeps.plan import Plain
from mbla.sweeps.tables.sweep_table import SweepTable, as_text

SAME = 1e-6
"""relative distance below a demand up to which a value still bears it: load factors are found to that accuracy, and one
that is the demand, as the slenderness of a block that rocks may be, must not be counted by its rounding"""


@dataclass(frozen=True)
class Fragility:
    """Of one result, at one combination of what is not sampled.

    column     : of the result
    at, units  : value and unit of each parameter outside of the sample, by its name
    points     : sample points, at least one
    left_out   : sample points that constraints leave out here: the probability is that of the others
    demands    : (n,) in the unit of the column
    below      : (n,) points certainly below each
    unknown    : points without a verified answer
    lower, upper : (n,) ends of the interval
    confidence : of the interval
    sampling   : ``random``, ``latin_hypercube`` or ``sobol``
    """

    column: SweepColumn
    at: Mapping[str, Plain]
    units: Mapping[str, str]
    points: int
    left_out: int
    demands: FloatArray
    below: IntArray
    unknown: int
    lower: FloatArray
    upper: FloatArray
    confidence: float
    sampling: str

    @property
    def least(self) -> FloatArray:
        """Fraction below each demand if every unknown point is above it, (n,)."""
        return np.asarray(self.below / self.points)

    @property
    def greatest(self) -> FloatArray:
        """The same if every unknown point is below it, (n,)."""
        return np.asarray((self.below + self.unknown) / self.points)


def fragility_of(table: SweepTable, result: str, demands: Sequence[float], confidence: float) -> tuple[Fragility, ...]:
    """For each column of a result and each combination of what is not sampled, in the order of the table.

    result  : name of a column of numbers, or key path, which is one in each load case
    demands : in the unit of the result
    """
    found = []
    for column in (column for column in table.of_role("result") if result in (column.name, column.path)):
        answers = answers_of(table, column)
        for at, rows in _combinations(table):
            found.append(_fragility(table, answers, at, rows, np.array(demands, dtype=np.float64), confidence))
    return tuple(found)


def interval(below: IntArray, unknown: int, points: int, confidence: float) -> tuple[FloatArray, FloatArray]:
    """Ends of the interval of the probability, (n,) each; 0 and 1 where nothing is known.

    below   : (n,) points certainly below
    unknown : points that may be below or not
    """
    tail = (1.0 - confidence) / 2.0
    least, greatest = np.asarray(below, dtype=np.float64), np.asarray(below + unknown, dtype=np.float64)
    first, last = least > 0, greatest < points
    lower, upper = np.zeros(len(least)), np.ones(len(least))
    lower[first] = betaincinv(least[first], points - least[first] + 1.0, tail)
    upper[last] = betaincinv(greatest[last] + 1.0, points - greatest[last], 1.0 - tail)
    return lower, upper


def _fragility(
    table: SweepTable,
    answers: Answers,
    at: Mapping[str, Plain],
    rows: IntArray,
    demands: FloatArray,
    confidence: float,
) -> Fragility:
    values = answers.values[rows][answers.good[rows]]
    below = (values[:, None] < demands - SAME * np.abs(demands)).sum(axis=0) + int(answers.below[rows].sum())
    count = int(answers.unknown[rows].sum())
    lower, upper = interval(below, count, len(rows), confidence)
    return Fragility(
        column=answers.column,
        at=at,
        units={column.name: column.unit for column in table.columns if column.name in at},
        points=len(rows),
        left_out=_sample_size(table) - len(rows),
        demands=demands,
        below=below,
        unknown=count,
        lower=lower,
        upper=upper,
        confidence=confidence,
        sampling=table.sampling,
    )


def _sample_size(table: SweepTable) -> int:
    return next(dimension.size for dimension in table.dimensions if dimension.name == table.samples)


def _combinations(table: SweepTable) -> Iterator[tuple[dict[str, Plain], IntArray]]:
    """Values of the parameters outside of the sample, and the rows of its points, in the order of the design."""
    names = [dimension.name for dimension in table.dimensions]
    others = [axis for axis, name in enumerate(names) if name != table.samples]
    outside = [
        (column, values)
        for column, values in zip(table.columns, table.values, strict=True)
        if column.dimension and column.dimension != table.samples
    ]
    combinations, row = np.unique(table.position[:, others], axis=0, return_inverse=True)
    for place in range(len(combinations)):
        rows = np.flatnonzero(row.ravel() == place)
        yield {column.name: values[rows[:1]].tolist()[0] for column, values in outside}, rows


NOT_INDEPENDENT = (
    "the points of a {} are not independent: the interval is that of as many points drawn at random, mostly too wide "
    "for these, and not guaranteed"
)
SAMPLED = {
    "random": "",
    "latin_hypercube": NOT_INDEPENDENT.format("Latin hypercube"),
    "sobol": NOT_INDEPENDENT.format("Sobol sequence"),
}
"""what is said of intervals of samples that are not drawn point by point"""
UNKNOWN = (
    "points without a verified answer are unknown: they are counted both as below and as above a demand, and the "
    "interval holds both"
)


def fragility_lines(found: Sequence[Fragility]) -> list[str]:
    """A table of every demand, combination and result, and what must be known of them."""
    if not found:
        return []
    rows = _rows(found)
    head = [name for name in rows if name not in ("confidence", "sampling")]
    cells = [[_short(value) for value in row] for row in zip(*(rows[name] for name in head), strict=True)]
    lines = sentence(
        f"probability that a result lies below a demand, with its {100 * found[0].confidence:g} % interval:"
    )
    lines += table([SHORT.get(name, name) for name in head], cells)
    remarks = [
        *dict.fromkeys(SAMPLED[one.sampling] for one in found),
        *([UNKNOWN] if any(one.unknown for one in found) else []),
    ]
    return lines + [line for remark in remarks if remark for line in sentence(remark)]


SHORT = {
    "probability_least": "at least",
    "probability_greatest": "at most",
    "interval_lower": "from",
    "interval_upper": "to",
}
"""names of columns on the terminal"""


def _short(value: Plain) -> str:
    return f"{value:.4g}" if isinstance(value, float) else as_text(value)


def _rows(found: Sequence[Fragility]) -> dict[str, list[Any]]:
    """Columns by their headers: a row for each result, combination and demand."""
    rows = [(one, row) for one in found for row in range(len(one.demands))]
    first = found[0]
    return {
        "result": [one.column.name for one, _ in rows],
        **{header_of(name, first.units[name]): [one.at[name] for one, _ in rows] for name in first.at},
        header_of("demand", first.column.unit): [float(one.demands[row]) for one, row in rows],
        "points": [one.points for one, _ in rows],
        "below": [int(one.below[row]) for one, row in rows],
        "unknown": [one.unknown for one, _ in rows],
        "probability_least": [float(one.least[row]) for one, row in rows],
        "probability_greatest": [float(one.greatest[row]) for one, row in rows],
        "interval_lower": [float(one.lower[row]) for one, row in rows],
        "interval_upper": [float(one.upper[row]) for one, row in rows],
        "confidence": [one.confidence for one, _ in rows],
        "sampling": [one.sampling for one, _ in rows],
    }


def fragility_csv(found: Sequence[Fragility]) -> str:
    """The text of sweep_fragility.csv: a row for each result, combination and demand."""
    if not found:
        return ""
    rows = _rows(found)
    return csv_text(tuple(rows), [np.array(values, dtype=object) for values in rows.values()])


def fragility_json(found: Sequence[Fragility]) -> list[dict[str, Any]]:
    """An object for each result and combination, as ``fragility_keys`` describes them."""
    return [
        {
            "result": one.column.name,
            "unit": one.column.unit,
            "at": dict(one.at),
            "sampling": one.sampling,
            "confidence": one.confidence,
            "points": one.points,
            "left_out": one.left_out,
            "unknown": one.unknown,
            "demands": [
                {
                    "demand": number(demand),
                    "below": int(below),
                    "probability": numbers((least, greatest)),
                    "interval": numbers((lower, upper)),
                }
                for demand, below, least, greatest, lower, upper in zip(
                    one.demands, one.below, one.least, one.greatest, one.lower, one.upper, strict=True
                )
            ],
        }
        for one in found
    ]


def fragility_keys(place: str) -> tuple[Key, ...]:
    """Description of these objects in the list at ``place``."""
    return (
        Key(place, "list", "probabilities that a result lies below demands"),
        Key(f"{place}[]", "object", "of a result column at a combination of the parameters outside of the sample"),
        Key(f"{place}[].result", "string", "the column"),
        Key(f"{place}[].unit", "string", "its unit and that of the demands; empty for plain numbers"),
        Key(f"{place}[].at", "object", "the combination"),
        Key(f"{place}[].at.*", "any", "value of a parameter"),
        Key(f"{place}[].sampling", "string", "random, latin_hypercube or sobol; intervals are exact for random alone"),
        Key(f"{place}[].confidence", "number", "of the intervals"),
        Key(f"{place}[].points", "integer", "points of the sample"),
        Key(f"{place}[].left_out", "integer", "more of it, left out by constraints"),
        Key(f"{place}[].unknown", "integer", "those without a verified answer"),
        Key(f"{place}[].demands", "list", "in the order of the sweep file"),
        Key(f"{place}[].demands[]", "object", "a demand"),
        Key(f"{place}[].demands[].demand", "number", "the demand"),
        Key(f"{place}[].demands[].below", "integer", "points certainly below it"),
        Key(f"{place}[].demands[].probability", "list", "fraction below it with unknown points above, and below"),
        Key(f"{place}[].demands[].probability[]", "number", "a fraction"),
        Key(f"{place}[].demands[].interval", "list", "of Clopper and Pearson, over both counts"),
        Key(f"{place}[].demands[].interval[]", "number", "an end"),
    )
