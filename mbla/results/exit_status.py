"""Exit status of a run, from its cases."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.errors import Notice
from mbla.results.results import CaseResult
from mbla.results.series import series_of
from mbla.solution import Status
from mbla.solution.verification.verify_points import meets_what_was_asked

FAULTS = ("not-as-expected", "isolated-blocks")
"""Warnings of a whole run that count as not verified."""


def exit_code(cases: Sequence[CaseResult], notices: Sequence[Notice] = ()) -> int:
    """Exit status of a run: the gravest of its cases; ``FAULTS`` among its notices count as not verified.

    An approximate case that is as sharp as its deck asks for is no failure: a draft ends well, and its status tells it
    from a case that is solved. Nor are positions of a travelling load that bring nothing down where another is the
    worst.
    """
    harmless = {id(case) for series in series_of(cases) if series.worst is not None for case in series.cases}
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
