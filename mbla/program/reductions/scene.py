"""What the search for reductions looks at: free blocks and contact points of a part, with their geometry."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.process.sharing import shared
from mbla.program.program import Program

COPLANAR = 1e-9
"""Relative to block size: distance up to which points count as in one plane or on one line."""

STRAIGHT_ON = 1e3 * COPLANAR
"""Sine of a turn that counts as none."""


@dataclass(frozen=True)
class Scene:
    """Free blocks and contact points of a spatial program, in the order of its rows and columns.

    centroids : (n_free, 3); arms : (n_free,) length of each block in the program's scaling
    points    : (n_points, 3); frames : (n_points, 3, 3); areas : (n_points,)
    bodies    : (n_points, 2) row of each free block, −1 for what does not move
    interfaces: (n_points,) number of the interface
    refined   : (n_points,) points of interfaces with more points than corners, where that can no longer be seen from
                their outlines; None where it can
    allowed   : projector on the motions that guides allow, (6 n_free, 6 n_free) in the program's units; None for all
    """

    program: Program
    centroids: FloatArray
    arms: FloatArray
    points: FloatArray
    frames: FloatArray
    areas: FloatArray
    bodies: IntArray
    interfaces: IntArray
    allowed: sp.csr_array | None = None
    refined: BoolArray | None = None

    @property
    def refined_points(self) -> BoolArray:
        """Points of interfaces whose outline goes straight on at some of them, (n_points,)."""
        if self.refined is not None:
            return self.refined
        straight = self.interfaces[np.abs(turns(self)) <= STRAIGHT_ON]
        return np.asarray(np.isin(self.interfaces, straight))

    @property
    def length(self) -> float:
        """Mean size of a block."""
        return float(self.arms.mean())

    def loads(self) -> tuple[FloatArray, FloatArray]:
        """Dead and live load, (n_free, 6) each, non-dimensional."""
        return self.program.dead_load.reshape(-1, 6), self.program.live_load.reshape(-1, 6)


def scene_of(model: Model, contacts: Contacts, program: Program) -> Scene:
    """The scene of the program of the whole model."""
    row = np.full(len(model.blocks) + len(model.grounds), -1, dtype=np.int64)
    row[program.free] = np.arange(len(program.free))
    units = program.scaling.row.reshape(-1, 6)
    return Scene(
        program=program,
        centroids=model.blocks.centroids[program.free],
        arms=units[:, 0] / units[:, 3],
        points=contacts.points,
        frames=contacts.frames,
        areas=contacts.point_areas,
        bodies=row[contacts.bodies[contacts.interface_of_point]],
        interfaces=contacts.interface_of_point,
        allowed=program.allowed,
    )


def part_of(scene: Scene, program: Program, blocks: IntArray, points: IntArray) -> Scene:
    """The scene of some of the blocks and points, with their own program."""
    row = np.full(len(scene.centroids) + 1, -1, dtype=np.int64)  # the last entry answers for −1
    row[blocks] = np.arange(len(blocks))
    return Scene(
        program=program,
        centroids=scene.centroids[blocks],
        arms=scene.arms[blocks],
        points=scene.points[points],
        frames=scene.frames[points],
        areas=scene.areas[points],
        bodies=row[scene.bodies[points]],
        interfaces=scene.interfaces[points],
        refined=None if scene.refined is None else scene.refined[points],
        allowed=None if scene.allowed is None else _own(scene.allowed, blocks),
    )


def _own(allowed: sp.csr_array, blocks: IntArray) -> sp.csr_array | None:
    """The projector of some blocks, none of which belongs to a body with others; None where all motions are allowed."""
    rows = (6 * blocks[:, None] + np.arange(6)).ravel()
    own = sp.csr_array(allowed[rows][:, rows])
    return own if own.diagonal().sum() < len(rows) - 0.5 else None


def turns(scene: Scene) -> FloatArray:
    """Sine of the turn to the left at each point of an interface, in their order, (n_points,)."""
    return _turns(scene.interfaces, scene.points, scene.frames[:, 0])


@shared("turns")
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
