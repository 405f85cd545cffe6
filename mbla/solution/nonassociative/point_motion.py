"""What the contact points do in a state of the joint law: who opens, crushes and slides, and in which direction.

The law leaves one of two small at every point: opening velocity or normal force, sliding velocity or reserve of shear.
In numbers neither is zero, so that pairs of ratios are compared, velocities over the largest contact speed and forces
over the largest of their kind::

    opens    v_N / v_max > (N + f_t) / N_max          slides   ‖v_T‖ / v_max > (μN + c − ‖T‖) / (μN + c)_max

Points that just touch, with both below ``touching``, are counted as at rest: the mechanism then leaves their force
free, which is what it says of a velocity that is zero. If it was not zero, forces found with it miss the law and show
that in their residual; a motion that is only noise would go unnoticed.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.static import PointMotion
from mbla.solution.nonassociative.law_state import LawState


def point_motion(program: Program, state: LawState, touching: float, slope: FloatArray | float = 0.0) -> PointMotion:
    """Motion of every point in a state.

    touching : velocity over the largest contact speed below which a point is at rest
    slope    : dilatancy of the flow rule (tangent), (n_points,) or one for all: a sliding point opens with that share
               of its sliding velocity
    """
    limits, forces = program.limits, state.forces
    v = (program.equilibrium_matrix.T @ state.velocities).reshape(-1, program.components)
    speed = max(float(np.linalg.norm(v, axis=1).max(initial=0.0)), 1e-300)
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    surplus = (v[:, 0] - slope * sliding) / speed
    largest = max(float(np.abs(forces[:, 0]).max(initial=0.0)), 1e-300)
    strength = np.maximum(limits.cohesion + limits.friction * forces[:, 0], 0.0)
    strongest = max(float(strength.max(initial=0.0)), 1e-300)
    shear = np.linalg.norm(forces[:, 1:], axis=1)
    reserve = np.maximum(strength - shear, 0.0) / strongest
    opens = surplus > np.maximum((forces[:, 0] + limits.tension) / largest, touching)
    crushable = np.isfinite(limits.compression)
    unused = np.where(crushable, limits.compression - forces[:, 0], np.inf) / largest
    return PointMotion(
        opens=opens,
        crushes=~opens & (-surplus > np.maximum(unused, touching)),
        slides=sliding / speed > np.maximum(reserve, touching),
        shear=_shear_direction(v[:, 1:], sliding / speed, forces[:, 1:], shear / strongest),
    )


def _shear_direction(v: FloatArray, speed: FloatArray, shear: FloatArray, size: FloatArray) -> FloatArray:
    """Direction of the shear from the force or against the velocity, whichever is larger in its kind.

    The error of the power is of the second order in the angle between them. With the direction of the forces that were
    found, those forces stay among the ones compatible with the mechanism.
    """
    of_force = shear / np.maximum(np.linalg.norm(shear, axis=1), 1e-300)[:, None]
    of_velocity = -v / np.maximum(np.linalg.norm(v, axis=1), 1e-300)[:, None]
    return np.asarray(np.where((size > speed)[:, None], of_force, of_velocity))
