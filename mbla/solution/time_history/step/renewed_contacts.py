"""Contacts found anew while a structure moves in time: what joints remember goes on at the points that are there.

Gaps are those of the poses. Shear goes from points that stay to themselves, from those that are gone to the nearest new
one of the same two bodies, by their areas, and keeps its way in space.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import within
from mbla.solution.pushover.inherited import sources, turned
from mbla.solution.pushover.pose.moved_joints import History, MovedJoints
from mbla.solution.pushover.renewal import is_stale
from mbla.solution.time_history.step.dashpots import dashpots_of
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.time_state import TimeState


def renewed(bodies: MovingBodies, state: TimeState, of_all: float) -> TimeState:
    """The state with contacts found anew where something has moved since they were, or a tie has broken.

    of_all : β that all joints have, s
    """
    joints, structure = state.joints, bodies.structure
    broken = state.ties.broken(structure.model.ties)
    gone = len(joints.ties) > 0 and bool(broken[joints.ties].any())
    if not gone and not is_stale(joints, state.pose, state.at.placed):
        return state
    history = History(np.vstack([state.free[None], state.shear]), state.at.offsets[1:])
    there = MovedJoints.at_pose(structure, state.pose, joints.fallen, broken, joints.ratio, (joints, history))
    counts = replace(state.counts, searches=state.counts.searches + 1)
    free, shear = _remembered(state, there, history.values)
    state = replace(state, joints=there, counts=counts, free=free, shear=shear)
    return replace(state, dashpots=dashpots_of(bodies, there, state.at, of_all))


def _remembered(state: TimeState, there: MovedJoints, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Normal force at no gap, and shear, of joints there, from values of those before, (components, n_points)."""
    old, at = state.joints, there.unloaded(state.pose)
    n_before, n_now = len(old.areas), len(there.areas)
    source = sources(old.touching, state.at.placed, there.touching, at.placed)
    takes = source >= 0
    new = there.touching.before < 0
    forces = old.forces(values)
    found = np.zeros((len(there.contacts.points), 3))
    share, anew = np.ones(n_now), new & takes
    share[anew] = there.areas[anew] / old.areas[source[anew]]
    found[:n_now][takes] = turned(state.at.placed, at.placed, forces[:n_before], takes, source) * share[takes, None]
    row = {tie: number for number, tie in enumerate(old.ties.tolist())}
    found[n_now:] = forces[n_before + np.array([row[tie] for tie in there.ties.tolist()], dtype=np.int64)]
    own = there.values(found)
    normal = own[0] - at.joints.normal * there.length * at.offsets[0]
    return own[0], within(own[1:], at.joints.limit(np.maximum(normal, 0.0)))
