"""What the search for reductions examines: free blocks and contact points of a part, with their geometry.

Parts that cannot interact: free blocks connected through contacts; what does not move connects nothing.

No mechanism reaches from one part to another. Those with live load each have a load factor of their own, of which the
least is that of the structure. Those without cannot change it: they only have to carry their dead load, which is shown
apart.

Each part gets the mean dead load of its own blocks as its unit of force, as if it were alone: with forces x = f y and
velocities u = q/f the power of the live load stays what it was, and the load factor too. In the unit of a part a
million times as heavy all its loads would be rounding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.model.solids.measures import connected_labels
from mbla.program.program import Program
from mbla.program.reductions.restrict import chosen_limits, restricted, selection

COPLANAR = 1e-9
"""Relative to block size: distance up to which points count as in one plane or on one line."""

STRAIGHT_ON = 1e3 * COPLANAR
"""Sine of a turn that counts as none."""

SYMMETRIC = 1e-9
"""Relative to block size, and to the mean load of a block: deviation from symmetry that counts as rounding. The load
factor moves by no more than about that much."""

ROUNDED = 16.0 * float(np.finfo(np.float64).eps)
"""Rounding of a coordinate, relative to the distance from the origin: it moves faces and turns their normals."""


@dataclass(frozen=True)
class ProgramGeometry:
    """Free blocks and contact points of a spatial program, in the order of its rows and columns.

    centroids : (n_free, 3); arms : (n_free,) length of each block in the program's scaling
    points    : (n_points, 3); frames : (n_points, 3, 3); areas : (n_points,)
    bodies    : (n_points, 2) row of each free block, −1 for what does not move
    interfaces: (n_points,) number of the interface
    linked    : (m, 2) bodies, as above, that ties link besides those of their points
    linking   : (m,) these points
    allowed   : projector on the motions that guides allow, (6 n_free, 6 n_free) in the program's units; None for all
    cut       : (n_points,) side on which a load cell measures (:mod:`mbla.assembly.load_cell`); 0 without
    """

    program: Program
    centroids: FloatArray
    arms: FloatArray
    points: FloatArray
    frames: FloatArray
    areas: FloatArray
    bodies: IntArray
    interfaces: IntArray
    cut: IntArray
    linked: IntArray
    linking: IntArray
    allowed: sp.csr_array | None = None

    @property
    def refined_points(self) -> BoolArray:
        """Points of interfaces whose outline goes straight on at some of them, (n_points,)."""
        return refined(self.interfaces, self.points, self.frames[:, 0])

    @property
    def length(self) -> float:
        """Mean size of a block."""
        return float(self.arms.mean())

    @property
    def symmetric(self) -> float:
        """Deviation from symmetry that counts as rounding, relative to block size: more where coordinates are large."""
        far = float(np.abs(self.points).max(initial=0.0))
        return max(SYMMETRIC, ROUNDED * far / float(self.arms.min()))

    def loads(self) -> tuple[FloatArray, FloatArray]:
        """Dead and live load, (n_free, 6) each, non-dimensional."""
        return self.program.dead_load.reshape(-1, 6), self.program.live_load.reshape(-1, 6)


def scene_of(model: Model, contacts: Contacts, program: Program) -> ProgramGeometry:
    """The scene of the program of the full model."""
    row = np.full(len(model.blocks) + len(model.grounds), -1, dtype=np.int64)
    row[program.facts.free] = np.arange(len(program.facts.free))
    units = program.scaling.row.reshape(-1, 6)
    return ProgramGeometry(
        program=program,
        centroids=model.blocks.centroids[program.facts.free],
        arms=units[:, 0] / units[:, 3],
        points=contacts.points,
        frames=contacts.frames,
        areas=contacts.point_areas,
        bodies=row[contacts.bodies[contacts.interface_of_point]],
        interfaces=contacts.interface_of_point,
        cut=np.zeros(program.n_points, dtype=np.int64) if contacts.cut_of_point is None else contacts.cut_of_point,
        **_links(contacts, row),
        allowed=program.facts.allowed,
    )


def _links(contacts: Contacts, row: IntArray) -> dict[str, IntArray]:
    """Bodies that ties pull at, by their row, each with a free one of the two of its contact point."""
    none = np.zeros(0, dtype=np.int64)
    if contacts.ties is None:
        return {"linked": none.reshape(0, 2), "linking": none}
    points, others = contacts.ties.points, row[contacts.ties.bodies]
    ends = row[contacts.bodies[contacts.interface_of_point[points]]]
    return {"linked": np.column_stack([ends.max(axis=1), others]), "linking": points}


def part_of(scene: ProgramGeometry, program: Program, blocks: IntArray, points: IntArray) -> ProgramGeometry:
    """The scene of some of the blocks and points, with their own program.

    blocks : (n_chosen_blocks,) rows of free blocks in the scene, which get new ones in this order
    points : (n_chosen_points,) numbers of contact points
    """
    row = np.full(len(scene.centroids) + 1, -1, dtype=np.int64)  # the last entry answers for −1
    row[blocks] = np.arange(len(blocks))
    number = np.full(len(scene.points), -1, dtype=np.int64)
    number[points] = np.arange(len(points))
    own = number[scene.linking] >= 0
    return ProgramGeometry(
        program=program,
        centroids=scene.centroids[blocks],
        arms=scene.arms[blocks],
        points=scene.points[points],
        frames=scene.frames[points],
        areas=scene.areas[points],
        bodies=row[scene.bodies[points]],
        interfaces=scene.interfaces[points],
        cut=scene.cut[points],
        linked=row[scene.linked[own]],
        linking=number[scene.linking[own]],
        allowed=None if scene.allowed is None else _own(scene.allowed, blocks),
    )


def _own(allowed: sp.csr_array, blocks: IntArray) -> sp.csr_array | None:
    """The projector of some blocks, none of which belongs to a body with others; None where all motions are allowed."""
    rows = (6 * blocks[:, None] + np.arange(6)).ravel()
    own = sp.csr_array(allowed[rows][:, rows])
    return own if own.diagonal().sum() < len(rows) - 0.5 else None


def turns(scene: ProgramGeometry) -> FloatArray:
    """Sine of the turn to the left at each point of an interface, in their order, (n_points,)."""
    return _turns(scene.interfaces, scene.points, scene.frames[:, 0])


def refined(interfaces: IntArray, points: FloatArray, normals: FloatArray) -> BoolArray:
    """Which points (n_points, 3) are of interfaces whose outline goes straight on at some of them, (n_points,)."""
    straight = interfaces[np.abs(_turns(interfaces, points, normals)) <= STRAIGHT_ON]
    return np.asarray(np.isin(interfaces, straight))


def _turns(interfaces: IntArray, points: FloatArray, normals: FloatArray) -> FloatArray:
    """``turns`` of points (n_points, 3) with normals (n_points, 3)."""
    start = np.flatnonzero(np.diff(interfaces, prepend=-1))
    length = np.diff(np.append(start, len(interfaces)))
    place = np.arange(len(interfaces)) - np.repeat(start, length)
    after = np.repeat(start, length) + (place + 1) % np.repeat(length, length)
    before = np.repeat(start, length) + (place - 1) % np.repeat(length, length)
    inward, outward = points - points[before], points[after] - points
    turn = (np.cross(inward, outward) * normals).sum(axis=1)
    size = np.linalg.norm(inward, axis=1) * np.linalg.norm(outward, axis=1)
    return np.asarray(turn / np.maximum(size, 1e-300))


def part_of_blocks(scene: ProgramGeometry) -> IntArray:
    """Part that each free block belongs to, (n_free,), numbered in the order of first blocks."""
    n = len(scene.centroids)
    both = (scene.bodies >= 0).all(axis=1)
    pairs = np.vstack([scene.bodies[both], scene.linked[(scene.linked >= 0).all(axis=1)]])
    if scene.allowed is not None:  # blocks of one guided body
        pairs = np.vstack([pairs, np.column_stack(scene.allowed.nonzero()) // 6])
    measured = scene.bodies[scene.cut != 0].max(axis=1)  # by the load cell, which is the last block
    pairs = np.vstack([pairs, np.column_stack([measured, np.full(len(measured), n - 1)])])
    return connected_labels(pairs, n)


def split_into_parts(scene: ProgramGeometry) -> list[ProgramGeometry]:
    """Scenes that are solved one by one, in the order of their first blocks; the same scene where that is one."""
    label = part_of_blocks(scene)
    if not np.any(label):
        return [scene]
    label_of_point = label[scene.bodies.max(axis=1)]  # the greater body is free: fixed bodies have no contacts
    return [
        _alone(scene, np.flatnonzero(label == number), np.flatnonzero(label_of_point == number))
        for number in range(label.max() + 1)
    ]


def _alone(scene: ProgramGeometry, blocks: IntArray, points: IntArray) -> ProgramGeometry:
    """Some of the blocks with all their points, in their own unit of force."""
    unit = _unit_of_force(scene.loads()[0][blocks])
    program = restricted(
        scene.program,
        sp.csr_array(selection(blocks, len(scene.centroids), 6) / unit),
        sp.csr_array(selection(points, scene.program.n_points, 3) * unit),
        chosen_limits(scene.program.limits, points).scaled(1.0 / unit),
    )
    return part_of(scene, program, blocks, points)


def _unit_of_force(dead_load: FloatArray) -> float:
    """Mean dead load of the blocks that have one, (n_blocks, 6); the unit of the model where none has."""
    sizes = np.linalg.norm(dead_load, axis=1)
    return float(sizes[sizes > 0].mean()) if np.any(sizes > 0) else 1.0
