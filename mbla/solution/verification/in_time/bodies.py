"""Rigid bodies of a time history for the verification: their masses, second moments, places and velocities in a frame.

Second moments by the divergence theorem. With x from the centroid, x xᵀ is of the second degree and div(x xᵀ ⊗ x) is
five times it; on a plane x·n is constant, and the midpoints m of the edges of a triangle integrate what is quadratic::

    ∫ x xᵀ dV = 1/5 Σ over faces ∫ x xᵀ (x·n) dA = 1/5 Σ over triangles (p·a)/3 Σ m mᵀ

p is a corner of the triangle, a its area times the outward normal; a face is a fan of triangles from its first corner.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts, summed
from mbla.assembly.assembly import Assembly
from mbla.model.model import LoadCase, Model
from mbla.model.pose import Pose
from mbla.model.solids.blocks import Blocks


@dataclass(frozen=True)
class Solids:
    """Bodies of blocks that are glued, or rigid by the deck, and of every other block by itself; n of them.

    model   : of the load case
    label   : (n_blocks,) body of each block, numbered in the order of their first blocks
    first   : (n,) first block of each
    centres : (n, 3) m, mass centres as built, from which arms of contact points are taken
    masses  : (n,) force per acceleration
    tensors : (n, 3, 3) inertia about the mass centre, in the axes of the deck as built
    free    : (n,) those that can move
    sizes   : (n,) m, cube roots of their volumes
    """

    model: Model
    label: IntArray
    first: IntArray
    centres: FloatArray
    masses: FloatArray
    tensors: FloatArray
    free: BoolArray
    sizes: FloatArray

    def __len__(self) -> int:
        return len(self.masses)


def solids_of(assembly: Assembly, case: LoadCase) -> Solids:
    """The bodies of a load case with a time history."""
    model, history = assembly.model.of_case(case), case.time_history
    blocks, glue = model.blocks, assembly.contacts.solid_of_block
    label = np.arange(len(blocks)) if glue is None else glue
    label = _joined(label, () if history is None else history.rigid)
    first = np.unique(label, return_index=True)[1]
    count, unit = len(first), model.units.force_per_mass_acceleration
    own = blocks.volumes * blocks.densities
    volumes = summed(label, blocks.volumes, count)
    masses = summed(label, own + blocks.added_masses, count)
    places = summed(label, blocks.volumes[:, None] * blocks.centroids, count) / volumes[:, None]
    moments = own[:, None] * blocks.centroids + blocks.added_masses[:, None] * blocks.added_mass_points
    heavy = masses > 0.0
    centres = np.where(heavy[:, None], summed(label, moments, count) / np.where(heavy, masses, 1.0)[:, None], places)
    second = blocks.densities[:, None, None] * second_moments(blocks)
    for mass, at in ((own, blocks.centroids), (blocks.added_masses, blocks.added_mass_points)):
        arm = at - centres[label]
        second += mass[:, None, None] * arm[:, :, None] * arm[:, None, :]
    second = summed(label, second, count)
    tensors = np.trace(second, axis1=1, axis2=2)[:, None, None] * np.eye(3) - second
    held = np.zeros(count, dtype=bool)
    held[label[model.fixed]] = True
    return Solids(model, label, first, centres, unit * masses, unit * tensors, ~held, np.cbrt(volumes))


def _joined(label: IntArray, groups: Iterable[IntArray]) -> IntArray:
    """Bodies where the blocks of each group are one as well, numbered in the order of their first blocks."""
    label = label.copy()
    for group in groups:
        label[np.isin(label, label[group])] = label[group].min(initial=len(label))
    _, first, back = np.unique(label, return_index=True, return_inverse=True)
    return np.asarray(np.argsort(np.argsort(first))[back.ravel()], dtype=np.int64)


def second_moments(blocks: Blocks) -> FloatArray:
    """∫ x xᵀ dV about the centroid of each block, (n_blocks, 3, 3)."""
    sizes = np.diff(blocks.loop_start)
    face = np.repeat(np.arange(len(sizes)), sizes - 2)
    within = np.arange(len(face)) - starts(sizes - 2)[face] + 1
    block = blocks.block_of_face[face]
    p, q, r = (
        blocks.vertices[blocks.loops[blocks.loop_start[face] + at]] - blocks.centroids[block]
        for at in (np.zeros_like(within), within, within + 1)
    )
    through = np.einsum("ij,ij->i", p, np.cross(q - p, r - p)) / 30.0  # p·a/3/5, with a half of the product
    total = np.zeros((len(face), 3, 3))
    for middle in ((p + q) / 2.0, (q + r) / 2.0, (r + p) / 2.0):
        total += middle[:, :, None] * middle[:, None, :]
    return summed(block, through[:, None, None] * total, len(blocks))


def rotations_of(turns: FloatArray) -> FloatArray:
    """Matrices of rotation vectors, (n, 3, 3) from (n, 3), by the quaternions (cos θ/2, sin θ/2 of the axis).

    That is (w² − q·q) 1 + 2 q qᵀ + 2 w [q]×.
    """
    half = np.sqrt((turns**2).sum(axis=1)) / 2.0
    w, q = np.cos(half), np.sinc(half / np.pi)[:, None] * turns / 2.0
    found = 2.0 * q[:, :, None] * q[:, None, :]
    for axis, (i, j) in enumerate(((1, 2), (2, 0), (0, 1))):
        found[:, axis, axis] += w**2 - (q**2).sum(axis=1)
        found[:, j, i] += 2.0 * w * q[:, axis]
        found[:, i, j] -= 2.0 * w * q[:, axis]
    return np.asarray(found)


@dataclass(frozen=True)
class MovedSolids:
    """Bodies at the poses of their blocks: blocks move by shifts (n_blocks, 3) m and turn by vectors (n_blocks, 3)."""

    solids: Solids
    shifts: FloatArray
    turns: FloatArray

    @cached_property
    def pose(self) -> Pose:
        """Of the blocks."""
        return Pose(self.shifts, rotations_of(self.turns))

    @cached_property
    def rotations(self) -> FloatArray:
        """Of the bodies, (n, 3, 3)."""
        return self.pose.rotation[self.solids.first]

    @cached_property
    def centres(self) -> FloatArray:
        """Where the mass centres are, (n, 3)."""
        first = self.solids.first
        arms = self.solids.centres - self.solids.model.blocks.centroids[first]
        return np.asarray(self.block_centroids[first] + np.einsum("nij,nj->ni", self.rotations, arms))

    @cached_property
    def block_centroids(self) -> FloatArray:
        """Where the centroids of the blocks are, (n_blocks, 3)."""
        return self.solids.model.blocks.centroids + self.shifts

    def points(self, bodies: IntArray, arms: FloatArray) -> FloatArray:
        """Where material points of bodies are, (m, 3); bodies beyond the last are grounds, whose points stay."""
        found = arms.copy()
        on = bodies < len(self.solids)
        own = bodies[on]
        found[on] = self.centres[own] + np.einsum("nij,nj->ni", self.rotations[own], arms[on])
        return found

    def turned(self, bodies: IntArray, frames: FloatArray) -> FloatArray:
        """Frames (m, 3, 3) that turn with bodies."""
        found = frames.copy()
        on = bodies < len(self.solids)
        found[on] = np.einsum("nij,nkj->nki", self.rotations[bodies[on]], frames[on])
        return found

    def velocities(self, bodies: IntArray, points: FloatArray, motion: FloatArray) -> FloatArray:
        """Of bodies at points, (m, 3), where their blocks have the velocities (n_blocks, 6)."""
        found = np.zeros((len(bodies), 3))
        on = bodies < len(self.solids)
        block = self.solids.first[bodies[on]]
        own = motion[block]
        found[on] = own[:, :3] + np.cross(own[:, 3:], points[on] - self.block_centroids[block])
        return found

    def apart(self) -> float:
        """Largest distance of blocks from where their bodies take them, or turn beyond theirs, over size and 1."""
        blocks, body = self.solids.model.blocks, self.solids.label
        first = self.solids.first[body]
        turn = self.rotations[body]
        there = self.block_centroids[first]
        there = there + np.einsum("nij,nj->ni", turn, blocks.centroids - blocks.centroids[first])
        off = np.linalg.norm(self.block_centroids - there, axis=1) / self.solids.sizes[body]
        turned = np.abs(self.pose.rotation - turn).max(axis=(1, 2), initial=0.0)
        return float(np.max([off, turned], initial=0.0))


TURNS = 4
"""Times that an angular velocity is found again with the inertia half a step before; each gains a factor h ω."""

SETTLED = 1e-13
"""Change of the turn in a step by which it does not change any more, rad."""


def spins_before(solids: Solids, moved: MovedSolids, angular: FloatArray, before: float) -> FloatArray:
    """Angular velocities, (n, 3), of momenta before a step, (n, 3), by the inertia half of the step before it ago.

    before : length of that step
    """
    found = np.zeros_like(angular)
    can = solids.free & (solids.masses > 0.0)
    turn, tensors = moved.rotations[can], solids.tensors[can]
    back = turn
    for _ in range(TURNS):
        inertia = back @ tensors @ back.transpose(0, 2, 1)
        spins: FloatArray = np.asarray(np.linalg.solve(inertia, angular[can, :, None])[:, :, 0], dtype=np.float64)
        settled = bool((np.abs(spins - found[can]) * before <= SETTLED).all())
        found[can] = spins
        if settled:
            break
        back = rotations_of(-spins * before / 2.0) @ turn
    return found
