"""One step of a structure that moves, at the pose where it ends, for a given live work.

Unknown are the displacements of the solids and the load factor. Gaps, frames, A and loads are those of the end of the
step, so that a load factor has no error of the length of its step::

    n = n₀ − k_N g,     t = t₀ − k_T (w_T − w₀),  cut to the limit of shear l(n)
    A x + f_D + λ f_L = 0,     Σ f_L·du = s

The pose is expected to be where the step before leads on to, velocities turned with their solids. From there a step of
elastic joints (:mod:`mbla.solution.law.joint_step`) makes up for what changes in contacts: smoothed
(:mod:`mbla.solution.pushover.pose.smoothed_step`), or as the law is (:mod:`mbla.solution.pushover.pose.solved_step`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.pose import paths_of
from mbla.solution.law.elastic_joints import Memory, lengths, within
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.pushover.pose.moved_joints import History, JointsAt, MovedJoints

FARTHEST, NEARBY = 0.05, 1e-3
"""Greatest motion of a solid over its size, and greatest rotation, in a direction of a step, and with which its pose
stays as it is."""

ROUNDS, DIRECTIONS = 4, 30
"""Poses at which a step is solved with falling products, one after the other, and most directions at each."""

REGULAR, HELD = 1e-11, 1e-9
"""Springs over the stiffness of a row: that what nothing holds has a place, and what holds blocks at rest."""


@dataclass
class PoseStep:
    """A step from a pose.

    joints  : of what touches there
    history : before it
    start   : where it begins
    factor  : of the program, there
    work    : live work; nothing where the structure is at rest under a load factor
    driven  : whether the live work is given
    held    : (n_rows,) springs that hold solids where the step begins: their masses, where they move in time
    spent   : factorisations
    """

    joints: MovedJoints
    history: History
    start: JointsAt
    factor: float
    work: float
    driven: bool = True
    held: FloatArray | float = 0.0
    spent: int = 0

    def memory(self, at: JointsAt) -> Memory:
        """What the joints remember, for displacements from that pose on."""
        k_n, k_t = at.joints.normal * self.joints.length, at.joints.shear * self.joints.length
        slip = at.offsets[1:] - self.history.slips
        return Memory(self.history.values[0] - k_n * at.offsets[0], self.history.values[1:] - k_t * slip)

    def after(self, at: JointsAt, normal: FloatArray) -> History:
        """What the joints remember once they are at a pose with normal forces, (n_points,)."""
        joints, limits, memory = at.joints, at.joints.program.limits, self.memory(at)
        k_n, k_t = joints.normal * self.joints.length, joints.shear * self.joints.length
        shear, free = within(memory.shear, joints.limit(normal)), self.history.values[0].copy()
        if joints.dilates:
            free = free + joints.dilatancy * k_n / k_t * lengths(memory.shear - shear)
        crushes = joints.crushable
        there = np.minimum(free - k_n * at.offsets[0], limits.compression)
        free[crushes] = (there + k_n * at.offsets[0])[crushes]
        return History(np.vstack([free[None], shear]), at.offsets[1:])

    def rest(self, at: JointsAt, u: FloatArray, done: float) -> JointStep:
        """The rest of the step from a pose, to which displacements have led that did a work."""
        joints, held = at.joints, self.held_springs
        if np.any(u) and np.any(held):
            program = replace(joints.program, dead_load=joints.program.dead_load - held * u)
            joints = replace(joints, program=program)
        springs = held + self.loose_springs
        return JointStep(joints, self.memory(at), self.joints.length, self.driven, self.work - done, springs)

    @property
    def held_springs(self) -> FloatArray:
        """Springs that are part of the balance, (n_rows,)."""
        at_rest = 0.0 if self.driven else HELD * self.joints.length
        return at_rest * self.joints.size + self.held

    @property
    def loose_springs(self) -> FloatArray:
        """That hold what nothing holds, (n_rows,)."""
        return REGULAR * self.joints.length * self.joints.size

    def force(self, at: JointsAt) -> float:
        """n₀, the mean load of a point."""
        program, n = at.joints.program, max(self.joints.n_points, 1)
        dead, live = (float(np.abs(load).sum()) / n for load in (program.dead_load, program.live_load))
        return dead or abs(self.factor) * live or 1.0

    def size(self, u: FloatArray) -> float:
        """Greatest motion of a solid over its size, or rotation, by displacements, (n_rows,)."""
        return greatest_motion(self.joints, self.joints.twists(u))


def greatest_motion(joints: MovedJoints, twists: FloatArray) -> float:
    """Of twists, (n_solids, 6): greatest motion over the size of the solid, and rotation."""
    moved = np.linalg.norm(twists[:, :3], axis=1) / joints.structure.solids.model.blocks.sizes
    return float(max(moved.max(initial=0.0), np.linalg.norm(twists[:, 3:], axis=1).max(initial=0.0)))


def turned_on(twists: FloatArray, share: float) -> FloatArray:
    """Twists of a step that goes on as the one before, (n_solids, 6): velocities turn with their solids."""
    turn, _ = paths_of(twists[:, 3:])
    return np.hstack([np.einsum("nij,nj->ni", turn, twists[:, :3]), twists[:, 3:]]) * share
