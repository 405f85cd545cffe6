"""Brittle ties: a tie breaks when its elastic force reaches its capacity, and carries nothing afterwards.

A tie is a point that crushes at its capacity. It breaks where its trial force, the force of an elastic joint without a
limit, exceeds the capacity: n̄ − k_N v_N h > f_c; a bar also breaks where the trial force falls below −f_t. Force and
stiffness are lost at once. A step in which a tie breaks ends where the first tie breaks: the load beyond that point is
not carried.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState

GONE = 1e-7
"""Stiffness of what has broken over that of a joint."""

REMAINING_STRENGTH = 0.01
"""Share of its strength that a broken point has at the start of the next step, in which it loses that too."""


def share_until_break(joints: ElasticJoints, memory: Memory, moved: FloatArray) -> tuple[float, IntArray]:
    """Share of a step after which the first tie breaks, inf where none does; the points that break within it.

    memory : before the step; moved : (n_points,) by how much the points open in it
    """
    brittle, limits = joints.brittle, joints.program.limits
    change = -joints.normal * moved
    with np.errstate(divide="ignore", invalid="ignore"):
        above = np.where(brittle[:, 0] & (change > 0.0), (limits.compression - memory.normal) / change, np.inf)
        below = np.where(brittle[:, 1] & (change < 0.0), (-limits.tension - memory.normal) / change, np.inf)
    share = np.minimum(above, below)
    return float(share.min(initial=np.inf)), np.flatnonzero(share <= 1.0)


def without(joints: ElasticJoints, memory: Memory, points: IntArray) -> tuple[ElasticJoints, Memory]:
    """Joints and memory once some points have broken: what hangs on them has no force but what is not a tie's."""
    stiffness, gap, brittle = joints.normal.copy(), memory.normal.copy(), joints.brittle.copy()
    gap[points] = force_of_none(joints)[points]
    stiffness[points] *= GONE
    brittle[points] = False
    return replace(joints, normal=stiffness, brittle=brittle), replace(memory, normal=gap)


def force_of_none(joints: ElasticJoints) -> FloatArray:
    """Normal force of points without force of their tie, (n_points,): a prestress is a dead load that N takes back."""
    return np.where(joints.brittle[:, 1], 0.0, -joints.program.limits.tension)


def let_go(joints: ElasticJoints, state: StepState, points: IntArray, sigma: float) -> StepState:
    """A state in which broken points have hardly a force, before the structure has answered."""
    normal, opening = state.normal.copy(), state.opening.copy()
    none = force_of_none(joints)
    normal[points] = none[points] + REMAINING_STRENGTH * (joints.program.limits.compression - none)[points]
    opening[points] = sigma / (normal + joints.program.limits.tension)[points]
    crushing = state.crushing.copy()
    broken = np.isin(joints.crushable, points)
    crushing[broken] = (sigma / joints.room(normal))[broken]
    return replace(state, normal=normal, opening=opening, crushing=crushing)
