"""How a run and its cases show themselves in a notebook: as a table, a picture, and a view to be turned."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING

from mbla.errors import MblaError, UsageError
from mbla.model.model import Model
from mbla.results.disk import write_complete
from mbla.results.listing.answers import answer_columns, bound_figures, status_words
from mbla.results.listing.verdict_words import bound_words, reasons
from mbla.results.pictures.image import EncodedPicture, drawn_image
from mbla.results.pictures.options import format_of
from mbla.results.pictures.page import WARNING
from mbla.results.results import CaseResult, Results
from mbla.solution.solution import Status

if TYPE_CHECKING:
    from mbla.results.notebook.case import Case
    from mbla.results.notebook.run import Run


SURE = (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
"""statuses that are answers"""
MOST_ROWS = 30
"""load cases in a table; the others are counted"""


def run_html(run: Run) -> str:
    """Title, table of all load cases, warnings, and one picture."""
    title = escape(run.records.model.title or run.records.deck.name)
    warnings = "".join(f'<p style="color: {WARNING}">{escape(str(each))}</p>' for each in run.warnings)
    case = run.representative_case
    picture = "" if case is None else _picture(case)
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
    style = f' style="color: {WARNING}"' if alarm else ""
    return f"<tr{style}>{''.join(f'<{tag}>{escape(cell)}</{tag}>' for cell in cells)}</tr>"


def _picture(case: Case) -> str:
    """Verdict of a case, then its picture; where that cannot be drawn, why."""
    texts = [case.summary, *reasons(case.record), bound_words(case.model, case.record)]
    words = "".join(f"<p>{escape(text)}</p>" for text in texts if text)
    try:
        image = f'<img alt="{escape(case.summary)}" style="max-width: 100%" src="{case.picture().data_uri}">'
    except MblaError as error:
        image = f"<p><em>no picture: {escape(str(error))}</em></p>"
    return words + image


def case_picture(
    results: Results, case: CaseResult, kind: str, path: Path | None, format: str | None
) -> EncodedPicture:
    """Draw a case, to a file too if a path is given; raises as :meth:`Case.picture`."""
    from mbla.results.pictures import plot

    ending = format_of(path or Path(f"picture.{format or 'png'}"))
    if format not in (None, ending):
        raise UsageError("output-format", f"{path}: its suffix says {ending}, the format {format}: give one of them")
    picture = drawn_image(ending, lambda drawn: plot.plot_case(results, case, drawn, kind))
    if path is not None:
        write_complete(path, picture.content)
    return picture


# --- The view that can be turned, as a page of its own: in a frame in a notebook, or in a file ----------------------


HEIGHT = 780
"""pixels of the frame in a notebook"""


@dataclass(frozen=True)
class View:
    """A complete page with one view; it asks for nothing from a network."""

    name: str
    page: str = field(repr=False)

    @classmethod
    def of_case(cls, results: Results, case: CaseResult) -> View:
        """Of a load case; UsageError if the extra for reports is not installed."""
        from mbla.results.view3d.view import page_html

        return cls(case.load_case.name, page_html(results, case))

    def save(self, path: str | Path) -> Path:
        """Write the page, to be opened in a browser; FileError if that fails."""
        path = Path(path)
        write_complete(path, self.page.encode("utf-8"))
        return path

    def _repr_html_(self) -> str:
        frame = f'width="100%" height="{HEIGHT}" style="border: 0"'
        return f'<iframe title="{escape(self.name)}" {frame} srcdoc="{escape(self.page)}"></iframe>'
