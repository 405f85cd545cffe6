"""Curves: a result over one parameter of a grid, a line for each value of a second, a diagram for each of a third."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.results.pictures.diagrams import dress
from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.pictures.sheet import (
    drawn_values,
    line_handles,
    line_style,
    mark_along,
    open_sheet,
    scale_axis,
)
from mbla.sweeps.pictures.view import ResultView, gridded, several


def refusal(view: ResultView) -> str:
    """Why there can be no curves, or nothing."""
    if view.text_refused:
        return view.text_refused
    return "" if view.axes else "no parameter has two values of a grid; distribution shows samples"


def draw(path: Path, view: ResultView, options: PictureOptions) -> None:
    """Write the picture; a line is broken where a point has no value; raises as ``open_page`` does."""
    grid = gridded(view.answers, *view.axes)
    x, cells = grid.x, grid.cells
    what = f"{view.answers.label} over {x.label}" + (f", a line for each {grid.lines.label}" if grid.lines else "")
    notes = grid.median_words("line") + ["band: least to greatest of these points"] * several(cells)
    with open_sheet(path, view, what, options, lambda page: line_handles(page, grid), notes) as sheet:
        panels, lines, _ = cells.shape
        frames = sheet.frames(panels, sharex=True, sharey=True)
        for panel, axes in enumerate(frames.flat[:panels]):
            dress(sheet.page, axes, x.label, view.answers.label, grid.title(panel))
            for line in range(lines):
                own = cells[panel, line]
                value = drawn_values(own)
                style = line_style(sheet.page, line, lines)
                style |= {"linestyle": "none"} if x.categorical else {}
                axes.plot(x.coordinates, value, zorder=3, **style)
                if several(cells):
                    low, high = (np.where(np.isfinite(value), side, np.nan) for side in (own.low, own.high))
                    band = {"alpha": 0.2, "color": style["color"], "linewidth": 0.0, "zorder": 1}
                    axes.fill_between(x.coordinates, low, high, **band)
                mark_along(sheet.page, axes, x.coordinates, own.answer, own.value, view.answers)
            scale_axis(sheet.page, axes, x)
            axes.label_outer()
