"""Energies of the rows of a pushover held against poses and load factors, by the trapezoidal rule from row to row.

With the loads p and λ q at the poses of two rows, and the motion u of the blocks from one to the other::

    live work = ½ (λ_1 + λ_2) ½ (q_1 + q_2)·u        gained by the dead load = −½ (p_1 + p_2)·u

The second is exact where loads keep their direction. Between two rows the load factor runs mostly between theirs: the
first may be off by half of their difference. What the live load does goes into friction and ties, into the dead load,
into elastic joints, or is lost where blocks drop: none of the rest can make up for what it has not done.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.model import LoadCase
from mbla.model.pose import moved_case
from mbla.solution.pushover.record import PushedRows

ROOM = 0.02
"""Energy over the greatest of the rows that the trapezoidal rule may be off."""

STORES = 4.0
"""Energy over the greatest that elastic joints store, by which rows differ from the structure as built: blocks sag
under the dead load before they are pushed."""


def energy_failure(case: LoadCase, rows: PushedRows) -> str:
    """Why the energies of a pushover are not those of its rows, in words; empty where they are.

    rows : of which the first is the structure as it starts to move
    """
    live, friction, ties, crushing, potential = rows.energies.T
    works = _works(case, rows)
    room = room_of(case, rows)
    off = {
        "live work": np.abs(live - works[:, 0]) - works[:, 1],
        "energy that the dead load gains": np.abs(potential - works[:, 2]),
        "energy that friction, ties and crushing take": friction + ties + crushing + potential - live,
    }
    for name, by in off.items():
        if not by.max() <= room:
            return f"the {name} up to step {int(by.argmax())} of the pushover is not that of its poses and load factors"
    for name, taken in (("by friction", friction), ("by ties", ties), ("by crushing", crushing)):
        if not np.diff(taken).min(initial=0.0) >= -room:
            return f"what is dissipated {name} does not grow along the pushover"
    return ""


def room_of(case: LoadCase, rows: PushedRows) -> float:
    """What energies of a pushover may be off, J."""
    works = _works(case, rows)
    size = max(float(np.abs(rows.energies).max()), float(np.abs(works[:, [0, 2]]).max()))
    return ROOM * size + STORES * _stored(rows)


def energy_lost(case: LoadCase, rows: PushedRows) -> float:
    """Live work that neither friction, ties, crushing nor the dead load has taken at the last row, over the greatest.

    0 where it is no more than energies may be off.
    """
    live, friction, ties, crushing, potential = rows.energies[-1]
    lost = float(live - friction - ties - crushing - potential)
    return lost / float(np.abs(rows.energies[-1]).max()) if lost > room_of(case, rows) else 0.0


def _works(case: LoadCase, rows: PushedRows) -> FloatArray:
    """Live work, what it may be off, and what the dead load gains, J since row 0, (n, 3)."""
    found, poses, factors = [np.zeros(3)], list(rows.poses), rows.load_factors
    there = ((moved_case(case, pose), factor) for pose, factor in zip(poses, factors, strict=True))
    loads = [moved.question.loads_at(moved.dead_load, moved.live_load, factor)[:2] for moved, factor in there]
    for row, (before, after) in enumerate(pairwise(poses)):
        by = before.motion_to(after)
        dead, live = (0.5 * float(np.vdot(p + q, by)) for p, q in zip(loads[row], loads[row + 1], strict=True))
        mean, apart = 0.5 * (factors[row] + factors[row + 1]), 0.5 * abs(factors[row + 1] - factors[row])
        found.append(np.array([mean * live, apart * abs(live), -dead]))
    return np.asarray(np.cumsum(found, axis=0))


def _stored(rows: PushedRows) -> float:
    """Greatest energy of the elastic joints of a row, J: ½ N²/k_n + ½ T²/k_t of every point."""
    points = rows.points
    k = points.areas[:, 1:] * rows.stiffness[[0, 1, 1]]
    with np.errstate(divide="ignore", invalid="ignore"):
        every = np.where(k > 0.0, 0.5 * points.forces**2 / k, 0.0).sum(axis=1)
    total = np.concatenate([[0.0], np.cumsum(every)])[rows.point_start]
    return float(np.diff(total).max(initial=0.0))
