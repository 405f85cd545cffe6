"""Histories of the points and interfaces that a deck names, one instant for each of its steps."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.pose import Pose
from mbla.solution.law.return_map import JointForces, joint_forces
from mbla.solution.time_history.as_built import CornersAsBuilt
from mbla.solution.time_history.history import RecordedHistories
from mbla.solution.time_history.step.joints_in_step import JointsInStep
from mbla.solution.time_history.step.march import DeckStep
from mbla.solution.time_history.step.moving_bodies import MovingBodies
from mbla.solution.time_history.step.time_state import TimeState

Instant = tuple[FloatArray, ...]


@dataclass
class Instants:
    """Of a structure that begins at rest.

    rest     : pose of the blocks there
    corners  : of the interfaces between the bodies that are named, one after the other
    of_named : (n_corner interfaces,) number of the pair that each is of
    """

    bodies: MovingBodies
    rest: Pose
    corners: CornersAsBuilt
    of_named: IntArray
    kept: list[Instant] = field(default_factory=list)

    @staticmethod
    def of(bodies: MovingBodies, contacts: Contacts, rest: Pose) -> Instants:
        """For interfaces of an assembly."""
        named = [np.sort(each.bodies) for each in bodies.history.interfaces]
        pairs = np.sort(contacts.bodies, axis=1)
        own = [np.flatnonzero((pairs == each).all(axis=1)) for each in named]
        rows = np.concatenate([*own, np.zeros(0, dtype=np.int64)]).astype(np.int64)
        of_named = np.repeat(np.arange(len(own)), [len(each) for each in own]).astype(np.int64)
        corners = CornersAsBuilt.of(bodies.structure.model.blocks, contacts, rows)
        return Instants(bodies, rest, corners, of_named)

    def after(self, found: RecordedHistories) -> Instants:
        """The same after instants that are on record."""
        rest = (found.openings, found.slips, found.forces)
        times = (found.times[:, None], found.velocity_times[:, None])
        columns = (*times, found.displacements, found.velocities, found.accelerations, *rest)
        return replace(self, kept=list(zip(*columns, strict=True)))

    def add(self, state: TimeState, there: Pose, before: TimeState | None, step: DeckStep | None) -> None:
        """The instant at which a state is; nothing before it at the first."""
        blocks = self.bodies.structure.model.blocks
        moved = there.displacements(blocks, self._owners, self._points)
        moved -= self.rest.displacements(blocks, self._owners, self._points)
        speed = self._speeds(state, there)
        middle, history = state.time - 0.5 * state.length, self.bodies.history
        acceleration = np.zeros_like(speed)
        if before is not None:
            # the middles of the last steps before both, which may be small ones; of the base the mean between them too
            begin = before.time - 0.5 * before.length
            gain = history.base_velocity(middle) - history.base_velocity(begin)
            acceleration = (speed - self._speeds(before, there) + gain) / (middle - begin)
        forces = self._at_rest(state) if step is None else self._forces(step.first.joints, step.first.forces)
        apart = [self._largest(each) for each in self.corners.apart(there)]
        times = np.array([state.time]), np.array([middle])
        self.kept.append((*times, moved, speed, acceleration, *apart, forces))

    def result(self) -> RecordedHistories:
        """All instants."""
        times, middles, moved, speeds, accelerations, *rest = (np.stack(each) for each in zip(*self.kept, strict=True))
        base = self._base(times[:, 0])
        return RecordedHistories(times[:, 0], middles[:, 0], moved, speeds, accelerations, base, *rest)

    def _base(self, times: FloatArray) -> FloatArray:
        """Displacement, velocity and acceleration of the base, (m, 3, 3)."""
        of = self.bodies.history
        each = (of.base_displacement, of.base_velocity, of.base_acceleration)
        return np.stack([function(times) for function in each], axis=1)

    @cached_property
    def _owners(self) -> IntArray:
        return np.array([point.block for point in self.bodies.history.points], dtype=np.int64)

    @cached_property
    def _points(self) -> FloatArray:
        return np.array([point.point for point in self.bodies.history.points], dtype=np.float64).reshape(-1, 3)

    def _speeds(self, state: TimeState, there: Pose) -> FloatArray:
        """Of the points, (n_points, 3), with levers of a pose of the blocks."""
        solids = self.bodies.structure.solids
        solid = solids.label[self._owners]
        blocks = self.bodies.structure.model.blocks.centroids[self._owners]
        arms = solids.arms[self._owners] + self._points - blocks
        arms = np.einsum("nij,nj->ni", there.rotation[self._owners], arms)
        own = state.velocities[solid]
        return np.asarray(own[:, :3] + np.cross(own[:, 3:], arms))

    def _largest(self, values: FloatArray) -> FloatArray:
        """Of each named pair, (n_named,); 0 of a pair that did not touch as built."""
        found = np.full(len(self.bodies.history.interfaces), -np.inf)
        np.maximum.at(found, self.of_named, values)
        return np.where(np.isfinite(found), found, 0.0)

    def _at_rest(self, state: TimeState) -> FloatArray:
        """The same of a structure at rest."""
        joints = JointsInStep.of(state, self.bodies.history.step)
        normal = joints.free - joints.stiffness[0] * state.at.offsets[0]
        return self._forces(joints, joint_forces(state.at.joints, np.vstack([normal[None], joints.shear])))

    def _forces(self, joints: JointsInStep, by_law: JointForces) -> FloatArray:
        """On the second of each named pair of bodies, (n_named, 3)."""
        history = self.bodies.history
        found = np.zeros((len(history.interfaces), 3))
        if not len(found):
            return found
        touching = joints.joints.touching
        every = joints.joints.forces(np.vstack([by_law.normal[None], by_law.shear]))
        forces = np.einsum("nk,nkj->nj", every[: len(touching.sizes)], joints.at.placed.frames)
        solid = np.append(self.bodies.structure.solids.label, self._grounds)
        for number, named in enumerate(history.interfaces):
            first, second = solid[named.bodies]
            for pair, sign in (((first, second), 1.0), ((second, first), -1.0)):
                own = (touching.points.bodies == pair).all(axis=1)
                found[number] += sign * forces[own].sum(axis=0)
        return found

    @property
    def _grounds(self) -> IntArray:
        structure = self.bodies.structure
        return structure.n_solids + np.arange(len(structure.model.grounds))
