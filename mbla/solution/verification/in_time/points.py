"""Histories at named points and interfaces held against frames and record, at the instants that both have."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import Model
from mbla.model.motion.signal import Signal
from mbla.model.motion.time_history import RecordedPoint, TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.history import RecordedHistories
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.verification.in_time.bodies import MovedSolids, Solids, rotations_of, spins_before
from mbla.solution.verification.in_time.motion import base_changes, base_displacements
from mbla.solution.verification.in_time.rows import rows_of_frames
from mbla.solution.verification.in_time.said import SAME, same

FAST = 1e-3
"""Difference of two velocities, or accelerations, over the greatest that are one: the inertia half a step before is
known to the turn that a step adds."""


@dataclass(frozen=True)
class HistoryCheck:
    """Histories, and the frames that they are held against.

    at : (n_frames,) instant of each, the row at which it begins
    """

    contacts: Contacts
    history: TimeHistory
    solids: Solids
    rows: StepRows
    frames: Frames
    found: RecordedHistories
    at: IntArray

    @staticmethod
    def of(
        contacts: Contacts,
        history: TimeHistory,
        solids: Solids,
        rows: StepRows,
        frames: Frames,
        found: RecordedHistories,
    ) -> HistoryCheck:
        """Of a time history."""
        at = rows_of_frames(rows, frames, history.step)
        return HistoryCheck(contacts, history, solids, rows, frames, found, at)

    def failures(self) -> Iterator[Message]:
        """Where histories are not those of poses, record and forces."""
        if not np.array_equal(self.found.times, self.rows.times):
            yield Message("time-histories", "histories are of other instants than the rows of the time history")
            return
        middles, ends = self.found.velocity_times, self.found.times
        own = same(middles[self.at], (self.frames.times - self.frames.lengths_before / 2.0))
        if not (own and middles[0] == 0.0 and (middles[1:] > ends[:-1]).all() and (middles[1:] < ends[1:]).all()):
            yield Message("time-histories", "velocities of the histories are of other instants than steps have them")
            return
        yield from self._of_base()
        for number, point in enumerate(self.history.points):
            yield from self._of_point(number, point)
        if self.history.interfaces:
            yield from self._of_interfaces()

    def _of_base(self) -> Iterator[Message]:
        found, times = self.found, self.found.times
        gone = base_displacements(self.history, times)
        fast = base_changes(self.history, np.full_like(times, -np.inf), times)
        accelerated, sure = accelerations(self.history, times)
        told = found.base[:, 0], found.base[:, 1], found.base[sure, 2]
        if not all(same(one, other) for one, other in zip(told, (gone, fast, accelerated[sure]), strict=True)):
            yield Message("time-base", "the motion of the base in the histories is not that of the record")

    def _of_point(self, number: int, point: RecordedPoint) -> Iterator[Message]:
        found, frames, at = self.found, self.frames, self.at
        arm = point.point - self.solids.model.blocks.centroids[point.block]
        places = frames.shifts[:, point.block] + rotations_of(frames.turns[:, point.block]) @ arm
        size = float(self.solids.sizes.mean())
        if not same(found.displacements[at, number], places - places[0], SAME * size):
            yield Message("time-histories", f"the displacement of {point.name} is not that of the poses of its block")
        speeds, gains, room = np.zeros((len(frames), 3)), np.full((len(frames), 3), np.nan), np.zeros(len(frames))
        for frame in range(len(frames)):
            speeds[frame], gains[frame], room[frame] = self._motion(frame, point)
        largest = max(float(np.abs(found.velocities[:, number]).max(initial=0.0)), SAME * size / self.history.step)
        if not float(np.abs(found.velocities[at, number] - speeds).max(initial=0.0)) <= FAST * largest:
            yield Message("time-histories", f"the velocity of {point.name} is not that of the momentum of its block")
        ends = frames.times - frames.lengths_before / 2.0, frames.times + frames.lengths / 2.0
        next_one = np.minimum(at + 1, len(found.times) - 1)
        known = ~np.isnan(gains).any(axis=1) & (at + 1 < len(found.times))
        shaken = base_changes(self.history, *ends) / (ends[1] - ends[0])[:, None]
        if found.accelerations[0, number].any():
            yield Message("time-histories", f"{point.name} is at rest at first, and its acceleration is not 0 there")
        relative = found.accelerations[next_one, number] - shaken
        largest = max(
            float(np.abs(found.accelerations[:, number]).max(initial=0.0)), largest / self.history.step * FAST
        )
        off = np.abs(relative - gains).max(axis=1) - np.maximum(room, np.append(0.0, room[:-1]))
        if not float(off[known].max(initial=0.0)) <= FAST * largest:
            yield Message("time-histories", f"the acceleration of {point.name} is not that of frames")

    def _motion(self, frame: int, point: RecordedPoint) -> tuple[FloatArray, FloatArray, float]:
        """Velocity of a point before the step, its acceleration to that after it at the pose there, and room for that.

        The acceleration is nan where the step is one of several in the place of one of the deck. It follows from spins
        with the inertia half a step ahead, to where the spin before leads: off by as much as the spin changes.
        """
        frames, solids = self.frames, self.solids
        moved = MovedSolids(solids, frames.shifts[frame], frames.turns[frame])
        h, before = float(frames.lengths[frame]), float(frames.lengths_before[frame])
        solid = int(solids.label[point.block])
        if not solids.free[solid] or solids.masses[solid] == 0.0:
            return np.zeros(3), np.zeros(3), 0.0
        momenta = frames.momenta_before[frame]
        spin = spins_before(solids, moved, momenta[:, 3:], before)[solid]
        speed = momenta[solid, :3] / solids.masses[solid]
        arm = moved.rotations[solid] @ (point.point - solids.centres[solid])
        own = speed + np.cross(spin, arm)
        row = int(self.at[frame])
        whole = row + 1 < len(self.rows) and abs(self.rows.times[row + 1] - self.rows.times[row] - h) <= SAME * h
        if not whole:
            return own, np.full(3, np.nan), 0.0
        turning = frames.velocities[frame, point.block, 3:]
        there = rotations_of(turning[None] * h)[0] @ arm
        after = frames.momenta[frame, solid, :3] / solids.masses[solid]
        gain = after - speed + np.cross(turning - spin, there)
        fast = float(np.linalg.norm(turning) + np.linalg.norm(spin)) * float(np.linalg.norm(turning - spin))
        return own, gain / ((h + before) / 2.0), 0.5 * fast * float(np.linalg.norm(arm))

    def _of_interfaces(self) -> Iterator[Message]:
        found, frames, history, at = self.found, self.frames, self.history, self.at
        pairs = np.sort(self.contacts.bodies, axis=1)
        named = [np.flatnonzero((pairs == np.sort(each.bodies)).all(axis=1)) for each in history.interfaces]
        solids, model = self.solids, self.solids.model
        solid = np.append(solids.label, len(solids) + np.arange(len(model.grounds)))
        forces = np.zeros((len(frames), len(named), 3))
        apart = np.zeros((len(frames), len(named), 2))
        for frame in range(len(frames)):
            values = openings_and_slips(model, self.contacts, frames.shifts[frame], frames.turns[frame])
            apart[frame] = [[each[own].max(initial=-np.inf) for each in values] for own in named]
            forces[frame] = self._forces(frame, [solid[each.bodies] for each in history.interfaces])
        apart[~np.isfinite(apart)] = 0.0
        size = SAME * float(solids.sizes.mean())
        told = np.stack([found.openings, found.slips], axis=2)[at]
        if not same(told, apart, size):
            yield Message("time-histories", "opening or slip of an interface is not that of the poses of its bodies")
        inside = at + 1 < len(found.times)
        if not same(found.forces[at[inside] + 1], forces[inside]):
            yield Message("time-histories", "the force of an interface is not that of its contact points")

    def _forces(self, frame: int, pairs: list[IntArray]) -> FloatArray:
        """On the second of each pair of bodies, (n_pairs, 3)."""
        frames = self.frames
        moved = MovedSolids(self.solids, frames.shifts[frame], frames.turns[frame])
        points = frames.sets[int(frames.set_of_frame[frame])]
        on = points.bodies[:, 0] >= 0
        bodies = points.bodies[on]
        axes = moved.turned(np.where(points.host[on], bodies[:, 1], bodies[:, 0]), points.frames[on])
        forces = np.einsum("nk,nkj->nj", frames.forces[frames.values(frame)][on], axes)
        total = np.zeros((len(pairs), 3))
        for number, (one, other) in enumerate(pairs):
            total[number] = forces[(bodies == (one, other)).all(axis=1)].sum(axis=0)
            total[number] -= forces[(bodies == (other, one)).all(axis=1)].sum(axis=0)
        return total


def openings_and_slips(
    model: Model, contacts: Contacts, shifts: FloatArray, turns: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Of interfaces as built, the largest between their points on the two bodies, (n_interfaces,) each.

    In the frame of the interface as it turns with its first body.
    """
    blocks, rotations = model.blocks, rotations_of(turns)
    bodies = contacts.bodies[contacts.interface_of_point]
    places = []
    for side in (0, 1):
        on = bodies[:, side] < len(blocks)
        own = bodies[on, side]
        place = contacts.points.copy()
        arms = contacts.points[on] - blocks.centroids[own]
        place[on] = blocks.centroids[own] + shifts[own] + np.einsum("nij,nj->ni", rotations[own], arms)
        places.append(place)
    on, apart = bodies[:, 0] < len(blocks), places[1] - places[0]
    apart[on] = np.einsum("nji,nj->ni", rotations[bodies[on, 0]], apart[on])
    along = np.einsum("nij,nj->ni", contacts.frames, apart)
    openings, slips = (np.full(len(contacts), -np.inf) for _ in range(2))
    np.maximum.at(openings, contacts.interface_of_point, along[:, 0])
    np.maximum.at(slips, contacts.interface_of_point, np.hypot(along[:, 1], along[:, 2]))
    return openings, slips


def accelerations(history: TimeHistory, times: FloatArray) -> tuple[FloatArray, np.ndarray]:
    """Of the base, (n, 3), and where no jump of a record is so near that rounding decides."""
    total, sure = np.zeros((len(times), 3)), np.ones(len(times), dtype=bool)
    for motion in history.motions:
        value, own = _values(motion.signal, times)
        total += value[:, None] * motion.direction
        sure &= own
    return total, sure


def _values(signal: Signal, times: FloatArray) -> tuple[FloatArray, np.ndarray]:
    jumps = signal.times[1:][np.diff(signal.times) == 0.0]
    ends = signal.times[[0, -1]][signal.values[[0, -1]] != 0.0]
    edges = np.sort(np.concatenate([jumps, ends, [np.inf]]))
    place = np.searchsorted(edges, times)
    near = np.minimum(np.abs(edges[place] - times), np.abs(edges[np.maximum(place - 1, 0)] - times))
    return np.interp(times, signal.times, signal.values, left=0.0, right=0.0), near > SAME * signal.duration
