"""A result over load directions of a sphere: a map of azimuth and elevation, each direction with what lies nearest."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from scipy.spatial import cKDTree

from mbla.arrays import FloatArray, IntArray
from mbla.results.pictures.options import PictureOptions
from mbla.sweeps.answers import Answer, numbers_of
from mbla.sweeps.pictures.map import hatch_handles
from mbla.sweeps.pictures.sheet import MARKS, SCALE, Sheet, dress, open_sheet
from mbla.sweeps.pictures.view import View, is_sampled

STEP = 1.0
"""degrees of azimuth and elevation between the places of the image"""
MOST_DOTS = 1000
"""directions that are marked by dots"""


def directions(view: View) -> tuple[FloatArray, FloatArray] | None:
    """Azimuths and elevations of all points in degrees, (n_points,) each; None without a sphere of a grid."""
    for elevation in view.table.of_role("elevation"):
        for azimuth in view.table.of_role("azimuth"):
            if azimuth.dimension == elevation.dimension and not is_sampled(view.table, azimuth.dimension):
                pair = (numbers_of(column, view.table[column.name]) for column in (azimuth, elevation))
                return next(pair), next(pair)
    return None


def refusal(view: View) -> str:
    """Why there can be no map of the sphere, or nothing."""
    others = len(view.table.dimensions) - 1
    if others:
        sizes = [dimension.size for dimension in view.table.dimensions]
        if int(np.prod(sizes)) > max(sizes) and len(_repeated(view)) < len(view.table):
            return "a map of a sphere has one point for each direction; this sweep has other parameters too"
    return "" if len(view.table) > 2 else "needs three directions"


def _repeated(view: View) -> FloatArray:
    found = directions(view)
    assert found is not None
    return np.asarray(np.unique(np.stack(found, axis=1), axis=0))


def draw(path: Path, view: View, options: PictureOptions) -> None:
    """Write the picture; raises as ``open_page`` does."""
    found = directions(view)
    assert found is not None
    azimuth, elevation = np.mod(found[0], 360.0), found[1]
    what = f"{view.answers.label} over load directions; each place has the value of the nearest direction"

    def handles(page: Any) -> list[Any]:
        return hatch_handles(page, view.answers.answer)

    with open_sheet(path, view, what, options, handles) as sheet:
        axes = sheet.panels(1, 1)[0, 0]
        dress(sheet, axes, "azimuth [degree], from +x towards +y", "elevation [degree]")
        _draw_image(sheet, axes, view, azimuth, elevation)
        axes.set_xticks(range(0, 361, 45))
        axes.set_yticks(range(-90, 91, 30))
        axes.set_xlim(0, 360)
        axes.grid(visible=False)
        if len(azimuth) <= MOST_DOTS:
            axes.plot(azimuth, elevation, linestyle="none", marker=".", color="black", alpha=0.5,
                      markersize=3 * sheet.page.scale, zorder=4)  # fmt: skip


def _draw_image(sheet: Sheet, axes: Any, view: View, azimuth: FloatArray, elevation: FloatArray) -> None:
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
        bar = sheet.figure.colorbar(image, ax=axes, fraction=0.04, pad=0.01, aspect=40)
        bar.ax.tick_params(labelsize=sheet.small)
        bar.set_label(view.answers.label, fontsize=sheet.small, parse_math=False)
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
