"""Rows of a time history held against each other and against its frames: energies, instants, and the base.

The energy that bodies gain is what base and forces do less what joints take, in every row. Kinetic energy follows from
the momenta of frames, with the inertia half a step before; what the dead load gains from the poses, and from where mass
centres were half a step before: energies are those then. In a step the base does −(p₋ + p)/2·ΔV_g on all bodies, and
about as much with what two frames have at the begin and the end of the time between them.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.verification.time_bodies import MovedSolids, Solids, spins_before
from mbla.solution.verification.time_motion import base_changes

SAME_TIME = 1e-9
"""Difference of two instants over the step of the deck that is none."""


@dataclass(frozen=True)
class RowResidual:
    """How far rows are from what they should be, over the greatest energy of any.

    balance   : of gains, work and what joints take, in a row
    kinetic   : of a row against the momenta of the frame that begins there
    potential : of a row against the poses of that frame
    base      : work of the base against momenta of frames and the record, up to a frame; over what it does and undoes
    loss      : by how much what joints have dissipated falls below what it was
    """

    balance: float
    kinetic: float
    potential: float
    base: float
    loss: float


def greatest_energy(rows: StepRows) -> float:
    """Of any kind in any row."""
    kinds = (rows.kinetic, rows.potential, rows.friction, rows.contacts, rows.ties, rows.base, rows.forces)
    return float(np.max([np.abs(kind).max(initial=0.0) for kind in kinds]))


def rows_of_frames(rows: StepRows, frames: Frames, step: float) -> IntArray:
    """Row at whose instant each frame begins, (n_frames,); −1 where there is none."""
    place = np.clip(np.searchsorted(rows.times, frames.times), 1, max(len(rows) - 1, 1))
    place = np.where(len(rows) == 1, 0, place)
    before = np.maximum(place - 1, 0)
    nearer = np.abs(rows.times[before] - frames.times) < np.abs(rows.times[place] - frames.times)
    place = np.where(nearer, before, place)
    return np.where(np.abs(rows.times[place] - frames.times) <= SAME_TIME * step, place, -1)


def row_residual(case: LoadCase, history: TimeHistory, solids: Solids, rows: StepRows, frames: Frames) -> RowResidual:
    """Of all rows."""
    scale = max(greatest_energy(rows), 1e-300)
    taken = rows.contacts + rows.friction + rows.ties
    lacks = rows.kinetic + rows.potential + taken - rows.base - rows.forces - rows.numerical
    at = rows_of_frames(rows, frames, history.step)
    on = at >= 0
    kinetic = np.array([_kinetic(solids, frames, frame) for frame in range(len(frames))])
    gained = np.array([_gained(case, history, solids, frames, frame) for frame in range(len(frames))])
    dissipated = (taken - rows.elastic)[1:]  # at rest nothing is said of what is stored
    work, size = _base_work(history, solids, frames)
    return RowResidual(
        balance=float(np.abs(lacks).max()) / scale,
        kinetic=float(np.abs(kinetic - rows.kinetic[at])[on].max(initial=0.0)) / scale,
        potential=float(np.abs(gained - rows.potential[at])[on].max(initial=0.0)) / scale,
        base=float(np.abs(work - rows.base[at])[on].max(initial=0.0)) / max(scale, size),
        loss=_fall(dissipated) / scale,
    )


def _kinetic(solids: Solids, frames: Frames, frame: int) -> float:
    """Of all bodies that can move, before the step of a frame."""
    momenta, can = frames.momenta_before[frame], solids.free & (solids.masses > 0.0)
    moved = MovedSolids(solids, frames.shifts[frame], frames.turns[frame])
    spins = spins_before(solids, moved, momenta[:, 3:], float(frames.lengths_before[frame]))
    own = (momenta[can, :3] ** 2).sum(axis=1) / solids.masses[can] + (momenta[:, 3:] * spins).sum(axis=1)[can]
    return 0.5 * float(own.sum())


def _gained(case: LoadCase, history: TimeHistory, solids: Solids, frames: Frames, frame: int) -> float:
    """What the dead load that keeps its direction has gained since the first frame, as if at the mass centres."""
    moved, begun = (MovedSolids(solids, frames.shifts[each], frames.turns[each]) for each in (frame, 0))
    forces = summed(solids.label, (case.dead_load - history.dead_following)[:, :3], len(solids))
    can = solids.free & (solids.masses > 0.0)
    back = frames.momenta_before[frame, can, :3] / solids.masses[can, None] * frames.lengths_before[frame] / 2.0
    return -float((forces[can] * ((moved.centres - begun.centres)[can] - back)).sum())


def _base_work(history: TimeHistory, solids: Solids, frames: Frames) -> tuple[FloatArray, float]:
    """Work of the base up to each frame, (n_frames,), and the sum of what it does and undoes."""
    before, after = (each[:, solids.free, :3].sum(axis=1) for each in (frames.momenta_before, frames.momenta))
    begins, ends = frames.times - frames.lengths_before / 2.0, frames.times + frames.lengths / 2.0
    inside = -((before + after) / 2.0 * base_changes(history, begins, ends)).sum(axis=1)
    between = -((after[:-1] + before[1:]) / 2.0 * base_changes(history, ends[:-1], begins[1:])).sum(axis=1)
    parts = inside[:-1] + between
    return np.concatenate([[0.0], np.cumsum(parts)]), float((np.abs(inside[:-1]) + np.abs(between)).sum())


def _fall(values: FloatArray) -> float:
    """Largest, below the greatest value before."""
    return float((np.maximum.accumulate(values) - values).max(initial=0.0)) if len(values) else 0.0
