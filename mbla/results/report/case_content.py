"""What a report says of one load case: the sections of the listing, with pictures, checks and a view to turn."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.results.listing.answers import status_words
from mbla.results.listing.case_words import case_sections
from mbla.results.listing.figure_words import residual_figures, verification_verdict
from mbla.results.listing.verdict_words import verdict
from mbla.results.outcome import case_notices, result_of
from mbla.results.report.blocks import Block, Entries, blocks_of
from mbla.results.report.figures import Figures
from mbla.results.report.verification import Check, checks_of
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status


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
    sections = case_sections(results.model, results.contacts, case)
    told, others = sections[0], sections[1:]
    checked = {name for name, _, _ in residual_figures(case.checks)}
    parts = [
        Part(f"{key}-{_slug(section.title)}", section.title, _without(blocks_of(section.lines), checked))
        for section in others
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


def _slug(title: str) -> str:
    return title.lower().replace(" ", "-")


def _without(blocks: list[Block], names: set[str]) -> list[Block]:
    """Entries that the table of checks shows with their tolerances are not said twice."""
    kept = [
        Entries(tuple(row for row in block.rows if row[0] not in names)) if isinstance(block, Entries) else block
        for block in blocks
    ]
    return [block for block in kept if not isinstance(block, Entries) or block.rows]
