"""Loads in a spatial picture: one arrow for an acceleration, arrows at their points for forces, rings for moments."""

from __future__ import annotations

import textwrap
from collections import Counter
from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase
from mbla.results.collapse.motion import moved_points
from mbla.results.pictures.geometry import box_of
from mbla.results.pictures.load_marks import BESIDE, OFF_PATH, LoadMarks, load_marks
from mbla.results.pictures.page import CASES, DEAD_LOAD, LIVE_LOAD, SETTLEMENT, pale
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.shapes import Shape, arrows, rgb, turning_arrows

LONGEST, SHORTEST = 0.12, 0.04
"""of arrows, over the size of the structure"""
FEW = 20
"""forces up to which their arrows are thick"""
COLUMNS, LINES = 64, 4
"""letters and lines of a load in the legend"""
SHARE_OF_BLOCK = 0.6
"""radius of the ring of a moment, over the size of its block"""

Entries = list[tuple[str, str]]


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
        marks = load_marks(scene.model, dead.dead_load, dead.dead_words)
        more = _force_arrows(scene, marks, DEAD_LOAD) + _moment_rings(scene, marks, DEAD_LOAD)
        shapes += more
        entries += [("dead load besides gravity", DEAD_LOAD)] * bool(more)
    return shapes, entries


def _of_case(scene: Scene, load_case: LoadCase, label: str, colour: str, row: int = 0) -> tuple[list[Shape], Entries]:
    settlement = load_case.settlement
    if settlement is not None:
        shapes = _settlement(scene, load_case)
        return shapes, [(_wrapped(settlement.words), SETTLEMENT)] * bool(shapes)
    marks = load_marks(scene.model, load_case.live_load, load_case.live_words, load_case.travel)
    shapes = _force_arrows(scene, marks, colour) + _moment_rings(scene, marks, colour)
    if marks.uniform and marks.acceleration.any():
        shapes.append(_acceleration_arrow(scene, marks, colour, row))
    entries = [(_wrapped(f"{label}: {_together(load_case.live_words)}"), colour)] * bool(shapes)
    beside = _axles_beside(scene, marks, pale(colour))
    return shapes + beside, entries + [(OFF_PATH, pale(colour))] * bool(beside)


def _together(words: Sequence[str]) -> str:
    """Loads one after the other, the same words once with how often they apply."""
    return "; ".join(word if count == 1 else f"{count} times {word}" for word, count in Counter(words).items())


def _wrapped(text: str) -> str:
    return "\n".join(textwrap.wrap(text, COLUMNS, max_lines=LINES, placeholder=" ..."))


def _force_arrows(scene: Scene, marks: LoadMarks, colour: str) -> list[Shape]:
    """Arrows that end where forces enter their blocks, by their sizes."""
    if not len(marks.blocks):
        return []
    tips = moved_points(scene.model.blocks, scene.motion, marks.blocks, marks.tips)
    return [_arrows_at(scene, tips, marks.forces, _largest(marks), colour)]


def _axles_beside(scene: Scene, marks: LoadMarks, colour: str) -> list[Shape]:
    """Axles of a vehicle off its path; those further off than half the structure's size would shrink it."""
    low, high = box_of(scene.model.blocks.vertices)
    reach = BESIDE * scene.size
    near = np.all((marks.beside > low - reach) & (marks.beside < high + reach), axis=1)
    if not near.any():
        return []
    return [_arrows_at(scene, marks.beside[near], marks.beside_forces[near], _largest(marks), colour)]


def _largest(marks: LoadMarks) -> float:
    return float(np.linalg.norm(np.vstack([marks.forces, marks.beside_forces]), axis=1).max())


def _arrows_at(scene: Scene, tips: FloatArray, forces: FloatArray, largest: float, colour: str) -> Shape:
    """Arrows that end at points, by the sizes of their forces over the largest."""
    sizes = np.linalg.norm(forces, axis=1)
    lengths = scene.size * np.maximum(LONGEST * sizes / largest, SHORTEST)
    starts = tips - forces * (lengths / sizes)[:, None]
    radii = np.full(len(tips), scene.size * (0.005 if len(tips) <= FEW else 0.0025))
    return arrows(starts, tips, radii, np.tile(rgb(colour), (len(tips), 1)))


def _moment_rings(scene: Scene, marks: LoadMarks, colour: str) -> list[Shape]:
    """Three quarters of a ring about the centroid of each block, the way the moment turns."""
    rows = marks.moment_blocks
    if not len(rows):
        return []
    blocks = scene.model.blocks
    centres = moved_points(blocks, scene.motion, rows, blocks.centroids[rows])
    axes = marks.moments / np.linalg.norm(marks.moments, axis=1, keepdims=True)
    reach = np.minimum(SHARE_OF_BLOCK * blocks.sizes[rows], LONGEST * scene.size)
    return [turning_arrows(centres, axes, reach, float(0.04 * reach.max()), rgb(colour))]


def _acceleration_arrow(scene: Scene, marks: LoadMarks, colour: str, row: int) -> Shape:
    """One thick arrow above the structure, over the middle of what it accelerates; further ones above it."""
    blocks = scene.model.blocks
    direction = marks.acceleration / np.linalg.norm(marks.acceleration)
    top = float(max(scene.moved[:, 2].max(), blocks.vertices[:, 2].max())) + (0.05 + 0.04 * row) * scene.size
    middle = np.append(blocks.centroids[marks.accelerated, :2].mean(axis=0), top)
    length = LONGEST * scene.size
    start = middle - length * direction * np.array([0.5, 0.5, 1.0 if direction[2] < 0 else 0.0])
    radius = np.array([0.0055 * scene.size])
    return arrows(start[None], (start + length * direction)[None], radius, rgb(colour)[None])


def _settlement(scene: Scene, load_case: LoadCase) -> list[Shape]:
    """Arrows from the blocks that give way, along their motion; rings where they only turn."""
    settlement = load_case.settlement
    assert settlement is not None
    centres = scene.model.blocks.centroids[settlement.blocks]
    colour = rgb(SETTLEMENT)
    ways, turns = settlement.motions[:, :3], settlement.motions[:, 3:]
    sizes, spins = np.linalg.norm(ways, axis=1), np.linalg.norm(turns, axis=1)
    shapes: list[Shape] = []
    rows = np.flatnonzero(sizes > 0)
    if len(rows):
        tips = centres[rows] + LONGEST * scene.size * ways[rows] / sizes[rows].max()
        radii = np.full(len(rows), 0.005 * scene.size)
        shapes.append(arrows(centres[rows], tips, radii, np.tile(colour, (len(rows), 1))))
    rows = np.flatnonzero((sizes == 0) & (spins > 0))
    if len(rows):
        reach = SHARE_OF_BLOCK * scene.model.blocks.sizes[settlement.blocks[rows]]
        shapes.append(
            turning_arrows(centres[rows], turns[rows] / spins[rows, None], reach, float(0.04 * reach.max()), colour)
        )
    return shapes
