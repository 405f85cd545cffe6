"""Instants, base and end that a time history says, held against its rows, its frames and its record."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.history import Peaks, TimeHistoryResult
from mbla.solution.time_history.step_rows import HistoryEnd, StepRows
from mbla.solution.verification.in_time.bodies import Solids
from mbla.solution.verification.in_time.loads import free_fall
from mbla.solution.verification.in_time.motion import base_displacements
from mbla.solution.verification.in_time.rows import rows_of_frames

SAME = 1e-6
"""Difference of two figures, over the greatest of their kind, that are one."""

REST = 1e-9
"""Kinetic energy over weight times mean size of bodies of what is at rest; a run waits for a tenth of it."""


def same(one: FloatArray, other: FloatArray, size: float = 0.0) -> bool:
    """Whether figures are the same.

    size : of their kind, where all may be small
    """
    scale = max(float(np.abs(other).max(initial=0.0)), size)
    return bool((np.abs(one - other) <= SAME * scale).all())


def frames_failures(history: TimeHistory, solids: Solids, rows: StepRows, frames: Frames) -> Iterator[Message]:
    """Where instants of rows and frames are not those asked for, or frames are not whole."""

    def failure(words: str) -> Message:
        return Message("time-frames", words)

    steps = np.diff(rows.times)
    if rows.times[0] != 0.0 or not (steps > 0.0).all() or not (steps <= history.step * (1.0 + SAME)).all():
        yield failure("the rows of the time history are not those of its steps from the begin on")
    if not np.array_equal(frames.solid_of_block, solids.label):
        yield failure("the bodies of the time history are others than those of its deck")
    values = [len(frames.sets[each].laws) for each in frames.set_of_frame.tolist()]
    if len(frames) == 0 or not np.array_equal(np.diff(frames.point_start), values):
        yield failure("frames of the time history have other contact points than forces")
        return
    if frames.times[0] != 0.0 or (rows_of_frames(rows, frames, history.step) < 0).any():
        yield failure("a frame of the time history begins where it has no row")
    longest = float(np.diff(np.append(frames.times, rows.times[-1])).max(initial=0.0))
    if not longest <= (max(history.every, history.step) + history.step) * (1.0 + SAME):
        words = f"the time history has no frame for {longest:.4g} s, where its deck asks for one every "
        yield failure(f"{words}{history.every:.4g} s")
    if not ((frames.lengths > 0.0) & (frames.lengths <= history.step * (1.0 + SAME))).all():
        yield failure("a frame of the time history is longer than a step")
    if int(frames.missed.sum()) > int(rows.missed[-1]):
        yield failure("frames of the time history have missed more steps than its rows say")
    if any((np.diff(kind) < 0).any() for kind in (rows.missed, rows.halved, rows.small_steps, rows.factorisations)):
        yield failure("counts of the time history fall from a row to the next")
    if not same(frames.base, base_displacements(history, frames.times)):
        yield Message("time-base", "the base of a frame is not where the record takes it")


def said_failures(history: TimeHistory, frames: Frames, result: TimeHistoryResult) -> Iterator[Message]:
    """Where sag and damping are not those of the first frame and of the first period that is said."""
    sag = float(np.linalg.norm(frames.shifts[0], axis=1).max(initial=0.0))
    if not abs(result.sag - sag) <= SAME * sag:
        yield Message("time-frames", f"the joints give by {sag:.4g} at rest, and are said to give by {result.sag:.4g}")
    damping = history.damping + np.pi * history.step / result.period
    if not np.isclose(result.damping, damping, rtol=SAME, atol=0.0, equal_nan=True):
        yield Message("time-frames", "the damping that is said is not that of the step and the first period")


def end_failures(
    case: LoadCase, history: TimeHistory, solids: Solids, rows: StepRows, peaks: Peaks, end: HistoryEnd
) -> Iterator[Message]:
    """Where the end is not the one that rows and peaks show: the first of these, and nothing after it."""
    last = float(rows.times[-1])
    fallen = history.stop_at_collapse and not np.isnan(peaks.falling).all()
    falls = float(np.nanmin(peaks.falling)) if fallen else np.inf
    far = bool(peaks.displacements.max(initial=0.0) >= history.stop_displacement)
    shown = [
        kind
        for kind, seen in (
            (HistoryEnd.COLLAPSE, falls < np.inf),
            (HistoryEnd.DISPLACED, far),
            (HistoryEnd.DURATION, last >= history.duration * (1.0 - SAME)),
        )
        if seen
    ]
    if shown and end is not shown[0]:
        yield Message("time-end", f"the time history ends because {shown[0]}, and says: {end or 'nothing'}")
    elif not shown and not _may_end(case, history, solids, rows, end):
        yield Message("time-end", f"the time history does not show that {end or 'it ends'}")
    if last > history.duration * (1.0 + SAME) + history.step or falls < last - history.step * SAME:
        yield Message("time-end", "the time history goes on after its end")


def _may_end(case: LoadCase, history: TimeHistory, solids: Solids, rows: StepRows, end: HistoryEnd) -> bool:
    """Whether it may end so where rows and peaks show nothing; why a run was cut off they cannot show."""
    if end is not HistoryEnd.AT_REST:
        return end in (HistoryEnd.LATE, HistoryEnd.STOPPED)
    signals = [motion.signal for motion in history.motions] + [force.signal for force in history.forces]
    over = max((float(signal.times[-1]) for signal in signals), default=0.0)
    weight = free_fall(case, solids) * float(solids.masses[solids.free].sum())
    still = rows.kinetic[-1] <= REST * weight * float(solids.sizes.mean())
    return bool(history.stop_at_rest and still and rows.times[-1] >= over)
