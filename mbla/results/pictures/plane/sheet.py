"""The sheet of a plane figure: lines, areas and arrows in the structure's own lengths, equal along both axes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.page import Page
from mbla.results.pictures.palette import INK

HEAD = 0.3
"""length of an arrow's head over that of the arrow"""
MARGIN = 0.03
"""free space around what is drawn, share of the sheet"""
STRIP = 0.085
"""height of the strip below it that holds the scale bar, share of the page"""


@dataclass
class Sheet:
    """Where a plane figure is drawn.

    size    : diagonal of the structure on the page, m
    drawn   : points that must be seen, (n, 2) m each
    handles : entries of the legend by their names
    """

    page: Page
    axes: Any
    size: float
    drawn: list[FloatArray] = field(default_factory=list)
    handles: dict[str, Any] = field(default_factory=dict)

    def width(self, points: float) -> float:
        """Width of a line on this page, from that on a page of the usual width, both in points."""
        return points * self.page.scale

    def areas(self, polygons: Sequence[FloatArray], **style: Any) -> None:
        """Filled polygons, (n, 2) each."""
        if len(polygons):
            self.axes.add_collection(self.page.parts.PolyCollection(polygons, **style))
            self.drawn.append(np.vstack(polygons))

    def lines(
        self, paths: Sequence[FloatArray] | FloatArray, width: float | FloatArray, colour: Any, **style: Any
    ) -> None:
        """Polylines, (n, 2) each; ``width`` in points, one or one for each line."""
        if len(paths):
            widths = np.asarray(width) * self.page.scale
            collection = self.page.parts.LineCollection(
                paths, linewidths=widths, colors=colour, capstyle=style.pop("capstyle", "round"), **style
            )
            self.axes.add_collection(collection)
            self.drawn.append(np.vstack(list(paths)))

    def dots(self, points: FloatArray, size: float | FloatArray, **style: Any) -> None:
        """Markers of a diameter in points, one or one for each."""
        if len(points):
            edge = self.width(style.pop("linewidths", 1.2))
            self.axes.scatter(*points.T, s=(np.asarray(size) * self.page.scale) ** 2, linewidths=edge, **style)
            self.drawn.append(points)

    def write(self, place: FloatArray, text: str) -> None:
        """A few letters in a white disc."""
        style = {"ha": "center", "va": "center", "color": INK, "fontsize": 0.75 * self.page.letter, "zorder": 5.5}
        box = {"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": INK, "linewidth": self.width(0.6)}
        self.axes.text(*place, text, bbox=box, parse_math=False, **style)

    def arrows(
        self, tips: FloatArray, steps: FloatArray, width: float, colour: str, order: float, thin: bool = False
    ) -> None:
        """Arrows that end at the tips, (n, 2), having come by the steps, (n, 2); heads at most twelve widths long."""
        if not len(tips):
            return
        lengths = np.linalg.norm(steps, axis=1)
        tips, steps, lengths = tips[lengths > 0], steps[lengths > 0], lengths[lengths > 0, None]
        along = steps / lengths
        across = np.column_stack([-along[:, 1], along[:, 0]])
        head = np.minimum(HEAD * lengths, (0.012 if thin else 0.025) * self.size)
        neck = tips - head * along
        self.lines(np.stack([tips - steps, neck], axis=1), width, colour, zorder=order, capstyle="butt")
        heads = np.stack([tips, neck + 0.4 * head * across, neck - 0.4 * head * across], axis=1)
        self.areas(list(heads), facecolors=colour, edgecolors="none", zorder=order)

    def name(self, label: str, **style: Any) -> None:
        """An entry of the legend: a line or marker."""
        if "markersize" in style:
            style["markersize"] = self.width(style["markersize"])
        if "linewidth" in style:
            style["linewidth"] = self.width(style["linewidth"])
        self.handles.setdefault(label, self.page.parts.Line2D([], [], label=label, **style))

    def name_area(self, label: str, **style: Any) -> None:
        """An entry of the legend: a filled box."""
        self.handles.setdefault(label, self.page.parts.Patch(label=label, **style))


def new_sheet(page: Page, size: float) -> Sheet:
    """An empty sheet; ``lay_out`` gives it its place once everything is drawn."""
    axes = page.figure.add_axes((0, 0, 1, 1))
    axes.set_axis_off()
    return Sheet(page, axes, size)


def lay_out(sheet: Sheet, above: float, below: float) -> float:
    """Place the sheet between words and legend, all that is drawn in its middle; metres per inch of the page.

    above, below : shares of the page that words and legend take
    """
    bottom = below + STRIP
    height = max(1.0 - above - bottom, 0.1)
    sheet.axes.set_position((0.0, bottom, 1.0, height))
    points = np.vstack(sheet.drawn)
    low, high = points.min(axis=0), points.max(axis=0)
    inches = np.array([sheet.page.figure.get_figwidth(), height * sheet.page.figure.get_figheight()])
    metres = float(np.max((high - low) / ((1 - 2 * MARGIN) * inches)))
    middle, half = (low + high) / 2, metres * inches / 2
    sheet.axes.set_xlim(middle[0] - half[0], middle[0] + half[0])
    sheet.axes.set_ylim(middle[1] - half[1], middle[1] + half[1])
    return metres


def add_scale_bar(sheet: Sheet, metres_per_inch: float, below: float, unit: str, names: tuple[str, str] | None) -> None:
    """A bar of a round length in the strip at the left; beside it the axes, if named."""
    page = sheet.page
    wide, high = page.figure.get_figwidth(), page.figure.get_figheight()
    length = round_length(0.14 * wide * metres_per_inch)
    share = length / metres_per_inch / wide
    left, level = 0.03, below + 0.42 * STRIP
    line, style = page.parts.Line2D, {"color": INK, "linewidth": sheet.width(2.0)}
    page.figure.add_artist(line([left, left + share], [level, level], **style))
    for x in (left, left + share):
        page.figure.add_artist(line([x, x], [level - 0.008, level + 0.008], **style))
    words = {"color": INK, "fontsize": 0.85 * page.letter, "parse_math": False}
    page.figure.text(left + share / 2, level + 0.012, f"{length:g} {unit}", ha="center", va="bottom", **words)
    if names is None:
        return
    start, arm = left + share + 0.05, 0.055 * wide
    for name, (x, y) in zip(names, ((1.0, 0.0), (0.0, 0.8)), strict=True):
        tip = (start + arm * x / wide, level - 0.008 + arm * y / high * 0.8)
        arrow = {"arrowstyle": "-|>", "color": INK, "linewidth": sheet.width(1.5), "shrinkA": 0, "shrinkB": 0}
        page.figure.text(tip[0] + 0.006, tip[1], name, ha="left", va="center", **words)
        sheet.axes.annotate(
            "", tip, (start, level - 0.008), xycoords="figure fraction", arrowprops=arrow, annotation_clip=False
        )


def round_length(length: float) -> float:
    """The largest of 1, 2 or 5 times a power of ten that is no longer."""
    power = 10.0 ** np.floor(np.log10(length))
    return float(max(step for step in (1.0, 2.0, 5.0) if step * power <= length * (1 + 1e-9)) * power)
