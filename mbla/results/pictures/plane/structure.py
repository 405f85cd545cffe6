"""Blocks, their outlines, the ghost of the structure at rest and the ground, in a plane figure."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.collapse.motion import moved_points
from mbla.results.listing.text import counted
from mbla.results.pictures.geometry import block_edges
from mbla.results.pictures.palette import FIXED_BLOCK, GHOST, GROUND, GROUPS, INK, REST, group_colours
from mbla.results.pictures.plane.flat import Flat, face_polygons, seen_edges
from mbla.results.pictures.plane.sheet import Sheet
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.tints import tint_of_part

FIXED_HATCH, GUIDE_HATCH = "////", "oo"
MANY = 300
"""blocks from which outlines are thinner"""
MOST_GROUPS = 12
"""groups that the legend names"""
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
    """Blocks filled with their colours, fixed ones hatched, guided ones dotted."""
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
    blocks = scene.model.blocks
    of_group = group_colours(blocks.groups)
    for name, colour in list(of_group.items())[:MOST_GROUPS]:
        sheet.name_area(name, facecolor=colour, edgecolor=INK, linewidth=0.5)
    if len(of_group) > MOST_GROUPS:
        sheet.name(f"and {counted(len(of_group) - MOST_GROUPS, 'more group')}", linestyle="none")
    return [of_group[name] for name in blocks.groups]


def colours_by_part(sheet: Sheet, scene: Scene) -> list[str]:
    """Colour of each block by the part that it moves with; fixed ones grey."""
    fixed, parts = scene.model.fixed, scene.clusters
    count = int(parts.max(initial=0))
    few = count <= len(GROUPS)
    tints = tint_of_part(scene, parts, len(GROUPS))
    colours = [
        FIXED_BLOCK if fixed[b] else GROUPS[tints[part]] if part else REST for b, part in enumerate(parts.tolist())
    ]
    if count and np.any((parts == 0) & ~fixed):
        sheet.name_area("at rest", facecolor=REST, edgecolor=INK, linewidth=0.5)
    for part in range(1, count + 1 if few else 1):
        sheet.name_area(f"part {part}", facecolor=GROUPS[tints[part]], edgecolor=INK, linewidth=0.5)
    return colours


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
