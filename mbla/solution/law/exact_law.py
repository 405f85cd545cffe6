"""Forces that joints have for a motion by the law itself, without products: how far a state is from it.

With what they remember, n̄ and t̄, after a step of length h with the velocities v of the contacts::

    t = t̄ − k_T h v_T,  cut to the limit of shear l(n)
    n = n̄ − k_N h v_N + (k_N/k_T) δ ‖t̄ − k_T h v_T − t‖,  cut to −f_t … f_c

Interfaces with a law of their own are off it by how far they are from the bounds at which they flow.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import StepState, lengths, within
from mbla.solution.law.joint_equations import JointStep


def forces_by_law(step: JointStep, state: StepState) -> tuple[FloatArray, FloatArray]:
    """Normal forces, (n_points,), and shear, (components − 1, n_points), that joints have for the motion of a state."""
    joints, limits = step.joints, step.joints.program.limits
    v = joints.velocities(state.u)
    trial = step.memory.shear - v[1:] / step.shear_compliance
    shear = within(trial, joints.limit(state.normal))
    normal = step.memory.normal - v[0] / step.normal_compliance
    if joints.dilates:
        normal = normal + joints.normal * joints.dilatancy * lengths(trial - shear) / joints.shear
    return np.clip(normal, -limits.tension, limits.compression), shear


def misfit(step: JointStep, state: StepState, force: float) -> float:
    """Largest difference of a force from the law, over the largest force; what is without balance counts with it.

    Springs that hold the blocks in the step are part of the balance.

    force : n₀; where all joints open, none is larger
    """
    joints, (normal, shear) = step.joints, forces_by_law(step, state)
    largest = max(float(np.abs(state.normal).max(initial=0.0)), float(np.abs(state.shear).max(initial=0.0)), force)
    off = [float(np.abs(one).max(initial=0.0)) for one in (normal - state.normal, shear - state.shear)]
    each = zip(joints.laws, state.interfaces, strict=True)
    off += [law.misfit(one, state.normal, step.length) for law, one in each]
    balance = joints.unbalanced(state) - step.held * state.u
    return max(max(off) / largest, float(np.abs(balance).max(initial=0.0)))
