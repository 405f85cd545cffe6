"""Where a time history has come to, so that it can go on from there later to the same figures."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.carried import Touching
from mbla.model.pose import Pose
from mbla.model.ties.moved import TieHistory
from mbla.solution.pushover.pose.moved_joints import MovedJoints
from mbla.solution.pushover.way import RATIO
from mbla.solution.time_history.history import TimeHistoryResult
from mbla.solution.time_history.step.energies import Energies
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.time_state import StepCounts, TimeState


@dataclass(frozen=True)
class Checkpoint:
    """A state in time as arrays; names as in :class:`TimeState`.

    found_at, touching, areas : pose of the solids where contacts were found, these, and the areas that their points are
                as stiff as
    tie_rows : (n_ties,) ties of the model that are among the joints
    last     : (m, n_blocks, 3) displacements of the blocks by which the residual displacement still varies
    in_frames : whether the contact points are those of the last frame
    """

    time: float
    length: float
    pose: Pose
    velocities: FloatArray
    momenta: FloatArray
    free: FloatArray
    shear: FloatArray
    dashpots: FloatArray
    ties: TieHistory
    energies: Energies
    counts: StepCounts
    found_at: Pose
    touching: Touching
    areas: FloatArray
    tie_rows: IntArray
    last: FloatArray
    in_frames: bool

    @staticmethod
    def of(state: TimeState, last: FloatArray, in_frames: bool) -> Checkpoint:
        """Of a state."""
        joints = state.joints
        return Checkpoint(
            time=state.time,
            length=state.length,
            pose=state.pose,
            velocities=state.velocities,
            momenta=state.momenta,
            free=state.free,
            shear=state.shear,
            dashpots=state.dashpots,
            ties=state.ties,
            energies=state.energies,
            counts=state.counts,
            found_at=joints.found_at,
            touching=joints.touching,
            areas=joints.areas,
            tie_rows=joints.ties,
            last=last,
            in_frames=in_frames,
        )

    def state(self, bodies: MovingBodies) -> TimeState:
        """The state of the same structure."""
        structure = bodies.structure
        none, gone = np.zeros(structure.n_solids, dtype=np.bool_), np.ones(len(structure.model.ties), dtype=np.bool_)
        gone[self.tie_rows] = False
        joints = MovedJoints.on_points(structure, self.found_at, none, gone, RATIO, self.touching, self.areas)
        return TimeState(
            self.time,
            self.length,
            self.pose,
            self.velocities,
            self.momenta,
            joints,
            self.free,
            self.shear,
            self.dashpots,
            self.ties,
            self.energies,
            self.counts,
        )


@dataclass(frozen=True)
class Unfinished:
    """A time history that was stopped: what there is of it, and where it goes on."""

    found: TimeHistoryResult
    checkpoint: Checkpoint
