"""Maps: a result over two parameters of a grid, a cell for each point; cells without a value are hatched."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.pictures.diagrams import SCALE, Diagrams, dress
from mbla.results.pictures.options import DOTS_PER_INCH, PictureOptions
from mbla.results.pictures.page import GROUPS, INK, Page
from mbla.sweeps.answers import Answer
from mbla.sweeps.pictures.sheet import MARKS, drawn_values, open_sheet, scale_axis
from mbla.sweeps.pictures.view import NO_POINT, Axis, Cells, View, gridded, value_words

LEAST_CONTOURED = 5
"""values along each side from which contours tell more than the cells"""
NO_POINT_COLOUR = "#F3F3F3"
NO_POINT_WORDS = "no point"
MOST_CLASSES = len(GROUPS)


def refusal(view: View) -> str:
    """Why there can be no map, or nothing."""
    if len(view.axes) < 2:
        return "needs two parameters of a grid with two values each"
    if len(view.answers.categories) > MOST_CLASSES:
        return f"{len(view.answers.categories)} different texts; {MOST_CLASSES} can be told apart"
    return ""


def usual(view: View) -> bool:
    """Whether maps are drawn without being asked for: of two times three values it tells no more than curves."""
    return not refusal(view) and min(len(axis.levels) for axis in view.axes[:2]) > 2


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    grid = gridded(view.answers, *view.axes)
    x, y, cells = grid.x, grid.lines, grid.cells
    assert y is not None  # as ``refusal`` says
    notes = grid.median_words("cell")
    if notes and view.answers.categories:
        notes = [f"cell: class of up to {cells.count.max()} points of the other parameters where it is the same"]

    def handles(page: Page) -> list[Any]:
        return _class_handles(page, view, cells) + hatch_handles(page, cells.answer)

    what = f"{view.answers.label} over {x.label} and {y.label}"
    with open_sheet(path, view, what, options, handles, notes) as sheet:
        frames = sheet.frames(len(cells), sharex=True, sharey=True)
        image = None
        for number, axes in enumerate(frames.flat[: len(cells)]):
            dress(sheet.page, axes, x.label, y.label, grid.title(number))
            image = _draw_cells(sheet, axes, view, (x, y), cells[number], _limits(cells), len(cells)) or image
            scale_axis(sheet, axes, x, share=1 / frames.shape[1])
            scale_axis(sheet, axes, y, "y", share=1 / frames.shape[0])
            axes.grid(visible=False)
        for axes in frames.flat:
            axes.label_outer()
        if image is not None and not view.answers.categories:
            sheet.add_bar(image, frames, view.answers.label)


def cell_edges(axis: Axis) -> FloatArray:
    """Edges of the cells of values, (n_levels + 1,): half way to the neighbours, on a log axis in ratio."""
    at = np.log(axis.coordinates) if axis.log else axis.coordinates
    if len(at) == 1:
        return np.array([at[0] - 0.5, at[0] + 0.5])
    middle = (at[1:] + at[:-1]) / 2
    edges = np.concatenate([[2 * at[0] - middle[0]], middle, [2 * at[-1] - middle[-1]]])
    return np.exp(edges) if axis.log else edges


def _draw_cells(
    sheet: Diagrams, axes: Any, view: View, sides: tuple[Axis, Axis], cells: Cells, limits: Any, panels: int
) -> Any:
    """Colours, hatches, contours or numbers of one diagram; the image, None where no cell has a value."""
    x, y = (cell_edges(side) for side in sides)
    values = np.ma.masked_invalid(drawn_values(cells))
    axes.set(xlim=(x[0], x[-1]), ylim=(y[0], y[-1]))
    classes = view.answers.categories
    image = None
    if values.count():
        scale = sheet.page.parts.colors.ListedColormap(GROUPS) if classes else SCALE
        low, high = (-0.5, MOST_CLASSES - 0.5) if classes else limits
        image = axes.pcolormesh(x, y, values, cmap=scale, vmin=low, vmax=high, rasterized=values.size > 400)
    _hatch(sheet, axes, x, y, cells)
    if classes:
        return image
    if _written(sheet, sides, panels):
        _write_values(sheet, axes, sides, cells, limits)
    elif values.count() and all(not side.categorical and len(side.levels) >= LEAST_CONTOURED for side in sides):
        _contour(sheet, axes, sides, values, panels)
    return image


def _written(sheet: Diagrams, sides: tuple[Axis, Axis], panels: int) -> bool:
    """Whether the cells are so large that their values can be written in them."""
    width, height = (side * 72 / DOTS_PER_INCH for side in sheet.page.options.size)
    across = sheet.places(panels)
    smallest = [np.diff(_even(axis)).min() / np.ptp(_even(axis)) for axis in sides]
    wide = 0.8 * width / across[1] * smallest[0] >= 4.0 * sheet.small
    return bool(wide and 0.85 * height * (sheet.top - sheet.bottom) / across[0] * smallest[1] >= 1.5 * sheet.small)


def _even(axis: Axis) -> FloatArray:
    """Edges of cells at their distances on the page."""
    return np.log(cell_edges(axis)) if axis.log else cell_edges(axis)


def _contour(sheet: Diagrams, axes: Any, sides: tuple[Axis, Axis], values: Any, panels: int) -> None:
    """Lines of equal value between the middles of cells that have one; none beside a cell without."""
    if np.ptp(values.compressed()) <= 0:
        return
    lines = axes.contour(sides[0].coordinates, sides[1].coordinates, values, levels=7 if panels == 1 else 4,
                         colors="white", linewidths=1.2 * sheet.page.scale)  # fmt: skip
    for text in axes.clabel(lines, fontsize=sheet.small, fmt=value_words):
        text.set_bbox({"facecolor": "#222222", "edgecolor": "none", "pad": 1.0, "alpha": 0.6})


def _write_values(sheet: Diagrams, axes: Any, sides: tuple[Axis, Axis], cells: Cells, limits: Any) -> None:
    for row, column in zip(*np.nonzero(np.isfinite(cells.value) & (cells.answer != Answer.UNVERIFIED)), strict=True):
        value = cells.value[row, column]
        share = (value - limits[0]) / (limits[1] - limits[0]) if limits[1] > limits[0] else 0.0
        axes.text(sides[0].coordinates[column], sides[1].coordinates[row], f"{value:.3g}", ha="center", va="center",
                  fontsize=sheet.small, color=INK if share > 0.55 else "white")  # fmt: skip


def _hatch(sheet: Diagrams, axes: Any, x: FloatArray, y: FloatArray, cells: Cells) -> None:
    """Cells without a value, each kind with its own hatch; of several runs along a row one rectangle."""
    kinds = [(NO_POINT, NO_POINT_COLOUR, "", "")]
    kinds += [
        (int(answer), "none" if answer == Answer.PARTLY else "white", mark.colour, mark.hatch)
        for answer, mark in MARKS.items()
    ]
    for answer, face, edge, hatch in kinds:
        corners = []
        for row, own in enumerate(cells.answer == answer):
            steps = np.flatnonzero(np.diff(np.concatenate([[0], own.astype(int), [0]])))
            for first, last in steps.reshape(-1, 2):
                left, right, low, high = x[first], x[last], y[row], y[row + 1]
                corners.append([(left, low), (right, low), (right, high), (left, high)])
        if corners:
            axes.add_collection(
                sheet.page.parts.collections.PolyCollection(
                    corners, facecolor=face, edgecolor=edge or face, hatch=hatch or None, linewidth=0.0, zorder=2
                )
            )


def hatch_handles(page: Page, answers: IntArray) -> list[Any]:
    """Entries of a legend for the answers among these, of any shape, that are no values, as cells have them."""
    handles = [
        page.box(mark.words, facecolor="white", edgecolor=mark.colour, hatch=2 * mark.hatch)
        for answer, mark in MARKS.items()
        if (answers == answer).any()
    ]
    if (answers == NO_POINT).any():
        handles.append(page.box(NO_POINT_WORDS, facecolor=NO_POINT_COLOUR, edgecolor=INK, linewidth=0.5))
    return handles


def _class_handles(page: Page, view: View, cells: Cells) -> list[Any]:
    shown = cells.value[cells.answer == Answer.VALUE]
    return [
        page.box(name, facecolor=GROUPS[i], edgecolor=INK, linewidth=0.5)
        for i, name in enumerate(view.answers.categories)
        if (shown == i).any()
    ]


def _limits(cells: Cells) -> tuple[float, float] | None:
    values = np.ma.masked_invalid(drawn_values(cells))
    return (float(values.min()), float(values.max())) if values.count() else None
