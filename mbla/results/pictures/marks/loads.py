"""Marks of the loads of a picture: arrows at the points at which single forces act, one arrow for an acceleration.

A load case knows the force and moment on each block about its centroid. A force F with a moment M across it acts along
the line through p = c + F × M / F², c the centroid; its arrow ends where that line enters the box around the block.
Forces that are one acceleration times the mass are one arrow for all blocks. A vehicle has an arrow for each axle that
is on its path, or for each contact of them; a load that travels its way, and the arrows of the worst position.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.applied_load import AppliedLoad, joined_patches
from mbla.model.model import LoadCase, Model
from mbla.questions.reaction import Settlement
from mbla.questions.travel_position import NOWHERE, TravelPosition
from mbla.results.pictures.marks.marks import Mark, arrows, dots, rings, segments
from mbla.results.pictures.marks.patches import patch_mark
from mbla.results.pictures.page import CASES, DEAD_LOAD, LIVE_LOAD
from mbla.results.pictures.scene import PictureScene
from mbla.results.results import CaseResult
from mbla.results.series import without_vehicle, worst_known

SAME = 1e-6
"""relative difference up to which blocks have the same acceleration; results are stored in full, so it is rounding"""
NOTHING = 1e-5
"""of a load, relative to the largest, that is rounding"""
LONGEST, SHORTEST = 0.12, 0.03
"""of arrows, over the size of the structure"""
LONGEST_OF_MANY, MANY = 0.04, 24
"""the same of more forces than that, which would cover the structure and each other; blocks hide them"""
MOST_CASES = 6
"""load cases whose loads a legend names"""


def shown_loads(scene: PictureScene, kind: str, towards: FloatArray | None = None) -> list[Mark]:
    """The live load of the case; of the model those of all load cases shown; the dead load where it is what acts.

    towards : (3,) unit, to the eye of a plane figure; None in space
    """
    case, found = scene.case.load_case, list[Mark]()
    falls = kind == "mechanism" and scene.mechanics is None and scene.case.solution.certificate is not None
    if kind == "model" or falls:
        text = text_of("dead load", case.dead_words)
        found += marks_of_load(scene, text, DEAD_LOAD, scene.dead_load, case.dead, towards=towards)
    if kind != "model":
        return found + live_marks(scene, case, "live load", LIVE_LOAD, bool(found), towards)
    cases: dict[str, list[CaseResult]] = {}
    for shown in scene.shown_cases:
        cases.setdefault(shown.load_case.deck_name, []).append(shown)
    for row, (name, together) in enumerate(cases.items()):
        label = f"live load {name}" if len(cases) > 1 else "live load"
        label, colour = label if row < MOST_CASES else "", CASES[row % len(CASES)]
        if len(together) > 1 and together[0].load_case.question.place.count:
            found += path_marks(together, f"{label}, {len(together)} positions" if label else "", colour)
            together = [worst_known(together)]
        for each in together:
            found += live_marks(scene, each.load_case, label, colour, row + 1, towards)
    return found


def path_marks(positions: Sequence[CaseResult], label: str, colour: str) -> list[Mark]:
    """The way of a travelling load, from where it stands first, or its first axle, with a dot at each position."""
    points = np.array([each.load_case.question.place.point for each in positions])
    bodies, texts = np.full((len(points), 2), -1), [label] * len(points)
    line = segments(label, colour, np.stack([points[:-1], points[1:]], axis=1), bodies[1:], texts[1:])
    return [replace(line, widths=np.full(len(line.pairs), 0.3)), dots(label, colour, points, bodies, texts)]


def live_marks(
    scene: PictureScene, case: LoadCase, label: str, colour: str, place: int = 0, towards: FloatArray | None = None
) -> list[Mark]:
    """The live load of a load case, of a vehicle its axles, or the way that a support gives.

    label : for the legend; empty for none
    place : number among the loads of the picture; towards : as of ``shown_loads``
    """
    if not case.question.collapses:
        return []
    if settlement := case.question.record(Settlement):
        text = f"{label.replace('live load', '').strip()} {settlement.words}".strip()
        return _of_settlement(scene, text if label else "", colour, settlement)
    text = text_of(label, case.live_words) if label else ""
    return marks_of_load(scene, text, colour, case.live_load, case.live, case.question.place, place, towards)


def _arrow_above(
    scene: PictureScene, text: str, colour: str, acceleration: FloatArray, accelerated: BoolArray, place: int
) -> Mark:
    """One arrow for an acceleration, (3,), above the blocks, (n_blocks,), that have it."""
    blocks, size = scene.model.blocks, scene.size
    step = LONGEST * size * acceleration / np.linalg.norm(acceleration)
    top = float(max(scene.moved[:, 2].max(), blocks.vertices[:, 2].max())) + (0.05 + 0.04 * place) * size
    middle = np.append(blocks.centroids[accelerated, :2].mean(axis=0), top)
    tip = middle + step * [0.5, 0.5, 0.0 if step[2] < 0 else 1.0]
    return arrows(text, colour, tip[None], step[None], np.full((1, 2), -1), [text])


def text_of(name: str, words: tuple[str, ...]) -> str:
    """Loads one after the other, the same words once with how often they apply."""
    counted = [word if count == 1 else f"{count} times {word}" for word, count in Counter(words).items()]
    return f"{name}: {'; '.join(counted)}" if counted else name


def marks_of_load(
    scene: PictureScene,
    text: str,
    colour: str,
    loads: FloatArray,
    applied: Sequence[AppliedLoad],
    travel: TravelPosition = NOWHERE,
    place: int = 0,
    towards: FloatArray | None = None,
) -> list[Mark]:
    """Arrows of loads on free blocks about their centroids, (n_blocks, 6); rings of moments without a force.

    applied : that they are the sum of; travel : the vehicle among them, where one travels, which is the last of them
    towards : as of ``shown_loads``
    """
    model, blocks, size = scene.model, scene.model.blocks, scene.size
    standing = [load for load in applied if len(load.patches.blocks) and not load.patches.spreads]
    rest = _without(standing, without_vehicle(blocks, loads, travel))
    rest = np.where(model.fixed[:, None], 0.0, rest)
    found = []
    acceleration, accelerated = np.zeros(3), np.zeros(len(rest), dtype=bool)
    if any(load.on_masses for load in applied):
        acceleration, accelerated = common_acceleration(model, rest)
    if accelerated.any():
        rest = rest - _mass_loads(model, acceleration, accelerated)
        found.append(_arrow_above(scene, text, colour, acceleration, accelerated, place))
    least = NOTHING * np.linalg.norm(loads[:, :3], axis=1).max(initial=0.0)
    under = np.flatnonzero(np.linalg.norm(rest[:, :3], axis=1) > least)
    points, left = lines_of_action(blocks.centroids[under], rest[under])
    forces, about = rest[under, :3], rest[:, 3:].copy()
    about[under] = left
    acting = travel.acting & ~model.fixed[travel.blocks] & (not (standing and applied[-1] is standing[-1]))
    patches = joined_patches([load.patches for load in standing])
    free = ~model.fixed[patches.blocks]
    under = np.concatenate([under, patches.blocks[free], travel.blocks[acting]])
    forces = np.vstack([forces, patches.forces[free], travel.forces[acting]])
    points = np.vstack([points, patches.corners[free].mean(axis=1), travel.points[acting]])
    if len(under):
        tips, both = _entries(model, under, points, forces), np.column_stack([under, under])
        if travel.spread:  # the axles on top, and below what lands of them
            tips[len(tips) - int(acting.sum()) :] = travel.points[acting]
        mark = arrows(text, colour, tips, arrow_steps(forces, size), both, [text] * len(under))
        found.append(replace(mark, covered=len(under) > MANY))
    turned = np.flatnonzero(np.linalg.norm(about, axis=1) > NOTHING * _moment_size(model, loads))
    found += _rings_about(scene, turned, about, text, colour) if len(turned) else []
    stands = joined_patches([load.patches for load in applied])
    return found + [patch_mark(stands, size, colour, bool(text), towards)] * bool(len(stands.blocks))


def _rings_about(scene: PictureScene, turned: IntArray, about: FloatArray, text: str, colour: str) -> list[Mark]:
    """Rings of moments, (n_blocks, 3), about the centroids of blocks (n,)."""
    blocks = scene.model.blocks
    reach, both = np.minimum(0.6 * blocks.sizes[turned], LONGEST * scene.size), np.column_stack([turned, turned])
    return rings(text, colour, blocks.centroids[turned], about[turned], reach, both, text)


def _without(standing: Sequence[AppliedLoad], loads: FloatArray) -> FloatArray:
    """Loads on blocks, (n_blocks, 6), less those of axles on contacts, which are drawn there."""
    if not standing:
        return loads
    rest = loads.copy()
    for load in standing:
        rest[load.blocks] -= load.wrenches[:, :6]
    return np.where(np.abs(rest) <= SAME**2 * np.abs(loads).max(axis=0), 0.0, rest)


def common_acceleration(model: Model, loads: FloatArray) -> tuple[FloatArray, BoolArray]:
    """The force per mass, (3,), that more than half of the loaded blocks have, and which these are, (n_blocks,)."""
    masses = model.blocks.masses
    chosen = np.flatnonzero((masses > 0) & np.any(loads[:, :3] != 0, axis=1))
    none = np.zeros(3), np.zeros(len(loads), dtype=bool)
    if not len(chosen):
        return none
    per_mass = loads[chosen, :3] / masses[chosen, None]
    rounded = np.round(per_mass / (SAME * float(np.abs(per_mass).max())))
    _, first, row, counts = np.unique(rounded, axis=0, return_index=True, return_inverse=True, return_counts=True)
    most = int(np.argmax(counts))
    if 2 * counts[most] <= len(chosen):
        return none
    having = none[1]
    having[chosen[row.ravel() == most]] = True
    return per_mass[first[most]], having


def _mass_loads(model: Model, acceleration: FloatArray, accelerated: BoolArray) -> FloatArray:
    """Loads of an acceleration on own and added masses, about the centroids, (n_blocks, 6)."""
    blocks = model.blocks
    moments = np.cross(blocks.added_mass_points - blocks.centroids, blocks.added_masses[:, None] * acceleration)
    return np.where(accelerated[:, None], np.hstack([blocks.masses[:, None] * acceleration, moments]), 0.0)


def lines_of_action(centroids: FloatArray, loads: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Points of the lines along which forces act, (n, 3) m, level with the centroids, and the moments along the forces.

    That is c + F × M / F² and (F · M / F²) F; without a force the centroid, and the moment as it is.

    loads : (n, 6) forces, and moments about the centroids, (n, 3) m
    """
    forces, moments = loads[:, :3], loads[:, 3:]
    square = np.einsum("ij,ij->i", forces, forces)[:, None]
    acts = square > 0
    square = np.where(acts, square, 1.0)
    along = np.einsum("ij,ij->i", forces, moments)[:, None] / square * forces
    return centroids + np.cross(forces, moments) / square, np.where(acts, along, moments)


