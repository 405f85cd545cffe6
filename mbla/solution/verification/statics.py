"""Statics and kinematics of the verification, written a second time on purpose, without the program stage.

Forces are summed over bodies and velocities taken from rigid-body motion directly, so that an error in the equilibrium
matrix that the solver used cannot hide here.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import Model


def bodies_of_points(contacts: Contacts) -> IntArray:
    """Bodies a and b of every contact point, (n_points, 2)."""
    return contacts.bodies[contacts.interface_of_point]


def contact_resultants(model: Model, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """Force and moment about the centroid that the contacts exert on each block, (n_blocks, 6) N, N m.

    contact_forces : (n_points, 3)  N, T1, T2, compression positive
    """
    n_blocks = len(model.blocks)
    bodies = bodies_of_points(contacts)
    force = np.einsum("pj,pjx->px", contact_forces, contacts.frames)
    total = np.zeros((n_blocks, 6))
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = np.flatnonzero(bodies[:, side] < n_blocks)
        block = bodies[here, side]
        arm = contacts.points[here] - model.blocks.centroids[block]
        on_block = sign * force[here]
        np.add.at(total, block, np.concatenate([on_block, np.cross(arm, on_block)], axis=1))
    return total


def contact_velocities(model: Model, contacts: Contacts, mechanism: FloatArray) -> FloatArray:
    """Velocity of body b relative to body a at every contact point in its frame, (n_points, 3), opening positive.

    mechanism : (n_blocks, 6)  velocity of the centroid and angular velocity
    """
    n_blocks = len(model.blocks)
    bodies = bodies_of_points(contacts)
    relative = np.zeros((len(bodies), 3))
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = np.flatnonzero(bodies[:, side] < n_blocks)
        block = bodies[here, side]
        arm = contacts.points[here] - model.blocks.centroids[block]
        motion = mechanism[block]
        relative[here] += sign * (motion[:, :3] + np.cross(motion[:, 3:], arm))
    return np.asarray(np.einsum("pjx,px->pj", contacts.frames, relative))


def power(load: FloatArray, mechanism: FloatArray) -> float:
    """Power of a load (n_blocks, 6) on a mechanism (n_blocks, 6)."""
    return float((load * mechanism).sum())
