"""Exit status of a run, and its cases against the deck's ``expected`` section."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mbla.deck.content import Expectation
from mbla.errors import Notice
from mbla.results.outcome import angle_of, associative_of, reaction_of, result_of
from mbla.results.results import CaseResult
from mbla.results.series import position_of, series_of
from mbla.solution.solution import Status
from mbla.solution.verification.verify_points import meets_what_was_asked

FAULTS = ("not-as-expected", "isolated-blocks")
"""Warnings of an entire run that count as not verified."""


def exit_code(cases: Sequence[CaseResult], notices: Sequence[Notice] = ()) -> int:
    """Exit status of a run: the most severe of its cases; ``FAULTS`` among its notices count as not verified.

    An approximate case that is as sharp as its deck asks for is no failure: a draft ends well, and its status
    distinguishes it from a case that is solved. Nor are positions of a travelling load that bring nothing down where
    another is the worst, nor forces that have no limit: that is an answer.
    """
    harmless = {id(case) for series in series_of(cases) if series.worst is not None for case in series.cases}
    harmless |= {id(case) for case in cases if case.load_case.objective is not None}
    judged = [case for case in cases if case.status is not Status.UNBOUNDED or id(case) not in harmless]
    codes = {0 if as_asked(case) else EXIT_CODES[case.status] for case in judged}
    if any(notice.severity == "warning" and notice.identifier in FAULTS for notice in notices):
        codes.add(4)
    return next((code for code in GRAVEST_FIRST if code in codes), 0)


def as_asked(case: CaseResult) -> bool:
    """Whether a case is approximate only because its deck asks for no more (``gap``, ``residual``, a draft)."""
    return case.status is Status.APPROXIMATE and meets_what_was_asked(case.solution, case.checks)


EXIT_CODES = {
    Status.SOLVED: 0,
    Status.APPROXIMATE: 4,
    Status.NOT_VERIFIED: 4,
    Status.NO_EQUILIBRIUM: 5,
    Status.UNBOUNDED: 5,
    Status.ITERATION_LIMIT: 4,
    Status.TIME_LIMIT: 7,
    Status.NUMERICAL_ERROR: 4,
}

GRAVEST_FIRST = (7, 4, 5)


def differences(cases: Sequence[CaseResult], expected: dict[str, Expectation]) -> list[str]:
    """What differs in all cases, one sentence each; of a travelling load the worst position is compared."""
    named = [case for case in cases if case.load_case.name in expected]
    found = [text for case in named for text in compare_with_expected(case, expected[case.load_case.name])]
    for series in series_of(cases):
        if series.name not in expected:
            continue
        wanted = expected[series.name]
        if series.worst is None or not series.complete:
            why = "no worst position is known" if series.complete else "not every position was solved"
            found.append(f"{series.name}: {why} ({wanted.source})")
            continue
        found += compare_with_expected(series.worst, wanted)
        worst = position_of(series.worst).number
        if wanted.position is not None and worst != wanted.position:
            found.append(f"{series.name}: worst at position {worst}, expected {wanted.position} ({wanted.source})")
    return found


def compare_with_expected(case: CaseResult, expected: Expectation) -> list[str]:
    """What differs, one sentence each; nothing where the case is as expected."""
    name = case.load_case.name
    differences = []
    if expected.status is not None and case.status.value != expected.status:
        differences.append(f"{name}: status {case.status.value}, expected {expected.status} ({expected.source})")
    found = {
        "load_factor": getattr(result_of(case), "load_factor", None),
        "angle": angle_of(case),
        "associative_load_factor": getattr(associative_of(case), "load_factor", None),
        "reaction": reaction_of(case),
        "lower": case.checks.lower,
    }
    for key, value in found.items():
        wanted = getattr(expected, key)
        if wanted is None:
            continue
        if value is None or math.isnan(value):
            differences.append(f"{name}: no {key}, expected {wanted:g} ({expected.source})")
        elif abs(value - wanted) > expected.tolerance * max(abs(wanted), _least(key, case)):
            differences.append(
                f"{name}: {key} {value:.10g}, expected {wanted:.10g} within {expected.tolerance:g} ({expected.source})"
            )
    return differences


ZERO_REACTION = 1e-3
"""share of the weight of the free blocks below which a reaction is compared as if it were that share"""


def _least(key: str, case: CaseResult) -> float:
    """Size below which a figure counts as zero in the comparison."""
    settlement = case.load_case.settlement
    return ZERO_REACTION * settlement.unit if key == "reaction" and settlement is not None else 1e-12
