"""The equilibrium matrix: forces and moments of the contact forces on the free blocks."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model
from mbla.process.sharing import shared


def equilibrium_matrix(model: Model, contacts: Contacts, free: IntArray) -> sp.csr_array:
    """A, (6 n_free, 3 n_points), in the deck's units: A x is the resultant of contact forces x about the centroids.

    Columns 3 k + j belong to component j (N, T1, T2) of point k, which pushes body b along row j of its frame and
    body a against it; moments are (point − centroid) × force.
    """
    n_bodies = len(model.blocks) + len(model.grounds)
    bodies = contacts.bodies[contacts.interface_of_point]
    return _matrix(n_bodies, model.blocks.centroids, bodies, contacts.points, contacts.frames, free)


@shared("equilibrium")
def _matrix(
    n_bodies: int, centroids: FloatArray, bodies: IntArray, points: FloatArray, frames: FloatArray, free: IntArray
) -> sp.csr_array:
    """``equilibrium_matrix``; bodies (n_points, 2)."""
    row_of_block = np.full(n_bodies, -1, dtype=np.int64)
    row_of_block[free] = np.arange(len(free))
    n_points = len(bodies)
    columns = np.broadcast_to((3 * np.arange(n_points)[:, None] + np.arange(3))[:, :, None], (n_points, 3, 6))

    values, rows, cols = [], [], []
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = row_of_block[bodies[:, side]] >= 0
        block = bodies[here, side]
        force = sign * frames[here]
        arm = points[here] - centroids[block]
        moment = np.cross(arm[:, None, :], force)
        values.append(np.concatenate([force, moment], axis=2).ravel())
        first_row = 6 * row_of_block[block]
        rows.append(np.broadcast_to(first_row[:, None, None] + np.arange(6), (len(block), 3, 6)).ravel())
        cols.append(columns[here].ravel())
    shape = (6 * len(free), 3 * n_points)
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(cols)))
    return sp.csr_array(sp.coo_array(entries, shape=shape))


def lever_arms(model: Model, contacts: Contacts, free: IntArray) -> FloatArray:
    """Mean distance of contact points from the centroid of each free block, its size where it has none, (n_free,)."""
    bodies = contacts.bodies[contacts.interface_of_point]
    return _arms(model.blocks.centroids, model.blocks.sizes, bodies, contacts.points, free)


def _arms(centroids: FloatArray, sizes: FloatArray, bodies: IntArray, points: FloatArray, free: IntArray) -> FloatArray:
    """``lever_arms`` of blocks with centroids (n_blocks, 3); bodies (n_points, 2)."""
    n_blocks = len(centroids)
    total, count = np.zeros(n_blocks), np.zeros(n_blocks)
    for side in (0, 1):
        here = bodies[:, side] < n_blocks
        block = bodies[here, side]
        arm = np.linalg.norm(points[here] - centroids[block], axis=1)
        total += np.bincount(block, arm, n_blocks)
        count += np.bincount(block, minlength=n_blocks)
    mean = np.divide(total, count, out=sizes.copy(), where=count > 0)
    return np.asarray(mean[free])