def _moment_size(model: Model, loads: FloatArray) -> float:
    sizes = np.linalg.norm(loads[:, :3], axis=1) * model.blocks.sizes
    return float(max(sizes.max(initial=0.0), np.linalg.norm(loads[:, 3:], axis=1).max(initial=0.0)))


def _entries(model: Model, blocks: IntArray, points: FloatArray, forces: FloatArray) -> FloatArray:
    """Where the lines of forces, (n, 3), through points, (n, 3) m, enter the boxes around their blocks, (n, 3) m.

    The points themselves where they lie outside.
    """
    vertices, start = model.blocks.vertices, model.blocks.vertex_start[:-1]
    low, high = (each.reduceat(vertices, start)[blocks] for each in (np.minimum, np.maximum))
    with np.errstate(divide="ignore", invalid="ignore"):
        steps = np.where(forces > 0, (points - low) / forces, (points - high) / forces)
    back = np.where(forces != 0, steps, np.inf).min(axis=1)
    return np.asarray(points - np.maximum(back, 0.0)[:, None] * forces)


def arrow_steps(forces: FloatArray, size: float) -> FloatArray:
    """Arrows of forces by their sizes over the largest, (n, 3) m from (n, 3) N; short ones of many."""
    sizes = np.linalg.norm(forces, axis=1, keepdims=True)
    longest = LONGEST if len(forces) <= MANY else LONGEST_OF_MANY
    lengths = size * np.maximum(longest * sizes / sizes.max(), min(SHORTEST, longest / 2))
    return np.asarray(forces * lengths / sizes)


