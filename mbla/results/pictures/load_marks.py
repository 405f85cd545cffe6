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
from mbla.model.solids.blocks import Blocks
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
LONGEST, SHORTEST = 0.12, 0.03
"""of arrows, over the size of the structure"""
LONGEST_OF_MANY, MANY = 0.04, 24
"""the same of more forces than that, which would cover the structure and each other"""
FEW = 4
"""forces up to which arrows are thick"""
OFF = 0.01
"""distance of an arrow from what it belongs to, over the same size"""
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
    def largest(self) -> float:
        """Of all forces and axles, N."""
        return float(np.linalg.norm(np.vstack([self.forces, self.beside_forces]), axis=1).max(initial=0.0))

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
    size = np.linalg.norm(loads[:, :3], axis=1).max(initial=0.0)
    pushed = np.flatnonzero(np.linalg.norm(rest[:, :3], axis=1) > WRITTEN * size)
    points, left = lines_of_action(model.blocks.centroids[pushed], rest[pushed])
    vectors, about = rest[pushed, :3], rest[:, 3:].copy()
    about[pushed] = left
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


# --- Arrows, for a structure of a size in m -------------------------------------------------------------------------


def arrow_steps(forces: FloatArray, largest: float, size: float) -> FloatArray:
    """Arrows of forces by their sizes over the largest, (n, 3) m from (n, 3) N; short ones of many."""
    sizes = np.linalg.norm(forces, axis=1, keepdims=True)
    longest = LONGEST if len(forces) <= MANY else LONGEST_OF_MANY
    lengths = size * np.maximum(longest * sizes / largest, min(SHORTEST, longest / 2))
    return np.asarray(forces * lengths / sizes)


def axles_near(marks: LoadMarks, points: FloatArray, size: float) -> BoolArray:
    """Axles off their path that are drawn: those further off than half the structure's size would shrink it.

    points : (n, 3) m, of the structure
    """
    low, high = points.min(axis=0) - BESIDE * size, points.max(axis=0) + BESIDE * size
    return np.asarray(np.all((marks.beside > low) & (marks.beside < high), axis=1))


def arrow_above(blocks: Blocks, marks: LoadMarks, top: float, size: float) -> tuple[FloatArray, FloatArray]:
    """Start and step of the arrow of an acceleration, (3,) m each, above the middle of what it accelerates."""
    step = LONGEST * size * marks.acceleration / np.linalg.norm(marks.acceleration)
    middle = np.append(blocks.centroids[marks.accelerated, :2].mean(axis=0), top)
    return middle - step * [0.5, 0.5, 1.0 if step[2] < 0 else 0.0], step


def settlement_arrow(vertices: FloatArray, way: FloatArray, size: float) -> tuple[FloatArray, FloatArray]:
    """Start and step of an arrow from the box around what gives way, away from its middle, (3,) m each.

    vertices : (n, 3) m, of what gives way; way : (3,) its mean motion, which is not zero
    """
    unit = way / np.linalg.norm(way)
    with np.errstate(divide="ignore"):
        reach = float(np.min(np.ptp(vertices, axis=0) / 2 / np.abs(unit)))
    middle = (vertices.min(axis=0) + vertices.max(axis=0)) / 2
    return middle + (reach + OFF * size) * unit, LONGEST * size * unit
