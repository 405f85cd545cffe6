"""Newton's method on the law of elastic joints itself: a step without products.

With what joints remember, forces follow from the motion alone (:mod:`mbla.solution.law.return_map`), so that balance is
an equation in u and λ::

    A x(Aᵀu) + f_D + λ f_L − ε u = 0,    f_L·u = w

It is semismooth. From joints that stick, where most of them do, it comes to its solution to rounding in a few
iterations; elsewhere to none, which its misfit says. Interfaces with a law of their own have no return map.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.exact_law import forces_by_law
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.law.return_map import JointForces, joint_stiffness

ROUNDING, SHARPEST = 1e-11, 1e-14
"""Force without balance, in mean loads of a block, with which a step is solved, and with which iterations end: a block
of a millionth of the mean load must be in balance too."""

BACKTRACKS, FALL = 8, 1e-4
"""Times that an iteration is halved until what is without balance falls, and the least share of that, of its length."""


@dataclass(frozen=True)
class NewtonState:
    """A state whose forces are those of the law.

    u, factor  : velocities, (n_rows,), and load factor
    forces     : of the joints
    unbalanced : largest force without balance, in mean loads of a block, or lack of live work
    iterations : factorisations
    """

    u: FloatArray
    factor: float
    forces: JointForces
    unbalanced: float
    iterations: int

    @property
    def is_solved(self) -> bool:
        """Whether the step is solved to rounding."""
        return self.unbalanced <= ROUNDING

    def state_of(self, step: JointStep) -> StepState:
        """The same as a state of a step, without products."""
        return _state(step, self.u, self.factor, self.forces)


@np.errstate(over="ignore", invalid="ignore")  # iterations that diverge are seen and given up
def by_newton(step: JointStep, u: FloatArray, factor: float, *, most: int) -> NewtonState:
    """The last iterate; whether it solves the step what it leaves without balance says.

    u, factor : velocities, (n_rows,), and load factor to begin with
    most      : iterations at most
    """
    residual, forces = _residual(step, u, factor)
    count = 0
    while np.abs(residual).max(initial=0.0) > SHARPEST and count < most:
        found = _iteration(step, u, factor, residual, forces)
        count += 1
        if found is None:
            break
        u, factor, residual, forces = found
    return NewtonState(u, factor, forces, float(np.abs(residual).max(initial=0.0)), count)


def _residual(step: JointStep, u: FloatArray, factor: float) -> tuple[FloatArray, JointForces]:
    """Unbalanced forces and f_L·u − w, (n_rows + 1,), 0 where the load factor stays; forces of the joints."""
    forces = forces_by_law(step, u)
    return step.balance(_state(step, u, factor, forces)), forces


def _state(step: JointStep, u: FloatArray, factor: float, forces: JointForces) -> StepState:
    """A state with forces of the law, without products."""
    none = np.zeros_like(forces.normal)
    slip, crushing = np.zeros_like(forces.shear), none[step.joints.crushable]
    return StepState(u, factor, forces.normal, none, forces.shear, slip, none, crushing)


def _iteration(
    step: JointStep, u: FloatArray, factor: float, residual: FloatArray, forces: JointForces
) -> tuple[FloatArray, float, FloatArray, JointForces] | None:
    """The next iterate, halved until the residual falls; None where it does not, or where the tangent is singular."""
    joints = step.joints
    tangents = joint_stiffness(joints, forces, step.length)
    springs = np.broadcast_to(step.held, u.shape)
    solve = joints.matrix.factorized(tangents, springs, fixed_load=not step.driven)
    change = None if solve is None else solve(-residual)
    if change is None or not np.isfinite(change).all():
        return None
    size, norm = 1.0, float(np.linalg.norm(residual))
    for _ in range(BACKTRACKS):
        ahead, there = u + size * change[:-1], factor + size * float(change[-1])
        trial, found = _residual(step, ahead, there)
        if np.linalg.norm(trial) < (1.0 - FALL * size) * norm:
            return ahead, there, trial, found
        size *= 0.5
    return None
