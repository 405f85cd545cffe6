"""Rows of a time history held against each other and against its frames: energies, instants, and the base.

The energy that bodies gain is what base and forces do less what joints take, in every row. Kinetic energy follows from
the momenta of frames, with the inertia half a step before; what the dead load gains from the poses. What the base does
between two frames is about −p·ΔV_g, with the mean of the momenta of all bodies before, between and after.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.verification.time_bodies import MovedSolids, Solids, rotations_of
from mbla.solution.verification.time_motion import base_changes

SAME_TIME = 1e-9
"""Difference of two instants over the step of the deck that is none."""

TURNS = 4
"""Times that the angular velocity half a step before is found again with the inertia there; each gains a factor h ω."""


@dataclass(frozen=True)
class RowResidual:
    """How far rows are from what they should be, over the greatest energy of any.

    balance   : of gains, work and what joints take, in a row
    kinetic   : of a row against the momenta of the frame that begins there
    potential : of a row against the poses of that frame
    base      : work of the base against momenta of frames and the record, up to a frame; over what it does and undoes
    loss      : by how much what joints have dissipated falls from a row to another
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
    lacks = rows.kinetic + rows.potential + taken - rows.base - rows.forces - rows.turning
    at = rows_of_frames(rows, frames, history.step)
    on = at >= 0
    kinetic = np.array([_kinetic(solids, frames, frame) for frame in range(len(frames))])
    gained = np.array([_gained(case, history, solids, frames, frame) for frame in range(len(frames))])
    dissipated = taken - rows.elastic
    work, size = _base_work(history, solids, frames)
    return RowResidual(
        balance=float(np.abs(lacks).max()) / scale,
        kinetic=float(np.abs(kinetic - rows.kinetic[at])[on].max(initial=0.0)) / scale,
        potential=float(np.abs(gained - rows.potential[at])[on].max(initial=0.0)) / scale,
        base=float(np.abs(work - rows.base[at])[on].max(initial=0.0)) / max(scale, size),
        loss=-float(np.diff(dissipated).min(initial=0.0)) / scale,
    )


def _kinetic(solids: Solids, frames: Frames, frame: int) -> float:
    """Of all bodies that can move, before the step of a frame."""
    momenta, before = frames.momenta_before[frame], frames.lengths_before[frame]
    can = solids.free & (solids.masses > 0.0)
    turn = MovedSolids(solids, frames.shifts[frame], frames.turns[frame]).rotations[can]
    angular, tensors, back = momenta[can, 3:, None], solids.tensors[can], turn
    spin = np.zeros((int(can.sum()), 3, 1))
    for _ in range(TURNS):
        spin = np.linalg.solve(back @ tensors @ back.transpose(0, 2, 1), angular)
        back = rotations_of(-spin[:, :, 0] * before / 2.0) @ turn
    return float((momenta[can, :3] ** 2).sum(axis=1) @ (0.5 / solids.masses[can]) + 0.5 * (angular * spin).sum())


def _gained(case: LoadCase, history: TimeHistory, solids: Solids, frames: Frames, frame: int) -> float:
    """What the dead load that keeps its direction has gained since the first frame, at its points on the blocks."""
    moved, begun = (MovedSolids(solids, frames.shifts[each], frames.turns[each]) for each in (frame, 0))
    forces = case.dead_load[:, :3] - history.dead_following[:, :3]
    by = moved.shifts - begun.shifts
    # of forces at arms a that turn: F·(R a − a), the trace of the change of a Fᵀ
    levers = (rotations_of(moved.turns) - rotations_of(begun.turns)) @ history.dead_levers.reshape(-1, 3, 3)
    free = solids.free[solids.label]
    return -float((forces * by).sum(axis=1)[free].sum() + np.trace(levers, axis1=1, axis2=2)[free].sum())


def _base_work(history: TimeHistory, solids: Solids, frames: Frames) -> tuple[FloatArray, float]:
    """Work of the base up to each frame, (n_frames,), and the sum of what it does and undoes."""
    free = solids.free
    momentum = (frames.momenta_before + frames.momenta)[:, free, :3].sum(axis=1) / 2.0
    changes = base_changes(history, frames.times[:-1], frames.times[1:])
    parts = -((momentum[:-1] + momentum[1:]) / 2.0 * changes).sum(axis=1)
    return np.concatenate([[0.0], np.cumsum(parts)]), float(np.abs(parts).sum())
