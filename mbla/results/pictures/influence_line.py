"""Load factor of a travelling load over its position, above the structure cut along the path, on one axis.

The section shows the load where it is worst, and nowhere else.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.questions.travel_position import TravelPosition
from mbla.results.listing.answers import standing_words
from mbla.results.listing.text import number
from mbla.results.outcome import figure_of
from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, FILL, FIXED_BLOCK, INK, LIVE_LOAD, REST, VERMILION, WARNING, Page
from mbla.results.pictures.plane import PALE
from mbla.results.pictures.scene import PictureScene
from mbla.results.pictures.section import SectionPlane, cut_blocks, cut_fill, plane_along
from mbla.results.series import Series
from mbla.solution.solution import Status

SPREAD = 10.0
"""greatest over least load factor from which positions of a load are drawn to a logarithmic scale"""
LONGEST = 0.1
"""arrow of the greatest axle over the length of the section"""
LEAST, MOST = 0.2, 0.6
"""share of the height that the section has"""
ROOM = (0.92, 0.86)
"""share of the page that axes have, of its width and of the height under the words"""


def draw_series(path: Path, scene: PictureScene, series: Series, options: PictureOptions) -> None:
    """Write the load factor of a travelling load over its position; raises as ``open_diagrams`` does.

    Positions without a result are crosses at the foot, those that no load brings down arrows at the top. Beneath is the
    section along the path, where that is straight and crosses the structure.
    """
    positions = [case.load_case.question.place for case in series.cases]
    words = [scene.words_of("model")[0], f"load case {series.name}: load factor over {len(positions)} positions"]
    worst = None if series.worst is None else series.worst.load_case.question.place
    if series.worst is not None and worst is not None:
        least = number(figure_of(series.worst))
        words.append(f"worst at position {worst.number}, {standing_words(scene.model, worst)}: {least}")
    missing = int(np.isnan([figure_of(case) for case in series.cases]).sum())
    mark = f"NOT VERIFIED: {missing} of {len(positions)} positions without a result" if missing else ""
    with open_diagrams(path, options, words, mark) as sheet:
        page, plane = sheet.page, plane_along(positions)
        blocks = [] if plane is None else cut_blocks(scene.model.blocks, plane)
        what = "position" if len(positions[0].points) == 1 else "first axle"
        name = f"{what} along the path [{scene.model.units.length}]"
        if plane is None or not blocks:
            axes = sheet.frames(1)[0, 0]
            dress(page, axes, name, "load factor")
            _draw_positions(page, axes, series)
            return
        low, high = _limits([outline for _, outline in blocks], positions, worst)
        shape = ROOM[0] * options.size[0] / (ROOM[1] * options.size[1] * (sheet.top - sheet.bottom))
        share = float(np.clip(shape * (high[1] - low[1]) / (high[0] - low[0]), LEAST, MOST))
        aside = max(0.0, shape * (high[1] - low[1]) / share - (high[0] - low[0])) / 2
        axes, below = sheet.frames(2, columns=1, sharex=True, height_ratios=[1 - share, share])[:, 0]
        dress(page, axes, "", "load factor")
        _draw_positions(page, axes, series)
        dress(page, below, name, f"z [{scene.model.units.length}]", _title(worst, what))
        _draw_section(page, below, scene, plane, blocks)
        if worst is not None:
            _draw_worst(page, (axes, below), worst, plane, LONGEST * float(high[0] - low[0]))
        below.set(xlim=(low[0] - aside, high[0] + aside), ylim=(low[1], high[1]))
        below.set_aspect("equal", adjustable="datalim")


def _title(worst: TravelPosition | None, what: str) -> str:
    return "section along the path" + ("" if worst is None else f", with the {what} where it is worst")


def _limits(
    outlines: list[FloatArray], positions: list[TravelPosition], worst: TravelPosition | None
) -> tuple[FloatArray, FloatArray]:
    """Least and greatest (s, z) of what is to be seen, with a margin: outlines, positions, and arrows of the worst."""
    points = [*outlines, np.array([[each.distance, each.point[2]] for each in positions])]
    length = float(np.ptp(np.concatenate(points)[:, 0]))
    if worst is not None:
        acts = worst.acting
        points.append(np.column_stack([worst.distances[acts], worst.points[acts, 2] + LONGEST * length]))
    all_points = np.concatenate(points)
    margin = 0.03 * length
    return all_points.min(axis=0) - margin, all_points.max(axis=0) + margin


def _draw_section(
    page: Page, axes: Any, scene: PictureScene, plane: SectionPlane, blocks: list[tuple[int, FloatArray]]
) -> None:
    """Blocks, and fill behind them, on axes of (s, z)."""
    polygons, fixed = page.parts.collections.PolyCollection, scene.model.fixed
    fill = scene.model.fill
    for body in () if fill is None else fill.bodies.values():
        axes.add_collection(polygons(cut_fill(body, plane), facecolors=FILL, edgecolors="none", alpha=PALE, zorder=1))
    colours = [FIXED_BLOCK if fixed[block] else REST for block, _ in blocks]
    outlines = [outline for _, outline in blocks]
    axes.add_collection(polygons(outlines, facecolors=colours, edgecolors=INK, linewidths=0.6 * page.scale, zorder=2))


def _draw_worst(
    page: Page, frames: tuple[Any, Any], worst: TravelPosition, plane: SectionPlane, longest: float
) -> None:
    """A line through both diagrams where the first axle stands, and an arrow for each axle that acts."""
    for axes in frames:
        axes.axvline(worst.distance, color=VERMILION, linewidth=page.scale, linestyle="--", zorder=1)
    forces = np.column_stack([worst.forces @ plane.along, worst.forces[:, 2]])
    greatest = float(np.linalg.norm(forces, axis=1).max()) or 1.0
    for axle in np.flatnonzero(worst.acting):
        tip = np.array([worst.distances[axle], worst.points[axle, 2]])
        look = {"arrowstyle": "-|>", "color": LIVE_LOAD, "linewidth": 2.0 * page.scale, "shrinkA": 0, "shrinkB": 0}
        look["mutation_scale"] = 16 * page.scale
        frames[1].annotate("", xy=tip, xytext=tip - longest * forces[axle] / greatest, arrowprops=look, zorder=5)


def _draw_positions(page: Page, axes: Any, series: Series) -> None:
    """Load factor over the distance of the first axle along the path, and the worst."""
    place = np.array([case.load_case.question.place.distance for case in series.cases])
    values = np.array([figure_of(case) for case in series.cases])
    sure = np.array([case.status is Status.SOLVED for case in series.cases])
    known = np.isfinite(values)
    size = 7 * page.scale
    axes.plot(place, np.where(known, values, np.nan), color=BLUE, linewidth=1.8 * page.scale)
    for chosen, face, name in ((known & sure, BLUE, "load factor"), (known & ~sure, "white", "approximate")):
        if chosen.any():
            look = {"markerfacecolor": face, "markeredgecolor": BLUE, "linestyle": "none", "markersize": size}
            axes.plot(place[chosen], values[chosen], marker="o", label=name, **look)
    _scale_values(page, axes, values[known])
    for chosen, level, marker, name in (
        (np.isnan(values), 0.03, "x", "no result"),
        (np.isinf(values), 0.97, "^", "any multiple is carried"),
    ):
        if chosen.any():
            ends = axes.get_xaxis_transform()
            heights = np.full(int(chosen.sum()), level)
            axes.plot(place[chosen], heights, marker, color=WARNING, transform=ends, markersize=1.3 * size, label=name)
    if series.worst is not None:
        look = {"color": VERMILION, "markersize": 11 * page.scale, "label": "worst", "zorder": 5}
        axes.plot(series.worst.load_case.question.place.distance, figure_of(series.worst), "D", **look)
    axes.legend(fontsize=page.small, frameon=False)


def _scale_values(page: Page, axes: Any, values: FloatArray) -> None:
    """From nothing, or logarithmic where the ends of the path, with hardly any load on it, would hide the rest."""
    low, high = float(values.min(initial=np.inf)), float(values.max(initial=-np.inf))
    if 0.0 < SPREAD * low < high:
        axes.set_yscale("log")
        axes.tick_params(which="minor", labelsize=page.small, colors=INK)
        for axis in (axes.yaxis.set_major_formatter, axes.yaxis.set_minor_formatter):
            axis(page.parts.ticker.LogFormatter(labelOnlyBase=False, minor_thresholds=(2, 0.5)))
    elif len(values):
        axes.set_ylim(bottom=min(0.0, 1.1 * low))
