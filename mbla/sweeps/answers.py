"""What each point of a sweep has of one result: a verified value, or which other answer, or none.

Pictures and probabilities use these records, so that a point without a verified answer looks the same everywhere.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.record.scene import Values
from mbla.solution.solution import Status
from mbla.sweeps.plan import DONE
from mbla.sweeps.results import FACTORS, STATUS, is_of_run
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable

ALIKE = 1e-6
"""relative; numbers are shown with six digits, and the others are below the accuracy of solvers"""


class Answer(IntEnum):
    """Of a point, or of the points of a cell (MIXED: texts that differ; PARTLY: a median that holds whatever the points
    without a verified value would have).
    """

    VALUE = 0
    UNVERIFIED = 1
    NO_EQUILIBRIUM = 2
    UNBOUNDED = 3
    NONE = 4
    FAILED = 5
    NOT_RUN = 6
    MIXED = 7
    PARTLY = 8


@dataclass(frozen=True)
class Answers:
    """One result of all points.

    values     : (n_points,) nan where there is none; of text and truth values the place among ``categories``
    answer     : (n_points,) of ``Answer``
    categories : texts in alphabetical order; empty for numbers
    """

    column: SweepColumn
    values: FloatArray
    answer: IntArray
    categories: tuple[str, ...] = ()

    @property
    def is_factor(self) -> bool:
        """Whether the result is a load factor."""
        return self.column.path in FACTORS

    @property
    def good(self) -> BoolArray:
        """Points with a verified value, (n_points,)."""
        return np.asarray(self.answer == Answer.VALUE)

    @property
    def label(self) -> str:
        """``load factor [unit]``, with ``, push_x`` where the table has several load cases."""
        case = self.column.case
        several = bool(case) and self.column.name.startswith(f"{case}.")
        name = self.column.name.removeprefix(f"{case}." if several else "").replace("_", " ")
        name += f", {case}" if several else ""
        return f"{name} [{self.column.unit}]" if self.column.unit else name

    @property
    def below(self) -> BoolArray:
        """Points that lie below every value: load factors of what does not stand, (n_points,)."""
        return self.of(Answer.NO_EQUILIBRIUM) & self.is_factor

    @property
    def above(self) -> BoolArray:
        """Points that lie above every value: load factors of what no load brings down, (n_points,)."""
        return self.of(Answer.UNBOUNDED) & self.is_factor

    @property
    def unknown(self) -> BoolArray:
        """Points whose place is unknown, (n_points,)."""
        return np.asarray(~self.good & ~self.below & ~self.above)

    def of(self, answer: Answer) -> BoolArray:
        """Points with this answer, (n_points,)."""
        return np.asarray(self.answer == answer)


def answers_of(table: SweepTable, column: SweepColumn) -> Answers:
    """The answers of all points for one result column."""
    values, categories = _numbers(column, table[column.name])
    known = np.isfinite(values)
    done, begun = _done(table)
    answer = np.where(done, Answer.NONE, np.where(begun, Answer.FAILED, Answer.NOT_RUN)).astype(np.int64)
    answer[known] = np.where(done[known], Answer.VALUE, Answer.UNVERIFIED)
    status = _status(table, column)
    if status is not None and column.path != STATUS:
        answer[known & (status == Status.SOLVED)] = Answer.VALUE
        answer[known & np.isin(status, UNSURE)] = Answer.UNVERIFIED
        for state, own in ((Status.NO_EQUILIBRIUM, Answer.NO_EQUILIBRIUM), (Status.UNBOUNDED, Answer.UNBOUNDED)):
            answer[~known & (status == state)] = own
    if column.path == STATUS:  # is itself the word for the outcome of a point
        answer[known] = Answer.VALUE
    return Answers(column, values, answer, categories)


UNSURE = (Status.NOT_VERIFIED, Status.ITERATION_LIMIT, Status.TIME_LIMIT, Status.NUMERICAL_ERROR)
"""states in which a value is not verified, whatever the outcome of the other load cases"""


def numbers_of(column: SweepColumn, values: Values) -> FloatArray:
    """A numeric column as floats (n_points,), nan where there is none."""
    return np.ma.filled(np.ma.asarray(values).astype(float), np.nan)


def _numbers(column: SweepColumn, values: Values) -> tuple[FloatArray, tuple[str, ...]]:
    if column.kind == "bool":
        return numbers_of(column, values), ("no", "yes")
    if column.kind != "text":
        return numbers_of(column, values), ()
    texts = [value or None for value in values.tolist()]
    categories = tuple(sorted({text for text in texts if text is not None}))
    place = {text: float(i) for i, text in enumerate(categories)}
    return np.array([np.nan if text is None else place[text] for text in texts]), categories


def _done(table: SweepTable) -> tuple[BoolArray, BoolArray]:
    """Points whose load cases all have a verified answer, and points that were solved at all; (n_points,) each."""
    (column,) = table.of_role("state")
    states = table[column.name].tolist()
    return np.array([state == DONE for state in states]), np.array([bool(state) for state in states])


def _status(table: SweepTable, column: SweepColumn) -> Values | None:
    """Status of the load case of a column as texts, None where the table has no such column."""
    if not column.path or (is_of_run(column.path) and not column.case):
        return None
    own = [each for each in table.of_role("result") if each.path == STATUS and each.case == column.case]
    return table[own[0].name] if own else None
