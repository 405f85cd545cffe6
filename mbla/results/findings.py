"""Identifiers of what solver and verification say in words: their sentences are matched, so that older files have them.

A sentence that no row knows gets a general identifier, and is not lost. A test holds the rows to the sentences in the
source, both ways.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
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


@dataclass(frozen=True)
class Finding:
    """A kind of sentence: its identifier, and parts of it of which it has one."""

    identifier: str
    severity: Literal["notice", "warning"]
    phrases: tuple[str, ...]


def _failure(identifier: str, *phrases: str) -> Finding:
    return Finding(identifier, "warning", phrases)


FAILURES = (
    _failure("equilibrium-residual", "equilibrium residual"),
    _failure("yield-violation", "yield violation"),
    _failure("penetration", "penetration"),
    _failure("complementarity-residual", "complementarity residual"),
    _failure("power-balance", "power balance"),
    _failure("live-power", "deviation of the live power"),
    _failure("bounds-apart", "lie further apart than"),
    _failure("outside-bounds", "does not lie between its bounds"),
    _failure("above-kinematic-bound", "exceeds the kinematic bound"),
    _failure(
        "bracket-not-proved",
        "is more than its forces prove",
        "is less than its mechanism",
        "lies above the kinematic bound",
    ),
    _failure("collapse-not-proved", "lack of equilibrium"),
    _failure(
        "lock-not-proved",
        "that the structure locks",
        "carry every multiple of the live load",
        "no live load on blocks that can move",
    ),
    _failure(
        "standing-not-proved",
        "under the dead load alone",
        "under the dead load are not finite",
        "fixed blocks are displaced",
        "guided blocks are displaced",
    ),
    _failure(
        "tilt-not-proved",
        "is not the change from the level table",
        "bears every angle up to 180 degrees",
        "the loads at collapse are not those at",
        "is not the tangent of the angle",
    ),
    _failure("glued-blocks-part", "glued to each other move apart"),
    _failure("wrong-resultants", "of the interfaces are missing", "are not those of the contact forces"),
)
"""What verification can find wrong."""

REMARKS = (
    Finding("law-missed", "notice", ("miss the law by", "miss it by")),  # law-residual warns of it
    Finding("associative-bounds-apart", "notice", ("with associative flow",)),
    Finding("second-opinion-differs", "warning", ("and should by",)),
    Finding("second-opinion-missing", "warning", ("came to no answer",)),
    Finding("second-opinion-agrees", "notice", ("they agree",)),
    Finding("polyhedral-bracket", "notice", ("with friction polyhedra of",)),
    Finding("livesley-overstates", "warning", ("no mechanism without dilatancy belongs",)),
    Finding("livesley-polyhedral", "warning", ("by the law of the friction polyhedron",)),
    Finding("livesley-confirms", "notice", ("bear a mechanism without dilatancy too",)),
    Finding("locked-by-dilatancy", "notice", ("without it joints give way",)),
    Finding("proximal-for-published", "warning", ("the proximal scheme was used instead",)),
    Finding(
        "load-factor-not-unique",
        "notice",
        ("load factor is not unique", "of one state of the law", "others may lie below it"),
    ),
    Finding("below-passed-load", "warning", ("which the steps passed through",)),
    Finding("peak-on-path", "warning", ("the peak is the collapse load",)),
    Finding("found-above-path", "notice", ("above the load that the structure reaches",)),
    Finding("path-not-seen", "warning", ("the load path was followed to", "the load path was not followed")),
    Finding("peak-not-seen", "warning", ("its end was not seen",)),
    Finding("peak-not-examined", "warning", ("whether the structure carries more on the way was not examined",)),
    Finding("lowest-search", "notice", ("search for lower load factors (", "fit the joint law and are not counted")),
    Finding("lowest-search-not-begun", "warning", ("did not begin",)),
    Finding("range-not-found", "warning", ("end of the range",)),
    Finding("range-not-computed", "notice", ("the range of the load factor for the mechanism found is not computed",)),
    Finding("force-range-not-found", "warning", ("range of the normal force was not found",)),
    Finding("least-forces-not-found", "notice", ("not the least ones, which were not found",)),
    Finding("tilt-by-steps", "notice", ("change of the loads from the level table", "collapses as soon as it turns")),
    Finding("tilt-between-not-proved", "warning", ("not proved",)),
)
"""What a solver can remark."""

UNKNOWN_FAILURE = Finding("verification-failed", "warning", ())
UNKNOWN_REMARK = Finding("solver-remark", "notice", ())


def finding_of(text: str, kinds: Sequence[Finding], otherwise: Finding) -> Finding:
    """The first row one of whose phrases is in a sentence."""
    lowered = text.casefold()
    return next((kind for kind in kinds if any(phrase in lowered for phrase in kind.phrases)), otherwise)


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
    for text in case.checks.failures:
        if text != solution.reason:
            add("warning", finding_of(text, FAILURES, UNKNOWN_FAILURE).identifier, text)
    for text in solution.remarks:
        if text != solution.reason or case.status is Status.SOLVED:
            kind = finding_of(text, REMARKS, UNKNOWN_REMARK)
            add(kind.severity, kind.identifier, text)
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
