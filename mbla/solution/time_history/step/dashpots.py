"""Dashpots of joints: they act while a joint is closed.

A point of stiffness k whose motion, with the masses on both sides, has the mean inverse mass w swings with √(k w). Its
dashpot has a share ξ_c of critical damping; all joints have one more, of a share ξ at the first period ω₁::

    β = 2 ξ_c/√(k_N w) + 2 ξ/ω₁,   w the mean over its directions of the diagonal of Aᵀ M⁻¹ A
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import ArpackError, eigsh

from mbla.arrays import FloatArray
from mbla.solution.pushover.pose.moved_joints import JointsAt, MovedJoints
from mbla.solution.time_history.step.moving_bodies import MovingBodies

DENSE = 60
"""Unknowns up to which all periods are found at once."""

SHIFT = 1e-6
"""Of the mean stiffness of a row over its mass, by which the search for the first period starts below zero."""


def dashpots_of(bodies: MovingBodies, joints: MovedJoints, at: JointsAt, of_all: float) -> FloatArray:
    """β of each point of the program, (n_points,) s; ties have that of all alone.

    of_all : 2 ξ/ω₁
    """
    inverse = _inverse_masses(bodies, joints, at)
    matrix = at.joints.program.equilibrium_matrix
    by_component = np.asarray(matrix.multiply(inverse @ matrix).sum(axis=0)).ravel()
    w = by_component.reshape(-1, joints.components).mean(axis=1)
    stiffness = at.joints.normal * joints.length
    moves = (w > 0.0) & ~joints.is_tie
    rate = np.sqrt(np.where(moves, stiffness * w, 1.0))
    own = np.where(moves, 2.0 * bodies.history.contact_damping / rate, 0.0)
    return np.asarray(own + of_all)


def first_period(bodies: MovingBodies, joints: MovedJoints, at: JointsAt, presses: FloatArray) -> float:
    """T₁, s, of small motions about a pose, by the joints that press there; nan where nothing holds the bodies.

    presses : (n_points,) of the program, 0 or 1
    """
    matrix = at.joints.program.equilibrium_matrix
    stiffness = np.column_stack([at.joints.normal] + [at.joints.shear] * (joints.components - 1)) * joints.length
    springs = sp.diags_array((stiffness * presses[:, None]).ravel())
    k = sp.csc_array(matrix @ springs @ matrix.T)
    m = sp.csc_array(joints.masses.pattern.filled(_mass_entries(bodies, joints, at)))
    if not k.shape[0]:
        return np.nan
    square = _least(k, m)
    return 2.0 * np.pi / np.sqrt(square) if square > 0.0 else np.nan


def _least(k: sp.csc_array, m: sp.csc_array) -> float:
    """The least ω² of K φ = ω² M φ."""
    if k.shape[0] <= DENSE:
        import scipy.linalg  # late: large structures do without

        return float(scipy.linalg.eigh(k.toarray(), m.toarray(), eigvals_only=True)[0])
    below = -SHIFT * float((k.diagonal() / m.diagonal()).mean())
    start = np.ones(k.shape[0])
    try:
        return float(eigsh(k, 1, m, sigma=below, v0=start, return_eigenvectors=False)[0])
    except (ArpackError, RuntimeError):
        return np.nan


def _mass_entries(bodies: MovingBodies, joints: MovedJoints, at: JointsAt) -> FloatArray:
    free = joints.full.facts.free
    matrices = np.zeros((len(free), 6, 6))
    matrices[:, [0, 1, 2], [0, 1, 2]] = bodies.masses[free, None]
    matrices[:, 3:, 3:] = bodies.tensors_at(at.pose.rotation)[free]
    return joints.masses.entries(matrices)


def _inverse_masses(bodies: MovingBodies, joints: MovedJoints, at: JointsAt) -> sp.csr_array:
    pattern = joints.masses.pattern
    inverses = pattern.inverses(_mass_entries(bodies, joints, at))
    rows, columns, values = [], [], []
    for (own, _), inverse in zip(pattern.sets, inverses, strict=True):
        rows.append(np.broadcast_to(own[:, :, None], inverse.shape).ravel())
        columns.append(np.broadcast_to(own[:, None, :], inverse.shape).ravel())
        values.append(inverse.ravel())
    places = np.concatenate(rows), np.concatenate(columns)
    return sp.csr_array(sp.coo_array((np.concatenate(values), places), shape=pattern.matrix.shape))
