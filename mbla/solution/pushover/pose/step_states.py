"""States that a smoothed step begins with: the one before, and one without motion."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.flow.peak_step import with_openings
from mbla.solution.law.elastic_joints import ElasticJoints, StepState, lengths, smoothed_margin
from mbla.solution.law.joint_equations import JointStep


def gone_on(step: JointStep, before: StepState, share: float, sigma: float) -> StepState:
    """The state of the step before at the pose that is expected: its forces, openings and slips of that pose."""
    joints = step.joints
    state = replace(before, u=np.zeros_like(before.u), slip=before.slip * share, speed=before.speed * share)
    state = with_openings(step, state, sigma)
    limit = joints.limit(state.normal)
    slip = (state.shear - step.memory.shear) * step.shear_compliance
    least = sigma * limit / (limit * limit - (state.shear * state.shear).sum(axis=0))
    size = lengths(slip)
    slides = size > least
    slip = np.where(slides, slip, -(least / limit) * state.shear)
    return replace(state, slip=slip, speed=np.where(slides, size * BEYOND, least))


BEYOND = 1.0 + 1e-7
"""Speed over slip of a joint that slides against its friction."""


def below_strength(joints: ElasticJoints, normal: FloatArray) -> FloatArray:
    """Normal forces, (n_points,), of which none crushes its joint."""
    limits, crushable = joints.program.limits, joints.crushable
    found = normal.copy()
    middle = 0.5 * (limits.compression - limits.tension)[crushable]
    found[crushable] = np.minimum(found[crushable], np.maximum(middle, 0.95 * limits.compression[crushable]))
    return found


def on_central_path(step: JointStep, sigma: float, factor: float) -> StepState:
    """State without motion that fulfils the smoothed law of a step."""
    joints, memory, limits = step.joints, step.memory, step.joints.program.limits
    k_n, k_t = joints.normal * step.length, joints.shear * step.length
    normal = smoothed_margin(memory.normal + limits.tension, sigma * k_n) - limits.tension
    normal = below_strength(joints, normal)
    limit, size = joints.limit(normal), lengths(memory.shear)
    low, high = np.zeros_like(size), np.minimum(size, limit)
    for _ in range(50):
        half = 0.5 * (low + high)
        up = (size - half) * (limit * limit - half * half) - sigma * k_t * half > 0.0
        low, high = np.where(up, half, low), np.where(up, high, half)
    shear = np.minimum(low, (1.0 - 1e-12) * limit)
    way = memory.shear / np.maximum(size, 1e-300)
    ratio = sigma / np.maximum(limit * limit - shear * shear, 1e-300)
    return StepState(
        u=np.zeros(len(joints.program.dead_load)),
        factor=factor,
        normal=normal,
        opening=sigma / joints.margin(normal),
        shear=shear * way,
        slip=-(ratio * shear) * way,
        speed=limit * ratio,
        crushing=sigma / joints.room(normal),
    )
