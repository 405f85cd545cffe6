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

import numpy as np
from scipy.special import betaincinv

from mbla.arrays import FloatArray, IntArray
from mbla.deck.suggestions import listed
from mbla.errors import UsageError
from mbla.sweeps.answers import Answers, answers_of
from mbla.sweeps.plan import Plain
from mbla.sweeps.results import FACTORS, STATUS
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable

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
        """The same if every unknown point is below it."""
        return np.asarray((self.below + self.unknown) / self.points)


def fragility_of(table: SweepTable, result: str, demands: Sequence[float], confidence: float) -> tuple[Fragility, ...]:
    """For each column of a result and each combination of what is not sampled, in the order of the table.

    result  : name of a column, or key path, which is one in each load case
    demands : in the unit of the result

    Raises
    ------
    UsageError
        the design has no random sample, or there is no such column of numbers
    """
    if not table.samples:
        raise UsageError(
            "sweep-fragility", "fragility needs a random design: the points of this sweep are no random sample"
        )
    found = []
    for column in _columns(table, result):
        _refuse_without_status(table, column)
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


def _columns(table: SweepTable, result: str) -> tuple[SweepColumn, ...]:
    columns = table.of_role("result")
    chosen = [column for column in columns if column.name == result]
    chosen = chosen or [column for column in columns if column.path == result]
    if not chosen:
        raise UsageError(
            "sweep-fragility", f"fragility: no result {result}; the table has {listed(c.name for c in columns)}"
        )
    if any(column.kind not in ("float", "int") for column in chosen):
        raise UsageError("sweep-fragility", f"fragility: {result} is no number")
    return tuple(chosen)


def _refuse_without_status(table: SweepTable, column: SweepColumn) -> None:
    """Without it nobody knows of a missing load factor whether it lies below every demand or above."""
    statuses = [each.case for each in table.of_role("result") if each.path == STATUS]
    if column.path in FACTORS and column.case not in statuses:
        raise UsageError("sweep-fragility", f"fragility: {column.name} needs {STATUS} among the results")


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
    for number in range(len(combinations)):
        rows = np.flatnonzero(row.ravel() == number)
        yield {column.name: values[rows[:1]].tolist()[0] for column, values in outside}, rows
