"""Least and greatest value of a force: the two load cases that a load case with an objective became, as one answer."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from mbla.questions.force import Force
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
    """The ends of one force that were solved, by their names ``least`` and ``greatest``; what one of them asks."""

    name: str
    question: Force
    ends: dict[str, CaseResult]

    @property
    def status(self) -> Status:
        """The graver of both."""
        return min((case.status for case in self.ends.values()), key=GRAVEST_FIRST.index)


def force_ranges_of(cases: Sequence[CaseResult]) -> tuple[ForceRange, ...]:
    """The forces among the cases, in the order of the deck."""
    found: dict[str, ForceRange] = {}
    for case in cases:
        if isinstance(question := case.load_case.question, Force):
            own = found.setdefault(question.series, ForceRange(question.series, question, {}))
            own.ends[question.objective.end] = case
    return tuple(found.values())


def other_end(cases: Sequence[CaseResult], case: CaseResult) -> CaseResult | None:
    """The other end of the force of a case; None where it has none, or that was not solved."""
    own = [each for each in force_ranges_of(cases) if each.name == case.load_case.question.series]
    return next((end for each in own for end in each.ends.values() if end is not case), None)
