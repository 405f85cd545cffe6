"""Load factor of a travelling load over its position, above the structure cut along the path, on one axis.

The section shows the load where it is worst, and nowhere else, and along what soil of cells slips there.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.questions.travel_position import TravelPosition
from mbla.results.listing.answers import standing_words
from mbla.results.listing.text import number
from mbla.results.outcome import figure_of
from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.marks.joints import slip_lines
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import (
    BLUE,
    FILL,
    FIXED_BLOCK,
    INK,
    LIVE_LOAD,
    REST,
    SLIDE,
    SOIL,
    VERMILION,
    WARNING,
    Page,
)
from mbla.results.pictures.plane import PALE, SEAM, THICK
from mbla.results.pictures.scene import PictureScene
from mbla.results.pictures.section import SectionPlane, cut_blocks, cut_fill, lines_along, plane_along, rings_around
from mbla.results.series import Series
from mbla.solution.solution import Status

SPREAD, SHOWN = 10.0, 5.0
"""greatest over least load factor that an axis shows in full, and at which it ends where there are greater ones, as of
positions with hardly any load on the structure, which would flatten the rest"""
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
        if series.worst is not None:
            _draw_slip_lines(page, below, replace(scene, case=series.worst), plane)
        if worst is not None:
            _draw_worst(page, (axes, below), worst, plane, LONGEST * float(high[0] - low[0]))
            _draw_contacts(page, below, series, plane)
        _add_legend(page, below, scene)
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
    edges = {"edgecolors": INK, "linewidths": 0.6 * page.scale, "zorder": 2}
    soil = scene.model.soil_of_block
    for row in range(len(scene.model.soils)):
        cells = [outline for block, outline in blocks if soil[block] == row]
        if not cells:
            continue
        seam = {"edgecolors": "face", "linewidths": SEAM * page.scale, "zorder": 1.5}  # no paper between cells
        axes.add_collection(polygons(cells, facecolors=SOIL, **seam))
        axes.add_collection(page.parts.collections.LineCollection(rings_around(cells, scene.size), **edges))
    stones = [(block, outline) for block, outline in blocks if soil[block] < 0]
    colours = [FIXED_BLOCK if fixed[block] else REST for block, _ in stones]
    axes.add_collection(polygons([outline for _, outline in stones], facecolors=colours, **edges))


def _draw_slip_lines(page: Page, axes: Any, scene: PictureScene, plane: SectionPlane) -> None:
    """Joints of cells that slip in the mechanism of a case, the thicker the faster."""
    if not scene.model.soils or scene.joint_motion is None:
        return
    mark = slip_lines(scene, scene.joint_motion)
    widths = THICK * page.scale * mark.widths
    for width in np.unique(widths):
        lines = lines_along(mark.points[mark.pairs[widths == width]], plane)
        axes.add_collection(page.parts.collections.LineCollection(lines, colors=SLIDE, linewidths=width, zorder=3))


def _draw_contacts(page: Page, axes: Any, series: Series, plane: SectionPlane) -> None:
    """What the axles stand on where they are worst."""
    assert series.worst is not None  # who calls knows
    for load in series.worst.load_case.live:
        ends = load.patches.corners[:, [[0, 1], [3, 2]]].reshape(-1, 2, 3)
        lines = page.parts.collections.LineCollection(
            lines_along(ends, plane), colors=LIVE_LOAD, linewidths=THICK * page.scale, zorder=4
        )
        axes.add_collection(lines)


def _add_legend(page: Page, axes: Any, scene: PictureScene) -> None:
    """What the section shows besides blocks, where that is soil of cells."""
    if scene.model.soils:
        box = page.box("soil", facecolor=SOIL, edgecolor=INK, linewidth=0.6 * page.scale)
        line = page.line("slip line where it is worst", color=SLIDE, linewidth=THICK * page.scale)
        axes.legend(handles=[box, line], fontsize=page.small, frameon=False, loc="upper right")


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
    top = _scale_values(axes, values[known])
    above, most = known & (values > top), float(values[known].max(initial=0.0))
    for chosen, level, marker, name, face in (
        (np.isnan(values), 0.03, "x", "no result", WARNING),
        (np.isinf(values), 0.97, "^", "any multiple is carried", WARNING),
        (above, 0.97, "^", f"above the axis, up to {number(most)}", "white"),
    ):
        if chosen.any():
            heights = np.full(int(chosen.sum()), level)
            colour = BLUE if face == "white" else face
            look = {"transform": axes.get_xaxis_transform(), "markersize": 1.3 * size, "markerfacecolor": face}
            axes.plot(place[chosen], heights, marker, color=colour, linestyle="none", label=name, **look)
    if series.worst is not None:
        look = {"color": VERMILION, "markersize": 11 * page.scale, "label": "worst", "zorder": 5}
        axes.plot(series.worst.load_case.question.place.distance, figure_of(series.worst), "D", **look)
    axes.legend(fontsize=page.small, frameon=False)


def _scale_values(axes: Any, values: FloatArray) -> float:
    """From nothing to the greatest of values (n,), or a multiple of the least that is beyond; the end of the axis."""
    low, high = float(values.min(initial=np.inf)), float(values.max(initial=-np.inf))
    if not len(values):
        axes.set_yticks([])
        return np.inf
    axes.set_ylim(bottom=min(0.0, 1.1 * low))
    if not 0.0 < SPREAD * low < high:
        return np.inf
    axes.set_ylim(top=SHOWN * low)
    return SHOWN * low
