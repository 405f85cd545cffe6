"""What all pictures of a sweep have: words with counts above, marks of points without a value, scales, lines."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.pictures.diagrams import Diagrams, hollow, open_diagrams, tint
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import GHOST, INK, PURPLE, WARNING, Page
from mbla.sweeps.answers import Answer, Answers
from mbla.sweeps.pictures.view import Cells, Grid, ParameterAxis, ResultView
from mbla.sweeps.results import STATUS


@dataclass(frozen=True)
class AnswerMark:
    """How an answer that is no value is shown: words of legends and counts, marker, colour."""

    words: str
    marker: str
    colour: str


MARKS = {
    Answer.UNVERIFIED: AnswerMark("not verified", "o", WARNING),
    Answer.NO_EQUILIBRIUM: AnswerMark("no equilibrium (does not stand)", "v", INK),
    Answer.UNBOUNDED: AnswerMark("unbounded (no collapse)", "^", PURPLE),
    Answer.NONE: AnswerMark("has no such value", "|", GHOST),
    Answer.FAILED: AnswerMark("failed", "x", WARNING),
    Answer.NOT_RUN: AnswerMark("not solved yet", ".", GHOST),
    Answer.MIXED: AnswerMark("different from point to point", "d", GHOST),
    Answer.PARTLY: AnswerMark("some points without a verified value", "o", WARNING),
}
LETTERS = 60
"""of all names along an axis from which on they stand upright"""
MANY = 2000
"""points from which on they are one image in SVG and PDF"""
MOST_NAMED = 10
"""lines that a legend names"""
MARKERS = ("o", "s", "^", "D", "v", "P", "<", "X", ">", "p")


def count_words(answers: Answers) -> str:
    """``48 points: 40 with a verified value, 5 no equilibrium (does not stand), 3 failed``."""
    total = len(answers.answer)
    counts = [(answers.of(answer).sum(), mark.words) for answer, mark in MARKS.items()]
    known = "with a value" if answers.column.path == STATUS else "with a verified value"
    parts = [f"{answers.good.sum()} {known}", *(f"{count} {words}" for count, words in counts if count)]
    return f"{total} point{'s' * (total != 1)}: {', '.join(parts)}"


def open_sheet(
    path: Path,
    view: ResultView,
    what: str,
    options: PictureOptions,
    handles: Callable[[Page], Sequence[Any]] | None = None,
    notes: Sequence[str] = (),
) -> AbstractContextManager[Diagrams]:
    """A page with the title of the sweep, what is drawn, how many points, and notes; raises as ``open_diagrams``."""
    words = [view.table.title or "sweep", what, count_words(view.answers), *notes]
    return open_diagrams(path, options, words, handles=handles)


def drawn_values(cells: Cells) -> FloatArray:
    """Values of cells as lines show them, nan where there is no verified one; of the shape of the cells."""
    return np.where(np.isin(cells.answer, (Answer.VALUE, Answer.PARTLY)), cells.value, np.nan)


def scale_axis(page: Page, axes: Any, axis: ParameterAxis, which: str = "x") -> None:
    """Scale and ticks of an axis of the design along ``x`` or ``y``: names of categories, 45 degrees of directions."""
    along = getattr(axes, f"{which}axis")
    if axis.categorical:
        turned = which == "x" and sum(map(len, axis.names)) > LETTERS
        along.set_ticks(axis.coordinates, axis.names, parse_math=False, rotation=90 if turned else 0)
    elif axis.log:
        axes.set(**{f"{which}scale": "log"})
    elif axis.column.role == "azimuth":
        along.set_major_locator(page.parts.ticker.MultipleLocator(45.0))


# --- marks ------------------------------------------------------------------------------------------------------------


def mark_handles(page: Page, answers: IntArray) -> list[Any]:
    """Entries of a legend for the answers among these, of any shape, that are no values."""
    return [
        page.line(mark.words, **hollow(page, mark.marker, mark.colour))
        for answer, mark in MARKS.items()
        if (answers == answer).any()
    ]


def draw_marks(page: Page, axes: Any, x: Any, y: Any, answer: IntArray, **style: Any) -> None:
    """Markers of answers that are no values, each kind its own, at places x, y (n,)."""
    for kind, mark in MARKS.items():
        own = answer == kind
        if own.any():
            look = hollow(page, mark.marker, mark.colour) | {"zorder": 4, "clip_on": False}
            axes.plot(x[own], y[own], rasterized=own.sum() > MANY, **look, **style)


def mark_along(page: Page, axes: Any, x: Any, answer: IntArray, values: Any, answers: Answers) -> None:
    """Marks of points over an axis.

    Of a load factor what does not stand lies at zero, of other results at the lower edge; what nothing brings down at
    the upper edge; what failed or has no such value at the lower edge; a value that is not verified at its place.

    x, answer, values : (n,) place along the axis, ``Answer``, result
    """
    fallen = (answer == Answer.NO_EQUILIBRIUM) & answers.is_factor
    placed = fallen | np.isin(answer, (Answer.UNVERIFIED, Answer.PARTLY))
    heights = np.where(fallen, 0.0, values), np.where(answer == Answer.UNBOUNDED, 1.0, 0.0)
    draw_marks(page, axes, x[placed], heights[0][placed], answer[placed])
    at_edge = axes.get_xaxis_transform()
    draw_marks(page, axes, x[~placed], heights[1][~placed], answer[~placed], transform=at_edge)
    if fallen.any():
        axes.axhline(0.0, color=GHOST, linewidth=0.8 * page.scale, zorder=1)


# --- lines, one for each value of a parameter -------------------------------------------------------------------------


def line_style(page: Page, number: int, count: int) -> dict[str, Any]:
    """Colour and marker of a line among ``count``."""
    marker = MARKERS[number] if count <= MOST_NAMED else "."
    look = {"linewidth": 1.6 * page.scale, "markersize": 5.5 * page.scale}
    return look | {"color": tint(page, number, count), "marker": marker}


def line_handles(page: Page, grid: Grid) -> list[Any]:
    """Entries of a legend for the lines of each diagram, of many every second or third, and for answers."""
    names = [] if grid.lines is None else [f"{grid.lines.column.name} {name}" for name in grid.lines.names]
    step = -(-len(names) // MOST_NAMED) or 1
    named = [page.line(names[i], **line_style(page, i, len(names))) for i in range(0, len(names), step)]
    return named + mark_handles(page, grid.cells.answer)
