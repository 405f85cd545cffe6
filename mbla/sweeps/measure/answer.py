"""What a load case answers: load factor, angle of a tilting table, or reaction of a support that gives way."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mbla.model.model import Model
from mbla.results.diff.cases import ZERO, least_factor
from mbla.results.exit_status import as_asked
from mbla.results.listing.answers import reaction_of, reaction_unit
from mbla.results.outcome import locked_in, result_of
from mbla.results.results import CaseResult
from mbla.results.tilt_angle import angle_bounds, angle_of
from mbla.solution.solution import Status

VERDICTS = (Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
"""statuses that are an answer without a figure, once verified"""


@dataclass(frozen=True)
class Answer:
    """Figure with its bounds (of associative flow, in the same unit); nan where there is none. No unit: a factor."""

    kind: str
    unit: str
    value: float
    lower: float
    upper: float
    least: float


def answer_of(model: Model, case: CaseResult) -> Answer:
    """The answer of a case."""
    load_case, checks, found = case.load_case, case.checks, result_of(case)
    if load_case.settlement is not None:
        settlement, value = load_case.settlement, reaction_of(case)
        ends = settlement.reaction(checks.kinematic_bound), settlement.reaction(checks.static_bound)
        unit = reaction_unit(model, settlement)
        return Answer("reaction", unit, math.nan if value is None else value, *ends, ZERO * settlement.unit)
    if load_case.tilt is not None:
        return Answer("angle", "degree", angle_of(case), *angle_bounds(case), 0.0)
    value = math.nan if found is None else found.load_factor
    return Answer("load factor", "", value, checks.static_bound, checks.kinematic_bound, least_factor(model, load_case))


def verdict_of(case: CaseResult) -> str:
    """``answer``, or why there is none."""
    if result_of(case) is not None:
        return "answer"
    return "locked_in" if case.status is Status.SOLVED and locked_in(case) else case.status.value


def is_verified(case: CaseResult) -> bool:
    """Whether what the case says is confirmed: a figure as sharp as the setting asks for, or that there is none."""
    return as_asked(case) or (case.checks.verified and case.status in (Status.SOLVED, *VERDICTS))
