"""What a time history says of itself, held against its frames and rows: instants, histories, peaks, falls, its end."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.history import Peaks, RecordedHistories
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows
from mbla.solution.verification.time_bodies import Solids, rotations_of
from mbla.solution.verification.time_loads import free_fall
from mbla.solution.verification.time_motion import base_changes, base_displacements
from mbla.solution.verification.time_rows import SAME_TIME, rows_of_frames

SAME = 1e-6
"""Difference of two figures, over the greatest of their kind, that are one: what is stored goes through a file."""

FALLEN = 0.5
"""Share of its height by which a block is lower that has fallen."""


def frames_failures(history: TimeHistory, solids: Solids, rows: StepRows, frames: Frames) -> Iterator[Message]:
    """Where instants of rows and frames are not those asked for, or frames are not whole."""

    def failure(words: str) -> Message:
        return Message("time-frames", words)

    steps = np.diff(rows.times)
    if rows.times[0] != 0.0 or not (steps > 0.0).all() or not (steps <= history.step * (1.0 + SAME)).all():
        yield failure("the rows of the time history are not those of its steps from the begin on")
    values = [len(frames.sets[each].laws) for each in frames.set_of_frame.tolist()]
    if len(frames) == 0 or not np.array_equal(np.diff(frames.point_start), values):
        yield failure("frames of the time history have other contact points than forces")
        return
    at = rows_of_frames(rows, frames, history.step)
    if frames.times[0] != 0.0 or (at < 0).any():
        yield failure("a frame of the time history begins where it has no row")
    longest = float(np.diff(np.append(frames.times, rows.times[-1])).max(initial=0.0))
    if not longest <= max(history.every, history.step) * (1.0 + SAME) + history.step:
        yield failure(f"the time history has no frame for {longest:.4g} s, where the deck asks for one every "
                      f"{history.every:.4g} s")  # fmt: skip
    if not (frames.lengths > 0.0).all() or not (frames.lengths <= history.step * (1.0 + SAME)).all():
        yield failure("a frame of the time history is longer than a step")
    base = base_displacements(history, frames.times)
    if not _same(frames.base, base):
        yield Message("time-base", "the base of a frame is not where the record takes it")
    missed = int(frames.missed.sum())
    if missed > int(rows.missed[-1]) or not all((np.diff(kind) >= 0).all() for kind in (rows.missed, rows.halved)):
        yield failure("the time history has missed more steps than its rows say")


def _same(one: FloatArray, other: FloatArray, size: float = 0.0) -> bool:
    scale = max(float(np.abs(other).max(initial=0.0)), size)
    return bool((np.abs(one - other) <= SAME * scale).all())


def histories_failures(
    history: TimeHistory, solids: Solids, frames: Frames, found: RecordedHistories
) -> Iterator[Message]:
    """Where histories at points are not those of poses, record and forces."""
    times = found.times
    moved = base_displacements(history, times)
    fast = base_changes(history, np.full_like(times, -np.inf), times)
    if not (_same(found.base[:, 0], moved) and _same(found.base[:, 1], fast)):
        yield Message("time-base", "the motion of the base in the histories is not that of the record")
    place = np.searchsorted(times, frames.times - SAME_TIME * history.step)
    inside = place < len(times)
    here = inside & (np.abs(times[np.minimum(place, len(times) - 1)] - frames.times) <= SAME_TIME * history.step)
    size = float(solids.sizes.mean())
    centroids = solids.model.blocks.centroids
    for number, point in enumerate(history.points):
        arm = point.point - centroids[point.block]
        there = frames.shifts[:, point.block] + rotations_of(frames.turns[:, point.block]) @ arm
        by = there - there[0]
        if not _same(found.displacements[place[here], number], by[here], size * SAME):
            yield Message("time-histories", f"the history of {point.name} is not that of the poses of its block")


def peaks_failures(case: LoadCase, solids: Solids, rows: StepRows, frames: Frames, peaks: Peaks) -> Iterator[Message]:
    """Where greatest displacements are not those of frames: each at least theirs, and no more than can be between."""
    blocks = solids.model.blocks
    by = np.linalg.norm(frames.shifts - frames.shifts[0], axis=2)
    greatest = by.max(axis=0)
    room = SAME * float(np.mean(solids.sizes))
    if not (peaks.displacements >= greatest * (1.0 - SAME) - room).all():
        block = int(np.argmin(peaks.displacements - greatest))
        yield Message("time-peak", f"{blocks.name(block)} is displaced further in a frame than its peak says")
    end = float(rows.times[-1])
    if not ((peaks.times >= 0.0) & (peaks.times <= end * (1.0 + SAME))).all():
        yield Message("time-peak", "a peak is later than the time history")
        return
    between = np.clip(np.searchsorted(frames.times, peaks.times, side="right") - 1, 0, len(frames) - 1)
    after = np.minimum(between + 1, len(frames) - 1)
    own = np.arange(len(blocks))
    speed = np.linalg.norm(frames.velocities[:, :, :3], axis=2)
    fast = speed[between, own] + speed[after, own]
    near = np.maximum(by[between, own], by[after, own])
    span = np.maximum(np.where(after > between, frames.times[after], end) - frames.times[between], 0.0)
    allowed = near + span * (fast + span * free_fall(case, solids))
    if not (peaks.displacements <= allowed * (1.0 + SAME) + room).all():
        block = int(np.argmax(peaks.displacements - allowed))
        words = f"the peak of {blocks.name(block)}, {peaks.displacements[block]:.4g}, is none of the frames about it"
        yield Message("time-peak", words)
    yield from _falls_failures(solids, frames, rows, peaks)


def _falls_failures(solids: Solids, frames: Frames, rows: StepRows, peaks: Peaks) -> Iterator[Message]:
    """Where blocks that are said to have fallen are not lower by half of their height, or others are."""
    blocks = solids.model.blocks
    low, high = blocks.boxes
    height = (high - low)[:, 2]
    lower = -(frames.shifts - frames.shifts[0])[:, :, 2]
    fallen = ~np.isnan(peaks.falling)
    seen = lower >= FALLEN * height * (1.0 + SAME)
    first = np.where(seen.any(axis=0), frames.times[seen.argmax(axis=0)], np.inf)
    late = np.where(fallen, peaks.falling, np.inf) > first
    if late.any():
        block = int(late.argmax())
        yield Message("time-peak", f"{blocks.name(block)} has fallen in a frame and is not said to have by then")
    before = np.clip(np.searchsorted(frames.times, np.where(fallen, peaks.falling, 0.0), side="right") - 1, 0, None)
    after = np.minimum(before + 1, len(frames) - 1)
    own = np.arange(len(blocks))
    span = np.where(after > before, frames.times[after], rows.times[-1]) - frames.times[before]
    down = np.maximum(-frames.velocities[before, own, 2], -frames.velocities[after, own, 2])
    reached = np.maximum(lower[after, own], lower[before, own]) + span * np.maximum(down, 0.0)
    not_seen = fallen & ~(reached >= FALLEN * height * (1.0 - SAME))
    if not_seen.any():
        block = int(not_seen.argmax())
        yield Message("time-peak", f"{blocks.name(block)} is said to have fallen, and no frame shows it")


def end_failures(history: TimeHistory, rows: StepRows, peaks: Peaks, end: HistoryEnd) -> Iterator[Message]:
    """Where the end is not the one that rows and peaks show."""
    last = float(rows.times[-1])
    done = last >= history.duration * (1.0 - SAME)
    fallen = bool((~np.isnan(peaks.falling)).any())
    far = bool(peaks.displacements.max(initial=0.0) >= history.stop_displacement * (1.0 - SAME))
    shows = {
        HistoryEnd.DURATION: done,
        HistoryEnd.COLLAPSE: fallen,
        HistoryEnd.DISPLACED: far,
        HistoryEnd.AT_REST: history.stop_at_rest,
        HistoryEnd.LATE: True,
        HistoryEnd.STOPPED: True,
    }
    if not shows.get(end, False):
        yield Message("time-end", f"the time history does not show that {end or 'it ends'}")
    if last > history.duration * (1.0 + SAME) + history.step:
        yield Message("time-end", "the time history goes on after the duration that its deck asks for")
