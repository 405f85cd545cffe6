"""Guides: blocks that may move in given ways only, each by itself or several as one rigid body.

A guided body has up to five independent motions, its ways. In way j block b of the body moves with velocity and angular
velocity (v, ω) about its centroid, row :math:`motions[., :, j]`. What the body may do is any sum of its ways; the
support takes every force and moment that does no work in them. So loads and contact forces f of the body are in
equilibrium where Σ_b motionsᵀ f_b = 0, one equation a way.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray

WAYS = 6
"""columns of the motions of a body; those beyond its own ways are zero"""

INDEPENDENT = 1e-9
"""Least singular value, over the largest, of ways that count as independent; lengths in units of the body's size."""


@dataclass(frozen=True)
class Guides:
    """Guided blocks, in the deck's units.

    blocks  : (m,) guided blocks, each once
    bodies  : (m,) number of the rigid body that each belongs to, from 0, ascending
    motions : (m, 6, 6) velocity (3) and angular velocity (3) about the centroid of the block in every way of its body;
              columns beyond the ways of the body are zero
    words   : the guides in words, for the listing
    """

    blocks: IntArray
    bodies: IntArray
    motions: FloatArray
    words: tuple[str, ...] = ()

    def __len__(self) -> int:
        return len(self.blocks)

    @property
    def n_bodies(self) -> int:
        """Guided rigid bodies."""
        return int(self.bodies.max(initial=-1)) + 1


NO_GUIDES = Guides(np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64), np.zeros((0, 6, WAYS)))


def joined(first: Guides, second: Guides) -> Guides:
    """Both; the blocks of the second leave the first."""
    kept = ~np.isin(first.blocks, second.blocks)
    _, bodies = np.unique(first.bodies[kept], return_inverse=True)
    n = int(bodies.max(initial=-1)) + 1
    return Guides(
        np.concatenate([first.blocks[kept], second.blocks]),
        np.concatenate([bodies.astype(np.int64), n + second.bodies]),
        np.concatenate([first.motions[kept], second.motions]),
        (*first.words, *second.words),
    )


def held_components(fixed: BoolArray, count: int) -> FloatArray:
    """Motions of blocks of which some components are held, (count, 6, 6).

    fixed : (6,) x, y, z, rotation about x, y, z through the centroid
    """
    ways = np.zeros((6, WAYS))
    free = np.flatnonzero(~fixed)
    ways[free, np.arange(len(free))] = 1.0
    return np.broadcast_to(ways, (count, 6, WAYS)).copy()


def slide(direction: FloatArray, count: int) -> FloatArray:
    """Velocity along a unit direction, (count, 6)."""
    return np.broadcast_to(np.concatenate([direction, np.zeros(3)]), (count, 6)).copy()


def turn(axis: FloatArray, about: FloatArray, centroids: FloatArray) -> FloatArray:
    """Unit rotation about an axis through a point, (n, 6), of blocks with these centroids, (n, 3)."""
    velocity = np.cross(axis, centroids - about)
    return np.hstack([velocity, np.broadcast_to(axis, velocity.shape)])


def rigid_motions(centre: FloatArray, centroids: FloatArray) -> FloatArray:
    """The six motions of a body about a point as motions of its blocks, (n, 6, 6)."""
    motions = np.zeros((len(centroids), 6, 6))
    for axis, unit in enumerate(np.eye(3)):
        motions[:, :, axis] = slide(unit, len(centroids))
        motions[:, :, 3 + axis] = turn(unit, centre, centroids)
    return motions
