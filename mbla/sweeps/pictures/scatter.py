"""Scatter: a result against each parameter, a diagram for each, with the rank correlation."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.diagrams import Diagrams, dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, CASES, Page
from mbla.sweeps.answers import Answer, Answers, answers_of, numbers_of
from mbla.sweeps.pictures.sheet import MANY, mark_handles, open_sheet, place_marks, scale_axis
from mbla.sweeps.pictures.tornado import LEAST_POINTS, correlation
from mbla.sweeps.pictures.view import MOST_PANELS, View, axis_of, design_columns, label_of
from mbla.sweeps.tables.sweep_table import SweepColumn

CLASS = "mechanism.class"
CLASS_MARKERS = ("o", "s", "D", "P", "<", "*")
SPREAD = 0.28
"""points of one category lie this far to either side of it, so that they can be told apart"""
WIDE = 100.0
"""greatest by least value from which a parameter has a logarithmic axis"""
GOLDEN = 0.6180339887498949
"""its multiples fill an interval evenly: places of points within a category, the same in every drawing"""


def refusal(view: View) -> str:
    """Why there can be no scatter, or nothing."""
    columns = scattered(view)
    if not columns:
        return "no parameter has two values"
    return (
        f"{len(columns)} parameters; {MOST_PANELS} have room, name one with --by" if len(columns) > MOST_PANELS else ""
    )


def usual(view: View) -> bool:
    """Whether it is drawn without being asked for: of samples."""
    return bool(view.sampled) and not refusal(view)


def scattered(view: View) -> list[SweepColumn]:
    """Parameters that vary; the one that the user named alone."""
    columns = [column for column in design_columns(view.table) if len(set(view.table[column.name].tolist())) > 1]
    return [column for column in columns if view.by in ("", column.name)]


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    columns = scattered(view)
    classes = _classes(view)

    def handles(page: Page) -> list[Any]:
        style = {"linestyle": "none", "markersize": 7 * page.scale}
        of_classes = [
            page.line(name, marker=CLASS_MARKERS[i], color=CASES[i], **style)
            for i, name in enumerate(classes.categories if classes is not None else ())
            if classes is not None and (classes.values[view.answers.good] == i).any()
        ]
        return of_classes + mark_handles(page, view.answers.answer)

    titles = [_title(view, column) for column in columns]
    notes = ["above each diagram: Spearman rank correlation over the points with a verified value"] * any(titles)
    with open_sheet(path, view, f"{view.answers.label} against each parameter", options, handles, notes) as sheet:
        frames = sheet.frames(len(columns), sharey=True)
        across = frames.shape[1]
        for number, axes in enumerate(frames.flat[: len(columns)]):
            dress(sheet.page, axes, label_of(columns[number]), view.answers.label, titles[number])
            _draw_points(sheet, axes, view, columns[number], classes, across)
            if number % across:
                axes.set_ylabel("")


def _draw_points(
    sheet: Diagrams, axes: Any, view: View, column: SweepColumn, classes: Answers | None, across: int
) -> None:
    answers = view.answers
    x = _abscissa(view, column)
    if column.kind in ("text", "bool"):
        scale_axis(sheet, axes, axis_of(view.table, column), share=1 / across)
    elif _is_wide(x):
        axes.set_xscale("log")
    y = answers.values
    if answers.categories:
        y = y + _within(len(y))
        _name_classes(axes, answers)
    count = int(answers.good.sum())
    style = {"linestyle": "none", "rasterized": count > MANY, "alpha": 0.75 if count < 200 else 0.45,
             "markersize": (6 if count < 200 else 4 if count < MANY else 2) * sheet.page.scale, "markeredgewidth": 0.0,
             "zorder": 3}  # fmt: skip
    if classes is None:
        axes.plot(x[answers.good], y[answers.good], marker="o", color=BLUE, **style)
    else:
        for place in range(len(classes.categories)):
            own = answers.good & (classes.values == place)
            axes.plot(x[own], y[own], marker=CLASS_MARKERS[place], color=CASES[place], **style)
        own = answers.good & ~np.isfinite(classes.values)
        axes.plot(x[own], y[own], marker="o", color="#777777", **style)
    if answers.is_factor and answers.of(Answer.NO_EQUILIBRIUM).any():
        axes.axhline(0.0, color="#555555", linewidth=0.8 * sheet.page.scale, zorder=1)
    place_marks(sheet, axes, x, answers.answer, y, answers)


def _is_wide(x: FloatArray) -> bool:
    """Whether values are so spread that they need a logarithmic axis: over decades, and not evenly up to the least."""
    if x.min() <= 0 or x.max() <= WIDE * x.min():
        return False
    low, middle, high = np.quantile(np.log(x), [0.05, 0.5, 0.95])
    return bool(high - low > np.log(WIDE / 5) and high - middle > (high - low) / 4)


def _abscissa(view: View, column: SweepColumn) -> FloatArray:
    if column.kind not in ("text", "bool"):
        return numbers_of(column, view.table[column.name])
    return axis_of(view.table, column).place + _within(len(view.table))


def _within(count: int) -> FloatArray:
    """Places from -SPREAD to SPREAD, evenly."""
    return np.asarray(SPREAD * (2 * (np.arange(count) * GOLDEN % 1.0) - 1))


def _name_classes(axes: Any, answers: Answers) -> None:
    axes.set_yticks(range(len(answers.categories)), answers.categories, parse_math=False)
    axes.set_ylim(-0.6, len(answers.categories) - 0.4)


def _classes(view: View) -> Answers | None:
    """Mechanism classes of the same load case, where the table has them and they can be told apart by colour."""
    own = view.answers.column
    found = [each for each in view.table.of_role("result") if each.path == CLASS and each.case == own.case]
    if not found or own.kind == "text":
        return None
    classes = answers_of(view.table, found[0])
    return classes if 1 <= len(classes.categories) <= len(CASES) else None


def _title(view: View, column: SweepColumn) -> str:
    """The rank correlation; nothing for text, directions and few points."""
    if view.answers.categories or column.role != "parameter" or column.kind not in ("float", "int"):
        return ""
    found = correlation(view, column)
    if found.points < LEAST_POINTS or np.isnan(found.value):
        return ""
    return f"rank correlation {found.value:+.2f}"
