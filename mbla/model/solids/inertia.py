"""Inertia of blocks and of the rigid bodies that they make.

The second moment of a block about its centroid c is the sum over tetrahedra from c to the triangles (c_f, p_i, p_i+1)
of its faces, about c each with the signed volume V and corners a, b, d (the fourth is c itself)::

    S = ∫ x xᵀ dV = Σ V/20 (a aᵀ + b bᵀ + d dᵀ + s sᵀ),    s = a + b + d

exact for planar faces. The inertia tensor is J = ρ (tr(S) 1 − S). A mass m that is carried at r from the mass centre
adds m (|r|² 1 − r rᵀ). Kinetic energy about the centroid, to which loads and velocities of the program belong, with d
from there to the mass centre::

    2 T = m |v + ω × d|² + ω·J ω = (v, ω)·M (v, ω),    M = [[m 1, −m [d]×], [m [d]×, J − m [d]×²]]
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import row_means, row_sums


@dataclass(frozen=True)
class Inertia:
    """Of n blocks or bodies, in the deck's units of mass and length, in the axes of the deck as built.

    masses  : (n,) kg, own and added
    arms    : (n, 3) m, from the centroid of the volume to the mass centre
    tensors : (n, 3, 3) kg m2, about the mass centre
    """

    masses: FloatArray
    arms: FloatArray
    tensors: FloatArray

    @cached_property
    def matrices(self) -> FloatArray:
        """M about the centroids, (n, 6, 6): momentum and angular momentum from velocity and angular velocity."""
        found = np.zeros((len(self.masses), 6, 6))
        lever = self.masses[:, None, None] * crossing(self.arms)
        found[:, :3, :3] = self.masses[:, None, None] * np.eye(3)
        found[:, :3, 3:], found[:, 3:, :3] = -lever, lever
        found[:, 3:, 3:] = self.tensors + of_points(self.masses, self.arms)
        return found

    def joined(self, label: IntArray, arms: FloatArray) -> Inertia:
        """Of rigid bodies.

        label : (n,) body of each block, numbered from 0 without gaps
        arms  : (n, 3) m, from the centroid of the body to that of the block
        """
        count = int(label.max(initial=-1)) + 1
        masses = summed(label, self.masses, count)
        centres = summed(label, self.masses[:, None] * (arms + self.arms), count)
        centres /= np.where(masses > 0.0, masses, 1.0)[:, None]
        off = arms + self.arms - centres[label]
        return Inertia(masses, centres, summed(label, self.tensors + of_points(self.masses, off), count))


def inertia_of(blocks: Blocks) -> Inertia:
    """Of blocks, each by itself; what a block carries counts at the centroid of that."""
    own = second_moments(blocks)
    tensors = blocks.densities[:, None, None] * (np.trace(own, axis1=1, axis2=2)[:, None, None] * np.eye(3) - own)
    arms = blocks.mass_centres - blocks.centroids
    tensors += of_points(blocks.volumes * blocks.densities, arms)
    tensors += of_points(blocks.added_masses, blocks.added_mass_points - blocks.mass_centres)
    return Inertia(blocks.masses, arms, tensors)


def second_moments(blocks: Blocks) -> FloatArray:
    """∫ x xᵀ dV of every block about its centroid, (n_blocks, 3, 3) m5."""
    about = blocks.vertices - blocks.centroids[blocks.block_of_vertex]
    tails, heads = about[blocks.loops], about[blocks.next_loops]
    centres = row_means(tails, blocks.loop_start)[blocks.face_of_corner]
    volumes = np.einsum("ij,ij->i", centres, np.cross(tails, heads)) / 6
    moments = np.zeros((len(volumes), 3, 3))
    for corner in (centres, tails, heads, centres + tails + heads):
        moments += corner[:, :, None] * corner[:, None, :]
    return row_sums(volumes[:, None, None] / 20 * moments, blocks.loop_start[blocks.face_start])


def of_points(masses: FloatArray, arms: FloatArray) -> FloatArray:
    """Inertia tensors of masses (n,) at distances (n, 3), each about the point that these start from, (n, 3, 3)."""
    squares = np.einsum("ij,ij->i", arms, arms)[:, None, None] * np.eye(3)
    return np.asarray(masses[:, None, None] * (squares - arms[:, :, None] * arms[:, None, :]))


def crossing(arms: FloatArray) -> FloatArray:
    """Matrices [a]× of vectors, (n, 3, 3): [a]× b = a × b."""
    return np.cross(arms[:, None, :], np.eye(3)).transpose(0, 2, 1)
