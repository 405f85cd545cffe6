"""The step of the greatest load factor of a path, and the same solved until the law of its joints holds.

On the path a step is one direction on smoothed products. Once the peak has passed, its step is solved from what the
joints remembered before it: the load factor of a path is that of a state whose forces anybody can find again from its
motion and its history.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState, smoothed_margin, within
from mbla.solution.law.exact_law import misfit
from mbla.solution.law.joint_equations import JointStep, residual_of
from mbla.solution.law.joint_step import direction_of, length_of
from mbla.solution.law.newton import ROUNDING, by_newton

OF_FLOOR = 0.3
"""Least product N y at the beginning of a step, over the one wanted."""


@dataclass(frozen=True)
class PeakStep:
    """The step with the greatest load factor.

    step  : its equations
    sigma : the products that were wanted
    state : after it, at ``displacement`` in units
    misfit : of the law; not measured while the path is followed
    """

    step: JointStep
    sigma: float
    state: StepState
    displacement: float
    misfit: float = float("inf")

    @property
    def is_solved(self) -> bool:
        """Whether the law holds."""
        return self.misfit <= (EXACT_OF_LAWS if self.step.joints.laws else EXACT)

    @property
    def memory(self) -> Memory:
        """What the joints remember after it."""
        step, state, joints = self.step, self.state, self.step.joints
        moved = step.length * joints.velocities(state.u)
        motions = [step.length * motion for motion in joints.motions(state.u)]
        return step.memory.after(joints, moved, state.normal, motions)


def with_openings(step: JointStep, state: StepState, sigma: float) -> StepState:
    """The state with the openings that its motion has, where these are not nearly closed, and as much flow."""
    joints, opening = step.joints, step.openings(state, step.joints.velocities(state.u))
    floor = OF_FLOOR * sigma / joints.margin(state.normal)
    flows = zip(joints.laws, state.interfaces, step.motions(state.u), strict=True)
    interfaces = tuple(law.following(one, state.normal, motion) for law, one, motion in flows)
    return replace(state, opening=np.maximum(opening, floor), interfaces=interfaces)


def at_rest_of(step: JointStep, state: StepState, sigma: float) -> StepState:
    """The state with the normal forces that joints at rest have with products: (N − N̄) N = σ k_N h, and as much below
    what crushes them.
    """
    joints, limits = step.joints, step.joints.program.limits
    trial, product = step.memory.normal, sigma / step.normal_compliance
    normal = smoothed_margin(trial + limits.tension, product) - limits.tension
    at = joints.crushable
    strength, least = limits.compression[at], -limits.tension[at]
    below = np.minimum(normal[at], strength - smoothed_margin(strength - trial[at], product[at]))
    normal[at] = np.where(below > least, below, 0.5 * (strength + least))
    return replace(state, normal=normal)


def centred(joints: ElasticJoints, state: StepState, sigma: float, share: float) -> StepState:
    """On the central path for the present normal forces and shear, the latter within a share of its limit."""
    limit = joints.limit(state.normal)
    shear = within(state.shear, limit, share)
    speed = sigma * limit / (limit * limit - (shear * shear).sum(axis=0))
    return replace(
        state,
        opening=sigma / joints.margin(state.normal),
        shear=shear,
        slip=-(speed / limit) * shear,
        speed=speed,
        crushing=sigma / joints.room(state.normal),
        interfaces=tuple(
            law.centred(one, state.normal, sigma, share) for law, one in zip(joints.laws, state.interfaces, strict=True)
        ),
    )


FALL, QUICK, WHOLE, LEAST = 0.2, 0.01, 0.95, 1e-24
"""Factor on the products after a direction of more than half length, factor after a direction of nearly full length,
that length, and least products over n₀²."""

EXACT, EXACT_OF_LAWS, STEPS = 1e-6, 3e-5, 80
"""Misfit of the law with which the step is solved; the same with interfaces of a law of their own; most directions."""

NEWTON = 8
"""Iterations of Newton's method at most."""

BLOCKED, AGAIN = 0.05, (1e3, 10.0, 1e5)
"""Reach of a direction below which, twice running, the step starts again from the central path, and the products there
over those of the path, in turn."""


def solved_peak(
    peak: PeakStep,
    force: float,
    enough: Callable[[PeakStep], bool] = lambda peak: peak.is_solved,
    good: Callable[[PeakStep], bool] = lambda peak: False,
) -> tuple[PeakStep, int]:
    """The step of the peak from its history, by Newton's method, or with ever smaller products until the law holds.

    Returned with the factorisations spent.

    The state with the least misfit that was met, which says how far it came.

    force  : n₀
    enough : whether a state is taken; default: a solved one
    good   : whether one is taken where the way to such a state is blocked; else it begins anew
    """
    step, joints, again, blocked = peak.step, peak.step.joints, list(AGAIN), 0
    best, spent = _by_newton(replace(peak, misfit=misfit(step, peak.state, force)), force)
    if enough(best):
        return best, spent
    sigma, state = peak.sigma, with_openings(peak.step, peak.state, peak.sigma)
    while not enough(best) and spent < STEPS:
        found = direction_of(step, state, residual_of(step, state), sigma)
        spent += 1
        if found is None:
            break
        state = state.plus(found[0], length_of(found[1]))
        off = misfit(step, state, force)
        if off < best.misfit:
            best = PeakStep(step, sigma, state, peak.displacement, off)
        if found[1] > 0.5:
            sigma = max((FALL if found[1] < WHOLE else QUICK) * sigma, LEAST * force**2)
        blocked = blocked + 1 if found[1] < BLOCKED else 0
        if blocked >= 2 and (not again or good(best)):
            break
        if blocked >= 2:
            sigma, blocked = again.pop(0) * peak.sigma, 0
            state = centred(joints, state, sigma, 0.95)
    if not best.is_solved and best.state is not peak.state:
        best, more = _by_newton(best, force)
        spent += more
    return best, spent


def _by_newton(peak: PeakStep, force: float) -> tuple[PeakStep, int]:
    """The step solved by Newton's method from its state, as given where that comes to nothing; factorisations."""
    if peak.step.joints.laws or peak.misfit <= ROUNDING:
        return peak, 0
    found = by_newton(peak.step, peak.state.u, peak.state.factor, most=NEWTON)
    state = found.state_of(peak.step)
    there = replace(peak, state=state, misfit=misfit(peak.step, state, force))
    return (there if found.is_solved and there.misfit < peak.misfit else peak), found.iterations
