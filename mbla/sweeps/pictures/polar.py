"""Polar diagram: a result over load directions around the horizon.

Over a sphere a map of azimuth and elevation, each direction with what lies nearest.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from mbla.arrays import FloatArray, IntArray
from mbla.results.pictures.diagrams import SCALE, Diagrams, dress, hollow
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import INK
from mbla.sweeps.answers import Answer, numbers_of
from mbla.sweeps.pictures.map import hatch_handles
from mbla.sweeps.pictures.sheet import MARKS, add_scale, drawn_values, line_handles, line_style, open_sheet
from mbla.sweeps.pictures.view import Axis, Cells, View, axis_of, gridded, is_sampled, over_sphere
from mbla.sweeps.tables.sweep_table import SweepColumn

MOST_MARKED = 48
"""points of a curve with markers of their own"""
WIDEST_STEP = 1.5
"""gap over the full circle, in usual steps of the azimuth, across which a curve is still closed"""
LEAST_ROOM = 1e-9
"""relative room between the least radius and the greatest: of equal values the diagram is a circle, not a point"""


def refusal(view: View) -> str:
    """Why there can be no polar diagram, or nothing."""
    if view.text_refused:
        return view.text_refused
    if sphere_directions(view) is not None:
        return _sphere_refusal(view)
    column = _azimuth(view)
    if column is None:
        return "no parameter is a direction around the horizon of a grid, or over a sphere"
    return "" if len(axis_of(view.table, column).levels) > 2 else "needs three directions"


def usual(view: View) -> bool:
    """Whether it is drawn without being asked for."""
    return not refusal(view)


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
            _dress(sheet, axes, grid.title(panel), _radii(grid.cells))
            for line in range(lines):
                _draw_curve(sheet, axes, grid.x, grid.cells[panel, line], line_style(sheet.page, line, lines))
        add_scale(sheet, frames, grid.lines)


def _azimuth(view: View) -> SweepColumn | None:
    """Directions around the horizon of a grid, that of ``by`` first; None where there are some over a sphere."""
    if sphere_directions(view) is not None:
        return None
    found = [
        column
        for column in view.table.of_role("azimuth")
        if not over_sphere(view.table, column.dimension) and not is_sampled(view.table, column.dimension)
    ]
    chosen = [column for column in found if column.name == view.by]
    return next(iter((*chosen, *found)), None)


def _radii(cells: Cells) -> tuple[float, float]:
    """Value at the middle, zero unless there are values below it, and at the rim."""
    known = cells.value[np.isfinite(cells.value)]
    least, most = min(0.0, known.min(initial=0.0)), max(0.0, known.max(initial=0.0))
    if most - least <= LEAST_ROOM:
        return least, least + 1.0
    return least * 1.05, most * 1.08


def _dress(sheet: Diagrams, axes: Any, title: str, radii: tuple[float, float]) -> None:
    dress(sheet.page, axes)
    axes.set_rlim(*radii)
    rings = sheet.page.parts.ticker.MaxNLocator(5).tick_values(*radii)
    axes.set_rgrids([ring for ring in rings if radii[0] < ring < radii[1]])
    axes.set_rlabel_position(22.5)
    axes.set_thetagrids(range(0, 360, 45), ["0° (+x)", "45°", "90° (+y)", "135°", "180°", "225°", "270°", "315°"])
    axes.set_title(title, fontsize=sheet.small, color=INK, parse_math=False, pad=1.2 * sheet.small)
    if radii[0] < 0:  # zero is a circle then, not the middle
        axes.plot(np.linspace(0, 2 * np.pi, 181), np.zeros(181), color=INK, linewidth=sheet.page.scale, zorder=2)


def _draw_curve(sheet: Diagrams, axes: Any, turn: Axis, cells: Cells, style: dict[str, Any]) -> None:
    """A curve, closed where the directions go around; broken where there is no value; markers of other answers."""
    angle, value = np.radians(turn.coordinates), drawn_values(cells)
    shown = angle, value
    if closes(turn.coordinates):
        shown = np.append(angle, angle[0] + 2 * np.pi), np.append(value, value[0])
    if len(angle) > MOST_MARKED:
        style = style | {"marker": "."}
    axes.plot(*shown, zorder=3, **style)
    least, most = axes.get_ylim()
    for kind, mark in MARKS.items():
        own = cells.answer == kind
        radius = {Answer.UNVERIFIED: cells.value[own], Answer.PARTLY: cells.value[own], Answer.NO_EQUILIBRIUM: 0.0}
        if own.any():
            look = hollow(sheet.page, mark.marker, mark.colour)
            radii = np.broadcast_to(radius.get(kind, most), own.sum())
            axes.plot(angle[own], radii, clip_on=False, zorder=4, **look)
    axes.set_rlim(least, most)


def closes(azimuths: FloatArray) -> bool:
    """Whether directions, (n,) in degrees, ascending, go around the full circle without a gap."""
    if len(azimuths) < 3:
        return False
    steps = np.diff(azimuths)
    gap = azimuths[0] + 360.0 - azimuths[-1]
    return bool(0 < gap <= WIDEST_STEP * np.median(steps))


STEP = 1.0
"""degrees of azimuth and elevation between the places of the image"""
MOST_DOTS = 1000
"""directions that are marked by dots"""


def sphere_directions(view: View) -> tuple[FloatArray, FloatArray] | None:
    """Azimuths and elevations of all points in degrees, (n_points,) each; None without a sphere of a grid."""
    for elevation in view.table.of_role("elevation"):
        for azimuth in view.table.of_role("azimuth"):
            if azimuth.dimension == elevation.dimension and not is_sampled(view.table, azimuth.dimension):
                pair = (numbers_of(column, view.table[column.name]) for column in (azimuth, elevation))
                return next(pair), next(pair)
    return None


def _sphere_refusal(view: View) -> str:
    """Why there can be no map of the sphere, or nothing."""
    others = len(view.table.dimensions) - 1
    if others:
        sizes = [dimension.size for dimension in view.table.dimensions]
        if int(np.prod(sizes)) > max(sizes) and len(_repeated(view)) < len(view.table):
            return "a map of a sphere has one point for each direction; this sweep has other parameters too"
    return "" if len(view.table) > 2 else "needs three directions"


def _repeated(view: View) -> FloatArray:
    found = sphere_directions(view)
    assert found is not None
    return np.asarray(np.unique(np.stack(found, axis=1), axis=0))


def _draw_sphere(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    found = sphere_directions(view)
    assert found is not None
    azimuth, elevation = np.mod(found[0], 360.0), found[1]
    what = f"{view.answers.label} over load directions; each place has the value of the nearest direction"

    with open_sheet(path, view, what, options, lambda page: hatch_handles(page, view.answers.answer)) as sheet:
        axes = sheet.frames(1)[0, 0]
        dress(sheet.page, axes, "azimuth [degree], from +x towards +y", "elevation [degree]")
        _draw_image(sheet, axes, view, azimuth, elevation)
        axes.set(xticks=range(0, 361, 45), yticks=range(-90, 91, 30), xlim=(0, 360))
        axes.grid(visible=False)
        if len(azimuth) <= MOST_DOTS:
            axes.plot(azimuth, elevation, linestyle="none", marker=".", color="black", alpha=0.5,
                      markersize=3 * sheet.page.scale, zorder=4)  # fmt: skip


def _draw_image(sheet: Diagrams, axes: Any, view: View, azimuth: FloatArray, elevation: FloatArray) -> None:
    rims = np.arange(0, 360 + STEP, STEP), _rims(elevation)
    middles = [(rim[1:] + rim[:-1]) / 2 for rim in rims]
    nearest = nearest_direction(azimuth, elevation, middles[0], middles[1])
    answer, values = view.answers.answer[nearest], view.answers.values[nearest]
    good = answer == Answer.VALUE
    axes.set_ylim(rims[1][0], rims[1][-1])
    if good.any():
        own = view.answers.values[view.answers.good]
        image = axes.pcolormesh(*rims, np.ma.masked_array(values, ~good), cmap=SCALE, vmin=own.min(), vmax=own.max(),
                                rasterized=True)  # fmt: skip
        sheet.add_bar(image, axes, view.answers.label)
    for kind, mark in MARKS.items():
        if (answer == kind).any():
            area = axes.contourf(*middles, (answer == kind).astype(float), levels=[0.5, 1.5], colors="none",
                                 hatches=[mark.hatch])  # fmt: skip
            area.set_edgecolor(mark.colour)
            area.set_linewidth(0.0)


def _rims(elevation: FloatArray) -> FloatArray:
    """Edges of the image over the elevations that the directions cover, to the poles where they come near."""
    room = 180.0 / np.sqrt(len(elevation))  # about the distance of neighbours
    low = max(-90.0, np.floor(elevation.min() - room / 2))
    high = min(90.0, np.ceil(elevation.max() + room / 2))
    return np.linspace(low, high, max(2, round((high - low) / STEP) + 1))


def nearest_direction(azimuth: FloatArray, elevation: FloatArray, around: FloatArray, up: FloatArray) -> IntArray:
    """Number of the direction with the smallest angle to each place of a map, (n_up, n_around); angles in degrees."""
    tree = cKDTree(_unit_vectors(azimuth, elevation))
    places = np.meshgrid(around, up)
    _, found = tree.query(_unit_vectors(places[0].ravel(), places[1].ravel()))
    return np.asarray(found, dtype=np.int64).reshape(len(up), len(around))


def _unit_vectors(azimuth: FloatArray, elevation: FloatArray) -> FloatArray:
    turn, rise = np.radians(azimuth), np.radians(elevation)
    return np.stack([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)], axis=1)
