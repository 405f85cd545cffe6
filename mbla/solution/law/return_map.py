"""The law of elastic joints as a return map: forces from trial forces, and how they change with these.

From what it remembers, n̄ and t̄, a joint that moves by v over a time h would go without the law to the trial forces
a = n̄ − k_N h v_N and τ = t̄ − k_T h v_T. With dilatancy δ = tan ψ, and s = δ k_N/k_T::

    stick   n = a,                                   t = τ            where ‖τ‖ ≤ μ n + c
    slip    n = (a + s (‖τ‖ − c)) / (1 + s μ),       t = (μ n + c) θ,  θ = τ/‖τ‖
    and n within −f_t … f_c in both: open at the one end, crushing at the other

The tangents are consistent with it (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X). They are symmetric where
s = μ only: without dilatancy sliding depends on the normal force, not the other way round.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.solution.law.elastic_joints import ElasticJoints, lengths


@dataclass(frozen=True)
class JointForces:
    """Where each joint is on its law.

    normal    : (n_points,)
    shear     : (components − 1, n_points)
    direction : (components − 1, n_points) θ of the trial shear
    size      : (n_points,) its length
    limit     : (n_points,) of shear
    slips, in_contact : (n_points,) whether shear is at its limit, and whether n follows its trial
    """

    normal: FloatArray
    shear: FloatArray
    direction: FloatArray
    size: FloatArray
    limit: FloatArray
    slips: BoolArray
    in_contact: BoolArray


def joint_forces(joints: ElasticJoints, trial: FloatArray) -> JointForces:
    """Return map of every joint.

    trial : (components, n_points) trial forces a, τ
    """
    limits, slope = joints.program.limits, _lift(joints)
    size = lengths(trial[1:])
    direction = trial[1:] / np.maximum(size, 1e-300)
    slips = size > _limit(joints, np.clip(trial[0], -limits.tension, limits.compression))
    sliding = (trial[0] + slope * (size - limits.cohesion)) / (1.0 + slope * joints.friction)
    sliding = np.where(slips, sliding, trial[0])
    normal = np.clip(sliding, -limits.tension, limits.compression)
    limit = _limit(joints, normal)
    shear = np.where(slips, limit, size) * direction
    return JointForces(normal, shear, direction, size, limit, slips, normal == sliding)


def joint_stiffness(joints: ElasticJoints, forces: JointForces, length: float) -> FloatArray:
    """C = −∂forces/∂v of every joint in a step of a length, (n_points, components, components)."""
    stiffness = np.vstack([joints.normal, *[joints.shear] * (joints.program.components - 1)]) * length
    return joint_tangents(joints, forces) * stiffness.T[:, None, :]


def joint_tangents(joints: ElasticJoints, forces: JointForces) -> FloatArray:
    """Change of the forces of every joint with its trial forces, (n_points, components, components)."""
    theta, slips, friction = forces.direction.T, forces.slips, joints.friction
    n, size = theta.shape[0], theta.shape[1] + 1
    tangents = np.zeros((n, size, size))
    dilates = np.where(slips, _lift(joints), 0.0)
    tangents[:, 0, 0] = np.where(forces.in_contact, 1.0 / (1.0 + dilates * friction), 0.0)
    tangents[:, 0, 1:] = (tangents[:, 0, 0] * dilates)[:, None] * theta
    share = np.divide(forces.limit, forces.size, out=np.ones_like(forces.size), where=slips)
    across = np.eye(size - 1) - np.where(slips, 1.0, 0.0)[:, None, None] * theta[:, :, None] * theta[:, None, :]
    tangents[:, 1:, 1:] = share[:, None, None] * across
    follows = np.where(slips & (forces.limit > 0.0), friction, 0.0)
    tangents[:, 1:, :] += (follows[:, None] * theta)[:, :, None] * tangents[:, None, 0, :]
    return tangents


def _limit(joints: ElasticJoints, normal: FloatArray) -> FloatArray:
    return np.maximum(joints.friction * normal + joints.program.limits.cohesion, 0.0)


def _lift(joints: ElasticJoints) -> FloatArray:
    """s, (n_points,): normal force over shear that sliding takes away, without friction."""
    return joints.dilatancy * joints.normal / joints.shear
