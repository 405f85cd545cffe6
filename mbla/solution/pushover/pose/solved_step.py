"""The step of a structure that moves solved by its law as it is.

By Newton's method with the exact derivative, or ever smaller products where that comes to nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.exact_law import forces_by_law
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import aimed_direction, length_of
from mbla.solution.law.return_map import JointForces, joint_forces, joint_stiffness
from mbla.solution.pushover.pose.geometric_stiffness import geometric
from mbla.solution.pushover.pose.moved_joints import JointsAt
from mbla.solution.pushover.pose.pose_step import DIRECTIONS, FARTHEST, NEARBY, REGULAR, ROUNDS, PoseStep
from mbla.solution.pushover.pose.smoothed_step import Smoothed
from mbla.solution.pushover.pose.step_states import gone_on, on_central_path
from mbla.solution.thresholds import SOLVED_RESIDUAL

BALANCED, WORKS = 1e-6, 1e-6
"""Unbalanced force, in mean loads of a block, and deviation of the live work, relative, with which a step is solved."""

NEWTON, WORSE = 8, 10.0
"""Directions of Newton's method, which is given up where it leaves as many times as much as before."""

NEAR = 5e-3, 2e-7
"""Unbalanced force of the law itself from which Newton's method goes on, at the first pose and at the others."""

FIRM = REGULAR, 1e-6, 1e-4
"""Springs of Newton's method: the next is tried where joints at their limit slide anywhere, beyond ``NEARBY``."""

OVERLAP, LATER, LEAST = 0.1, 1e-3, 1e-13
"""Products of a step that is solved, over mean force times the elastic overlap or a share of the live displacement,
whichever is more: at the first pose, at later poses, at the end."""


@dataclass(frozen=True)
class SolvedPose:
    """A pose and the forces of the law there.

    u       : (n_rows,) displacements since the step began
    factor  : of the program
    work    : of the live load since the step began
    off     : largest unbalanced force, in mean loads of a block
    measure : that, or what is missing of the live work in the same measure
    """

    at: JointsAt
    forces: JointForces
    u: FloatArray
    factor: float
    work: float
    off: float
    measure: float

    @property
    def solved(self) -> bool:
        """Whether the step is."""
        return self.measure < BALANCED

    @property
    def fit(self) -> bool:
        """Whether it is fit to be shown: joints in series that slide at one load, each a little, come to no more."""
        return self.measure < SOLVED_RESIDUAL


def solved(step: PoseStep, near: Smoothed | None = None) -> SolvedPose | None:
    """The best by the law as it is, from a smoothed step or from the beginning; None where there is none."""
    at, u, factor, done = step.start, np.zeros(len(step.joints.reduced.dead_load)), step.factor, 0.0
    best: SolvedPose | None = None
    if near is not None:
        at, u, factor = near.at, near.u, near.state.factor
        done = float(step.start.joints.program.live_load @ u)
        best = _newton(step, at, u, factor, done)
    for number in range(ROUNDS):
        if best is not None and best.solved:
            break
        found = _primal(step, at, u, factor, done, number, None if near is None or number else near.state)
        if found is None:
            break
        best = found if best is None or found.measure < best.measure else best
        at, u, factor, done = found.at, found.u, found.factor, found.work
    return best


def _measured(step: PoseStep, at: JointsAt, u: FloatArray, factor: float, done: float) -> tuple[SolvedPose, FloatArray]:
    """What a pose leaves without balance."""
    memory, program = step.memory(at), at.joints.program
    forces = joint_forces(at.joints, np.vstack([memory.normal, memory.shear]))
    left = at.joints.carried(forces.normal, forces.shear) + program.dead_load + factor * program.live_load
    left = left - step.held_springs * u
    off = float(np.abs(left).max(initial=0.0))
    missing = 0.0
    if step.driven:  # of a support that is held, over what its joints store
        size = max(abs(step.work), step.force(at) ** 2 / step.joints.length)
        missing = BALANCED * abs(step.work - done) / (WORKS * size)
    measure = max(off, missing)
    measure = measure if np.isfinite(measure) else np.inf
    return SolvedPose(at, forces, u, factor, done, off, measure), left


def _newton(step: PoseStep, at: JointsAt, u: FloatArray, factor: float, done: float) -> SolvedPose | None:
    """The best that Newton's method comes to from a pose; None where there are no numbers."""
    best: SolvedPose | None = None
    for number in range(NEWTON + 1):
        found, left = _measured(step, at, u, factor, done)
        if not np.isfinite(found.measure):
            return best
        worse = best is not None and number >= 2 and found.measure > WORSE * best.measure
        best = found if best is None or found.measure < best.measure else best
        if best.solved or worse or number == NEWTON:
            return best
        further = geometric(step.joints, at, found.forces.normal, found.forces.shear)
        tangent, fixed = joint_stiffness(at.joints, found.forces, step.joints.length), not step.driven
        for firm in FIRM:
            springs = firm * step.joints.length * step.joints.size + step.held_springs
            stiffness = at.joints.matrix.factorized(tangent, springs, fixed_load=fixed, further=further)
            step.spent += 1
            if stiffness is None:
                return best
            change = stiffness(np.append(-left, 0.0 if fixed else step.work - done))
            du, by = change[:-1], 0.0 if fixed else float(change[-1])
            if step.size(du) < NEARBY:
                break
        else:
            return best
        done += 0.0 if fixed else float(at.joints.program.live_load @ du)
        u, factor = u + du, factor + by
        at = step.joints.there(step.joints.after(at.pose, du), factor)
    return best


def _primal(
    step: PoseStep, at: JointsAt, u: FloatArray, factor: float, done: float, number: int, before: StepState | None
) -> SolvedPose | None:
    """Ever smaller products at a pose, from a smoothed state where there is one, and Newton's method from there."""
    rest, force = step.rest(at, u, done), step.force(at)
    overlap = force / step.joints.length
    sigma = LATER * force * overlap if number else OVERLAP * force * max(overlap, OVERLAP * _moved(step, at))
    if not step.driven and not number:
        sigma = force * overlap
    state = on_central_path(rest, sigma, factor)
    if before is not None:
        state = gone_on(rest, replace(before, factor=factor), 0.0, LATER * force * overlap)
    for count in range(DIRECTIONS):
        residual = residual_of(rest, state)
        if residual.products.mean(rest.joints) < LEAST * force * overlap:
            break
        if count and _left(step, rest, state) < NEAR[min(number, 1)]:
            break
        found = aimed_direction(rest, state, residual)
        step.spent += 1
        if found is None or found[1] < 1e-6:
            break
        state = state.plus(found[0], length_of(found[1]))
    if not step.size(state.u) < 4.0 * FARTHEST:
        return None
    done += float(at.joints.program.live_load @ state.u) if step.driven else 0.0
    there = step.joints.there(step.joints.after(at.pose, state.u), state.factor)
    return _newton(step, there, u + state.u, state.factor, done)


def _moved(step: PoseStep, at: JointsAt) -> float:
    """Displacement that the live work stands for."""
    return abs(step.work) / max(float(np.abs(at.joints.program.live_load).sum()), 1e-300)


def _left(step: PoseStep, rest: JointStep, state: StepState) -> float:
    """Largest unbalanced force of the law itself for the motion of a state."""
    joints, program, forces = rest.joints, rest.joints.program, forces_by_law(rest, state.u)
    left = joints.carried(forces.normal, forces.shear) + program.dead_load + state.factor * program.live_load
    return float(np.abs(left - rest.held * state.u).max(initial=0.0))
