"""The smoothed step of a structure that moves: products of its law stay at σ.

Most steps take one direction from the state before. Where that is blocked, forces stay and openings are made as wide as
solids may move, so that products are large at first and fall: joints that open and slide of a sudden are found in a
dozen directions.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.flow.peak_step import centred
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import aimed_direction, direction_of, length_of
from mbla.solution.pushover.pose.moved_joints import JointsAt
from mbla.solution.pushover.pose.pose_step import DIRECTIONS, FARTHEST, NEARBY, ROUNDS, PoseStep
from mbla.solution.pushover.pose.step_states import below_strength, gone_on, on_central_path

WIDE, INSIDE = 0.1, 0.9
"""Products of a smoothed step that begins afresh, over mean force times size; greatest shear over its limit there."""

LOOSE, CLOSED, REACHED, FEW, CLOSE, EVEN = 1e-3, 0.1, 0.5, 5, 3.0, 30.0
"""A smoothed step is done with this unbalanced force, misfit of openings and slips over the elastic overlap, and reach
of its last direction; directions from the state before; greatest mean product, and greatest product, over σ."""


@dataclass(frozen=True)
class Smoothed:
    """A smoothed step that is done: joints and state there, displacements since it began, directions it took."""

    at: JointsAt
    state: StepState
    u: FloatArray
    directions: int


def smoothed(
    step: PoseStep, twists: FloatArray, before: StepState | None, share: float, kappa: float, anew: bool = False
) -> Smoothed | None:
    """The step with products n₀ times the elastic overlap over κ; None where it is blocked.

    twists : (n_solids, 6) that are expected
    before : the state of the step before, of which this one is a share; None where there is none that leads on
    anew   : whether the step begins afresh where that state does not lead to its end
    """
    if before is not None:
        u = step.joints.displacements(twists)
        pose = step.joints.after(step.start.pose, u)
        at = step.joints.there(pose, step.factor)
        rest = step.rest(at, u, float(step.start.joints.program.live_load @ u))
        sigma = _product(step, at) / kappa
        found = _to(step, rest, gone_on(rest, before, share, sigma), sigma, aimed=False)
        if found is not None:
            state, directions = found
            there = step.joints.there(step.joints.after(pose, state.u), state.factor)
            return Smoothed(there, state, u + state.u, directions)
    return _afresh(step, before, kappa) if before is None or anew else None


def _afresh(step: PoseStep, before: StepState | None, kappa: float) -> Smoothed | None:
    """The smoothed step by ever smaller products from the forces before, and again at the pose to which it led."""
    at, u, state, done, directions = step.start, np.zeros(len(step.joints.reduced.dead_load)), before, 0.0, 0
    for number in range(ROUNDS):
        rest, sigma, found = step.rest(at, u, done), _product(step, at) / kappa, None
        if number and state is not None:
            found = _to(step, rest, gone_on(rest, state, 0.0, sigma), sigma, aimed=False)
        if found is None:
            state = on_central_path(rest, sigma, step.factor) if state is None else state
            state = replace(state, u=np.zeros_like(u), normal=below_strength(rest.joints, state.normal))
            wide = WIDE * step.force(at) * step.joints.structure.size
            found = _to(step, rest, centred(rest.joints, state, wide, INSIDE), sigma, aimed=True)
        if found is None:
            return None
        state, directions = found[0], directions + found[1]
        done += float(at.joints.program.live_load @ state.u)
        at, u = step.joints.there(step.joints.after(at.pose, state.u), state.factor), u + state.u
        if step.size(state.u) < NEARBY:
            return Smoothed(at, state, u, directions)
    return None


def _product(step: PoseStep, at: JointsAt) -> float:
    """Mean force times elastic overlap."""
    return step.force(at) ** 2 / step.joints.length


def _to(
    step: PoseStep, rest: JointStep, state: StepState, sigma: float, *, aimed: bool
) -> tuple[StepState, int] | None:
    """A state with products σ, and directions to it; None where the way is blocked.

    aimed : whether products are larger at first and choose by how much they fall
    """
    residual, fits = residual_of(rest, state), CLOSED * step.force(step.start) / step.joints.length
    for number in range(1, (DIRECTIONS if aimed else FEW) + 1):
        last = not aimed or residual.products.mean(rest.joints) < CLOSE * sigma
        found = direction_of(rest, state, residual, sigma) if last else aimed_direction(rest, state, residual)
        step.spent += 1
        if found is None or found[1] < 1e-4:
            return None
        state = state.plus(found[0], length_of(found[1]))
        if not aimed and not step.size(state.u) < FARTHEST:
            return None
        residual = residual_of(rest, state)
        off = max(float(np.abs(each).max(initial=0.0)) for each in (residual.normal, residual.shear))
        done = last and found[1] >= REACHED and off < fits and float(np.abs(residual.balance[:-1]).max()) < LOOSE
        if done and float(residual.products.normal.max(initial=0.0)) < EVEN * sigma:
            return (state, number) if step.size(state.u) < FARTHEST else None
    return None
