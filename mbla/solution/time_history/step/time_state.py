"""Where a structure stands in time: poses, velocities, momenta, and what its joints remember."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.pose import Pose
from mbla.model.ties.moved import TieHistory
from mbla.solution.pushover.place import PushedPlace
from mbla.solution.pushover.pose.moved_joints import JointsAt, MovedJoints
from mbla.solution.time_history.step.energies import Energies


@dataclass(frozen=True)
class StepCounts:
    """So far: steps of the deck, steps in their place, halved ones, missed ones, factorisations, searches."""

    steps: int = 0
    small: int = 0
    halved: int = 0
    missed: int = 0
    factorisations: int = 0
    searches: int = 0


@dataclass(frozen=True)
class TimeState:
    """At an instant, velocities half a step earlier.

    time    : s
    length  : h of the step before, s; 0 at first
    pose    : of the solids
    velocities : (n_solids, 6) of mass centres, and angular velocities
    momenta : (n_solids, 6) momentum and angular momentum
    joints  : of what touches
    free    : (n_points,) normal force that each point would have at no gap: 0 but of joints that have crushed, and ties
    shear   : (components − 1, n_points) elastic shear after the step before
    dashpots : (n_points,) β, s
    ties    : history of ties
    """

    time: float
    length: float
    pose: Pose
    velocities: FloatArray
    momenta: FloatArray
    joints: MovedJoints
    free: FloatArray
    shear: FloatArray
    dashpots: FloatArray
    ties: TieHistory
    energies: Energies = field(default_factory=Energies)
    counts: StepCounts = field(default_factory=StepCounts)

    @staticmethod
    def at_rest(place: PushedPlace, dashpots: FloatArray) -> TimeState:
        """Of a structure that rests under its dead load."""
        none = np.zeros((len(place.pose.shift), 6))
        free, shear = place.history.values[0], place.history.values[1:]
        return TimeState(0.0, 0.0, place.pose, none, none, place.joints, free, shear, dashpots, place.ties)

    @cached_property
    def at(self) -> JointsAt:
        """The joints at the pose, without loads."""
        return self.joints.unloaded(self.pose)
