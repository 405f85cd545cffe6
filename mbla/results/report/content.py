"""What a report says: notices by kind, the sections of the listing for each case, and the table of verdicts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from mbla.errors import Notice
from mbla.results.explanations import Explanation, explanations
from mbla.results.listing.answers import answer_columns, bound_figures, case_status_words
from mbla.results.listing.blocks import Block, ListingSection
from mbla.results.listing.listing import case_sections
from mbla.results.outcome import answer_of, case_notices, result_of
from mbla.results.report.figures import ReportFigures
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status


@dataclass(frozen=True)
class NoticeKind:
    """All notices of one identifier and severity; ``explanation`` is None where nothing is known of it."""

    severity: str
    identifier: str
    messages: tuple[str, ...]
    explanation: Explanation | None


def notice_kinds(notices: Sequence[Notice]) -> list[NoticeKind]:
    """Warnings before remarks, otherwise in the order in which they first appear."""
    messages: dict[tuple[str, str], list[str]] = {}
    for notice in sorted(notices, key=lambda each: each.severity != "warning"):
        messages.setdefault((notice.severity, notice.identifier), []).append(notice.message)
    return [
        NoticeKind(severity, identifier, tuple(texts), explanations().get(identifier))
        for (severity, identifier), texts in messages.items()
    ]


# --- A load case in a report -----------------------------------------------------------------------------------------


LEADING = ("Mechanism", "Pushover", "Assessment", "Load factor and bounds")
"""sections of a load case that a client reads first"""
OF_LISTING = ("Reductions", "Path of elastic joints", "Solver programs")
"""how it was computed: the listing has these sections, the report does not"""


@dataclass(frozen=True)
class CaseContent:
    """One load case as the templates show it.

    tone  : how it may look, see ``tone_of``
    alarm : what a reader must know before any figure; empty for a verified load factor
    words : verdict and failure; ``parts`` are other sections of the listing
    view  : trusted HTML of the view to turn; empty without one
    """

    id: str
    name: str
    status: str
    tone: str
    alarm: str
    words: list[Block]
    parts: list[ListingSection]
    figures: ReportFigures
    warnings: tuple[str, ...]
    view: str


def case_content(results: Results, case: CaseResult, number: int, figures: ReportFigures, view: str) -> CaseContent:
    """The content of load case ``number``, from 1."""
    key = f"case-{number}"
    sections = {section.title: section for section in case_sections(results.assembly, case)}
    first = sections.pop("Verdict")
    order = [*(title for title in LEADING if title in sections), *(title for title in sections if title not in LEADING)]
    return CaseContent(
        id=key,
        name=case.load_case.name,
        status=case_status_words(case),
        tone=tone_of(case),
        alarm=alarm_of(case),
        words=first.blocks,
        parts=[sections[title] for title in order if title not in OF_LISTING],
        figures=figures,
        warnings=tuple(str(notice) for notice in case_notices(case)),
        view=view,
    )


def tone_of(case: CaseResult) -> str:
    """``good``: a verified answer; ``fair``: approximate; ``open``: any live load is borne; else ``bad``."""
    if not _answered(case):
        return "open" if case.status is Status.UNBOUNDED and case.checks.verified else "bad"
    return "good" if case.status is Status.SOLVED else "fair"


def alarm_of(case: CaseResult) -> str:
    """Warning at the head of a case without a verified answer."""
    if not case.load_case.has_load_factor:
        return _alarm_in_time(case)
    if result_of(case) is not None:
        return "" if case.status is Status.SOLVED else "the load factor is known to about 1 % only."
    if case.status is Status.NO_EQUILIBRIUM:
        return "the structure does not stand under its dead load; there is no load factor."
    if case.status is Status.UNBOUNDED:
        return "there is no load factor, the live load may grow without end."
    if case.solution.mechanics is None:
        return "there is no load factor."
    return "no load factor; figures, forces and mechanism below are those of the best iterate, not a result."


def _answered(case: CaseResult) -> bool:
    """Whether there is a figure that is a result."""
    return result_of(case) is not None or not math.isnan(answer_of(case))


def _alarm_in_time(case: CaseResult) -> str:
    """Of a structure that moves in time, or vibrates."""
    if _answered(case):
        return "" if case.status is Status.SOLVED else "figures are approximate."
    if case.status is Status.NO_EQUILIBRIUM:
        return "the structure does not stand under its dead load."
    return "figures below, where there are any, are not a result."


# --- The table at the head of a report: every load case with its status, answer and bounds --------------------------


@dataclass(frozen=True)
class VerdictRow:
    """One load case; figures are those of the listing, ``-`` where there is none."""

    id: str
    name: str
    status: str
    tone: str
    figures: tuple[str, ...]


def verdict_table(results: Results) -> tuple[list[str], list[VerdictRow]]:
    """Heads of the columns of figures, and a row for every case; the associative answers with their bounds.

    These only where a case has a load factor.
    """
    heads, figures = answer_columns(results.model, results.cases)
    bounded = any(case.load_case.has_load_factor for case in results.cases)
    if not bounded:
        heads, figures = heads[:-1], [row[:-1] for row in figures]
    rows = []
    for place, (case, own) in enumerate(zip(results.cases, figures, strict=True), start=1):
        values = (*own, *(bound_figures(case) if bounded else ()))
        rows.append(VerdictRow(f"case-{place}", case.load_case.name, case_status_words(case), tone_of(case), values))
    return [*heads, *(("static bound", "kinematic bound") if bounded else ())], rows
