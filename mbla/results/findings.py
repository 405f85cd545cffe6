"""What solver and verification found wrong or remark, as notices of a run."""

from __future__ import annotations

from typing import Literal

from mbla.errors import Notice
from mbla.results.results import CaseResult
from mbla.solution.solution import Status

UNSETTLED = {
    Status.APPROXIMATE: "approximate",
    Status.NOT_VERIFIED: "not-verified",
    Status.NO_EQUILIBRIUM: "no-equilibrium",
    Status.UNBOUNDED: "unbounded",
    Status.ITERATION_LIMIT: "iteration-limit",
    Status.TIME_LIMIT: "time-limit",
    Status.NUMERICAL_ERROR: "numerical-error",
}
"""Identifier of every status that is not simply a verified load factor."""

WITHOUT_REASON = {
    Status.APPROXIMATE: "verification confirms the load factor to 1e-2 at best",
    Status.NOT_VERIFIED: "verification does not confirm the answer",
    Status.NO_EQUILIBRIUM: "the dead load alone is not carried",
    Status.UNBOUNDED: "no multiple of the live load brings the structure down",
    Status.ITERATION_LIMIT: "the iterations ran out",
    Status.TIME_LIMIT: "the time ran out",
    Status.NUMERICAL_ERROR: "the solver failed numerically",
}
"""What is said of a status where the solver gives no reason."""

BROKEN = {
    Status.ITERATION_LIMIT: "the iterations ran out",
    Status.TIME_LIMIT: "the time ran out",
    Status.NUMERICAL_ERROR: "the solver failed numerically",
}
"""What befell a cone program that came to no answer."""


REMARKS_THAT_WARN = frozenset(
    {
        "livesley-overstates",
        "livesley-polyhedral",
        "proximal-for-published",
        "below-passed-load",
        "peak-on-path",
        "path-not-seen",
        "peak-not-seen",
        "peak-not-examined",
        "lowest-search-not-begun",
        "range-not-found",
        "force-range-not-found",
        "tilt-between-not-proved",
    }
)
"""Remarks of a solver that are warnings; the others are notices."""


def found_notices(case: CaseResult, *, harmless: bool = False) -> tuple[Notice, ...]:
    """Status, failures of the verification and remarks of the solver as notices.

    harmless : a position of a travelling load that brings nothing down where another does
    """
    name, solution = case.load_case.name, case.solution
    notices: list[Notice] = []

    def add(severity: Literal["notice", "warning"], identifier: str, text: str) -> None:
        notice = Notice(severity, identifier, f"{name}: {text}", name)
        if notice not in notices:
            notices.append(notice)

    if case.status in UNSETTLED:
        reason = solution.reason or _reason_of(case)
        add("notice" if harmless else "warning", UNSETTLED[case.status], reason)
    for failure in case.checks.failures:
        if failure != solution.reason:
            add("warning", failure.identifier, failure)
    for remark in solution.remarks:
        if remark != solution.reason or case.status is Status.SOLVED:
            severity: Literal["notice", "warning"] = "warning" if remark.identifier in REMARKS_THAT_WARN else "notice"
            add(severity, remark.identifier, remark)
    return (*notices, *_of_figures(case))


def _reason_of(case: CaseResult) -> str:
    """What is said where the solver gives no reason; of an answer that is not verified also what it came from."""
    words = WITHOUT_REASON[case.status]
    ended = [record for record in case.solution.programs if record.status in BROKEN]
    if case.status is not Status.NOT_VERIFIED or not ended:
        return words
    first = ended[0]
    what = BROKEN[first.status]
    return f"{words}: {what} in program {first.program} ({first.kind}), and what another found instead does not hold"


def _of_figures(case: CaseResult) -> list[Notice]:
    """What the figures show: tries that did not agree, ends of ranges and peaks that are claimed but not verified."""
    name, solution, checks = case.load_case.name, case.solution, case.checks
    texts = []
    if solution.spread is not None:
        least, greatest = solution.spread
        texts.append(("tries-disagree", f"several tries ended at load factors between {least:.6g} and {greatest:.6g}"))
    for end, claimed, found in (("lower", solution.lower, checks.lower), ("upper", solution.upper, checks.upper)):
        if claimed is not None and found != found:
            texts.append(("range-not-verified", f"the {end} end of the range was found but is not verified"))
    if solution.peak is not None and checks.peak_load_factor != checks.peak_load_factor:
        texts.append(("peak-not-verified", "a peak of the load path was found, but its forces are not verified"))
    return [Notice("warning", identifier, f"{name}: {text}", name) for identifier, text in texts]
