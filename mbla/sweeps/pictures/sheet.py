"""The page of a picture of a sweep: title and counts above, legend below, diagrams between that find their own room."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import IntArray
from mbla.errors import UsageError
from mbla.results.pictures.options import DOTS_PER_INCH, PictureOptions
from mbla.results.pictures.page import GHOST, INK, LETTER, PURPLE, WARNING, Page, add_legend, add_words, open_page
from mbla.sweeps.answers import Answer, Answers
from mbla.sweeps.pictures.view import Axis, View
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


def count_words(answers: Answers) -> str:
    """``48 points: 40 with a verified value, 5 no equilibrium (does not stand), 3 failed``."""
    total = len(answers.answer)
    counts = [(answers.of(answer).sum(), mark.words) for answer, mark in MARKS.items()]
    known = "with a value" if answers.column.path == STATUS else "with a verified value"
    parts = [f"{answers.good.sum()} {known}", *(f"{count} {words}" for count, words in counts if count)]
    return f"{total} point{'s' * (total != 1)}: {', '.join(parts)}"


MOST_PANELS = 16
"""diagrams on a page in which anything can be read"""


def panel_places(count: int, sheet: Any) -> tuple[int, int]:
    """Rows and columns of diagrams that are about half as wide again as high, no row empty."""
    width, height = sheet.page.options.size
    columns = min(count, max(1, round(math.sqrt(count * width / (1.5 * height * max(sheet.top - sheet.bottom, 0.2))))))
    rows = -(-count // columns)
    return rows, -(-count // rows)


def panel_title(axis: Axis | None, number: int) -> str:
    """``thickness 0.3 m``."""
    if axis is None:
        return ""
    unit = f" {axis.column.unit}" if axis.column.unit else ""
    return f"{axis.column.name} {axis.names[number]}{unit}"


LEAST_LETTER = 8.0
"""points of the smallest letters"""
LEAST_ROOM = 0.2
"""share of the height that words and legend must leave"""
SMALL = 0.8
"""letters at axes against those of the words"""
SCALE = "viridis"
"""colours of values: the colour-blind tell them apart, and they darken evenly in grey"""
DARK_END, LIGHT_END = 0.0, 0.88
"""part of the scale that lines use: its last colours are too light on white"""


@dataclass(frozen=True)
class Sheet:
    """An open page with room between ``bottom`` and ``top``, shares of its height."""

    page: Page
    bottom: float
    top: float

    @property
    def small(self) -> float:
        """Points of letters at axes."""
        return max(LEAST_LETTER, SMALL * self.page.letter)

    @property
    def figure(self) -> Any:
        """The figure of matplotlib."""
        return self.page.figure

    def panels(self, rows: int, columns: int, layout: str = "constrained", **options: Any) -> Any:
        """Axes in rows and columns, (rows, columns), that leave each other the room that their labels need."""
        rect = (0.01, self.bottom, 0.98, self.top - self.bottom)
        self.figure.set_layout_engine(layout, rect=rect, w_pad=0.06, h_pad=0.06)
        return self.figure.subplots(rows, columns, squeeze=False, **options)

    def colour(self, share: float) -> Any:
        """Colour of a line by its place among the others, 0 to 1."""
        return self.page.parts.colormaps[SCALE](DARK_END + (LIGHT_END - DARK_END) * share)


@contextmanager
def open_sheet(
    path: Path, view: View, what: str, options: PictureOptions, handles: Any = None, notes: Sequence[str] = ()
) -> Iterator[Sheet]:
    """A page with the title of the sweep, what is drawn, how many points, and notes.

    handles : function of the page that gives handles of a legend

    Raises as ``open_page`` does; UsageError where the page is too small.
    """
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("error", message=NO_ROOM)
            yield from _sheet(path, view, what, options, handles, notes)
    except UserWarning as error:
        width, height = options.size
        raise UsageError(
            "picture-option", f"--size {width}x{height}: words and legend leave no room; choose a larger one"
        ) from error


NO_ROOM = "constrained_layout not applied"
"""how matplotlib begins to say that names and figures leave a diagram nothing"""


def _sheet(
    path: Path, view: View, what: str, options: PictureOptions, handles: Any, notes: Sequence[str]
) -> Iterator[Sheet]:
    with open_page(path, options) as page:
        page = replace(page, scale=max(page.scale, LEAST_LETTER / LETTER))
        words = [view.table.title or "sweep", what, f"{count_words(view.answers)}", *notes]
        above = add_words(page, words)
        below = add_legend(page, handles(page) if handles else ())
        if 1 - above - below < LEAST_ROOM:
            raise UserWarning(NO_ROOM)
        yield Sheet(page, below + 0.01, 1 - above)


def dress(sheet: Sheet, axes: Any, x: str = "", y: str = "", title: str = "") -> None:
    """Letters, grid and names of a diagram."""
    axes.tick_params(labelsize=sheet.small, colors=INK)
    axes.grid(visible=True, color="#DDDDDD", linewidth=0.6, zorder=0)
    axes.set_axisbelow(True)
    axes.spines[["top", "right"]].set_visible(False)
    for text in (
        axes.set_xlabel(x, fontsize=sheet.small, color=INK),
        axes.set_ylabel(y, fontsize=sheet.small, color=INK),
        axes.set_title(title, fontsize=sheet.small, color=INK),
    ):
        text.set_parse_math(False)


def scale_axis(sheet: Sheet, axes: Any, axis: Axis, which: str = "x", share: float = 1.0) -> None:
    """Ticks and scale of an axis of the design along ``x`` or ``y``: at its values where their names have room.

    share : of the side of the page that the diagram has: fewer names have room then
    """
    if axis.log:
        getattr(axes, f"set_{which}scale")("log")
    width, height = sheet.page.options.size
    side = (width if which == "x" else height * (sheet.top - sheet.bottom)) / DOTS_PER_INCH * 72.0 * share
    if axis.column.role == "azimuth" and np.ptp(axis.coordinates) > QUARTER * 2:
        limits = getattr(axes, f"get_{which}lim")()
        getattr(axes, f"set_{which}ticks")(np.arange(-360, 361, QUARTER / 2))
        getattr(axes, f"set_{which}lim")(limits)  # which the ticks widen
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
    set_ticks = getattr(axes, f"set_{which}ticks")
    set_ticks([], minor=True)
    set_ticks(axis.coordinates[::step], axis.names[::step], **({"rotation": 90} if turn else {}))
    for text in getattr(axes, f"get_{which}ticklabels")():
        text.set_parse_math(False)


def _crowded(axis: Axis, most: int) -> bool:
    """Whether names at all values would lie over each other: a gap smaller than the share that a name needs."""
    values = np.log(axis.coordinates) if axis.log else axis.coordinates
    return bool(len(values) > 1 and np.diff(values).min() < np.ptp(values) / most)


def mark_handles(page: Page, answers: IntArray) -> list[Any]:
    """Handles of a legend for the answers among these that are no values."""
    return [
        page.parts.Line2D(
            [], [], linestyle="none", marker=mark.marker, markerfacecolor="none", markeredgecolor=mark.colour,
            markeredgewidth=1.5 * page.scale, markersize=8 * page.scale, label=mark.words,
        )
        for answer, mark in MARKS.items()
        if (answers == answer).any()
    ]  # fmt: skip


def place_marks(sheet: Sheet, axes: Any, x: Any, answer: IntArray, values: Any, answers: Answers) -> None:
    """Markers of points that have no verified value, at ``x``.

    Of a load factor what does not stand lies at zero, of other results at the lower edge; what nothing brings down at
    the upper edge; what failed or has no such value at the lower edge; a value that is not verified at its place.
    """
    scale = sheet.page.scale
    for kind, mark in MARKS.items():
        own = answer == kind
        if not own.any():
            continue
        style = {"marker": mark.marker, "linestyle": "none", "markerfacecolor": "none", "markeredgecolor": mark.colour,
                 "markeredgewidth": (1.5 if own.sum() < CROWD else 0.8) * scale, "zorder": 4, "clip_on": False,
                 "markersize": (8 if own.sum() < CROWD else 5) * scale,
                 "rasterized": own.sum() > MANY}  # fmt: skip
        if kind in (Answer.UNVERIFIED, Answer.PARTLY):
            axes.plot(x[own], values[own], **style)
        elif kind == Answer.NO_EQUILIBRIUM and answers.is_factor:
            axes.plot(x[own], np.zeros(own.sum()), **style)
        else:
            height = 1.0 if kind == Answer.UNBOUNDED else 0.0
            axes.plot(x[own], np.full(own.sum(), height), transform=axes.get_xaxis_transform(), **style)


CROWD = 60
"""markers from which on they are smaller"""
QUARTER = 90.0
"""degrees"""
MANY = 2000
"""markers from which on they are one image in SVG and PDF"""
