"""One half of a structure with a plane of symmetry, under associative flow."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions.mirror import Mirror
from mbla.program.reductions.restrict import block_matrix, chosen_limits, restricted
from mbla.program.reductions.scene import Scene


def half_of(scene: Scene, mirror: Mirror) -> Program:
    """The program with unknowns on one side of the plane: symmetric motions and symmetric forces.

    A point that stands for two has the force and the strength of both, and so moves as each of them does.
    """
    points = np.arange(len(mirror.point_of))
    kept = np.flatnonzero(points <= mirror.point_of)
    limits = chosen_limits(scene.program.limits, kept)
    stands_for = np.where(mirror.point_of[kept] == kept, 1.0, 2.0)
    limits = replace(
        limits,
        cohesion=stands_for * limits.cohesion,
        tension=stands_for * limits.tension,
        compression=stands_for * limits.compression,
    )
    half = restricted(scene.program, _symmetric_motions(mirror), _symmetric_forces(mirror), limits)
    return replace(half, halved=True)


def in_plane_directions(normal: FloatArray) -> FloatArray:
    """Two unit vectors across the normal, as near to the axes as may be, (2, 3)."""
    axis = np.eye(3)[np.abs(normal).argmin()]
    first = axis - (axis @ normal) * normal
    first = first / np.linalg.norm(first)
    return np.array([first, np.cross(normal, first)])


def in_plane_motions(normal: FloatArray) -> FloatArray:
    """Motions of a block that its mirror image repeats, (6, 3): two translations in the plane, rotation about m."""
    basis = np.zeros((6, 3))
    basis[:3, :2] = in_plane_directions(normal).T
    basis[3:, 2] = normal
    return basis


def _symmetric_motions(mirror: Mirror) -> sp.csr_array:
    """S, orthonormal columns: six for a pair of blocks, three for a block that the plane halves."""
    blocks = np.arange(len(mirror.block_of))
    first, alone = np.flatnonzero(blocks < mirror.block_of), np.flatnonzero(blocks == mirror.block_of)
    n, columns = len(blocks), np.arange(len(first))
    here = block_matrix(np.broadcast_to(np.eye(6), (len(first), 6, 6)), first, columns, (n, len(first)))
    images = np.broadcast_to(mirror.velocity_map, (len(first), 6, 6))
    there = block_matrix(images, mirror.block_of[first], columns, (n, len(first)))
    own = np.broadcast_to(in_plane_motions(mirror.normal), (len(alone), 6, 3))
    halved = block_matrix(own, alone, np.arange(len(alone)), (n, len(alone)))
    return sp.csr_array(sp.hstack([(here + there) / np.sqrt(2.0), halved]))


def _symmetric_forces(mirror: Mirror) -> sp.csr_array:
    """P: half of the force at a point and half at its image; at a point in the plane the mean of both."""
    points = np.arange(len(mirror.point_of))
    kept = np.flatnonzero(points <= mirror.point_of)
    partner, columns, shape = mirror.point_of[kept], np.arange(len(kept)), (len(points), len(kept))
    here = block_matrix(np.broadcast_to(0.5 * np.eye(3), (len(kept), 3, 3)), kept, columns, shape)
    return sp.csr_array(here + block_matrix(0.5 * mirror.force_maps[kept], partner, columns, shape))
