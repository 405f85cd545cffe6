"""Blocks carried along by a mechanism, for files and pictures: displacements to a scale that can be seen.

A mechanism has no size of its own. It is drawn so that the farthest corner moves by a tenth of the size of the part of
the model that can move, or the fastest block turns by half a radian, whichever comes first.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.blocks import Blocks
from mbla.model.model import Model
from mbla.results.results import CaseResult

SHARE_OF_SIZE = 0.1
"""largest displacement over the diagonal of the box around the free blocks"""
LARGEST_ROTATION = 0.5
"""radians; without this limit a small block that spins in a large model would turn several times"""


def drawn_motion(model: Model, case: CaseResult | None) -> FloatArray:
    """Displacement and rotation of each block as drawn, (n_blocks, 6) m and rad.

    From the mechanism; without equilibrium from the motion that proves it; zero where there is neither or no case.
    """
    if case is not None and case.solution.mechanics is not None:
        motion = case.solution.mechanics.mechanism
    elif case is not None and case.solution.certificate is not None:
        motion = case.solution.certificate
    else:
        return np.zeros((len(model.blocks), 6))
    return motion_scale(model, motion) * motion


def motion_scale(model: Model, motion: FloatArray) -> float:
    """Factor from velocities to displacements as drawn; 0 where nothing moves."""
    displacement = np.linalg.norm(vertex_displacements(model.blocks, motion), axis=1).max(initial=0.0)
    rotation = np.linalg.norm(motion[:, 3:], axis=1).max(initial=0.0)
    if displacement == 0.0:
        return 0.0
    scale = SHARE_OF_SIZE * movable_size(model) / displacement
    return float(min(scale, LARGEST_ROTATION / rotation) if rotation > 0 else scale)


def movable_size(model: Model) -> float:
    """Diagonal of the box around the free blocks, m."""
    free = ~model.fixed[model.blocks.block_of_vertex]
    vertices = model.blocks.vertices[free] if free.any() else model.blocks.vertices
    return float(np.linalg.norm(np.ptp(vertices, axis=0)))


def displacements_at(blocks: Blocks, motion: FloatArray, owners: IntArray, points: FloatArray) -> FloatArray:
    """Linearised displacement of points that belong to blocks, u + θ × (p − c), (n, 3) m."""
    arms = points - blocks.centroids[owners]
    return np.asarray(motion[owners, :3] + np.cross(motion[owners, 3:], arms))


def vertex_displacements(blocks: Blocks, motion: FloatArray) -> FloatArray:
    """Linearised displacement of every vertex, (n_vertices, 3) m."""
    return displacements_at(blocks, motion, blocks.block_of_vertex, blocks.vertices)


def contact_displacements(model: Model, contacts: Contacts, motion: FloatArray) -> FloatArray:
    """Mean displacement of the two bodies at every contact point, (n_points, 3) m; grounds do not move."""
    total = np.zeros_like(contacts.points)
    for side in (0, 1):
        owners = contacts.bodies[contacts.interface_of_point, side]
        block = owners < len(model.blocks)
        total[block] += displacements_at(model.blocks, motion, owners[block], contacts.points[block])
    return total / 2


def moved_vertices(blocks: Blocks, contacts: Contacts, motion: FloatArray) -> FloatArray:
    """Vertices after a finite motion, (n_vertices, 3) m; see ``moved_points``."""
    return moved_points(blocks, contacts, motion, blocks.block_of_vertex, blocks.vertices)


def moved_points(
    blocks: Blocks, contacts: Contacts, motion: FloatArray, owners: IntArray, points: FloatArray
) -> FloatArray:
    """Points of blocks after a finite motion, o + u + θ × (o − c) + exp(θ)(p − o), (n, 3) m. Blocks keep their shape.

    About the centroid of its own, o = c, a block would part from those it is glued to, for they turn about theirs: o
    is the centroid of the rigid body that they make.

    motion : (n_blocks, 6) displacement of the centroid m and rotation vector rad
    owners : (n,) block of each point
    """
    pivots = centres_of_bodies(blocks, contacts.solid_of_block)
    travel = motion[:, :3] + np.cross(motion[:, 3:], pivots - blocks.centroids)
    turned = np.einsum("vij,vj->vi", rotation_matrices(motion[:, 3:])[owners], points - pivots[owners])
    return np.asarray((pivots + travel)[owners] + turned)


def centres_of_bodies(blocks: Blocks, solid_of_block: IntArray | None) -> FloatArray:
    """Centroid of the rigid body that each block belongs to, (n_blocks, 3) m: its own where it is not glued.

    solid_of_block : (n_blocks,) numbers of the rigid bodies; None where each block is one
    """
    if solid_of_block is None:
        return blocks.centroids
    volumes = np.bincount(solid_of_block, weights=blocks.volumes)
    columns = [np.bincount(solid_of_block, weights=blocks.volumes * column) / volumes for column in blocks.centroids.T]
    return np.stack(columns, axis=1)[solid_of_block]


def moved_contact_points(model: Model, contacts: Contacts, motion: FloatArray, side: int) -> FloatArray:
    """Contact points after a finite motion as part of body a (side 0) or b (side 1), (n_points, 3) m."""
    owners = contacts.bodies[contacts.interface_of_point, side]
    block = owners < len(model.blocks)
    moved = contacts.points.copy()
    moved[block] = moved_points(model.blocks, contacts, motion, owners[block], contacts.points[block])
    return moved


def rotation_matrices(vectors: FloatArray) -> FloatArray:
    """Rotation matrices of rotation vectors, (n, 3, 3), by Rodrigues' formula I + sin θ K + (1 − cos θ) K²."""
    angles = np.linalg.norm(vectors, axis=1)
    axes = vectors / np.where(angles > 0, angles, 1.0)[:, None]
    cross = np.zeros((len(vectors), 3, 3))
    x, y, z = axes.T
    cross[:, 0, 1], cross[:, 0, 2], cross[:, 1, 2] = -z, y, -x
    cross -= cross.transpose(0, 2, 1)
    sine, versine = np.sin(angles)[:, None, None], (1 - np.cos(angles))[:, None, None]
    return np.asarray(np.eye(3) + sine * cross + versine * (cross @ cross))
