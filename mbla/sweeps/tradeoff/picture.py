"""Error against time on logarithmic scales, the Pareto front marked; one picture for each load case.

Drawn are the runs of the deck's own model that can be held against the reference. Other models are named below the
words only: their difference is no error. Where the reference has but a verdict (unbounded), there is nothing to draw,
and the words say it. Distances that are too small to be told lie on the line of the resolution.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import shapely

from mbla.results.pictures.diagrams import dress, open_diagrams
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, INK, VERMILION, WARNING, Page
from mbla.sweeps.tradeoff.trade import CaseTrade, Row
from mbla.sweeps.tradeoff.words import reference_words

ROOM = 3.0
"""factor of time and error left free around the points, for the labels"""
LEADER = 1.2
"""distance of a label from its point, in heights of a line, from which on a line joins them"""
RINGS = (1.0, 1.8, 3.0, 4.5, 6.5, 9.0, 12.0, 16.0)
"""distances of a label that are tried one after the other, in heights of a line"""
SIDES = 16
"""directions at each of them"""


def draw_trade(path: Path, title: str, trade: CaseTrade, advised: str, options: PictureOptions | None = None) -> None:
    """Write the picture of one load case, PNG, SVG or PDF.

    Raises UsageError where the extra for pictures is not installed, FileError where the file cannot be written.
    """
    words = [title, f"load case {trade.name}: {reference_words(trade)}", advised]
    others = [row.name for row in trade.solved if row.rung.model]
    if others:
        words.append(f"not drawn, as their difference is no error: {', '.join(others)}")
    rows = [row for row in trade.solved if not row.rung.model]
    drawn = [row for row in rows if trade.has_figure and not math.isnan(trade.error(row))]
    mark = "" if trade.verified else "NOT VERIFIED: no run is verified that the others could be held against"
    with open_diagrams(path, options or PictureOptions(), words, mark) as sheet:
        axes = sheet.frames(1)[0, 0]
        if drawn:
            _draw(sheet.page, axes, trade, drawn)
        else:
            axes.set_axis_off()


def _draw(page: Page, axes: Any, trade: CaseTrade, rows: Sequence[Row]) -> None:
    points = [(row.seconds, trade.error(row)) for row in rows]
    _frame(page, axes, trade, points)
    front = sorted(point for row, point in zip(rows, points, strict=True) if row.front)
    if front:
        axes.plot(*zip(*front, strict=True), drawstyle="steps-post", color=VERMILION, linewidth=1.8 * page.scale,
                  zorder=1)  # fmt: skip
    size = 9 * page.scale
    kinds = (
        ([row.front for row in rows], "o", VERMILION, VERMILION, "Pareto front"),
        ([row.sound and not row.front for row in rows], "o", "white", BLUE, "verified"),
        ([not row.sound for row in rows], "x", WARNING, WARNING, "not verified"),
    )
    for chosen, marker, face, edge, name in kinds:
        own = [point for point, shown in zip(points, chosen, strict=True) if shown]
        if own:
            look = {"markerfacecolor": face, "markeredgecolor": edge, "linestyle": "none", "markersize": size}
            axes.plot(*zip(*own, strict=True), marker=marker, label=name, markeredgewidth=1.6 * page.scale, **look)
    axes.legend(fontsize=page.small, framealpha=0.9, loc="upper right")
    page.figure.draw_without_rendering()  # which gives the diagram its place
    page.figure.set_layout_engine("none")
    _label(page, axes, rows, points, size)


def _frame(page: Page, axes: Any, trade: CaseTrade, points: Sequence[tuple[float, float]]) -> None:
    times, errors = zip(*points, strict=True)
    dress(page, axes, "time of one load case [s]", "relative distance from the reference")
    axes.set(xscale="log", xlim=(min(times) / ROOM, max(times) * ROOM))
    axes.set(yscale="log", ylim=(trade.resolution / ROOM, max(errors) * ROOM))
    axes.axhline(trade.resolution, color=GHOST, linewidth=page.scale, linestyle="--", zorder=0, label="resolution")


def _label(page: Page, axes: Any, rows: Sequence[Row], points: Sequence[tuple[float, float]], size: float) -> None:
    """Names beside the points, those on the front first; a thin line where a name had to go further away."""
    order = sorted(range(len(rows)), key=lambda place: (not rows[place].front, not rows[place].sound, points[place]))
    pixels = [tuple(axes.transData.transform(points[place])) for place in order]
    texts = [
        axes.text(0, 0, rows[place].name, fontsize=0.75 * page.letter, color=INK, parse_math=False, va="bottom",
                  weight="bold" if rows[place].front else "normal")
        for place in order
    ]  # fmt: skip
    sizes = [(extent.width, extent.height) for extent in map(page.extent_of, texts)]
    frame = page.extent_of(axes.patch)
    legend = page.extent_of(axes.get_legend())
    half = 0.7 * size * page.figure.dpi / 72.0
    inside = shapely.box(frame.x0, frame.y0, frame.x1, min(frame.y1, legend.y0))
    to_data = axes.transData.inverted().transform
    for text, place, pixel, box in zip(texts, order, pixels, label_places(pixels, sizes, inside, half), strict=True):
        if box is None:
            text.remove()
            continue
        left, bottom, right, top = box.bounds
        text.set_position(tuple(to_data((left, bottom))))
        near = min(max(pixel[0], left), right), min(max(pixel[1], bottom), top)
        if abs(near[0] - pixel[0]) + abs(near[1] - pixel[1]) > LEADER * (top - bottom):
            ends = [points[place], tuple(to_data(near))]
            axes.plot(*zip(*ends, strict=True), color=GHOST, linewidth=0.7 * page.scale, zorder=0)


def label_places(
    points: Sequence[tuple[float, float]], sizes: Sequence[tuple[float, float]], frame: shapely.Polygon, mark: float
) -> list[shapely.Polygon | None]:
    """A box for the label of each point, the nearest that is free; None where there is none within reach.

    points : of the marks, in pixels; earlier ones choose first
    sizes  : width and height of each label
    mark   : half the size of a mark
    """
    taken = [shapely.box(x - mark, y - mark, x + mark, y + mark) for x, y in points]
    places: list[shapely.Polygon | None] = []
    for point, size in zip(points, sizes, strict=True):
        tried = _around(point, size, mark)
        tried = tried[shapely.covered_by(tried, frame)]
        free = tried[~(shapely.area(shapely.intersection(tried[:, None], taken)) > 0).any(axis=1)]
        places.append(free[0] if len(free) else None)
        taken += list(free[:1])
    return places


def _around(point: tuple[float, float], size: tuple[float, float], mark: float) -> Any:
    """Boxes around a point, ring after ring, to the right first, (n,)."""
    (x, y), (width, height) = point, np.array(size) / 2
    reach = mark + 0.8 * height * np.repeat(RINGS, SIDES)
    step = np.tile(np.arange(SIDES), len(RINGS))
    angle = 2 * np.pi / SIDES * ((step + 1) // 2 * np.where(step % 2, 1, -1))
    across, up = x + np.cos(angle) * (reach + width), y + np.sin(angle) * (reach + height)
    return shapely.box(across - width, up - height, across + width, up + height)
