"""Elastic joints in one step of time: their dashpots, and the step of the joint law with the masses of the bodies.

A joint that moves by d = h u in a step carries, with β of its dashpot in series of the law, and its gap g before it::

    n = n̄ − k_N (1 + β/h) d_N,   n̄ = −k_N g,      t = t̄ − k_T (1 + β/h) d_T,   within its law
    t̄ ← t + β k_T d_T/h, cut to the limit of shear             (what the dashpot carried is not remembered)

so that a step of time is a step of the path of elastic joints (:mod:`mbla.solution.law.joint_equations`) with stiffer
joints and one more term in its balance (:mod:`mbla.solution.law.masses`).
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import Memory, within
from mbla.solution.law.joint_equations import JointStep
from mbla.solution.law.masses import Masses
from mbla.solution.law.return_map import JointForces
from mbla.solution.pushover.pose.moved_joints import JointsAt, MovedJoints
from mbla.solution.time_history.step.time_state import TimeState


@dataclass(frozen=True)
class JointsInStep:
    """Joints at the pose where a step begins.

    dashpots : (n_points,) β, s
    free     : (n_points,) normal force at no gap, what has crushed taken in
    """

    joints: MovedJoints
    at: JointsAt
    dashpots: FloatArray
    free: FloatArray
    shear: FloatArray
    h: float

    @staticmethod
    def of(state: TimeState, h: float) -> JointsInStep:
        """Of a step of length h from a state."""
        at, free = state.at, state.free
        crushes = at.joints.crushable
        if len(crushes):
            gaps = (at.joints.normal * state.joints.length * at.offsets[0])[crushes]
            strength = at.joints.program.limits.compression[crushes]
            free = free.copy()
            free[crushes] = np.minimum(free[crushes] - gaps, strength) + gaps
        return JointsInStep(state.joints, at, state.dashpots, free, state.shear, h)

    @property
    def stiffness(self) -> tuple[FloatArray, FloatArray]:
        """k_N and k_T of the points in units of the program, (n_points,) each."""
        length = self.joints.length
        return self.at.joints.normal * length, self.at.joints.shear * length

    def step(self, masses: Masses) -> JointStep:
        """The step of the joint law."""
        stiffer = 1.0 + self.dashpots / self.h
        joints = replace(self.at.joints, normal=self.at.joints.normal * stiffer, shear=self.at.joints.shear * stiffer)
        memory = Memory(self.free - self.stiffness[0] * self.at.offsets[0], self.shear)
        return JointStep(joints, memory, self.joints.length, driven=False, work=0.0, masses=masses)

    def remembered(self, forces: JointForces, slips: FloatArray) -> FloatArray:
        """Elastic shear after the step, (components − 1, n_points), from its forces and slips of the same shape."""
        elastic = forces.shear + self.dashpots / self.h * self.stiffness[1] * slips
        return within(elastic, self.at.joints.limit(forces.normal))

    def stored(self, forces: JointForces, shear: FloatArray) -> float:
        """Elastic energy of joints after the step, in units of the program."""
        k_n, k_t = self.stiffness
        return 0.5 * float((forces.normal**2 / k_n).sum() + (shear**2 / k_t).sum())
