"""One implicit step of the dead load on the stress-free assembly: where the path of elastic joints begins."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState
from mbla.solution.law.joint_step import JointStep, direction_of, length_of, residual_of

STEPS = 100
"""At most; where a dead load is carried 2 to 20 are usual, near the limit of standing 60 and more."""

FALL, LEAST = 0.1, 0.01
"""Factor on the products when a state is in balance, and their least over those at first."""

BALANCED, COMPATIBLE, EVEN = 1e-6, 1e-6, 30.0
"""Unbalanced force in mean loads of a block, incompatible velocity over the largest, and largest product N y over that
wanted, with which a state is taken."""


@dataclass(frozen=True)
class Gravity:
    """The structure at rest under its dead load.

    state : forces and displacements (as velocities over a time of 1)
    memory : what the joints remember of it
    force : n₀, the mean dead load of a point
    carried : whether the state is in balance within the number of steps
    steps : factorisations
    """

    state: StepState
    memory: Memory
    force: float
    carried: bool
    steps: int


def gravity_step(joints: ElasticJoints, least_force: float = 0.0) -> Gravity:
    """The dead load in one step, from joints without stress.

    least_force : n₀ of a structure without weight
    """
    program, n = joints.program, joints.program.n_points
    force = float(np.abs(program.dead_load).sum()) / max(n, 1) or least_force
    sigma, step = force**2, JointStep(joints, Memory.stress_free(joints), 1.0, driven=False)
    state, carried, count, reach = _start(joints, force), False, 0, 1.0
    for count in range(STEPS):
        residual = residual_of(step, state)
        if residual.unbalanced < BALANCED and residual.incompatible(joints, state) < COMPATIBLE:
            low = sigma < 2.0 * LEAST * force**2
            if low and float(residual.products.normal.max(initial=0.0)) < EVEN * sigma:
                carried = True
                break
            sigma = max(FALL * sigma, LEAST * force**2)
        found = direction_of(step, state, residual, sigma)
        if found is None:
            break
        direction, reach = found
        state = state.plus(direction, length_of(reach))
    at_rest = Memory(-joints.normal * joints.velocities(state.u)[0], state.shear)
    if joints.dilates or len(joints.crushable):
        at_rest = Memory.stress_free(joints).after(joints, joints.velocities(state.u), state.normal)
        at_rest = Memory(at_rest.normal, state.shear)
    return Gravity(state, at_rest, force, carried, count)


def _start(joints: ElasticJoints, force: float) -> StepState:
    """All joints pressed alike."""
    program, limits = joints.program, joints.program.limits
    none = np.zeros((program.components - 1, program.n_points))
    normal, sigma = force * np.sqrt(joints.normal), force**2
    middle = 0.5 * (limits.compression - limits.tension)[joints.crushable]
    normal[joints.crushable] = np.minimum(normal[joints.crushable], middle)
    return StepState(
        u=np.zeros(len(program.dead_load)),
        factor=0.0,
        normal=normal,
        opening=sigma / (normal + limits.tension),
        shear=none,
        slip=none.copy(),
        speed=sigma / joints.limit(normal),
        crushing=sigma / joints.room(normal),
    )
