"""What a report says: notices by kind, verification, each case, and the table of verdicts."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.errors import Notice
from mbla.results.explanations import Explanation, explanations
from mbla.results.listing.answers import answer_columns, bound_figures, status_words
from mbla.results.listing.figures import residual_figures, verification_verdict
from mbla.results.listing.listing import case_sections
from mbla.results.listing.text import Entry, Heading, Sentence, elements_of, number, small
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import case_notices, result_of
from mbla.results.report.figures import Figures
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status
from mbla.solution.verification.verify_points import tolerances


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


# --- Lines of the words as parts of a page --------------------------------------------------------------------------


@dataclass(frozen=True)
class Block:
    """A part of a page.

    kind   : ``title``, ``paragraph``, ``entries`` (names and values) or ``table``
    text   : of a title or paragraph, caption of a table
    detail : a paragraph belongs to what stands above it
    left   : columns of a table that are words; the others are figures
    """

    kind: str
    text: str = ""
    rows: tuple[tuple[str, ...], ...] = ()
    head: tuple[str, ...] = ()
    left: int = 0
    detail: bool = False


def blocks_of(lines: Iterable[str]) -> list[Block]:
    """Blocks of lines in their order; nothing that the lines say is left out.

    A sentence that ends in a colon becomes the caption of the table below it, a detail below an entry joins its value.
    """
    blocks: list[Block] = []
    for element in elements_of(lines):
        last = blocks[-1] if blocks else Block("")
        if isinstance(element, Entry) and last.kind == "entries":
            blocks[-1] = replace(last, rows=(*last.rows, (element.name.strip(), element.value)))
        elif isinstance(element, Entry):
            blocks.append(Block("entries", rows=((element.name.strip(), element.value),)))
        elif isinstance(element, Sentence) and element.detail and last.kind == "entries":
            name, value = last.rows[-1]
            blocks[-1] = replace(last, rows=(*last.rows[:-1], (name, f"{value}\n{element.text}")))
        elif isinstance(element, Sentence):
            blocks.append(Block("paragraph", element.text, detail=element.detail))
        elif isinstance(element, Heading):
            blocks.append(Block("title", element.text))
        else:
            captioned = last.kind == "paragraph" and last.text.endswith(":")
            caption = blocks.pop().text[:-1] if captioned else ""
            blocks.append(Block("table", caption, element.rows, element.head, element.left))
    return blocks


# --- The verification of a case as rows: every residual, what it may be at most, and whether it is ------------------


PARTS = {"tension_violation": "part of the yield violation", "slip_residual": "part of the complementarity residual"}
"""figures that are judged with another one"""
PASSED, FAILED, NOT_JUDGED = "passed", "NOT PASSED", "not judged"


@dataclass(frozen=True)
class Check:
    """One residual with its tolerance; ``verdict`` is PASSED, FAILED or NOT_JUDGED."""

    name: str
    value: str
    measure: str
    tolerance: str
    verdict: str


def checks_of(case: CaseResult) -> list[Check]:
    """Rows of the residuals that there are; none where there are neither forces nor mechanism to check."""
    checks = case.checks
    allowed = tolerances(case.solution.flow_rule)
    rows = [
        _row(name, value, measure, name.replace(" ", "_"), allowed)
        for name, value, measure in residual_figures(checks)
        if not np.isnan(value)
    ]
    if not np.isnan(checks.live_power):
        deviation = abs(checks.live_power - 1.0)
        rows.append(_row("deviation of the live power", deviation, "from 1", "live_power", allowed))
    if not np.isnan(checks.gap):
        rows.append(_gap_row(case, allowed))
    return rows


def _row(name: str, value: float, measure: str, key: str, allowed: dict[str, float]) -> Check:
    if key not in allowed:
        return Check(name, small(value), measure, PARTS.get(key, "none"), NOT_JUDGED)
    verdict = PASSED if value <= allowed[key] else FAILED
    return Check(name, small(value), measure, number(allowed[key]), verdict)


def _gap_row(case: CaseResult, allowed: dict[str, float]) -> Check:
    """Distance of the bounds; of other flow rules it says how well the associative factor is known, nothing more."""
    name, measure = "gap of the bounds", "of the associative load factor"
    if case.solution.outer is not None:
        return Check(name, small(case.checks.gap), measure, "distance of the polyhedra, no error", NOT_JUDGED)
    if "gap" not in allowed:
        return Check(name, small(case.checks.gap), measure, "none by this flow rule", NOT_JUDGED)
    return _row(name, case.checks.gap, measure, "gap", allowed)


# --- What a report says of one load case ----------------------------------------------------------------------------


@dataclass(frozen=True)
class Part:
    """One titled part of a load case."""

    id: str
    title: str
    blocks: list[Block]


@dataclass(frozen=True)
class CaseContent:
    """One load case as the templates show it.

    tone  : how it may look, see ``tone_of``
    alarm : what a reader must know before any figure; empty for a verified load factor
    confirmed : what the verification came to, and how that may look, ``confirmed_tone``
    view  : trusted HTML of the view to turn; empty without one
    """

    id: str
    name: str
    status: str
    tone: str
    alarm: str
    verdict: str
    words: list[Block]
    parts: list[Part]
    figures: Figures
    checks: list[Check]
    confirmed: str
    confirmed_tone: str
    failures: tuple[str, ...]
    warnings: tuple[str, ...]
    view: str


def case_content(results: Results, case: CaseResult, number: int, figures: Figures, view: str) -> CaseContent:
    """The content of load case ``number``, from 1."""
    key = f"case-{number}"
    told, *others = case_sections(results.model, results.contacts, case)
    checked = {name for name, _, _ in residual_figures(case.checks)}
    parts = [
        Part(f"{key}-{each.title.lower().replace(' ', '-')}", each.title, _without(blocks_of(each.lines), checked))
        for each in others
    ]
    return CaseContent(
        id=key,
        name=case.load_case.name,
        status=status_words(case.status),
        tone=tone_of(case),
        alarm=alarm_of(case),
        verdict=verdict(results.model.of_case(case.load_case), case),
        words=blocks_of(told.lines),
        parts=parts,
        figures=figures,
        checks=checks_of(case),
        confirmed=verification_verdict(case),
        confirmed_tone=_confirmed_tone(case),
        failures=case.checks.failures,
        warnings=tuple(str(notice) for notice in case_notices(case)),
        view=view,
    )


def tone_of(case: CaseResult) -> str:
    """``good``: a verified load factor; ``fair``: approximate; ``open``: any live load is borne; else ``bad``."""
    if result_of(case) is None:
        return "open" if case.status is Status.UNBOUNDED and case.checks.verified else "bad"
    return "good" if case.status is Status.SOLVED else "fair"


def _confirmed_tone(case: CaseResult) -> str:
    """Green for a verified load factor only."""
    if not case.checks.verified:
        return "bad"
    return "open" if result_of(case) is None else "good"


def alarm_of(case: CaseResult) -> str:
    """What stands above everything that is said of a case without a verified load factor."""
    if result_of(case) is not None:
        return "" if case.status is Status.SOLVED else "the load factor is known to about 1 % only."
    if case.status is Status.NO_EQUILIBRIUM:
        return "the structure does not stand under its dead load; there is no load factor."
    if case.status is Status.UNBOUNDED:
        return "there is no load factor, the live load may grow without end."
    if case.solution.mechanics is None:
        return "there is no load factor."
    return "no load factor; figures, forces and mechanism below are the best that was reached, and no result."


def _without(blocks: list[Block], names: set[str]) -> list[Block]:
    """Entries that the table of checks shows with their tolerances are not said twice."""
    kept = []
    for each in blocks:
        rows = tuple(row for row in each.rows if each.kind != "entries" or row[0] not in names)
        if rows or not each.rows:
            kept.append(replace(each, rows=rows))
    return kept


# --- The table at the head of a report: every load case with its status, answer and bounds --------------------------


@dataclass(frozen=True)
class VerdictRow:
    """One load case; figures are those of the listing, ``-`` where there is none."""

    id: str
    name: str
    status: str
    tone: str
    figures: tuple[str, ...]


@dataclass(frozen=True)
class VerdictTable:
    """Heads of the columns of figures, and rows."""

    heads: tuple[str, ...]
    rows: tuple[VerdictRow, ...]


def verdict_table(results: Results) -> VerdictTable:
    """The answers of every case, the associative ones with their bounds."""
    heads, figures = answer_columns(results.model, results.cases)
    rows = []
    for place, (case, own) in enumerate(zip(results.cases, figures, strict=True), start=1):
        values = (*own, *bound_figures(case))
        rows.append(VerdictRow(f"case-{place}", case.load_case.name, status_words(case.status), tone_of(case), values))
    return VerdictTable((*heads, "static bound", "kinematic bound"), tuple(rows))
