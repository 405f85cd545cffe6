"""The model in space: blocks by group, supports, loads where they act."""

from __future__ import annotations

import numpy as np

from mbla.results.listing.text import counted
from mbla.results.pictures.palette import FIXED_BLOCK, group_colours
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.drawing import Drawing
from mbla.results.pictures.space.loads import all_load_arrows
from mbla.results.pictures.space.shapes import Shape, rgb
from mbla.results.pictures.space.structure import SLAB, block_faces, edge_lines, grounds

MOST_GROUPS = 10
"""names of groups in a legend"""


def model_drawing(scene: Scene) -> Drawing:
    """The structure at rest with everything that holds and loads it."""
    blocks, fixed = scene.model.blocks, scene.results.model.fixed
    tint = group_colours(blocks.groups)
    colours = np.array([rgb(tint[group]) for group in blocks.groups])
    colours[fixed] = rgb(FIXED_BLOCK)
    solid: list[Shape] = [*grounds(scene), block_faces(scene, blocks.vertices, colours)]
    solid.append(edge_lines(scene, blocks.vertices))
    free_groups = dict.fromkeys(group for group, held in zip(blocks.groups, fixed, strict=True) if not held)
    names = list(free_groups)
    legend = [(name, tint[name]) for name in names[:MOST_GROUPS]]
    notes = (f"and {counted(len(names) - MOST_GROUPS, 'more group')}",) if len(names) > MOST_GROUPS else ()
    if fixed.any():
        legend.append(("fixed blocks", FIXED_BLOCK))
    if scene.slabs:
        legend.append(("ground", SLAB))
    marks, entries = all_load_arrows(scene)
    legend += entries
    extent = np.vstack([blocks.vertices, *scene.slabs, *(shape.points for shape in marks)])
    return Drawing(tuple(solid), tuple(marks), 0.5, extent, tuple(legend), notes=notes)
