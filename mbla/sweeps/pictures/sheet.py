"""What all pictures of a sweep have: words with counts above, marks of points without a value, ticks at values."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.pictures.diagrams import Diagrams, hollow, open_diagrams, tint
from mbla.results.pictures.options import DOTS_PER_INCH, PictureOptions
from mbla.results.pictures.page import GHOST, INK, PURPLE, WARNING, Page
from mbla.sweeps.answers import Answer, Answers
from mbla.sweeps.pictures.view import Axis, Cells, Grid, View
from mbla.sweeps.results import STATUS


@dataclass(frozen=True)
class Mark:
    """How an answer that is no value is shown: words of legends and notes, marker, colour, hatch of cells."""

    words: str
    marker: str
    colour: str
    hatch: str


MARKS = {
    Answer.UNVERIFIED: Mark("not verified", "o", WARNING, "xx"),
    Answer.NO_EQUILIBRIUM: Mark("no equilibrium (does not stand)", "v", INK, "///"),
    Answer.UNBOUNDED: Mark("unbounded (no collapse)", "^", PURPLE, 3 * "\\"),
    Answer.NONE: Mark("has no such value", "|", GHOST, "--"),
    Answer.FAILED: Mark("failed", "x", WARNING, "xx"),
    Answer.NOT_RUN: Mark("not solved yet", ".", GHOST, "oo"),
    Answer.MIXED: Mark("different from point to point", "d", GHOST, "++"),
    Answer.PARTLY: Mark("some points without a verified value", "o", WARNING, "//"),
}
CROWD = 60
"""markers from which on they are smaller"""
MANY = 2000
"""markers from which on they are one image in SVG and PDF"""
MOST_NAMED = 10
"""lines that a legend names; more have a scale of colours beside them"""
MARKERS = ("o", "s", "^", "D", "v", "P", "<", "X", ">", "p")
QUARTER = 90.0
"""degrees"""


def count_words(answers: Answers) -> str:
    """``48 points: 40 with a verified value, 5 no equilibrium (does not stand), 3 failed``."""
    total = len(answers.answer)
    counts = [(answers.of(answer).sum(), mark.words) for answer, mark in MARKS.items()]
    known = "with a value" if answers.column.path == STATUS else "with a verified value"
    parts = [f"{answers.good.sum()} {known}", *(f"{count} {words}" for count, words in counts if count)]
    return f"{total} point{'s' * (total != 1)}: {', '.join(parts)}"


@contextmanager
def open_sheet(
    path: Path,
    view: View,
    what: str,
    options: PictureOptions,
    handles: Callable[[Page], Sequence[Any]] | None = None,
    notes: Sequence[str] = (),
) -> Iterator[Diagrams]:
    """A page with the title of the sweep, what is drawn, how many points, and notes; raises as ``open_diagrams``."""
    words = [view.table.title or "sweep", what, count_words(view.answers), *notes]
    with open_diagrams(path, options, words, handles=handles) as sheet:
        yield sheet


def drawn_values(cells: Cells) -> FloatArray:
    """Values of cells as lines show them, nan where there is no verified one; of the shape of the cells."""
    return np.where(np.isin(cells.answer, (Answer.VALUE, Answer.PARTLY)), cells.value, np.nan)


def scale_axis(sheet: Diagrams, axes: Any, axis: Axis, which: str = "x", share: float = 1.0) -> None:
    """Ticks and scale of an axis of the design along ``x`` or ``y``: at its values where their names have room.

    share : of the side of the page that the diagram has: fewer names have room then
    """
    along = axes.xaxis if which == "x" else axes.yaxis
    if axis.log:
        axes.set(**{f"{which}scale": "log"})
    width, height = sheet.page.options.size
    side = (width if which == "x" else height * (sheet.top - sheet.bottom)) / DOTS_PER_INCH * 72.0 * share
    if axis.column.role == "azimuth" and np.ptp(axis.coordinates) > QUARTER * 2:
        limits = getattr(axes, f"get_{which}lim")()
        along.set_ticks(np.arange(-360, 361, QUARTER / 2))
        axes.set(**{f"{which}lim": limits})  # which the ticks widen
        return
    longest = max(len(name) for name in axis.names)
    across = sheet.small * (1.5 if which == "y" else 0.7 * longest + 1.0)
    most = max(2, int(0.85 * side / across))
    if not axis.categorical and (_crowded(axis, most) or not axis.names_exact):
        return
    turn = which == "x" and axis.categorical and len(axis.levels) > most
    if turn:
        most = max(2, int(0.85 * side / (1.4 * sheet.small)))
    step = -(-len(axis.levels) // most)
    along.set_ticks([], minor=True)
    along.set_ticks(axis.coordinates[::step], axis.names[::step], parse_math=False, rotation=90 if turn else 0)


def _crowded(axis: Axis, most: int) -> bool:
    """Whether names at all values would lie over each other: a gap smaller than the share that a name needs."""
    values = np.log(axis.coordinates) if axis.log else axis.coordinates
    return bool(len(values) > 1 and np.diff(values).min() < np.ptp(values) / most)


def mark_handles(page: Page, answers: IntArray) -> list[Any]:
    """Entries of a legend for the answers among these, of any shape, that are no values."""
    return [
        page.line(mark.words, **hollow(page, mark.marker, mark.colour))
        for answer, mark in MARKS.items()
        if (answers == answer).any()
    ]


def place_marks(sheet: Diagrams, axes: Any, x: Any, answer: IntArray, values: Any, answers: Answers) -> None:
    """Markers of points that have no verified value, at ``x``.

    Of a load factor what does not stand lies at zero, of other results at the lower edge; what nothing brings down at
    the upper edge; what failed or has no such value at the lower edge; a value that is not verified at its place.

    x, answer, values : (n,) place along the axis, ``Answer``, result
    """
    for kind, mark in MARKS.items():
        own = answer == kind
        if not own.any():
            continue
        size = (8.0, 1.5) if own.sum() < CROWD else (5.0, 0.8)
        style = hollow(sheet.page, mark.marker, mark.colour, *size)
        style |= {"zorder": 4, "clip_on": False, "rasterized": own.sum() > MANY}
        if kind in (Answer.UNVERIFIED, Answer.PARTLY):
            axes.plot(x[own], values[own], **style)
        elif kind == Answer.NO_EQUILIBRIUM and answers.is_factor:
            axes.plot(x[own], np.zeros(own.sum()), **style)
        else:
            height = 1.0 if kind == Answer.UNBOUNDED else 0.0
            axes.plot(x[own], np.full(own.sum(), height), transform=axes.get_xaxis_transform(), **style)


# --- Lines, one for each value of a parameter -----------------------------------------------------------------------


def line_style(page: Page, number: int, count: int) -> dict[str, Any]:
    """Colour and marker of a line among ``count``."""
    marker = MARKERS[number] if count <= MOST_NAMED else "."
    look = {"linewidth": 1.6 * page.scale, "markersize": 5.5 * page.scale}
    return look | {"color": tint(page, number, count), "marker": marker}


def line_handles(page: Page, grid: Grid) -> list[Any]:
    """Entries of a legend for the lines of each diagram where they can be named, and for answers that are no values."""
    lines, count = grid.lines, grid.cells.shape[1]
    names = [f"{lines.column.name} {name}" for name in lines.names] if lines is not None and count <= MOST_NAMED else []
    named = [page.line(name, **line_style(page, i, count)) for i, name in enumerate(names)]
    return named + mark_handles(page, grid.cells.answer)


def add_scale(sheet: Diagrams, frames: Any, lines: Axis | None) -> None:
    """A bar of the colours of lines, a step for each, beside the diagrams, where a legend cannot name them."""
    count = 0 if lines is None else len(lines.levels)
    if lines is None or count <= MOST_NAMED:
        return
    parts = sheet.page.parts
    colours = parts.colors.ListedColormap([tint(sheet.page, i, count) for i in range(count)])
    bar = sheet.add_bar(
        parts.cm.ScalarMappable(parts.colors.Normalize(-0.5, count - 0.5), colours), frames, lines.label
    )
    step = -(-count // 16)
    bar.set_ticks(np.arange(0, count, step), labels=lines.names[::step], fontsize=sheet.small, parse_math=False)
