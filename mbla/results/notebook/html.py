"""What a notebook shows of a run or a load case: the table of verdicts, sentences, and one picture."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

from mbla.errors import MblaError
from mbla.results.outcome import associative_of, result_of
from mbla.results.words.answer_words import answer_figure, answer_head, bound_figures, range_figures, status_words
from mbla.results.words.verdict_words import bound_words, reasons
from mbla.solution.solution import Status

if TYPE_CHECKING:
    from mbla.results.notebook.case import Case
    from mbla.results.notebook.run import Run

ALARM = "#B00020"
SURE = (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
"""statuses that are answers"""
MOST_ROWS = 30
"""load cases in a table; the others are counted"""


def run_html(run: Run) -> str:
    """Title, table of all load cases, warnings, and one picture."""
    title = escape(run.records.model.title or run.records.deck.name)
    warnings = "".join(f'<p style="color: {ALARM}">{escape(str(each))}</p>' for each in run.warnings)
    pictured = run.pictured
    picture = "" if pictured is None else _picture(pictured)
    return f"<div><strong>{title}</strong>{_table(run.cases)}{warnings}{picture}</div>"


def case_html(case: Case) -> str:
    """The same of one load case."""
    title = escape(case.results.model.title or case.results.deck.name)
    return f"<div><strong>{title}</strong>{_table([case])}{_picture(case)}</div>"


def _table(cases: Sequence[Case]) -> str:
    answers = list(dict.fromkeys(answer_head(case.model, case.record.load_case) for case in cases))
    heads = ["load case", "status", *answers, "range for this mechanism", "associative", "static bound"]
    rows = [_row([*heads, "kinematic bound"], "th")]
    for case in cases[:MOST_ROWS]:
        record = case.record
        head = answer_head(case.model, record.load_case)
        own = answer_figure(record.load_case, result_of(record))
        figures = [own if answer == head else "" for answer in answers]
        associative = answer_figure(record.load_case, associative_of(record))
        cells = [case.name, status_words(case.status), *figures, range_figures(record), associative]
        rows.append(_row([*cells, *bound_figures(record)], "td", alarm=case.status not in SURE))
    if len(cases) > MOST_ROWS:
        rows.append(_row([f"and {len(cases) - MOST_ROWS} more"], "td"))
    return f"<table>{''.join(rows)}</table>"


def _row(cells: Sequence[str], tag: str, *, alarm: bool = False) -> str:
    style = f' style="color: {ALARM}"' if alarm else ""
    return f"<tr{style}>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"


def _picture(case: Case) -> str:
    """What is said of a case, then its picture; where that cannot be drawn, why."""
    told = [case.summary, *reasons(case.record), bound_words(case.model, case.record)]
    words = "".join(f"<p>{escape(text)}</p>" for text in told if text)
    try:
        image = f'<img alt="{escape(case.summary)}" style="max-width: 100%" src="{case.picture().data_uri}">'
    except MblaError as error:
        image = f"<p><em>no picture: {escape(str(error))}</em></p>"
    return words + image
