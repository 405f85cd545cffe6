"""The collapse mechanism in space: parts in tints over the ghost of the structure, and what its joints do."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.results.collapse.motion import largest_displacements
from mbla.results.pictures.palette import FIXED_BLOCK, GHOST, REST
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.drawing import Drawing
from mbla.results.pictures.space.joints import joint_marks
from mbla.results.pictures.space.loads import live_load_arrows
from mbla.results.pictures.space.shapes import Shape, rgb
from mbla.results.pictures.space.structure import block_faces, edge_lines, ghost_lines, grounds
from mbla.results.pictures.tints import tint_of_part

PARTS = ("#7FB2D6", "#F2C36B", "#B7DDF2", "#F4EE9B", "#5E97BF", "#E8A87C")
"""tints of parts that move; of more parts neighbours get different ones"""
STILL = 1e-4
"""displacement over the largest up to which a block is drawn as one at rest"""


def mechanism_drawing(scene: Scene, widest: Scene | None = None, seen: FloatArray | None = None) -> Drawing:
    """The structure as moved; at rest where no motion is known.

    widest : the same with the greatest displacement, where this is a frame of a film: marks keep its sizes
    seen   : (n, 3) m, what fills the picture, for the size of marks; the whole structure by itself
    """
    widest = widest or scene
    moving = moving_blocks(widest)
    legend: list[tuple[str, str]] = []
    notes: tuple[str, ...] = ()
    solid: list[Shape] = [*grounds(scene), block_faces(scene, scene.moved, part_colours(widest, moving))]
    solid.append(edge_lines(scene, scene.moved))
    marks: list[Shape] = []
    if moving.any():
        solid.append(ghost_lines(scene, moving))
    if moving.any() and len(scene.contacts):
        gaps, lines, legend, notes = joint_marks(scene, widest, widest.moved if seen is None else seen)
        solid += gaps
        marks += lines
    extent = np.vstack([scene.moved, scene.model.blocks.vertices, *scene.slabs])
    loads, entries = live_load_arrows(scene)
    extent = np.vstack([extent, *(shape.points for shape in loads)])
    legend += entries
    if moving.any():
        rests = (widest.clusters == 0) & ~scene.model.fixed
        legend += [("at rest", REST)] * bool(rests.any()) + [("before", GHOST)]
    if scene.model.fixed.any():
        legend.append(("support", FIXED_BLOCK))
    notes = (*_parts_note(widest), *notes)
    return Drawing(tuple(solid), tuple(marks), 0.6, extent, tuple(legend), notes=notes, loads=tuple(loads))


def moving_blocks(scene: Scene) -> BoolArray:
    """Blocks that are drawn away from their place, (n_blocks,)."""
    distance = largest_displacements(scene.model.blocks, scene.motion)
    return np.asarray(distance > STILL * distance.max(initial=0.0))


def part_colours(scene: Scene, moving: BoolArray) -> FloatArray:
    """Colour of each block, (n_blocks, 3): stone at rest, grey if fixed, else by the part of the listing it is in."""
    colours = np.tile(rgb(REST), (len(moving), 1))
    if moving.any():
        tints = np.array([rgb(tint) for tint in PARTS])[tint_of_part(scene, scene.clusters, len(PARTS))]
        chosen = moving & (scene.clusters > 0)
        colours[chosen] = tints[scene.clusters[chosen]]
    colours[scene.model.fixed & ~moving] = rgb(FIXED_BLOCK)
    return colours


def _parts_note(scene: Scene) -> tuple[str, ...]:
    """What counts as one part, where that is not the exact motion."""
    failure = scene.failure
    if failure is None or not failure.merged or not scene.motion.any():
        return ()
    count = len(failure.main.motions)
    told = f"coloured as {count} parts" if count > 1 else "coloured as one part"
    if failure.spreads:
        return (f"{told}, as in the listing: {100 * failure.main.explained:.3g} % of the motion is explained by that",)
    return (
        f"{told}: less than {100 * failure.merged:g} % of the fastest contact counts as no motion, as in the listing",
    )
