"""Error against time on logarithmic scales, the Pareto front marked; one picture for each load case.

Drawn are the runs of the deck's own model that can be held against the reference. Other models are named below the
words only: their difference is no error. Where the reference has but a verdict (unbounded), there is nothing to draw,
and the words say it. Distances that are too small to be told lie on the line of the resolution.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import BLUE, GHOST, INK, VERMILION, WARNING, Page, add_words, open_page
from mbla.sweeps.tradeoff.trade import CaseTrade, Row
from mbla.sweeps.tradeoff.words import reference_words

LEFT, RIGHT, BOTTOM = 0.09, 0.97, 0.1
"""frame of the diagram, shares of the page"""
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
    with open_page(path, options or PictureOptions()) as page:
        words = [title, f"load case {trade.name}: {reference_words(trade)}", advised]
        others = [row.name for row in trade.solved if row.rung.model]
        if others:
            words.append(f"not drawn, as their difference is no error: {', '.join(others)}")
        rows = [row for row in trade.solved if not row.rung.model]
        drawn = [row for row in rows if trade.has_figure and not math.isnan(trade.error(row))]
        mark = "" if trade.verified else "NOT VERIFIED: no run is verified that the others could be held against"
        above = add_words(page, words, mark)
        axes = page.figure.add_axes((LEFT, BOTTOM, RIGHT - LEFT, 1 - above - BOTTOM - 0.02))
        if drawn:
            _draw(page, axes, trade, drawn)
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
    axes.legend(fontsize=0.85 * page.letter, framealpha=0.9, loc="upper right")
    _label(page, axes, rows, points, size)


def _frame(page: Page, axes: Any, trade: CaseTrade, points: Sequence[tuple[float, float]]) -> None:
    times, errors = zip(*points, strict=True)
    axes.set_xscale("log")
    axes.set_yscale("log")
    axes.set_xlim(min(times) / ROOM, max(times) * ROOM)
    axes.set_ylim(trade.resolution / ROOM, max(errors) * ROOM)
    axes.axhline(trade.resolution, color=GHOST, linewidth=page.scale, linestyle="--", zorder=0, label="resolution")
    axes.tick_params(labelsize=0.85 * page.letter, colors=INK)
    axes.grid(visible=True, which="major", color="#DDDDDD", linewidth=0.6)
    axes.spines[["top", "right"]].set_visible(False)
    axes.set_xlabel("time of one load case [s]", fontsize=0.9 * page.letter, color=INK)
    axes.set_ylabel("relative distance from the reference", fontsize=0.9 * page.letter, color=INK)


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
    inside = Box(frame.x0, frame.y0, frame.x1, min(frame.y1, legend.y0))
    to_data = axes.transData.inverted().transform
    for text, place, pixel, box in zip(texts, order, pixels, label_places(pixels, sizes, inside, half), strict=True):
        if box is None:
            text.remove()
            continue
        text.set_position(tuple(to_data((box.left, box.bottom))))
        near = min(max(pixel[0], box.left), box.right), min(max(pixel[1], box.bottom), box.top)
        if abs(near[0] - pixel[0]) + abs(near[1] - pixel[1]) > LEADER * (box.top - box.bottom):
            ends = [points[place], tuple(to_data(near))]
            axes.plot(*zip(*ends, strict=True), color=GHOST, linewidth=0.7 * page.scale, zorder=0)


@dataclass(frozen=True)
class Box:
    """A rectangle, in pixels."""

    left: float
    bottom: float
    right: float
    top: float

    def overlaps(self, other: Box) -> bool:
        """Whether the two have an area in common."""
        beside = self.right <= other.left or other.right <= self.left
        return not (beside or self.top <= other.bottom or other.top <= self.bottom)

    def within(self, other: Box) -> bool:
        """Whether this lies inside of the other."""
        across = other.left <= self.left and self.right <= other.right
        return across and other.bottom <= self.bottom and self.top <= other.top


def label_places(
    points: Sequence[tuple[float, float]], sizes: Sequence[tuple[float, float]], frame: Box, mark: float
) -> list[Box | None]:
    """A box for the label of each point, the nearest that is free; None where there is none within reach.

    points : of the marks, in pixels; earlier ones choose first
    sizes  : width and height of each label
    mark   : half the size of a mark
    """
    taken = [Box(x - mark, y - mark, x + mark, y + mark) for x, y in points]
    places: list[Box | None] = []
    for point, size in zip(points, sizes, strict=True):
        tried = (box for box in _around(point, size, mark))
        free = next((box for box in tried if box.within(frame) and not any(box.overlaps(each) for each in taken)), None)
        places.append(free)
        taken += [] if free is None else [free]
    return places


def _around(point: tuple[float, float], size: tuple[float, float], mark: float) -> list[Box]:
    """Boxes around a point, ring after ring, to the right first."""
    (x, y), (width, height) = point, size
    boxes = []
    for ring in RINGS:
        reach = mark + 0.4 * height * ring
        for step in range(SIDES):
            turn = (step + 1) // 2 * (1 if step % 2 else -1)
            angle = 2.0 * math.pi * turn / SIDES
            ahead, aside = math.cos(angle), math.sin(angle)
            centre_x = x + ahead * (reach + width / 2.0)
            centre_y = y + aside * (reach + height / 2.0)
            boxes.append(
                Box(centre_x - width / 2.0, centre_y - height / 2.0, centre_x + width / 2.0, centre_y + height / 2.0)
            )
    return boxes
