"""Curves: a result over one parameter of a grid, a line for each value of a second, a diagram for each of a third."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.results.listing.text import counted
from mbla.results.pictures.diagrams import Diagrams, dress
from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.answers import Answer, answers_of
from mbla.sweeps.pictures.sheet import (
    add_scale,
    drawn_values,
    line_handles,
    line_style,
    open_sheet,
    place_marks,
    scale_axis,
)
from mbla.sweeps.pictures.view import NO_POINT, Axis, Cells, Grid, View, gridded, pooled, several

MOST_MARKED = 60
"""points of a line with markers of their own"""


def refusal(view: View) -> str:
    """Why there can be no curves, or nothing."""
    if view.text_refused:
        return view.text_refused
    return "" if view.axes else "no parameter has two values of a grid; scatter shows samples"


def usual(view: View) -> bool:
    """Whether curves are drawn without being asked for."""
    return not refusal(view)


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    grid = gridded(view.answers, *view.axes)
    proved = _bounds(view, grid)
    bands = proved if proved is not None else grid.cells if several(grid.cells) else None
    what = f"{view.answers.label} over {grid.x.label}" + (f", a line for each {grid.lines.label}" if grid.lines else "")
    notes = _notes(view, grid, proved=proved is not None)
    with open_sheet(path, view, what, options, lambda page: line_handles(page, grid), notes) as sheet:
        panels, lines, _ = grid.cells.shape
        frames = sheet.frames(panels, sharex=True, sharey=True)
        for panel, axes in enumerate(frames.flat[:panels]):
            dress(sheet.page, axes, grid.x.label, view.answers.label, grid.title(panel))
            for line in range(lines):
                band = None if bands is None else bands[panel, line]
                _draw_line(
                    sheet, axes, view, grid.x, grid.cells[panel, line], line_style(sheet.page, line, lines), band
                )
            if view.answers.is_factor and (grid.cells.answer == Answer.NO_EQUILIBRIUM).any():
                axes.axhline(0.0, color="#555555", linewidth=0.8 * sheet.page.scale, zorder=1)
            scale_axis(sheet, axes, grid.x, share=1 / frames.shape[1])
            if not np.isfinite(grid.cells.value).any():
                axes.set_yticks([])
        for axes in frames.flat:
            axes.label_outer()
        add_scale(sheet, frames, grid.lines)


def _draw_line(
    sheet: Diagrams, axes: Any, view: View, x: Axis, cells: Cells, style: dict[str, Any], band: Cells | None
) -> None:
    """One line over an axis: broken where a point has no value, its markers where points have none."""
    value = drawn_values(cells)
    if band is not None:
        shown = np.isfinite(value) & np.isfinite(band.low) & np.isfinite(band.high)
        low, high = np.where(shown, band.low, np.nan), np.where(shown, band.high, np.nan)
        axes.fill_between(x.coordinates, low, high, alpha=0.2, color=style["color"], linewidth=0.0, zorder=1)
    style = style | ({"linestyle": "none"} if x.categorical else {})
    if len(value) > MOST_MARKED:
        style["marker"] = "none" if _joined(np.isfinite(value)) and not x.categorical else "."
    axes.plot(x.coordinates, value, zorder=3, **style)
    place_marks(sheet, axes, x.coordinates, cells.answer, cells.value, view.answers)


def _joined(good: Any) -> bool:
    """Whether every good point has a good neighbour: a line shows it without a marker."""
    beside = np.zeros(len(good), dtype=bool)
    beside[1:] |= good[:-1]
    beside[:-1] |= good[1:]
    return bool(np.all(beside[good]))


def _bounds(view: View, grid: Grid) -> Cells | None:
    """Static and kinematic bound of a load factor where the table has both and each cell one point."""
    found = {column.path: column for column in view.table.of_role("result") if column.case == view.answers.column.case}
    if view.answers.column.path != "load_factor" or not {"static_bound", "kinematic_bound"} <= set(found):
        return None
    low, high = (
        grid.shaped(pooled(answers_of(view.table, found[name]), grid.axes))
        for name in ("static_bound", "kinematic_bound")
    )
    low["high"] = high.value
    return None if several(low) else low


def _notes(view: View, grid: Grid, *, proved: bool) -> list[str]:
    notes = []
    if several(grid.cells):
        shown = {axis.column.dimension for axis in grid.axes}
        others = [dimension.name for dimension in view.table.dimensions if dimension.name not in shown]
        notes.append(
            f"line: median of up to {grid.cells.count.max()} points of {', '.join(others) or 'equal values'}; "
            "band: least to greatest"
        )
    if proved:
        notes.append("band: static to kinematic bound")
    empty = int((grid.cells.answer == NO_POINT).sum())
    if empty:
        notes.append(f"{counted(empty, 'combination')} {'has' if empty == 1 else 'have'} no point")
    return notes
