"""The table at the head of a report: every load case with its status, answer, bounds and range."""

from __future__ import annotations

from dataclasses import dataclass

from mbla.results.outcome import associative_of, result_of
from mbla.results.report.case_content import tone_of
from mbla.results.results import CaseResult, Results
from mbla.results.words.answer_words import answer_figure, answer_head, bound_figures, range_figures, status_words


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
    """A column for each kind of answer, and beside them range, associative answer and its bounds."""
    model = results.model
    answers = tuple(dict.fromkeys(answer_head(model, case.load_case) for case in results.cases))
    rows = tuple(_row(results, case, i + 1, answers) for i, case in enumerate(results.cases))
    heads = (*answers, "range for this mechanism", "associative", "static bound", "kinematic bound")
    return VerdictTable(heads, rows)


def _row(results: Results, case: CaseResult, number: int, answers: tuple[str, ...]) -> VerdictRow:
    head = answer_head(results.model, case.load_case)
    own = answer_figure(case.load_case, result_of(case))
    figures = (
        *(own if answer == head else "" for answer in answers),
        range_figures(case),
        answer_figure(case.load_case, associative_of(case)),
        *bound_figures(case),
    )
    return VerdictRow(f"case-{number}", case.load_case.name, status_words(case.status), tone_of(case), figures)
