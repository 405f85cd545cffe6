"""A state of rigid joints that nearly fits their law, taken to it: implicit steps from its own forces to rounding.

In a step of elastic joints that remember the forces of a state these change by what the state is off the law: after a
few steps they are those of a state of the law itself, whose load factor is as sharp as its forces.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, together
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.law.newton import by_newton
from mbla.solution.nonassociative.collapse_state import CollapseState, collapse_state
from mbla.solution.nonassociative.imbalance import imbalance

STEP, STEPS, ITERATIONS, HELD = 0.03, 3, 12, 1e-14
"""‖x‖² over the length of a step in the unit of the part, steps, iterations of each, and share of the stiffness of all
joints sticking that holds blocks whose joints all open."""


def polished(program: Program, slope: FloatArray, state: CollapseState) -> CollapseState:
    """The state, or one of a few steps to the law from it, whichever fits the law and balances every block best.

    slope : (n_points,) tangent of the dilatancy angle
    """
    joints = ElasticJoints.of(program, np.ones(program.n_points), 1.0, slope)
    states = [state]
    for _ in range(STEPS):
        states.append(_stepped(joints, states[-1]))
    return min(states, key=lambda each: max(each.residual, imbalance(program, each)))


def _stepped(joints: ElasticJoints, state: CollapseState) -> CollapseState:
    program = joints.program
    length = max(float((state.forces**2).sum()), np.finfo(float).tiny) / (STEP * program.own_unit)
    memory = Memory(state.forces[:, 0], state.forces[:, 1:].T)
    step = JointStep(joints, memory, length, held=HELD * length * joints.matrix.size)
    found = by_newton(step, state.velocities, state.load_factor, most=ITERATIONS)
    forces = together(found.forces.normal, found.forces.shear)
    return collapse_state(program, joints.dilatancy, forces, found.u, found.factor)
