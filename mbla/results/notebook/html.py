"""What a notebook shows of a run or a load case: the table of verdicts, sentences, and one picture."""

from __future__ import annotations

from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING

from mbla.errors import MblaError
from mbla.model.model import Model
from mbla.results.listing.answers import answer_columns, bound_figures, status_words
from mbla.results.listing.verdict_words import bound_words, reasons
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
    return f"<div><strong>{title}</strong>{_table(run.records.model, run.cases)}{warnings}{picture}</div>"


def case_html(case: Case) -> str:
    """The same of one load case."""
    title = escape(case.results.model.title or case.results.deck.name)
    return f"<div><strong>{title}</strong>{_table(case.results.model, [case])}{_picture(case)}</div>"


def _table(model: Model, cases: Sequence[Case]) -> str:
    shown = cases[:MOST_ROWS]
    heads, figures = answer_columns(model, [case.record for case in shown])
    rows = [_row(["load case", "status", *heads, "static bound", "kinematic bound"], "th")]
    for case, own in zip(shown, figures, strict=True):
        cells = [case.name, status_words(case.status), *own, *bound_figures(case.record)]
        rows.append(_row(cells, "td", alarm=case.status not in SURE))
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