def _of_settlement(scene: PictureScene, text: str, colour: str, settlement: Settlement) -> list[Mark]:
    """Of each support an arrow from the box around it, along its mean motion; a ring where it only turns."""
    ways = np.round(settlement.motions[:, :3], 9)
    if not settlement.turns and len(kinds := np.unique(ways, axis=0)) > 1:
        parts = [np.all(ways == kind, axis=1) for kind in kinds]
        each = [replace(settlement, blocks=settlement.blocks[own], motions=settlement.motions[own]) for own in parts]
        return [mark for part in each for mark in _of_settlement(scene, text, colour, part)]
    way, turn = settlement.motions[:, :3].mean(axis=0), settlement.motions[:, 3:].mean(axis=0)
    blocks, bodies = scene.model.blocks, np.full((1, 2), settlement.blocks[0])
    vertices = blocks.vertices[np.isin(blocks.block_of_vertex, settlement.blocks)]
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    if way.any():
        unit = way / np.linalg.norm(way)
        with np.errstate(divide="ignore"):
            reach = float(np.min(np.ptp(vertices, axis=0) / 2 / np.abs(unit)))
        step = LONGEST * scene.size * unit
        return [arrows(text, colour, (middle + reach * unit + step)[None], step[None], bodies, [text])]
    if not turn.any():
        return []
    reach_of = 0.6 * blocks.sizes[settlement.blocks].max(keepdims=True)
    return rings(text, colour, middle[None], turn[None], reach_of, bodies, text)
