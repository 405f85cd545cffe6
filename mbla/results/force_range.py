"""Least and greatest value of a force: the two load cases that a load case with an objective became, as one answer."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mbla.model.objective import ENDS
from mbla.results.outcome import reaction_of, result_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Status

GRAVEST_FIRST = (
    Status.NO_EQUILIBRIUM,
    Status.NUMERICAL_ERROR,
    Status.TIME_LIMIT,
    Status.ITERATION_LIMIT,
    Status.NOT_VERIFIED,
    Status.APPROXIMATE,
    Status.UNBOUNDED,
    Status.SOLVED,
)
"""Statuses of an end in the order in which they decide for both."""


@dataclass(frozen=True)
class ForceRange:
    """The ends of one force that were solved, by their names ``least`` and ``greatest``."""

    name: str
    ends: dict[str, CaseResult]

    @property
    def status(self) -> Status:
        """The graver of both."""
        return min((case.status for case in self.ends.values()), key=GRAVEST_FIRST.index)


def force_ranges_of(cases: Sequence[CaseResult]) -> tuple[ForceRange, ...]:
    """The forces among the cases, in the order of the deck."""
    found: dict[str, dict[str, CaseResult]] = {}
    for case in cases:
        objective = case.load_case.objective
        if objective is not None:
            found.setdefault(objective.series, {})[objective.end] = case
    return tuple(ForceRange(name, ends) for name, ends in found.items())


def other_end(cases: Sequence[CaseResult], case: CaseResult) -> CaseResult | None:
    """The other end of the force of a case; None where it has none, or that was not solved."""
    objective = case.load_case.objective
    own = [each for each in force_ranges_of(cases) if objective is not None and each.name == objective.series]
    return next((end for each in own for end in each.ends.values() if end is not case), None)


def end_value(case: CaseResult) -> float:
    """Value of an end; infinite where forces of any size fit, nan where there is no result."""
    objective = case.load_case.objective
    if case.status is Status.UNBOUNDED and objective is not None:
        return -ENDS[objective.end] * math.inf
    value = None if result_of(case) is None else reaction_of(case)
    return math.nan if value is None else value


def end_bounds(case: CaseResult) -> tuple[float, float]:
    """Between which values an end is proved to lie: those of forces that balance the loads and of a mechanism."""
    settlement = case.load_case.settlement
    assert settlement is not None  # that of the cut
    low, high = (settlement.reaction(bound) for bound in (case.checks.kinematic_bound, case.checks.static_bound))
    return (low, high) if settlement.sense > 0 else (high, low)
