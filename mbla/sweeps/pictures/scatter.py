"""Scatter: a result against each parameter, a diagram for each, with the rank correlation."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.results.pictures.diagrams import dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE
from mbla.sweeps.pictures.sheet import MANY, mark_along, mark_handles, open_sheet, scale_axis
from mbla.sweeps.pictures.tornado import LEAST_POINTS, correlation
from mbla.sweeps.pictures.view import MOST_PANELS, View, axis_of, design_columns
from mbla.sweeps.tables.sweep_table import SweepColumn


def refusal(view: View) -> str:
    """Why there can be no scatter, or nothing."""
    count = len(scattered(view))
    if not count:
        return "no parameter has two values"
    return f"{count} parameters; {MOST_PANELS} have room, name one with --by" if count > MOST_PANELS else ""


def scattered(view: View) -> list[SweepColumn]:
    """Parameters that vary; the one that the user named alone."""
    columns = [column for column in design_columns(view.table) if len(set(view.table[column.name].tolist())) > 1]
    return [column for column in columns if view.by in ("", column.name)]


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    columns, answers = scattered(view), view.answers
    titles = [_title(view, column) for column in columns]
    notes = ["above each diagram: Spearman rank correlation over the points with a verified value"] * any(titles)
    what = f"{answers.label} against each parameter"
    y = answers.values

    with open_sheet(path, view, what, options, lambda page: mark_handles(page, answers.answer), notes) as sheet:
        frames, count = sheet.frames(len(columns), sharey=True), int(answers.good.sum())
        style = {"linestyle": "none", "marker": "o", "color": BLUE, "alpha": 0.4, "zorder": 3}
        style |= {"markersize": 5 * sheet.page.scale}
        for column, title, axes in zip(columns, titles, frames.flat, strict=False):
            axis = axis_of(view.table, column)
            dress(sheet.page, axes, axis.label, answers.label, title)
            scale_axis(sheet.page, axes, axis)
            x = axis.coordinates[axis.place]
            axes.plot(x[answers.good], y[answers.good], markeredgewidth=0.0, rasterized=count > MANY, **style)
            if answers.categories:
                axes.set_yticks(range(len(answers.categories)), answers.categories, parse_math=False)
            mark_along(sheet.page, axes, x, answers.answer, y, answers)
            if not axes.get_subplotspec().is_first_col():
                axes.set_ylabel("")


def _title(view: View, column: SweepColumn) -> str:
    """The rank correlation; nothing for text, directions and few points."""
    if view.answers.categories or column.role != "parameter" or column.kind not in ("float", "int"):
        return ""
    found = correlation(view, column)
    known = view.answers.good.sum() >= LEAST_POINTS and not np.isnan(found.value)
    return f"rank correlation {found.value:+.2f}" if known else ""
