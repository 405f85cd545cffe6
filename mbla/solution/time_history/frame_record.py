"""Frames of a structure in time: states that are kept of it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from mbla.arrays import BoolArray, FloatArray, starts
from mbla.solution.pushover.pose.moved_joints import MovedJoints
from mbla.solution.time_history.frames import Frames, PointSet
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.solved_velocities import BALANCED
from mbla.solution.time_history.step.time_step import StepMade


@dataclass(frozen=True)
class FrameRecord:
    """One frame; fields as in :class:`Frames`."""

    time: float
    length: float
    length_before: float
    shift: FloatArray
    turn: FloatArray
    momenta_before: FloatArray
    momenta: FloatArray
    velocities: FloatArray
    base: FloatArray
    missed: bool
    number: int
    remembered: FloatArray
    forces: FloatArray


@dataclass
class FrameKeeper:
    """Frames so far, and the contact points of each search that some of them have."""

    bodies: MovingBodies
    frames: list[FrameRecord] = field(default_factory=list)
    sets: list[PointSet] = field(default_factory=list)
    of_last: MovedJoints | None = None

    @staticmethod
    def resumed(bodies: MovingBodies, frames: Frames, joints: MovedJoints | None) -> FrameKeeper:
        """After frames that are on record; joints that the last of them has, where they go on."""
        records = []
        for number in range(len(frames)):
            values = frames.values(number)
            records.append(
                FrameRecord(
                    time=float(frames.times[number]),
                    length=float(frames.lengths[number]),
                    length_before=float(frames.lengths_before[number]),
                    shift=frames.shifts[number],
                    turn=frames.turns[number],
                    momenta_before=frames.momenta_before[number],
                    momenta=frames.momenta[number],
                    velocities=frames.velocities[number],
                    base=frames.base[number],
                    missed=bool(frames.missed[number]),
                    number=int(frames.set_of_frame[number]),
                    remembered=frames.remembered[values],
                    forces=frames.forces[values],
                )
            )
        return FrameKeeper(bodies, records, list(frames.sets), joints)

    def add(self, step: StepMade) -> None:
        """A step."""
        state, after, own = step.before, step.after, step.joints
        joints, structure = own.joints, self.bodies.structure
        if joints is not self.of_last:
            self.sets.append(point_set(self.bodies, joints, own.dashpots))
            self.of_last = joints
        blocks = structure.blocks_at(state.pose)
        solids = structure.solids
        moves = after.velocities[solids.label]
        arms = np.einsum("nij,nj->ni", state.pose.rotation[solids.label], solids.arms)
        velocities = np.hstack([moves[:, :3] + np.cross(moves[:, 3:], arms), moves[:, 3:]])
        always = np.zeros((len(joints.contacts.points), 3))
        if joints.contacts.ties is not None:  # N is what the force of a tie differs from that
            always[len(joints.areas) :, 0] = joints.contacts.ties.offsets
        self.frames.append(
            FrameRecord(
                time=state.time,
                length=own.h,
                length_before=state.length,
                shift=blocks.shift,
                turn=blocks.rotation_vectors,
                momenta_before=state.momenta,
                momenta=after.momenta,
                velocities=velocities,
                base=self.bodies.history.base_displacement(state.time),
                missed=step.error >= BALANCED,
                number=len(self.sets) - 1,
                remembered=joints.forces(np.vstack([own.free[None], own.shear])) + always,
                forces=joints.forces(np.vstack([step.forces.normal[None], step.forces.shear])) + always,
            )
        )

    def before(self, time: float) -> None:
        """Leaves out frames that begin later, s, and contact points that only these have."""
        while self.frames and self.frames[-1].time >= time:
            self.frames.pop()
        used = self.frames[-1].number + 1 if self.frames else 0
        if len(self.sets) > used:
            del self.sets[used:]
            self.of_last = None

    def result(self) -> Frames:
        """All frames."""
        frames = self.frames

        def stacked(name: str) -> FloatArray:
            return np.stack([getattr(frame, name) for frame in frames])

        missed: BoolArray = np.array([frame.missed for frame in frames])
        return Frames(
            times=stacked("time"),
            lengths=stacked("length"),
            lengths_before=stacked("length_before"),
            shifts=stacked("shift"),
            turns=stacked("turn"),
            solid_of_block=self.bodies.structure.solids.label,
            momenta_before=stacked("momenta_before"),
            momenta=stacked("momenta"),
            velocities=stacked("velocities"),
            base=stacked("base"),
            missed=missed,
            set_of_frame=np.array([frame.number for frame in frames], dtype=np.int64),
            point_start=starts(np.array([len(frame.forces) for frame in frames])),
            remembered=np.concatenate([frame.remembered for frame in frames]),
            forces=np.concatenate([frame.forces for frame in frames]),
            sets=tuple(self.sets),
        )


def point_set(bodies: MovingBodies, joints: MovedJoints, dashpots: FloatArray) -> PointSet:
    """The contact points of joints, ties last, with their dashpots, (n_points of the program,)."""
    structure, points, contacts = bodies.structure, joints.touching.points, joints.touching.contacts
    n_ties = len(joints.ties)
    laws = structure.laws_of(contacts)[contacts.interface_of_point]
    areas = joints.full.facts.areas
    along = joints.ratio * np.append(structure.along(joints.touching), np.ones(n_ties))
    stiffness = structure.stiffness * areas[:, None] * np.column_stack([np.ones(len(areas)), along, along])
    holds = abs(joints.reduced.lift.normal_forces)
    mean = np.asarray(holds @ dashpots) / np.maximum(np.asarray(holds @ np.ones(len(dashpots))), 1e-300)

    def with_ties(values: np.ndarray, of_tie: float) -> np.ndarray:
        return np.concatenate([values, np.full((n_ties, *values.shape[1:]), of_tie, dtype=values.dtype)])

    return PointSet(
        bodies=with_ties(points.bodies, -1),
        host=with_ties(points.host, False),
        arms=with_ties(points.arms.transpose(1, 0, 2), 0.0),
        frames=with_ties(points.frames, 0.0),
        laws=np.append(laws, joints.ties),
        areas=np.append(contacts.point_areas, np.zeros(n_ties)),
        stiffness=stiffness,
        dashpot=mean,
    )
