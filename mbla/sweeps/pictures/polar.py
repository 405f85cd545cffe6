"""Polar diagram: a result over load directions around the horizon.

Over a sphere the directions by azimuth and elevation, each in the colour of its value.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.diagrams import SCALE, Diagrams, dress
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import INK
from mbla.sweeps.answers import Answer, numbers_of
from mbla.sweeps.pictures.sheet import (
    draw_marks,
    drawn_values,
    line_handles,
    line_style,
    mark_handles,
    open_sheet,
)
from mbla.sweeps.pictures.view import Axis, Cells, View, axis_of, gridded, is_sampled, over_sphere
from mbla.sweeps.tables.sweep_table import SweepColumn

WIDEST_STEP = 1.5
"""gap over the full circle, in usual steps of the azimuth, across which a curve is still closed"""


def refusal(view: View) -> str:
    """Why there can be no polar diagram, or nothing."""
    if view.text_refused:
        return view.text_refused
    column, sphere = _azimuth(view), sphere_directions(view)
    if sphere is not None and sum(dimension.size > 1 for dimension in view.table.dimensions) > 1:
        return "a map of a sphere has one point for each direction; this sweep has other parameters too"
    if column is None and sphere is None:
        return "no parameter is a direction around the horizon of a grid, or over a sphere"
    count = len(view.table) if column is None else len(axis_of(view.table, column).levels)
    return "" if count > 2 else "needs three directions"


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    column = _azimuth(view)
    if column is None:
        _draw_sphere(path, view, options)
        return
    rest = [axis for axis in view.axes if axis.column.dimension != column.dimension]
    grid = gridded(view.answers, axis_of(view.table, column), *rest)
    what = f"{view.answers.label} over {grid.x.label}"
    what += f", a curve for each {grid.lines.label}" if grid.lines else ""
    notes = grid.median_words("line")
    with open_sheet(path, view, what, options, lambda page: line_handles(page, grid), notes) as sheet:
        panels, lines, _ = grid.cells.shape
        frames = sheet.frames(panels, layout="compressed", subplot_kw={"projection": "polar"})
        for panel, axes in enumerate(frames.flat[:panels]):
            dress(sheet.page, axes, title=grid.title(panel))
            axes.set_rlim(*_radii(grid.cells))
            axes.set_rlabel_position(22.5)
            axes.set_thetagrids(
                range(0, 360, 45), ["0° (+x)", "45°", "90° (+y)", *(f"{n}°" for n in range(135, 360, 45))]
            )
            for line in range(lines):
                _draw_curve(sheet, axes, grid.x, grid.cells[panel, line], line_style(sheet.page, line, lines))


def _azimuth(view: View) -> SweepColumn | None:
    """Directions around the horizon of a grid, that of ``by`` first; None without any."""
    found = [
        column
        for column in view.table.of_role("azimuth")
        if not over_sphere(view.table, column.dimension) and not is_sampled(view.table, column.dimension)
    ]
    return next((column for column in found if column.name == view.by), next(iter(found), None))


def _radii(cells: Cells) -> tuple[float, float]:
    """Value at the middle, zero unless there are values below it, and at the rim."""
    known = cells.value[np.isfinite(cells.value)]
    least, most = min(0.0, known.min(initial=0.0)), max(0.0, known.max(initial=0.0))
    return (1.05 * least, 1.08 * most) if most > least else (least, least + 1.0)


def _draw_curve(sheet: Diagrams, axes: Any, turn: Axis, cells: Cells, style: dict[str, Any]) -> None:
    """A curve, closed where the directions go around; broken where there is no value; markers of other answers."""
    angle, value = np.radians(turn.coordinates), drawn_values(cells)
    shown = angle, value
    if closes(turn.coordinates):
        shown = np.append(angle, angle[0] + 2 * np.pi), np.append(value, value[0])
    axes.plot(*shown, zorder=3, **style)
    least, most = axes.get_ylim()
    at_value = np.isin(cells.answer, (Answer.UNVERIFIED, Answer.PARTLY))
    radii = np.where(at_value, cells.value, np.where(cells.answer == Answer.NO_EQUILIBRIUM, 0.0, most))
    draw_marks(sheet.page, axes, angle, radii, cells.answer)
    axes.set_rlim(least, most)


def closes(azimuths: FloatArray) -> bool:
    """Whether directions, (n,) in degrees, ascending, go around the full circle without a gap."""
    gap = azimuths[0] + 360.0 - azimuths[-1]
    return len(azimuths) > 2 and bool(0 < gap <= WIDEST_STEP * np.median(np.diff(azimuths)))


def sphere_directions(view: View) -> tuple[FloatArray, FloatArray] | None:
    """Azimuths and elevations of all points in degrees, (n_points,) each; None without a sphere of a grid."""
    for elevation in view.table.of_role("elevation"):
        for azimuth in view.table.of_role("azimuth"):
            if azimuth.dimension == elevation.dimension and not is_sampled(view.table, azimuth.dimension):
                around, up = (numbers_of(column, view.table[column.name]) for column in (azimuth, elevation))
                return np.mod(around, 360.0), up
    return None


def _draw_sphere(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    found, answers = sphere_directions(view), view.answers
    assert found is not None
    azimuth, elevation = found
    what = f"{answers.label} over load directions"
    with open_sheet(path, view, what, options, lambda page: mark_handles(page, answers.answer)) as sheet:
        axes = sheet.frames(1)[0, 0]
        dress(sheet.page, axes, "azimuth [degree], from +x towards +y", "elevation [degree]")
        axes.set(xticks=range(0, 361, 45), yticks=range(-90, 91, 30), xlim=(-5, 365), ylim=(-95, 95))
        size = 4e4 * sheet.page.scale**2 / max(len(azimuth), 100)
        places = azimuth[answers.good], elevation[answers.good]
        style = {"c": answers.values[answers.good], "s": size, "cmap": SCALE, "edgecolors": INK, "linewidths": 0.3}
        if answers.good.any():
            sheet.add_bar(axes.scatter(*places, zorder=3, **style), axes, answers.label)
        draw_marks(sheet.page, axes, azimuth, elevation, answers.answer)
