"""The step of the greatest load factor of a path, and the same once more without smoothing."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.solution.flow.settings import PathSettings
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import direction_of, length_of

OF_FLOOR = 0.3
"""Least product N y at the beginning of a step, over the one wanted."""


@dataclass(frozen=True)
class PeakStep:
    """The step with the greatest load factor: its equations, the products that were wanted, the state after it."""

    step: JointStep
    sigma: float
    state: StepState
    displacement: float


def with_openings(step: JointStep, state: StepState, sigma: float) -> StepState:
    """The state with the openings that its motion has, where these are not nearly closed, and as much flow."""
    joints, v = step.joints, step.joints.velocities(state.u)
    opening = v[0] + step.normal_compliance * (state.normal - step.memory.normal)
    if joints.dilates:
        opening = opening - joints.dilatancy * state.speed
    opening[joints.crushable] += state.crushing
    floor = OF_FLOOR * sigma / (state.normal + joints.program.limits.tension)
    flows = zip(joints.laws, state.interfaces, step.motions(state.u), strict=True)
    interfaces = tuple(law.following(one, state.normal, motion) for law, one, motion in flows)
    return replace(state, opening=np.maximum(opening, floor), interfaces=interfaces)


SHARPER, SHARPENINGS, AT_REST = 0.2, 8, 2e-5
"""Factor on the products when the step of the peak is solved again, times at most, and change of the load factor with
which it is at rest."""


def sharpened_peak(peak: PeakStep, settings: PathSettings) -> tuple[PeakStep, int]:
    """The step of the peak again from its history, with ever smaller products; factorisations spent."""
    step, state, sigma, best = peak.step, peak.state, peak.sigma, peak
    spent = 0
    while spent < SHARPENINGS:
        spent += 1
        sigma *= SHARPER
        before = with_openings(step, state, sigma)
        residual = residual_of(step, before)
        found = direction_of(step, before, residual, sigma)
        if found is None or found[1] < 0.2:
            break
        last, state = state, before.plus(found[0], length_of(found[1]))
        if float(np.abs(step.joints.unbalanced(state)).max(initial=0.0)) < settings.counted[0]:
            best = PeakStep(step, sigma, state, peak.displacement)
        if abs(state.factor - last.factor) < AT_REST * abs(state.factor):
            break
    return best, spent
