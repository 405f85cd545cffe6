"""A plane picture: its axes and legend, and the structure in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.collapse.motion import moved_points
from mbla.results.pictures.geometry import block_edges
from mbla.results.pictures.page import FIXED_BLOCK, GHOST, GROUND, GROUPS, INK, REST, Page, group_colours
from mbla.results.pictures.plane.flat import Flat, face_polygons, seen_edges
from mbla.results.pictures.scene import Scene, named_groups, part_colours, tint_of_part

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
            self.axes.add_collection(self.page.parts.collections.PolyCollection(polygons, **style))
            self.drawn.append(np.vstack(polygons))

    def lines(
        self, paths: Sequence[FloatArray] | FloatArray, width: float | FloatArray, colour: Any, **style: Any
    ) -> None:
        """Polylines, (n, 2) each; ``width`` in points, one or one for each line."""
        if len(paths):
            widths = np.asarray(width) * self.page.scale
            collection = self.page.parts.collections.LineCollection(
                paths, linewidths=widths, colors=colour, capstyle=style.pop("capstyle", "round"), **style
            )
            self.axes.add_collection(collection)
            self.drawn.append(np.vstack(list(paths)))

    def dots(self, points: FloatArray, size: float | FloatArray, **style: Any) -> None:
        """Markers at places, (n, 2) m, of a diameter in points, one or one for each, (n,)."""
        if len(points):
            edge = self.width(style.pop("linewidths", 1.2))
            self.axes.scatter(*points.T, s=(np.asarray(size) * self.page.scale) ** 2, linewidths=edge, **style)
            self.drawn.append(points)

    def write(self, place: FloatArray, text: str) -> None:
        """A few letters in a white disc at a place, (2,) m."""
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
        """An entry of the legend: a line or marker; none without a name."""
        if not label:
            return
        if "markersize" in style:
            style["markersize"] = self.width(style["markersize"])
        if "linewidth" in style:
            style["linewidth"] = self.width(style["linewidth"])
        self.handles.setdefault(label, self.page.line(label, **style))

    def name_arrow(self, label: str, colour: str) -> None:
        """An entry of the legend: an arrow."""
        self.name(label, color=colour, linewidth=3.0, marker=">", markersize=9)

    def name_area(self, label: str, **style: Any) -> None:
        """An entry of the legend: a filled box."""
        self.handles.setdefault(label, self.page.box(label, **style))


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


# --- Blocks, their outlines, the ghost of the structure at rest and the ground, in a plane figure -------------------


FIXED_HATCH, GUIDE_HATCH = "////", "oo"
MANY = 300
"""blocks from which outlines are thinner"""
MOST_NUMBERS = 20
"""parts whose numbers are written on them"""


def draw_grounds(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    """A thick line on every ground plane, hatched behind it."""
    for corners in scene.slabs:
        page = flat.project(corners)
        middle = page.mean(axis=0)
        # the corners are those of a box seen edge-on: sorted by angle they are two for each corner of a rectangle
        order = np.argsort(np.arctan2(*(page - middle).T[::-1]))
        sheet.areas([page[order]], facecolors="none", edgecolors=GROUND, hatch="////", linewidths=0, zorder=0.5)
    for ground in range(len(scene.model.grounds)):
        line = _ground_line(scene, flat, ground)
        if line is not None:
            sheet.lines(line[None], 2.2, GROUND, zorder=0.6, capstyle="butt")
    if scene.slabs:
        sheet.name_area("ground", facecolor="white", edgecolor=GROUND, hatch="////")


def _ground_line(scene: Scene, flat: Flat, ground: int) -> FloatArray | None:
    """Ends of the trace of a ground on the page, (2, 2); None where nothing stands on it."""
    plane = scene.model.grounds[ground]
    for corners in scene.slabs:
        off = (corners - plane.point) @ plane.normal
        if np.abs(off).min() <= 1e-6 * scene.size and off.max() <= 1e-6 * scene.size:
            face = flat.project(corners[np.abs(off) <= 1e-6 * scene.size])
            along = face @ (face[np.argmax(np.linalg.norm(face - face[0], axis=1))] - face[0])
            return face[[int(np.argmin(along)), int(np.argmax(along))]]
    return None


def draw_blocks(sheet: Sheet, flat: Flat, scene: Scene, colours: list[str], vertices: FloatArray) -> None:
    """Blocks filled with their colours, fixed ones hatched, guided ones dotted.

    colours  : of each block
    vertices : (n_vertices, 3) m, as drawn
    """
    blocks, model = scene.model.blocks, scene.model
    polygons, owner = face_polygons(blocks, flat, vertices), blocks.block_of_face[flat.faces]
    sheet.areas(polygons, facecolors=[colours[b] for b in owner], edgecolors="none", zorder=1)
    guided = np.zeros(len(blocks), dtype=bool)
    guided[scene.results.model.guides.blocks] = True
    marked = ((model.fixed, FIXED_HATCH, "fixed"), (guided & ~model.fixed, GUIDE_HATCH, "guided"))
    for chosen, hatch, name in marked:
        picked = [polygon for polygon, b in zip(polygons, owner, strict=True) if chosen[b]]
        sheet.areas(picked, facecolors="none", edgecolors=GROUND, hatch=hatch, linewidths=0, zorder=1.1)
        if picked:
            face = FIXED_BLOCK if FIXED_BLOCK in colours and name == "fixed" else "white"
            sheet.name_area(name, facecolor=face, edgecolor=GROUND, hatch=hatch)
    edges = seen_edges(blocks, flat, block_edges(blocks))
    sheet.lines(flat.project(vertices)[edges], 1.0 if len(blocks) < MANY else 0.6, INK, zorder=2)


def draw_ghost(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    """Outlines of the blocks that move, where they were, dashed."""
    blocks = scene.model.blocks
    edges = seen_edges(blocks, flat, block_edges(blocks))
    moves: BoolArray = np.any(scene.motion != 0, axis=1)
    edges = edges[moves[blocks.block_of_vertex[edges[:, 0]]]]
    if len(edges):
        sheet.lines(flat.project(blocks.vertices)[edges], 0.8, GHOST, zorder=2.5, linestyles=[(0, (4, 3))], alpha=0.8)
        sheet.name("before it moves", color=GHOST, linewidth=0.8, linestyle=(0, (4, 3)))


def colours_by_group(sheet: Sheet, scene: Scene) -> list[str]:
    """Colour of each block by its group, and the groups in the legend."""
    of_group = group_colours(scene.model.blocks.groups)
    named, more = named_groups(of_group)
    for name, colour in named:
        sheet.name_area(name, facecolor=colour, edgecolor=INK, linewidth=0.5)
    if more:
        sheet.name(more, linestyle="none")
    return [of_group[name] for name in scene.model.blocks.groups]


def colours_by_part(sheet: Sheet, scene: Scene) -> list[str]:
    """Colour of each block by the part that it moves with; fixed ones grey."""
    count = int(scene.clusters.max(initial=0))
    tints = tint_of_part(scene, scene.clusters, len(GROUPS))
    if count and np.any((scene.clusters == 0) & ~scene.model.fixed):
        sheet.name_area("at rest", facecolor=REST, edgecolor=INK, linewidth=0.5)
    for part in range(1, count + 1 if count <= len(GROUPS) else 1):
        sheet.name_area(f"part {part}", facecolor=GROUPS[tints[part]], edgecolor=INK, linewidth=0.5)
    return part_colours(scene, GROUPS)


def number_parts(sheet: Sheet, flat: Flat, scene: Scene) -> None:
    """The number of each part on its block nearest to its middle, as the listing numbers them; of many the heaviest."""
    parts, blocks = scene.clusters, scene.model.blocks
    count = int(parts.max(initial=0))
    if count < 2 or not scene.motion.any():
        return
    centroids = moved_points(blocks, scene.motion, np.arange(len(blocks)), blocks.centroids)
    for part in range(1, min(count, MOST_NUMBERS) + 1):
        rows = np.flatnonzero((parts == part) & ~scene.model.fixed)
        if len(rows):
            middle = np.average(centroids[rows], axis=0, weights=blocks.volumes[rows])
            away = np.round(np.linalg.norm(centroids[rows] - middle, axis=1) / scene.size, 9)
            sheet.write(flat.project(centroids[rows[[np.argmin(away)]]])[0], str(part))
    more = f", and {count - MOST_NUMBERS} more" if count > MOST_NUMBERS else ""
    if count > len(GROUPS):
        sheet.name(f"parts as in the listing{more}", linestyle="none", marker="$1$", color=INK, markersize=8)
