"""Where loads are drawn: arrows at the points at which single forces act, one arrow for a uniform acceleration.

A load case knows the force and moment on each block about its centroid. A force F with a moment M across it acts along
the line through p = c + F × M / F², c the centroid; its arrow ends where that line enters the block, which is at the
point of a force on the surface and in the middle of a loaded face. Forces that are one acceleration times the mass are
one arrow for all blocks. A vehicle has an arrow for each axle, those that are off its path beside the structure.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.model import Model, TravelPosition
from mbla.results.series import without_vehicle

SAME = 1e-6
"""relative difference up to which blocks have the same acceleration, and up to which a load is nothing: results are
stored in full, so it is rounding"""
MASS_LOADS = ("gravity", "acceleration", "tilt")
"""words of loads that are proportional to mass"""
IN_WORDS = re.compile(r"(?:([-+.\de]+) times )?(gravity|acceleration) \(([^)]*)\) (?:m/s2|g)$")
"""an acceleration of all blocks in the words of a load case"""
WRITTEN = 1e-5
"""relative accuracy of numbers in words"""
MOST = 0.5
"""share of the loaded blocks that must have one acceleration, where words do not say it, for it to be one arrow"""

BESIDE = 0.5
"""distance from the structure over its size up to which axles off their path are drawn"""
OFF_PATH = "axles off the path, which do not act"


@dataclass(frozen=True)
class LoadMarks:
    """Arrows of the loads on free blocks.

    blocks       : (n,) that forces act on
    tips         : (n, 3) m, where they enter their block
    forces       : (n, 3) N
    moment_blocks: (k,) blocks on which a moment without a force acts, or one about the line of action
    moments      : (k, 3) N m
    acceleration : (3,) of all blocks of ``accelerated``, force per mass; zero where there is none
    accelerated  : (n_blocks,)
    beside       : (m, 3) m, where axles of a vehicle stand that are off its path and do not act
    beside_forces: (m, 3) N, theirs
    """

    blocks: IntArray
    tips: FloatArray
    forces: FloatArray
    moment_blocks: IntArray
    moments: FloatArray
    acceleration: FloatArray
    accelerated: BoolArray
    beside: FloatArray
    beside_forces: FloatArray

    @property
    def uniform(self) -> bool:
        """Whether there is an acceleration to draw."""
        return bool(self.accelerated.any())


def load_marks(
    model: Model, loads: FloatArray, words: Sequence[str], travel: TravelPosition | None = None
) -> LoadMarks:
    """Arrows for loads on blocks about their centroids, (n_blocks, 6), with their words from the load case.

    travel : the vehicle among them, where one travels
    """
    marks = _marks_of_blocks(model, without_vehicle(model.blocks, loads, travel), words)
    if travel is None:
        return marks
    acting = travel.acting & ~model.fixed[travel.blocks]
    under, forces = travel.blocks[acting], travel.forces[acting]
    tips = [_entry(model, int(b), p, f) for b, p, f in zip(under, travel.points[acting], forces, strict=True)]
    return replace(
        marks,
        blocks=np.append(marks.blocks, under),
        tips=np.vstack([marks.tips, *tips]),
        forces=np.vstack([marks.forces, forces]),
        beside=travel.points[~travel.acting],
        beside_forces=travel.forces[~travel.acting],
    )


def _marks_of_blocks(model: Model, loads: FloatArray, words: Sequence[str]) -> LoadMarks:
    """Those of loads of which only the sum on each block is known."""
    loads = np.where(model.fixed[:, None], 0.0, loads)
    of_mass = all(any(word in text for word in MASS_LOADS) for text in words) or bool(_in_words(model, words).any())
    acceleration, accelerated = np.zeros(3), np.zeros(len(loads), dtype=bool)
    if of_mass:
        acceleration, accelerated = _acceleration(model, loads, _in_words(model, words))
        if _turns(model, loads - _mass_loads(model, acceleration, accelerated), accelerated):
            acceleration, accelerated = np.zeros(3), np.zeros(len(loads), dtype=bool)
    rest = loads - _mass_loads(model, acceleration, accelerated)
    blocks = model.blocks
    size = np.linalg.norm(loads[:, :3], axis=1).max(initial=0.0)
    force = np.linalg.norm(rest[:, :3], axis=1)
    pushed = np.flatnonzero(force > WRITTEN * size)
    vectors, moments = rest[pushed, :3], rest[pushed, 3:]
    square = np.einsum("ij,ij->i", vectors, vectors)[:, None]
    points = blocks.centroids[pushed] + np.cross(vectors, moments) / square
    about = np.zeros((len(loads), 3))
    about[:, :] = rest[:, 3:]
    about[pushed] = np.einsum("ij,ij->i", vectors, moments)[:, None] / square * vectors
    turned = np.flatnonzero(np.linalg.norm(about, axis=1) > WRITTEN * _moment_size(model, loads))
    return LoadMarks(
        blocks=pushed,
        tips=np.array([_entry(model, int(b), p, f) for b, p, f in zip(pushed, points, vectors, strict=True)]).reshape(
            -1, 3
        ),
        forces=vectors,
        moment_blocks=turned,
        moments=about[turned],
        acceleration=acceleration,
        accelerated=accelerated,
        beside=np.zeros((0, 3)),
        beside_forces=np.zeros((0, 3)),
    )


def _in_words(model: Model, words: Sequence[str]) -> FloatArray:
    """Sum of the accelerations of all blocks that the words name, force per mass, (3,)."""
    total, units = np.zeros(3), model.units
    for text in words:
        found = IN_WORDS.match(text)
        if found:
            factor, kind, numbers = found.groups()
            unit = units.standard_gravity if kind == "acceleration" else 1.0
            total += float(factor or 1) * unit * np.array([float(part) for part in numbers.split(",")])
    return total * units.force_per_mass_acceleration


def _acceleration(model: Model, loads: FloatArray, written: FloatArray) -> tuple[FloatArray, BoolArray]:
    """The force per mass that the words say, else the one that most blocks have, (3,); who has it, (n_blocks,)."""
    masses = model.blocks.masses
    chosen = (masses > 0) & np.any(loads[:, :3] != 0, axis=1)
    none = np.zeros(3), np.zeros(len(loads), dtype=bool)
    if not chosen.any():
        return none
    per_mass = loads[chosen, :3] / masses[chosen, None]
    step = SAME * float(np.abs(per_mass).max())
    _, first, row, counts = np.unique(
        np.round(per_mass / step), axis=0, return_index=True, return_inverse=True, return_counts=True
    )
    commonest = int(np.argmax(counts))
    apart = np.abs(per_mass[first[commonest]] - written).max()
    if written.any() and apart > WRITTEN * np.abs(written).max():  # other loads on most blocks
        return written, chosen
    if counts[commonest] <= MOST * len(per_mass):
        return none
    having = none[1].copy()
    having[np.flatnonzero(chosen)[row.ravel() == commonest]] = True
    return per_mass[first[commonest]], having


def _mass_loads(model: Model, acceleration: FloatArray, accelerated: BoolArray) -> FloatArray:
    """Loads of an acceleration on own and added masses, about the centroids, (n_blocks, 6)."""
    blocks = model.blocks
    forces = blocks.masses[:, None] * acceleration
    arms = blocks.added_mass_points - blocks.centroids
    moments = np.cross(arms, blocks.added_masses[:, None] * acceleration)
    return np.where(accelerated[:, None], np.hstack([forces, moments]), 0.0)


def _turns(model: Model, rest: FloatArray, accelerated: BoolArray) -> bool:
    """Accelerated blocks all have a moment besides and no force: what varies over them does not act at centroids."""
    blocks = model.blocks
    forces, moments = np.linalg.norm(rest[accelerated, :3], axis=1), np.linalg.norm(rest[accelerated, 3:], axis=1)
    alone = forces * blocks.sizes[accelerated] <= WRITTEN * moments
    return bool(accelerated.any() and np.all(alone & (moments > WRITTEN * _moment_size(model, rest))))


def _moment_size(model: Model, loads: FloatArray) -> float:
    sizes = np.linalg.norm(loads[:, :3], axis=1) * model.blocks.sizes
    return float(max(sizes.max(initial=0.0), np.linalg.norm(loads[:, 3:], axis=1).max(initial=0.0)))


def _entry(model: Model, block: int, point: FloatArray, force: FloatArray) -> FloatArray:
    """Where the line of a force enters a block; the point of the line nearest to the centroid where it misses it."""
    blocks = model.blocks
    faces = np.arange(blocks.face_start[block], blocks.face_start[block + 1])
    normals = blocks.face_normals[faces]
    corners = blocks.vertices[blocks.loops[blocks.loop_start[faces]]]
    along = normals @ force
    distance = np.einsum("ij,ij->i", normals, corners - point)
    level = np.abs(along) <= SAME * np.linalg.norm(force)
    if np.any(distance[level] < -SAME * blocks.sizes[block]):
        return point
    with np.errstate(divide="ignore", invalid="ignore"):
        steps = distance / along
    begin, end = steps[~level & (along < 0)].max(initial=-np.inf), steps[~level & (along > 0)].min(initial=np.inf)
    return np.asarray(point + begin * force) if np.isfinite(begin) and begin <= end + SAME else point
