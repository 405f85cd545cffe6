"""The table at the head of a report: every load case with its status, answer and bounds."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.results.listing.answers import answer_columns, bound_figures, status_words
from mbla.results.report.case_content import tone_of
from mbla.results.results import CaseResult, Results


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
    rows = tuple(
        _row(case, number, (*own, *bound_figures(case)))
        for number, (case, own) in enumerate(zip(results.cases, figures, strict=True), start=1)
    )
    return VerdictTable((*heads, "static bound", "kinematic bound"), rows)


def _row(case: CaseResult, number: int, figures: tuple[str, ...]) -> VerdictRow:
    return VerdictRow(f"case-{number}", case.load_case.name, status_words(case.status), tone_of(case), figures)
