"""Forces of joints for a given motion by the law itself, without smoothing products: the misfit of a state.

After a step of length h with the velocities v of the contacts, the forces are those of the return map of the trial
forces n̄ − k_N h v_N and t̄ − k_T h v_T. The misfit of an interface with a law of its own is its distance from the bounds
at which it flows.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.law.return_map import JointForces, joint_forces


def forces_by_law(step: JointStep, u: FloatArray) -> JointForces:
    """Forces that joints have for velocities of the blocks, (n_rows,)."""
    v = step.joints.velocities(u)
    normal = step.memory.normal - v[0] / step.normal_compliance
    return joint_forces(step.joints, np.vstack([normal, step.memory.shear - v[1:] / step.shear_compliance]))


def misfit(step: JointStep, state: StepState, force: float) -> float:
    """Largest difference of a force from the law, over the largest force; what is without balance counts with it.

    Springs that hold the blocks in the step are part of the balance.

    force : n₀; where all joints open, none is larger
    """
    joints, found = step.joints, forces_by_law(step, state.u)
    largest = max(float(np.abs(state.normal).max(initial=0.0)), float(np.abs(state.shear).max(initial=0.0)), force)
    off = [float(np.abs(one).max(initial=0.0)) for one in (found.normal - state.normal, found.shear - state.shear)]
    each = zip(joints.laws, state.interfaces, strict=True)
    off += [law.misfit(one, state.normal, step.length) for law, one in each]
    return max(max(off) / largest, float(np.abs(step.balance(state)[:-1]).max(initial=0.0)))
