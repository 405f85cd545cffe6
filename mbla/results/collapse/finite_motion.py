"""A mechanism carried on to a finite motion in which parts stay together at their hinges and on what they slide along.

Blocks that each follow their own screw keep their shape, but the velocities of a mechanism fit each other only at its
beginning: after a finite turn the parts on both sides of a hinge have come apart, by the square of the angle. From the
screws as a start the parts are therefore moved as little as brings them together again: in the sense of least squares
the contact points that do not move against each other coincide, and those that slide stay in contact (Gauss-Newton with
the damping of Levenberg, so that the motion of the mechanism itself stays as large as it was).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.results.collapse.motion import (
    drawn_motion,
    movable_size,
    moved_vertices,
    rotation_vectors,
    screw_matrices,
    screws,
)
from mbla.results.collapse.rigid_parts import rigid_parts
from mbla.results.results import CaseResult
from mbla.solution.verification.statics import contact_velocities

AT_REST = 1e-3
"""contact velocity over the largest up to which two parts do not move against each other at a point"""
MOST_PARTS = 500
"""of more parts, each a block or two, every one follows its own screw: their gaps are too small to be seen"""
DAMPING = 0.1
"""of the steps, over the size of what moves: with 0.01 a facade of 117 parts, many of them loose, went astray"""
MOST_STEPS = 10
FURTHEST = 0.5
"""way from the screws to where parts stay together, over that from rest, up to which that is taken"""
CLOSED = 1e-4
"""step over that size after which nothing moves any more"""


_Leads: TypeAlias = "dict[int, tuple[FloatArray, FloatArray]]"


@dataclass(frozen=True)
class _Pose:
    """Where parts are: rotation and place of a point of each, which was at ``origins``, (n_parts, ...)."""

    origins: FloatArray
    rotations: FloatArray
    places: FloatArray

    def arms(self, parts: IntArray, points: FloatArray) -> FloatArray:
        """From the place of its part to each point as moved, (n, 3) m."""
        return np.asarray(np.einsum("nij,nj->ni", self.rotations[parts], points - self.origins[parts]))

    def turned(self, turns: FloatArray, steps: FloatArray) -> _Pose:
        """After further rotation vectors about the places, and displacements of these; (n_parts, 3) each."""
        return replace(self, rotations=screw_matrices(turns)[0] @ self.rotations, places=self.places + steps)


@dataclass(frozen=True)
class _Joints:
    """Contact points between parts that are to stay together; part 0 is at rest.

    parts   : (n, 2) of bodies a and b
    points  : (n, 3) m
    normals : (n, 3) from a to b
    slides  : (n,) points that stay in contact only; the others coincide
    """

    parts: IntArray
    points: FloatArray
    normals: FloatArray
    slides: BoolArray


def finite_motion(model: Model, contacts: Contacts, case: CaseResult | None, scale: float = 1.0) -> FloatArray:
    """Displacement and rotation vector of each block, (n_blocks, 6) m and rad, of the mechanism of a case as drawn.

    ``mbla.results.collapse.motion.moved_points`` carries points along it. Zero where there is no motion.

    model : as it may move under the load case
    scale : multiple of the usual size
    """
    motion = scale * drawn_motion(model, case)
    settlement = None if case is None else case.load_case.settlement
    led = np.zeros(0, dtype=np.int64) if settlement is None else settlement.blocks
    return closed_motion(model, contacts, motion, led)


def closed_motion(model: Model, contacts: Contacts, motion: FloatArray, led: IntArray) -> FloatArray:
    """A finite motion, (n_blocks, 6) m and rad, near that of screws, in which hinges and sliding joints stay closed.

    That of the screws where there is none near: a mechanism need not reach as far as its picture is to show it.

    motion : (n_blocks, 6) displacements and rotations, velocities of a mechanism times a factor
    led    : blocks whose parts keep to their screws, as supports that give way do, and go along them as far as fits
    """
    parts = rigid_parts(model, contacts, motion)
    count = int(parts.max(initial=0)) + 1
    if not 2 < count <= MOST_PARTS:
        return motion
    joints = _joints(model, contacts, motion, parts)
    size = movable_size(model)
    start = _pose(model, motion, parts, count)
    pose, leads = start, _leads(model, motion, parts, led)
    for _ in range(MOST_STEPS):
        turns, steps = _step(joints, pose, leads, size)
        pose = pose.turned(turns, steps)
        if max(size * np.abs(turns).max(initial=0.0), np.abs(steps).max(initial=0.0)) <= CLOSED * size:
            break
    closed = _moved_with_parts(model, motion, parts, start, pose)
    before, after = moved_vertices(model.blocks, motion), moved_vertices(model.blocks, closed)
    further = np.linalg.norm(after - before, axis=1).max()
    far = np.linalg.norm(before - model.blocks.vertices, axis=1).max()
    return closed if further <= FURTHEST * far else motion


def _leads(model: Model, motion: FloatArray, parts: IntArray, led: IntArray) -> _Leads:
    """Parts that keep to a screw: a point that is carried along it and its twist there, (3,) m and (6,)."""
    return {int(parts[block]): (model.blocks.centroids[block], motion[block]) for block in led if parts[block] > 0}


def _joints(model: Model, contacts: Contacts, motion: FloatArray, parts: IntArray) -> _Joints:
    bodies = contacts.bodies[contacts.interface_of_point]
    of_bodies = np.append(parts, np.zeros(len(model.grounds), dtype=np.int64))[bodies]
    velocities = contact_velocities(model, contacts, motion)
    speed = np.linalg.norm(velocities, axis=1)
    slow = AT_REST * speed.max(initial=0.0)
    still, closed = speed <= slow, velocities[:, 0] <= slow
    chosen = (of_bodies[:, 0] != of_bodies[:, 1]) & (still | closed)
    return _Joints(of_bodies[chosen], contacts.points[chosen], contacts.frames[chosen, 0], ~still[chosen])


def _pose(model: Model, motion: FloatArray, parts: IntArray, count: int) -> _Pose:
    """Of parts as their first blocks move along their screws; part 0 stays."""
    rotations, travel = screws(motion)
    first = np.array([np.argmax(parts == part) for part in range(count)])
    origins = model.blocks.centroids[first]
    rotations, places = rotations[first], origins + travel[first]
    rotations[0], places[0] = np.eye(3), origins[0]
    return _Pose(origins, rotations, places)


def _ways(pose: _Pose, leads: _Leads, size: float) -> sp.csr_array:
    """From what is free to displacements and rotations times size, (6 n_parts, n_free).

    Part 0 has nothing free, one that is led the advance along its screw, any other all six.
    """
    count = 6 * len(pose.places)
    if not leads:
        return sp.eye_array(count, count - 6, k=-6, format="csr")
    ways = sp.lil_array((count, count))
    free = np.arange(count) >= 6
    ways.setdiag(1.0)
    for part, (point, twist) in leads.items():
        step = twist[:3] + np.cross(twist[3:], pose.places[part] - point)
        way = np.append(step, size * twist[3:])
        rows = slice(6 * part, 6 * part + 6)
        ways[rows, rows] = 0.0
        ways[rows, 6 * part] = way / np.linalg.norm(way)
        free[6 * part + 1 : 6 * part + 6] = False
    return sp.csr_array(ways)[:, free]


def _step(joints: _Joints, pose: _Pose, leads: _Leads, size: float) -> tuple[FloatArray, FloatArray]:
    """Rotations and displacements of the parts, (n_parts, 3) each, that close gaps."""
    arms = [pose.arms(joints.parts[:, side], joints.points) for side in (0, 1)]
    gaps = (pose.places[joints.parts[:, 1]] + arms[1]) - (pose.places[joints.parts[:, 0]] + arms[0])
    normals = np.einsum("nij,nj->ni", pose.rotations[joints.parts[:, 0]], joints.normals)
    coincide, touch = np.flatnonzero(~joints.slides), np.flatnonzero(joints.slides)
    rows = np.concatenate([np.repeat(coincide, 3), touch])
    ways = np.vstack([np.tile(np.eye(3), (len(coincide), 1)), normals[touch]])
    entries, columns = [], []
    for sign, side in ((-1.0, 0), (1.0, 1)):
        arm = arms[side][rows]
        entries.append(sign * np.hstack([ways, np.cross(arm, ways) / size]))  # w · (φ × r) = φ · (r × w)
        columns.append(6 * joints.parts[rows, side][:, None] + np.arange(6))
    count = 6 * len(pose.places)
    index = np.repeat(np.arange(len(rows))[:, None], 12, axis=1)
    matrix = sp.csr_array(
        (np.hstack(entries).ravel(), (index.ravel(), np.hstack(columns).ravel())), shape=(len(rows), count)
    )
    from scipy.sparse.linalg import spsolve

    along = _ways(pose, leads, size)
    matrix = matrix @ along
    normal = sp.csc_array(matrix.T @ matrix + DAMPING**2 * sp.eye_array(matrix.shape[1]))
    found = along @ spsolve(normal, -(matrix.T @ np.einsum("ni,ni->n", ways, gaps[rows])))
    found = found.reshape(-1, 6)
    return found[:, 3:] / size, found[:, :3]


def _moved_with_parts(model: Model, motion: FloatArray, parts: IntArray, start: _Pose, end: _Pose) -> FloatArray:
    """The motion of blocks that went along their screws and then with their parts from one pose to another."""
    rotations, travel = screws(motion)
    centroids = model.blocks.centroids
    further = (end.rotations @ start.rotations.transpose(0, 2, 1))[parts]
    arms = centroids + travel - start.places[parts]
    travel = end.places[parts] + np.einsum("nij,nj->ni", further, arms) - centroids
    vectors = rotation_vectors(further @ rotations)
    moved = np.hstack([np.linalg.solve(screw_matrices(vectors)[1], travel[:, :, None])[:, :, 0], vectors])
    return np.where((parts > 0)[:, None], moved, motion)
