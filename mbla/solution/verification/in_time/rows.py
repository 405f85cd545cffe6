"""Rows of a time history held against each other and against its frames: energies, instants, and the base.

The energy that bodies gain is what base and forces do less what joints take, in every row. Kinetic energy follows from
the momenta of frames, with the inertia half a step before; what the dead load gains from the poses, and from where mass
centres were half a step before: energies are those then. What a step does is derived from frames where it was made at
once (:mod:`mbla.solution.verification.in_time.works`).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, IntArray, summed
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.solution.time_history.frames import Frames
from mbla.solution.time_history.step_rows import StepRows
from mbla.solution.verification.in_time.bodies import MovedSolids, Solids, spins_before
from mbla.solution.verification.in_time.motion import base_changes

SAME_TIME = 1e-9
"""Difference of two instants over the step of the deck that is none."""


@dataclass(frozen=True)
class RowResidual:
    """How far rows are from what they should be, over the greatest energy of any (``energy_scale``).

    balance   : of gains, work and what joints take, in a row
    kinetic   : of a row against the momenta of the frame that begins there
    potential : of a row against the poses of that frame
    base      : by how much the base does more in a step than it can, by the kinetic energies before and after it
    """

    balance: float
    kinetic: float
    potential: float
    base: float


def energy_scale(case: LoadCase, solids: Solids, rows: StepRows, frames: Frames) -> float:
    """What energies are off by is told over this: the greatest of any kind in any row.

    At least the dead load of every block that can move times the sag of the block: joints store half of it at rest, and
    where what moves is less, energies are differences of what that rounds to.
    """
    kinds = (rows.kinetic, rows.potential, rows.friction, rows.contacts, rows.ties, rows.base, rows.forces)
    greatest = [np.abs(kind).max(initial=0.0) for kind in kinds]
    loads, sags = (np.linalg.norm(each, axis=1) for each in (case.dead_load[:, :3], frames.shifts[0]))
    at_rest = float((loads * sags)[solids.free[solids.label]].sum())
    return max(float(np.max(greatest)), at_rest, 1e-300)


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
    scale = energy_scale(case, solids, rows, frames)
    taken = rows.contacts + rows.friction + rows.ties
    lacks = rows.kinetic + rows.potential + taken - rows.base - rows.forces - rows.numerical
    at = rows_of_frames(rows, frames, history.step)
    on = at >= 0
    kinetic = np.array([_kinetic(solids, frames, frame) for frame in range(len(frames))])
    gained = np.array([_gained(case, history, solids, frames, frame) for frame in range(len(frames))])
    return RowResidual(
        balance=float(np.abs(lacks).max()) / scale,
        kinetic=float(np.abs(kinetic - rows.kinetic[at])[on].max(initial=0.0)) / scale,
        potential=float(np.abs(gained - rows.potential[at])[on].max(initial=0.0)) / scale,
        base=_base_beyond(history, solids, rows) / scale,
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


def whole_steps(rows: StepRows) -> BoolArray:
    """Which steps of the deck were made at once, (n,): none in the place of them."""
    changed = np.diff(rows.small_steps) != 0
    return np.asarray(~(changed | (np.diff(rows.halved) != 0) | (np.diff(rows.missed) != 0)))


def _base_beyond(history: TimeHistory, solids: Solids, rows: StepRows) -> float:
    """Largest work of the base in a step beyond √(2 m K)·ΔV, with the mass m of all and the mean of both roots.

    In a step the base does −(p₋ + p)/2·ΔV, and momentum is largest where all move alike. Only of steps made at once, as
    those before them, whose middles are known.
    """
    whole = whole_steps(rows)
    known = np.flatnonzero(whole[1:] & whole[:-1]) + 1
    middles = (rows.times[1:] + rows.times[:-1]) / 2.0
    changes = np.linalg.norm(base_changes(history, middles[known - 1], middles[known]), axis=1)
    roots = np.sqrt(2.0 * float(solids.masses[solids.free].sum()) * np.maximum(rows.kinetic, 0.0))
    most = (roots[known] + roots[known + 1]) / 2.0 * changes
    return float((np.abs(np.diff(rows.base))[known] - most).max(initial=0.0))
