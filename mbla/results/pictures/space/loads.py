"""Loads in a spatial picture: one arrow for an acceleration, arrows at their points for forces, rings for moments."""

from __future__ import annotations

import textwrap

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import Settlement
from mbla.results.collapse.motion import moved_points
from mbla.results.pictures.load_marks import (
    LONGEST,
    MANY,
    OFF_PATH,
    arrow_above,
    arrow_steps,
    axles_near,
    settlement_arrow,
)
from mbla.results.pictures.page import pale
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.shown_loads import ShownLoad, shown_loads
from mbla.results.pictures.space.shapes import Entries, Shape, arrows, rgb, turning_arrows

THICK, THIN = 0.005, 0.0025
"""radii of arrows, of few and of many, over the size of the structure"""
COLUMNS, LINES = 64, 4
"""letters and lines of a load in the legend"""
SHARE_OF_BLOCK = 0.6
"""radius of the ring of a moment, over the size of its block"""


def load_shapes(scene: Scene, kind: str) -> tuple[list[Shape], Entries]:
    """Of all loads that a picture of the kind shows, with entries of the legend."""
    shapes: list[Shape] = []
    entries: dict[str, str] = {}
    for load in shown_loads(scene, kind):
        own = _of_marks(scene, load)
        if load.settlement is not None:
            own = _settlement(scene, load.settlement, load.colour)
        if own and load.text:
            entries["\n".join(textwrap.wrap(load.text, COLUMNS, max_lines=LINES, placeholder=" ..."))] = load.colour
        near = axles_near(load.marks, scene.model.blocks.vertices, scene.size)
        if near.any():
            steps = arrow_steps(load.marks.beside_forces[near], load.marks.largest, scene.size)
            own.append(_arrows(scene, load.marks.beside[near], steps, pale(load.colour)))
            entries[OFF_PATH] = pale(load.colour)
        shapes += own
    return shapes, list(entries.items())


def _arrows(scene: Scene, tips: FloatArray, steps: FloatArray, colour: str) -> Shape:
    """Arrows that end at tips having come by steps, (n, 3) m each."""
    radii = np.full(len(tips), scene.size * (THICK if len(tips) <= MANY else THIN))
    return arrows(tips - steps, tips, radii, np.tile(rgb(colour), (len(tips), 1)))


def _of_marks(scene: Scene, load: ShownLoad) -> list[Shape]:
    """Arrows that end where forces enter their blocks, three quarters of a ring about the centroid for moments, and one
    arrow above the structure for an acceleration.
    """
    blocks, marks, shapes = scene.model.blocks, load.marks, list[Shape]()
    if len(marks.blocks):
        tips = moved_points(blocks, scene.motion, marks.blocks, marks.tips)
        shapes.append(_arrows(scene, tips, arrow_steps(marks.forces, marks.largest, scene.size), load.colour))
    if len(marks.moment_blocks):
        rows = marks.moment_blocks
        centres = moved_points(blocks, scene.motion, rows, blocks.centroids[rows])
        reach = np.minimum(SHARE_OF_BLOCK * blocks.sizes[rows], LONGEST * scene.size)
        shapes.append(_rings(centres, marks.moments, reach, load.colour))
    if marks.uniform and marks.acceleration.any():
        top = float(max(scene.moved[:, 2].max(), blocks.vertices[:, 2].max()))
        start, step = arrow_above(blocks, marks, top + (0.05 + 0.04 * load.place) * scene.size, scene.size)
        shapes.append(_arrows(scene, (start + step)[None], step[None], load.colour))
    return shapes


def _rings(centres: FloatArray, turns: FloatArray, reach: FloatArray, colour: str) -> Shape:
    axes = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    return turning_arrows(centres, axes, reach, float(0.04 * reach.max()), rgb(colour))


def _settlement(scene: Scene, settlement: Settlement, colour: str) -> list[Shape]:
    """An arrow away from what gives way, along its mean motion; a ring where it only turns."""
    way, turn = settlement.motions[:, :3].mean(axis=0), settlement.motions[:, 3:].mean(axis=0)
    blocks = scene.model.blocks
    vertices = scene.moved[np.isin(blocks.block_of_vertex, settlement.blocks)]
    if way.any():
        start, step = settlement_arrow(vertices, way, scene.size)
        return [_arrows(scene, (start + step)[None], step[None], colour)]
    if not turn.any():
        return []
    middle = blocks.centroids[settlement.blocks].mean(axis=0)
    reach = SHARE_OF_BLOCK * blocks.sizes[settlement.blocks].max(keepdims=True)
    return [_rings(middle[None], turn[None], reach, colour)]
