"""Maps: a result over two parameters of a grid, a cell for each point; cells without a value are marked."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.results.pictures.diagrams import SCALE, dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import GROUPS, INK, Page
from mbla.sweeps.pictures.sheet import draw_marks, drawn_values, mark_handles, open_sheet, scale_axis
from mbla.sweeps.pictures.view import ResultView, gridded

MOST_CLASSES = len(GROUPS)


def refusal(view: ResultView) -> str:
    """Why there can be no map, or nothing."""
    if len(view.axes) < 2:
        return "needs two parameters of a grid with two values each"
    if len(view.answers.categories) > MOST_CLASSES:
        return f"{len(view.answers.categories)} different texts; {MOST_CLASSES} can be distinguished"
    return ""


def draw(path: Path, view: ResultView, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    grid = gridded(view.answers, *view.axes)
    x, y, cells, classes = grid.x, grid.lines, grid.cells, view.answers.categories
    assert y is not None  # as ``refusal`` says
    values = np.ma.masked_invalid(drawn_values(cells))

    def handles(page: Page) -> list[Any]:
        shown = [(GROUPS[i], name) for i, name in enumerate(classes) if (values == i).any()]
        boxes = [page.box(name, facecolor=colour, edgecolor=INK, linewidth=0.5) for colour, name in shown]
        return boxes + mark_handles(page, cells.answer)

    what = f"{view.answers.label} over {x.label} and {y.label}"
    notes = [] if classes else grid.median_words("cell")
    with open_sheet(path, view, what, options, handles, notes) as sheet:
        frames = sheet.frames(len(cells), sharex=True, sharey=True)
        scale = sheet.page.parts.colors.ListedColormap(GROUPS) if classes else SCALE
        ends = (-0.5, MOST_CLASSES - 0.5) if classes else (values.min(), values.max()) if values.count() else (0, 1)
        across, up = (side.ravel() for side in np.meshgrid(x.coordinates, y.coordinates))
        style = {"cmap": scale, "vmin": ends[0], "vmax": ends[1], "shading": "nearest"}
        for number, axes in enumerate(frames.flat[: len(cells)]):
            dress(sheet.page, axes, x.label, y.label, grid.title(number))
            image = axes.pcolormesh(x.coordinates, y.coordinates, values[number], rasterized=values.size > 400, **style)
            draw_marks(sheet.page, axes, across, up, cells.answer[number].ravel())
            scale_axis(sheet.page, axes, x)
            scale_axis(sheet.page, axes, y, "y")
            axes.grid(visible=False)
            axes.label_outer()
        if values.count() and not classes:
            sheet.add_bar(image, frames, view.answers.label)
