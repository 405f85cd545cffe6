"""Exit status of a run, and its cases against the deck's ``expected`` section."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

from mbla.deck.content import Expectation
from mbla.errors import Notice
from mbla.results.force_range import ForceRange, force_ranges_of
from mbla.results.outcome import answer_of, associative_of, figure_of, history_of, least_of, result_of
from mbla.results.results import CaseResult
from mbla.results.series import series_of
from mbla.solution.solution import Status
from mbla.solution.verification.verify_points import meets_what_was_asked

UNEXPECTED = "not-as-expected"
"""identifier of notices that a run has only where it was asked to compare with what its deck expects"""

FAULTS = (UNEXPECTED, "isolated-blocks")
"""Warnings of an entire run that count as not verified."""


def exit_code(cases: Sequence[CaseResult], notices: Sequence[Notice] = ()) -> int:
    """Exit status of a run: the most severe of its cases; ``FAULTS`` among its notices count as not verified.

    An approximate case that is as sharp as its deck asks for is no failure: a draft ends well, and its status
    distinguishes it from a case that is solved. Nor are positions of a travelling load that bring nothing down where
    another is the worst, nor forces that have no limit: that is an answer.
    """
    harmless = {id(case) for series in series_of(cases) if series.worst is not None for case in series.cases}
    harmless |= {id(case) for case in cases if case.load_case.question.unbounded_answers}
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


def differences(
    cases: Sequence[CaseResult], expected: dict[str, Expectation], name_of: Callable[[int], str] = str
) -> list[str]:
    """What differs in all cases, one sentence each; of a travelling load the worst position is compared.

    name_of : of blocks
    """
    named = [case for case in cases if case.load_case.name in expected]
    found = [text for case in named for text in compare_with_expected(case, expected[case.load_case.name])]
    found += [text for case in named for text in _compare_history(case, expected[case.load_case.name], name_of)]
    for series in series_of(cases):
        if series.name not in expected:
            continue
        wanted = expected[series.name]
        if series.worst is None or not series.complete:
            why = "no worst position is known" if series.complete else "not every position was solved"
            found.append(f"{series.name}: {why} ({wanted.source})")
            continue
        found += compare_with_expected(series.worst, wanted)
        worst = series.worst.load_case.question.place.number
        if wanted.position is not None and worst != wanted.position:
            found.append(f"{series.name}: worst at position {worst}, expected {wanted.position} ({wanted.source})")
    for force in force_ranges_of(cases):
        if force.name in expected:
            found += _compare_force(force, expected[force.name])
    return found


def _compare_force(force: ForceRange, expected: Expectation) -> list[str]:
    """What differs of a force: the graver status of both ends, and the values of the ends that are expected."""
    found = _compare_status(force.name, force.status, expected)
    for end, case in force.ends.items():
        value, wanted = figure_of(case), getattr(expected, end)
        if wanted is not None:
            found += _compare(force.name, end, value, wanted, _least("reaction", case), expected)
    return found


def _compare_status(name: str, status: Status, expected: Expectation) -> list[str]:
    if expected.status is None or status.value == expected.status:
        return []
    return [f"{name}: status {status.value}, expected {expected.status} ({expected.source})"]


def _compare(name: str, key: str, value: float | None, wanted: float, least: float, expected: Expectation) -> list[str]:
    """A figure against what is wanted of it, relative to that, but to no less than ``least``."""
    if value is None or math.isnan(value):
        return [f"{name}: no {key}, expected {wanted:g} ({expected.source})"]
    if abs(value - wanted) > expected.tolerance * max(abs(wanted), least):
        return [f"{name}: {key} {value:.10g}, expected {wanted:.10g} within {expected.tolerance:g} ({expected.source})"]
    return []


def compare_with_expected(case: CaseResult, expected: Expectation) -> list[str]:
    """What differs, one sentence each; nothing where the case is as expected."""
    name = case.load_case.name
    differences = _compare_status(name, case.status, expected)
    found = {
        "load_factor": getattr(result_of(case), "load_factor", None),
        "angle": answer_of(case, "angle"),
        "associative_load_factor": getattr(associative_of(case), "load_factor", None),
        "reaction": answer_of(case, "reaction"),
        "least_load_factor": least_of(case),
        "period": case.solution.further.modes.period,
        "period_after": case.solution.further.modes_after.period,
    }
    for key, value in found.items():
        wanted = getattr(expected, key)
        if wanted is not None:
            differences += _compare(name, key, value, wanted, _least(key, case), expected)
    return differences


def _compare_history(case: CaseResult, expected: Expectation, name_of: Callable[[int], str]) -> list[str]:
    """What differs of a structure in time: its figures, the residual relative to the peak, what falls, its end."""
    name, found, differences = case.load_case.name, history_of(case), list[str]()
    for key in ("peak", "peak_time", "residual"):
        wanted, value = getattr(expected, key), None if found is None else getattr(found, key)
        if wanted is not None:
            least = found.peak if found is not None and key == "residual" else ZERO
            differences += _compare(name, key, value, wanted, least, expected)
    end = case.solution.further.time_history.end.name.lower()
    falls = "none" if found is None or found.falls < 0 else name_of(found.falls)
    said = {"falls": falls, "end": end} if found is not None else dict.fromkeys(("falls", "end"), "not known")
    for key, value in said.items():
        wanted = getattr(expected, key)
        if wanted is not None and wanted != value:
            differences.append(f"{name}: {key} {value}, expected {wanted} ({expected.source})")
    return differences


ZERO = 1e-12
"""size below which figures that nothing else measures count as zero"""


def _least(key: str, case: CaseResult) -> float:
    """Size below which a figure counts as zero in the comparison."""
    question = case.load_case.question
    return max(question.least(0.0), ZERO) if key == question.group else ZERO
