"""Greatest values of a time history held against its frames: each at least theirs, and no more than can be between.

Between two frames a block moves by no more than the time between them times its greatest velocities about both, and
free fall.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.history import Peaks
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.verification.in_time.bodies import Solids, rotations_of
from mbla.solution.verification.in_time.loads import free_fall
from mbla.solution.verification.in_time.points import openings_and_slips
from mbla.solution.verification.in_time.said import SAME

FALLEN, TILTED = 0.5, np.pi / 3.0
"""Share of its height by which a block is lower that has fallen, and angle by which one is tilted that turns over.
Soil falls as a whole: each of its cells by that share of all of its height, however it turns."""

WINDOW = 0.1
"""Share of the duration, at its end, over which the residual displacement is taken."""


@dataclass(frozen=True)
class PeakCheck:
    """Peaks, and the frames that they are held against."""

    case: LoadCase
    contacts: Contacts
    history: TimeHistory
    solids: Solids
    rows: StepRows
    frames: Frames
    peaks: Peaks

    def failures(self) -> Iterator[Message]:
        """Where they are not those of frames."""
        for words in (*self._displacements(), *self._others(), *self._places(), *self._residuals(), *self._falls()):
            yield Message("time-peak", words)

    @property
    def _room(self) -> float:
        return SAME * float(self.solids.sizes.mean())

    @property
    def _moved(self) -> FloatArray:
        """Displacement from rest, (n_frames, n_blocks, 3)."""
        return np.asarray(self.frames.shifts - self.frames.shifts[0])

    @property
    def _ends(self) -> FloatArray:
        """When the next frame begins, or the history ends, (n_frames,)."""
        return np.append(self.frames.times[1:], self.rows.times[-1])

    def _between(self, speeds: FloatArray, size: float = 1.0) -> FloatArray:
        """By how much what moves with velocities at frames can move from each to the next, (n_frames, n).

        size : of the bodies where the velocities are angular ones
        """
        spans = np.maximum(self._ends - self.frames.times, 0.0)[:, None]
        begin = np.maximum(speeds, np.vstack([speeds[:1], speeds[:-1]]))  # of what is struck, and stops again
        end = np.vstack([begin[2:], begin[-1:], begin[-1:]])[: len(speeds)]
        return np.asarray(spans * (begin + end + spans * free_fall(self.case, self.solids) / size))

    def _frame_of(self, times: FloatArray) -> np.ndarray:
        """The frame that begins last before instants; instants at which one begins are of that before."""
        return np.clip(np.searchsorted(self.frames.times, times, side="left") - 1, 0, len(self.frames) - 1)

    def _displacements(self) -> Iterator[str]:
        peaks, blocks, own = self.peaks, self.solids.model.blocks, np.arange(len(self.solids.label))
        by = np.linalg.norm(self._moved, axis=2)
        short = peaks.displacements < by.max(axis=0) * (1.0 - SAME) - self._room
        if short.any() or np.isnan(peaks.displacements).any():
            yield f"{blocks.name(int(short.argmax()))} is displaced further in a frame than its peak says"
        end = float(self.rows.times[-1])
        if not ((peaks.times >= 0.0) & (peaks.times <= end * (1.0 + SAME))).all():
            yield "a peak is later than the time history, or before it"
            return
        frame = self._frame_of(peaks.times)
        between = self._between(np.linalg.norm(self.frames.velocities[:, :, :3], axis=2))
        allowed = self._reached(by, between)[frame, own]
        far = peaks.displacements > allowed * (1.0 + SAME) + self._room
        if far.any():
            block = int(far.argmax())
            yield f"the peak of {blocks.name(block)}, {peaks.displacements[block]:.4g}, is none of the frames about it"

    def _others(self) -> Iterator[str]:
        """Rotations of blocks, openings and slips of interfaces."""
        frames, peaks, blocks = self.frames, self.peaks, self.solids.model.blocks
        turns = np.stack([rotations_of(each) for each in frames.turns])
        cosine = 0.5 * (np.einsum("fnij,nij->fn", turns, turns[0]) - 1.0)
        spins = np.linalg.norm(frames.velocities[:, :, 3:], axis=2)
        reach = np.zeros(len(blocks))
        arms = np.linalg.norm(blocks.vertices - blocks.centroids[blocks.block_of_vertex], axis=1)
        np.maximum.at(reach, blocks.block_of_vertex, arms)
        fast = np.hstack(
            [np.linalg.norm(frames.velocities[:, :, :3], axis=2) + spins * reach, np.zeros((len(frames), 1))]
        )
        pair = np.minimum(self.contacts.bodies, len(blocks))
        apart = [openings_and_slips(self.solids.model, self.contacts, *each) for each in self._poses()]
        openings, slips = (np.maximum(np.stack(each), 0.0) for each in zip(*apart, strict=True))
        relative = fast[:, pair[:, 0]] + fast[:, pair[:, 1]]
        angles = np.arccos(np.clip(cosine, -1.0, 1.0))
        for words, told, values, speeds in (
            ("a rotation of a block", peaks.rotations, angles, spins),
            ("the opening of an interface", peaks.openings, openings, relative),
            ("the slip of an interface", peaks.slips, slips, relative),
        ):
            size = self._size if values is angles else 1.0
            allowed = self._reached(values, self._between(speeds, size)).max(axis=0)
            rounding = np.sqrt(SAME) * 1e-2 if values is angles else self._room  # of the cosine of small angles
            least = values.max(axis=0) * (1.0 - SAME) - rounding
            if not ((told >= least) & (told <= allowed * (1.0 + SAME) + rounding)).all():
                yield f"{words} is not the greatest of its frames"

    def _poses(self) -> Iterator[tuple[FloatArray, FloatArray]]:
        yield from zip(self.frames.shifts, self.frames.turns, strict=True)

    def _places(self) -> Iterator[str]:
        """Blocks end as far from rest as their residual displacement says, and where the last frame may lead."""
        frames, ends = self.frames, self.peaks.ends
        by = np.linalg.norm(ends[:, :3] - frames.shifts[0], axis=1)
        if not np.allclose(by, self.peaks.residuals, rtol=SAME, atol=self._room):
            yield "a residual displacement is not that of the place where its block ends"
        turn = np.einsum("nij,nij->n", rotations_of(ends[:, 3:]), rotations_of(frames.turns[-1]))
        angles = np.arccos(np.clip(0.5 * (turn - 1.0), -1.0, 1.0))
        speeds, spins = (np.linalg.norm(frames.velocities[:, :, own], axis=2) for own in (slice(3), slice(3, 6)))
        far = np.linalg.norm(ends[:, :3] - frames.shifts[-1], axis=1) > self._between(speeds)[-1] + self._room
        far |= angles > self._between(spins, self._size)[-1] + np.sqrt(SAME) * 1e-2  # of the cosine of small angles
        if far.any() or np.isnan(ends).any():
            yield f"{self.solids.model.blocks.name(int(far.argmax()))} ends where the last frame does not lead it"

    def _residuals(self) -> Iterator[str]:
        """No pose of the last part is farther from the end than said."""
        begin = (
            self.rows.times[-1] - (round(WINDOW * self.history.duration / self.history.step) - 0.5) * self.history.step
        )
        last = self.frames.times >= begin
        by = np.linalg.norm(self._moved, axis=2)[last]
        residuals, wanders = self.peaks.residuals, self.peaks.wanders
        near = np.abs(by - residuals) <= wanders * (1.0 + SAME) + self._room
        if not near.all() or not (residuals <= self.peaks.displacements * (1.0 + SAME) + self._room).all():
            yield "a residual displacement is not that of the last frames"
        between = self._between(np.linalg.norm(self.frames.velocities[:, :, :3], axis=2))[last].sum(axis=0)
        spread = np.ptp(self._moved[last], axis=0) if last.any() else np.full((len(wanders), 3), np.inf)
        if not (wanders <= np.linalg.norm(spread, axis=1) + between + self._room).all():
            yield "a residual displacement is said to vary more than the last frames do"

    def _falls(self) -> Iterator[str]:
        """Blocks that are said to have fallen are lower by half of their height or have turned over; no others are."""
        blocks, falling, own = self.solids.model.blocks, self.peaks.falling, np.arange(len(self.solids.label))
        down, frames = self._down(), self.frames
        height = self._heights(down)
        lower = self._moved @ down / height
        turns = np.stack([rotations_of(each) for each in frames.turns])
        tilts = np.arccos(np.clip(np.einsum("i,fnij,nkj,k->fn", down, turns, turns[0], down), -1.0, 1.0))
        by_tilt = TILTED * np.where(self.solids.model.soil_of_block < 0, 1.0, np.inf)
        fallen = ~np.isnan(falling)
        seen = (lower > FALLEN * (1.0 + SAME)) | (tilts > by_tilt * (1.0 + SAME))
        when = np.where(seen.any(axis=0), frames.times[seen.argmax(axis=0)], np.inf)
        late = np.where(fallen, falling, np.inf) > when * (1.0 + SAME)
        if late.any():
            yield f"{blocks.name(int(late.argmax()))} has fallen in a frame and is not said to have by then"
        frame = self._frame_of(np.where(fallen, falling, 0.0))
        by_speed = self._between(np.abs(frames.velocities[:, :, :3] @ down)) / height
        by_spin = self._between(np.linalg.norm(frames.velocities[:, :, 3:], axis=2), self._size)
        near = self._reached(lower, by_speed)[frame, own] >= FALLEN * (1.0 - SAME)
        near |= self._reached(tilts, by_spin)[frame, own] >= by_tilt * (1.0 - SAME)
        if (missing := fallen & ~near).any():
            yield f"{blocks.name(int(missing.argmax()))} is said to have fallen, and no frame shows it"

    def _heights(self, down: FloatArray) -> FloatArray:
        """Along a direction, (n_blocks,): of each block, of a cell that of its soil."""
        blocks, soil = self.solids.model.blocks, self.solids.model.soil_of_block
        whole = np.where(soil < 0, len(self.solids.model.soils) + np.arange(len(blocks)), soil)
        of_corner, along = whole[blocks.block_of_vertex], blocks.vertices @ down
        least, most = np.full((2, len(self.solids.model.soils) + len(blocks)), [[np.inf], [-np.inf]])
        np.minimum.at(least, of_corner, along)
        np.maximum.at(most, of_corner, along)
        return np.asarray((most - least)[whole])

    @staticmethod
    def _reached(values: FloatArray, between: FloatArray) -> FloatArray:
        """Most that values at frames can come to until the next frame, (n_frames, n)."""
        return np.asarray(np.maximum(values, np.vstack([values[1:], values[-1:]])) + between)

    @property
    def _size(self) -> float:
        return float(self.solids.sizes.min())

    def _down(self) -> FloatArray:
        """Direction of the dead load; −z without any."""
        kept = self.case.dead_load - self.history.dead_following
        total = kept[:, :3].sum(axis=0)
        size = float(np.linalg.norm(total))
        return np.asarray(total / size if size > 0.0 else np.array([0.0, 0.0, -1.0]))
