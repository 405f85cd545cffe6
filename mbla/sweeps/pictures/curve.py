"""Curves: a result over one parameter of a grid, a line for each value of a second, a diagram for each of a third."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.listing.text import counted
from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.answers import Answer, answers_of
from mbla.sweeps.pictures.sheet import (
    MOST_PANELS,
    Sheet,
    dress,
    mark_handles,
    open_sheet,
    panel_places,
    panel_title,
    place_marks,
    scale_axis,
)
from mbla.sweeps.pictures.view import NO_POINT, Axis, Cells, View, pooled

MOST_NAMED = 10
"""lines that a legend names; more have a scale of colours beside them"""
MARKERS = ("o", "s", "^", "D", "v", "P", "<", "X", ">", "p")


def refusal(view: View) -> str:
    """Why there can be no curves, or nothing."""
    if view.text_refused:
        return view.text_refused
    return "" if view.axes else "no parameter has two values of a grid; scatter shows samples"


def usual(view: View) -> bool:
    """Whether curves are drawn without being asked for."""
    return not refusal(view)


def curve_axes(view: View) -> tuple[Axis, Axis | None, Axis | None]:
    """Axes of the abscissa, of the lines and of the diagrams; further parameters are taken together."""
    first, *rest = view.axes
    panels = rest[1] if len(rest) > 1 and len(rest[1].levels) <= MOST_PANELS else None
    return first, rest[0] if rest else None, panels


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    x, lines, panels = curve_axes(view)
    chosen = [axis for axis in (panels, lines, x) if axis is not None]
    cells = _with_three(pooled(view.answers, chosen))
    bounds = _bounds(view, chosen)
    notes = _notes(view, chosen, cells, bounds)
    what = f"{view.answers.label} over {x.label}" + (f", a line for each {lines.label}" if lines else "")
    named = lines is not None and len(lines.levels) <= MOST_NAMED

    def handles(page: Any) -> list[Any]:
        sheet = Sheet(page, 0, 1)
        of_lines = [
            page.parts.Line2D([], [], label=f"{lines.column.name} {name}", **line_style(sheet, i, len(lines.levels)))
            for i, name in enumerate(lines.names if lines and named else ())
            if lines is not None
        ]
        return of_lines + mark_handles(page, cells.answer)

    with open_sheet(path, view, what, options, handles, notes) as sheet:
        _draw_panels(sheet, view, (x, lines, panels), cells, bounds)


def _draw_panels(
    sheet: Sheet, view: View, axes_of: tuple[Axis, Axis | None, Axis | None], cells: Cells, bounds: Any
) -> None:
    x, lines, panels = axes_of
    rows, columns = panel_places(len(cells.value), sheet)
    frames = sheet.panels(rows, columns, sharex=True, sharey=True)
    for number, axes in enumerate(frames.flat):
        if number >= len(cells.value):
            axes.set_axis_off()
            continue
        dress(sheet, axes, x.label, view.answers.label, panel_title(panels, number))
        for line in range(cells.value.shape[1]):
            own = cells.part(number, line)
            band = (bounds[0][number, line], bounds[1][number, line]) if bounds else None
            draw_line(sheet, axes, view, x, own, line_style(sheet, line, cells.value.shape[1]), band)
        if view.answers.is_factor and (cells.answer == Answer.NO_EQUILIBRIUM).any():
            axes.axhline(0.0, color="#555555", linewidth=0.8 * sheet.page.scale, zorder=1)
        scale_axis(sheet, axes, x, share=1 / columns)
        if not np.isfinite(cells.value).any():
            axes.set_yticks([])
    for axes in frames.flat:
        axes.label_outer()
    if lines is not None and len(lines.levels) > MOST_NAMED:
        add_scale(sheet, frames, lines)


def draw_line(
    sheet: Sheet, axes: Any, view: View, x: Axis, cells: Cells, style: dict[str, Any], band: Any = None
) -> None:
    """One line over an axis: broken where a point has no value, its markers where points have none."""
    good = np.isin(cells.answer, (Answer.VALUE, Answer.PARTLY))
    value = np.where(good, cells.value, np.nan)
    low, high = band if band is not None else (cells.low, cells.high)
    if band is not None or cells.several:
        shown = good & np.isfinite(low) & np.isfinite(high)
        axes.fill_between(x.coordinates, np.where(shown, low, np.nan), np.where(shown, high, np.nan), alpha=0.2,
                          color=style["color"], linewidth=0.0, zorder=1)  # fmt: skip
    line = style | ({"linestyle": "none"} if x.categorical else {})
    if len(value) > 60:
        line["marker"] = "none" if _joined(good) and not x.categorical else "."
    axes.plot(x.coordinates, value, zorder=3, **line)
    place_marks(sheet, axes, x.coordinates, cells.answer, cells.value, view.answers)


def line_style(sheet: Sheet, number: int, count: int) -> dict[str, Any]:
    """Colour and marker of a line among ``count``."""
    share = number / max(count - 1, 1)
    marker = MARKERS[number] if count <= MOST_NAMED else "."
    scale = sheet.page.scale
    return {"color": sheet.colour(share), "marker": marker, "linewidth": 1.6 * scale, "markersize": 5.5 * scale}


def add_scale(sheet: Sheet, frames: Any, lines: Axis) -> None:
    """A bar of the colours of lines, a step for each, beside the diagrams."""
    count = len(lines.levels)
    parts = sheet.page.parts
    colours = parts.ListedColormap([sheet.colour(i / max(count - 1, 1)) for i in range(count)])
    mappable = parts.ScalarMappable(parts.Normalize(-0.5, count - 0.5), colours)
    bar = sheet.figure.colorbar(mappable, ax=frames, fraction=0.04, pad=0.01, aspect=40)
    step = -(-count // 16)
    bar.set_ticks(np.arange(0, count, step), labels=lines.names[::step], fontsize=sheet.small)
    bar.set_label(lines.label, fontsize=sheet.small)
    for text in (*bar.ax.get_yticklabels(), bar.ax.yaxis.label):
        text.set_parse_math(False)


def _joined(good: Any) -> bool:
    """Whether every good point has a good neighbour: a line shows it without a marker."""
    beside = np.zeros(len(good), dtype=bool)
    beside[1:] |= good[:-1]
    beside[:-1] |= good[1:]
    return bool(np.all(beside[good]))


def _with_three(cells: Cells) -> Cells:
    """With axes of one value before those that there are: panels, lines, abscissa."""
    return cells.shaped((1,) * (3 - cells.value.ndim) + cells.value.shape)


def _bounds(view: View, chosen: list[Axis]) -> tuple[FloatArray, FloatArray] | None:
    """Static and kinematic bound of a load factor where the table has both and each cell one point."""
    if view.answers.column.path != "load_factor":
        return None
    found = {column.path: column for column in view.table.of_role("result") if column.case == view.answers.column.case}
    if not {"static_bound", "kinematic_bound"} <= set(found):
        return None
    cells = [pooled(answers_of(view.table, found[name]), chosen) for name in ("static_bound", "kinematic_bound")]
    if cells[0].several:
        return None
    low, high = (_with_three(each).value for each in cells)
    return low, high


def _notes(view: View, chosen: list[Axis], cells: Cells, bounds: Any) -> list[str]:
    notes = []
    if cells.several:
        shown = {axis.column.dimension for axis in chosen}
        others = [dimension.name for dimension in view.table.dimensions if dimension.name not in shown]
        notes.append(
            f"line: median of up to {cells.count.max()} points of {', '.join(others) or 'equal values'}; "
            "band: least to greatest"
        )
    if bounds:
        notes.append("band: static to kinematic bound")
    if (cells.answer == NO_POINT).any():
        empty = int((cells.answer == NO_POINT).sum())
        notes.append(f"{counted(empty, 'combination')} {'has' if empty == 1 else 'have'} no point")
    return notes
