"""Loads in a spatial picture: one arrow for an acceleration, arrows at their points for forces, rings for moments."""

from __future__ import annotations

import textwrap
from collections import Counter

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase, Settlement
from mbla.results.collapse.motion import moved_points
from mbla.results.pictures.load_marks import (
    LONGEST,
    MANY,
    OFF_PATH,
    LoadMarks,
    arrow_above,
    arrow_steps,
    axles_near,
    load_marks,
    settlement_arrow,
)
from mbla.results.pictures.page import CASES, DEAD_LOAD, LIVE_LOAD, SETTLEMENT, pale
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.shapes import Entries, Shape, arrows, rgb, turning_arrows

THICK, THIN = 0.005, 0.0025
"""radii of arrows, of few and of many, over the size of the structure"""
COLUMNS, LINES = 64, 4
"""letters and lines of a load in the legend"""
SHARE_OF_BLOCK = 0.6
"""radius of the ring of a moment, over the size of its block"""


def live_load_arrows(scene: Scene) -> tuple[list[Shape], Entries]:
    """Of the live load, or the settlement in its place, with an entry of the legend."""
    return _of_case(scene, scene.case.load_case, "live load", LIVE_LOAD)


def all_load_arrows(scene: Scene) -> tuple[list[Shape], Entries]:
    """Of the live loads of every case shown, positions of a travelling load as one, and of dead load but gravity."""
    cases = {each.load_case.deck_name: each.load_case for each in scene.shown_cases or (scene.case,)}
    shapes: list[Shape] = []
    entries: Entries = []
    for number, (name, load_case) in enumerate(cases.items()):
        label = "live load" if len(cases) == 1 else name
        more, named = _of_case(scene, load_case, label, CASES[number % len(CASES)], number)
        shapes += more
        entries += named
    dead = scene.case.load_case
    if any("gravity" not in word for word in dead.dead_words):
        more = _shapes(scene, load_marks(scene.model, dead.dead_load, dead.dead_words), DEAD_LOAD)
        shapes += more
        entries += [("dead load besides gravity", DEAD_LOAD)] * bool(more)
    return shapes, entries


def _of_case(scene: Scene, load_case: LoadCase, label: str, colour: str, row: int = 0) -> tuple[list[Shape], Entries]:
    if load_case.settlement is not None:
        shapes = _settlement(scene, load_case.settlement)
        return shapes, [(_wrapped(load_case.settlement.words), SETTLEMENT)] * bool(shapes)
    marks = load_marks(scene.model, load_case.live_load, load_case.live_words, load_case.travel)
    shapes = _shapes(scene, marks, colour)
    if marks.uniform and marks.acceleration.any():
        vertices = np.vstack([scene.moved, scene.model.blocks.vertices])
        top = float(vertices[:, 2].max()) + (0.05 + 0.04 * row) * scene.size
        start, step = arrow_above(scene.model.blocks, marks, top, scene.size)
        shapes.append(_arrows(scene, (start + step)[None], step[None], colour))
    words = Counter(load_case.live_words)
    text = "; ".join(word if count == 1 else f"{count} times {word}" for word, count in words.items())
    entries = [(_wrapped(f"{label}: {text}"), colour)] * bool(shapes)
    near = axles_near(marks, scene.model.blocks.vertices, scene.size)
    if near.any():
        steps = arrow_steps(marks.beside_forces[near], marks.largest, scene.size)
        shapes.append(_arrows(scene, marks.beside[near], steps, pale(colour)))
        entries.append((OFF_PATH, pale(colour)))
    return shapes, entries


def _wrapped(text: str) -> str:
    return "\n".join(textwrap.wrap(text, COLUMNS, max_lines=LINES, placeholder=" ..."))


def _arrows(scene: Scene, tips: FloatArray, steps: FloatArray, colour: str) -> Shape:
    """Arrows that end at tips having come by steps, (n, 3) m each."""
    radii = np.full(len(tips), scene.size * (THICK if len(tips) <= MANY else THIN))
    return arrows(tips - steps, tips, radii, np.tile(rgb(colour), (len(tips), 1)))


def _shapes(scene: Scene, marks: LoadMarks, colour: str) -> list[Shape]:
    """Arrows that end where forces enter their blocks; three quarters of a ring about the centroid for moments."""
    blocks, shapes = scene.model.blocks, list[Shape]()
    if len(marks.blocks):
        tips = moved_points(blocks, scene.motion, marks.blocks, marks.tips)
        shapes.append(_arrows(scene, tips, arrow_steps(marks.forces, marks.largest, scene.size), colour))
    if len(marks.moment_blocks):
        rows = marks.moment_blocks
        centres = moved_points(blocks, scene.motion, rows, blocks.centroids[rows])
        reach = np.minimum(SHARE_OF_BLOCK * blocks.sizes[rows], LONGEST * scene.size)
        shapes.append(_rings(centres, marks.moments, reach, colour))
    return shapes


def _rings(centres: FloatArray, turns: FloatArray, reach: FloatArray, colour: str) -> Shape:
    axes = turns / np.linalg.norm(turns, axis=1, keepdims=True)
    return turning_arrows(centres, axes, reach, float(0.04 * reach.max()), rgb(colour))


def _settlement(scene: Scene, settlement: Settlement) -> list[Shape]:
    """An arrow away from what gives way, along its mean motion; a ring where it only turns."""
    way, turn = settlement.motions[:, :3].mean(axis=0), settlement.motions[:, 3:].mean(axis=0)
    blocks = scene.model.blocks
    vertices = scene.moved[np.isin(blocks.block_of_vertex, settlement.blocks)]
    if way.any():
        start, step = settlement_arrow(vertices, way, scene.size)
        return [_arrows(scene, (start + step)[None], step[None], SETTLEMENT)]
    if not turn.any():
        return []
    middle = blocks.centroids[settlement.blocks].mean(axis=0)
    reach = SHARE_OF_BLOCK * blocks.sizes[settlement.blocks].max(keepdims=True)
    return [_rings(middle[None], turn[None], reach, SETTLEMENT)]
