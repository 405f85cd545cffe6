"""What a picture of each kind shows, and how it lies on its page; drawn in the plane where that can show the case."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from textwrap import fill
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.results.pictures.camera import Camera, Room, fitted, view_of_case
from mbla.results.pictures.geometry import block_edges, edges_of_blocks
from mbla.results.pictures.marks.fill import fill_marks
from mbla.results.pictures.marks.forces import force_marks
from mbla.results.pictures.marks.joints import joint_marks
from mbla.results.pictures.marks.loads import shown_loads
from mbla.results.pictures.marks.marks import Mark, moved
from mbla.results.pictures.marks.ties import tie_marks
from mbla.results.pictures.options import DOTS_PER_INCH, PictureOptions, format_of
from mbla.results.pictures.page import (
    FIXED_BLOCK,
    GHOST,
    GROUPS,
    GUIDED_BLOCK,
    INK,
    REST,
    SLAB,
    SLOW,
    SOIL,
    Page,
    add_axes,
    add_bar,
    add_legend,
    add_words,
    group_colours,
    open_page,
)
from mbla.results.pictures.plane import DASHES, HATCH, PALE, Flat, draw_flat, flat_of
from mbla.results.pictures.renderer import image_of
from mbla.results.pictures.scene import PictureScene, bounding_edges, named_groups, part_colours

MARGIN = 0.03
"""of the page around the structure, share of the width"""
AXES = 0.09
"""share of the height that axes and scale bar take at least"""
COLUMNS, LINES = 80, 4
"""letters and lines of an entry of the legend"""
SHARPNESS = {"png": 1, "svg": 2, "pdf": 2}
"""pixels of an image over those of a PNG page"""


@dataclass(frozen=True)
class Drawing:
    """A structure with its marks, before it moves.

    flat     : the plane that it lies in; None in space
    colours  : (n_blocks) of the blocks
    legend   : names and colours of what is no mark
    outlined : edges are drawn where blocks were before they moved
    """

    flat: Flat | None
    colours: list[str]
    legend: list[tuple[str, str]]
    marks: list[Mark]
    outlined: bool


def drawing_of(scene: PictureScene, kind: str, view: tuple[float, float] | None = None) -> Drawing:
    """Model, mechanism or forces of a case, in the plane where that can show it and the view is none of space."""
    flat = flat_of(scene, view, kind)
    model, blocks = scene.results.model, scene.model.blocks
    loads = shown_loads(scene, kind, flat.towards if flat else None)
    held = np.where(model.fixed, FIXED_BLOCK, "").astype(object)
    held[np.setdiff1d(model.guides.blocks, np.flatnonzero(model.fixed))] = GUIDED_BLOCK
    supports = [("fixed", FIXED_BLOCK)] * bool(model.fixed.any())
    supports += [("guided", GUIDED_BLOCK)] * bool((held == GUIDED_BLOCK).any()) + [("ground", SLAB)] * bool(scene.slabs)
    if kind == "forces":
        own, legend, marks = [REST] * len(blocks), list[tuple[str, str]](), force_marks(scene)
    elif kind == "model":
        tint = group_colours(blocks.groups)
        free = {group for group, support in zip(blocks.groups, held, strict=True) if not support}
        named, more = named_groups({group: colour for group, colour in tint.items() if group in free})
        own, legend = [tint[group] for group in blocks.groups], named + [(more, "white")] * bool(more)
        marks = fill_marks(scene)
    else:
        own, marks = part_colours(scene, GROUPS), joint_marks(scene, flat=flat is not None)
        legend = _parts(scene)
    soil = scene.model.soil_of_block >= 0
    held[soil & (held == "")] = SOIL if soil.any() else ""
    supports = [("soil", SOIL)] * bool((held == SOIL).any()) + supports
    colours = [support or colour for support, colour in zip(held, own, strict=True)]
    legend = [(name, colour) for name, colour in legend if colour in colours or colour == "white"]
    marks = [*marks, *tie_marks(scene, at_work=kind != "model"), *loads]
    return Drawing(flat, colours, legend + supports, marks, bool(scene.displaced.any()))


def _parts(scene: PictureScene) -> list[tuple[str, str]]:
    """Names of the parts that move, where they have a colour each."""
    if not scene.motion.any() or scene.moment:  # in time every block moves by itself
        return []
    count = int(scene.clusters.max(initial=0))
    legend = [("at rest", REST)] * bool(((scene.clusters == 0) & ~scene.slow & ~scene.model.fixed).any())
    legend += [("moves less", SLOW)] * bool(scene.slow.any())
    if count <= len(GROUPS):
        legend += [(f"part {part + 1}", GROUPS[part]) for part in range(count)]
    return legend


def draw_picture(path: Path, scene: PictureScene, kind: str, options: PictureOptions) -> None:
    """Write model, mechanism or forces of a case to a PNG, SVG or PDF file.

    Raises
    ------
    UsageError
        The extra for pictures is not installed, the name asks for another format, or a picture in space is needed and
        the machine has no OpenGL.
    FileError
        The file cannot be written.
    """
    with open_page(path, options) as page:
        drawing = drawing_of(scene, kind, options.view)
        draw_on(page, scene, drawing, kind, extent_of([scene], drawing), SHARPNESS[format_of(path)])


def extent_of(scenes: Iterable[PictureScene], drawing: Drawing) -> FloatArray:
    """All that must be seen of a structure, as built and in some scenes of it, (n, 3) m."""
    points = []
    for scene in scenes:
        points += [scene.model.blocks.vertices, scene.moved, *(slab.points for slab in scene.slabs)]
        points += [moved(mark, scene.model, scene.motion) for mark in drawing.marks]
    return np.vstack(points)


def draw_on(
    page: Page, scene: PictureScene, drawing: Drawing, kind: str, extent: FloatArray, sharpness: float = 1.0
) -> None:
    """A drawing with its words, legend, scale and axes; ``extent`` is what must be seen, (n, 3) m."""
    options = page.options
    width, height = options.size
    used = add_words(page, scene.words_of(kind), scene.mark_of(kind))
    bottom = add_legend(page, _handles(page, drawing), bottom=0.012, corner=True)
    room: Room = ((MARGIN, 1 - MARGIN), (max(bottom, AXES) + 0.01, max(1 - used - 0.01, bottom + 0.2)))
    flat = drawing.flat
    view = (flat.azimuth, 0.0) if flat else options.view or view_of_case(scene)
    camera = fitted(extent, view, width / height, room)
    axes = page.figure.add_axes((0.0, 0.0, 1.0, 1.0), zorder=-1)
    axes.set_axis_off()
    axes.set(xlim=(0, camera.aspect), ylim=(0, 1))
    if flat:
        draw_flat(page, axes, camera, scene, drawing, flat)
    else:
        _draw_image(axes, camera, scene, drawing, view[1], sharpness * options.dpi / DOTS_PER_INCH * height)
    add_bar(page, camera.height / page.figure.get_figheight(), scene.model.units.length, 0.12, 0.045)
    add_axes(page, "xyz", np.column_stack([camera.right, camera.up]), 0.055, 0.06)


def _draw_image(
    axes: Any, camera: Camera, scene: PictureScene, drawing: Drawing, elevation: float, height: float
) -> None:
    placed = [(mark, moved(mark, scene.model, scene.motion)) for mark in drawing.marks]
    slabs = scene.slabs if elevation >= 0 else []  # from below the ground would hide the rest
    pixels = round(camera.aspect * height), round(height)
    image = image_of(scene, drawing.colours, placed, slabs, ghost_edges(scene), camera, pixels)
    axes.imshow(image, aspect="auto", interpolation="none", extent=(0.0, camera.aspect, 0.0, 1.0))


def ghost_edges(scene: PictureScene) -> IntArray:
    """Edges of the blocks that are seen to have moved, (n, 2) vertices."""
    blocks = scene.model.blocks
    return edges_of_blocks(blocks, bounding_edges(scene, block_edges(blocks)), scene.displaced)


def _handles(page: Page, drawing: Drawing) -> list[Any]:
    """Entries of the legend, as what they name is drawn: boxes for blocks and areas, lines, arrows and dots."""
    boxes = [page.box(name, facecolor=colour, edgecolor=GHOST, linewidth=0.5) for name, colour in drawing.legend]
    marks = {}
    if drawing.outlined:
        look = {"linestyle": DASHES if drawing.flat else "-", "linewidth": page.scale}
        marks["before it moves"] = page.line("before it moves", color=GHOST, **look)
    for mark in drawing.marks:
        label = fill(mark.name, COLUMNS, max_lines=LINES, placeholder=" ...")
        if mark.pale:
            boxes.append(page.box(label, facecolor=mark.colour, alpha=PALE, edgecolor=GHOST, linewidth=0.5))
            continue
        if len(mark.faces):
            hatch = {"hatch": HATCH} if drawing.flat else {}
            boxes.append(page.box(label, facecolor=mark.colour, edgecolor=INK, linewidth=0.5, **hatch))
            continue
        looks = {"marker": ">" if mark.arrows else "o", "markersize": 8 * page.scale}
        if (mark.pairs[:, 0] == mark.pairs[:, 1]).all():
            looks["linestyle"] = "none"
        elif not mark.arrows and mark.name != "hinge":
            looks = {}
        if label and (mark.arrows or label not in marks):
            marks[label] = page.line(label, color=mark.colour, linewidth=3.0 * page.scale, **looks)
    return [*boxes, *marks.values()]
