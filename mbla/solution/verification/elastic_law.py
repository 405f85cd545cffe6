"""Misfit of the law of elastic joints: whether the forces after a step follow from history and motion.

A joint with the history N̄ and T̄ that moves with v, opening positive, has the following forces; k_N and k_T are the
force lost for a unit velocity::

    T = T̄ − k_T v_T,  shortened to the shear strength μN + c where it is longer
    N = N̄ − k_N v_N + k_N tan ψ ‖T̄ − k_T v_T − T‖/k_T,  within −f_t … f_c

A joint slides along the shear that is cut off, and an open joint has no force: friction and unilateral contact are
parts of the same law. Where interfaces crush or twist, v is the motion of the blocks without that of the interface, and
the misfit of that motion with its own law counts too. Stiffness is in proportion to area, shared equally by the points
of an interface, with the ratio k_T/k_N of the path. Forces, motion and history are those of a result; no code of the
step is used.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.solution import Mechanics
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.stiffness import relative_stiffness

RESTS, ALIKE = 1e-9, 1e-6
"""Velocity over the largest up to which a joint counts as at rest, and difference of stiffness that is rounding."""


def elastic_residual(case: LoadedModel, mechanics: Mechanics, dilatancy: FloatArray) -> float:
    """Largest force that is off the law, over the largest force of a contact point or the mean weight of a point.

    NaN where the mechanics are those of rigid joints; infinite where a joint that moves has not the stiffness that it
    should have.

    dilatancy : (n_points,) tangents
    """
    remembered, stiffness = mechanics.remembered, mechanics.stiffness
    if remembered is None or stiffness is None:
        return float("nan")
    if not (np.isfinite(remembered).all() and np.isfinite(stiffness).all() and (stiffness > 0.0).all()):
        return float("inf")
    mechanism, motions = case.motion_of(mechanics)
    v = case.velocities(mechanism) - case.interface_velocities(motions)[0]
    if not _is_in_proportion(case, stiffness, v):
        return float("inf")
    forces = mechanics.contact_forces
    off = np.append(_off(case, forces, v, remembered, stiffness, dilatancy), case.off_flow(mechanics))
    weight = np.abs(case.load_case.dead_load[case.model.free][:, :3]).sum() / max(len(forces), 1)
    largest = max(float(np.abs(forces).max(initial=0.0)), float(weight))
    return float(off.max(initial=0.0)) / largest if largest > 0.0 else float("nan")


def _off(
    case: LoadedModel,
    forces: FloatArray,
    v: FloatArray,
    remembered: FloatArray,
    stiffness: FloatArray,
    dilatancy: FloatArray,
) -> FloatArray:
    """Forces that are off the law, (n_points,)."""
    limits, (normal_stiffness, shear_stiffness) = case.limits, stiffness.T
    trial = remembered[:, 1:] - shear_stiffness[:, None] * v[:, 1:]
    strength = np.maximum(limits.friction * forces[:, 0] + limits.cohesion, 0.0)
    size = np.hypot(trial[:, 0], trial[:, 1])
    shear = trial * np.where(size > strength, strength / np.maximum(size, 1e-300), 1.0)[:, None]
    slid = np.hypot(*(trial - shear).T)
    normal = remembered[:, 0] - normal_stiffness * v[:, 0] + normal_stiffness * dilatancy * slid / shear_stiffness
    normal = np.clip(normal, -limits.tension, limits.compression)
    return np.asarray(np.hypot(normal - forces[:, 0], np.hypot(*(shear - forces[:, 1:]).T)))


def _is_in_proportion(case: LoadedModel, stiffness: FloatArray, v: FloatArray) -> bool:
    """Whether the stiffness of joints that move is that of their area, in the units of light blocks.

    stiffness : (n_points, 2); v : (n_points, 3) velocities
    """
    speed = np.linalg.norm(v, axis=1)
    moves = speed > RESTS * speed.max(initial=0.0)
    joints = moves & ~case.contacts.tie_points
    if not joints.any():
        return True
    by_share = stiffness[joints, 0] / relative_stiffness(case.model, case.contacts, case.load_case)[joints]
    ratio = stiffness[joints, 1] / stiffness[joints, 0]
    same = float(np.ptp(by_share)) <= ALIKE * float(by_share.max())
    return same and float(np.ptp(ratio)) <= ALIKE * float(ratio.max())
