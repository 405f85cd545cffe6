"""Impulses that bodies of a time history get in a step, for the verification: loads, base motion, contacts, ties.

A force that keeps its direction acts at a point that turns with its block: with the lever L = a Fᵀ as built its moment
is ε : R L beside that of couples, which keep theirs as well. What follows its block turns with it.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, summed
from mbla.model.model import LoadCase
from mbla.model.motion.time_history import TimeHistory
from mbla.model.ties.ties import OUTSIDE, Ties
from mbla.solution.verification.in_time.bodies import MovedSolids, Solids


def dead_wrenches(moved: MovedSolids, case: LoadCase, history: TimeHistory) -> FloatArray:
    """Dead load on the blocks where they are, about their centroids, (n_blocks, 6)."""
    turn = moved.pose.rotation
    following = history.dead_following
    kept = _turned(case.dead_load - following, history.dead_levers, turn)
    along = np.einsum("bij,bkj->bki", turn, following.reshape(-1, 2, 3)).reshape(-1, 6)
    return np.asarray(kept + along)


def force_wrenches(moved: MovedSolids, history: TimeHistory, impulses: FloatArray) -> FloatArray:
    """Forces over time on the blocks, times the impulse of each, (n_blocks, 6) from (n_forces,)."""
    turn = moved.pose.rotation
    total = np.zeros((len(turn), 6))
    for force, impulse in zip(history.forces, impulses.tolist(), strict=True):
        if impulse:
            total += impulse * _turned(force.wrenches[:, :6], force.wrenches[:, 6:], turn)
    return total


def _turned(wrenches: FloatArray, levers: FloatArray, turn: FloatArray) -> FloatArray:
    """Forces that keep their direction at points of blocks that turn."""
    built = levers.reshape(-1, 3, 3)
    return np.hstack([wrenches[:, :3], wrenches[:, 3:] - _moments(built) + _moments(turn @ built)])


def _moments(levers: FloatArray) -> FloatArray:
    """Of levers a Fᵀ, a × F: (n, 3) from (n, 3, 3)."""
    return np.stack([levers[:, i, j] - levers[:, j, i] for i, j in ((1, 2), (2, 0), (0, 1))], axis=1)


def on_bodies(moved: MovedSolids, wrenches: FloatArray) -> FloatArray:
    """Sums on bodies about their mass centres, (n, 6), of wrenches on blocks about their centroids, (n_blocks, 6)."""
    label = moved.solids.label
    arms = moved.block_centroids - moved.centres[label]
    about = np.hstack([wrenches[:, :3], wrenches[:, 3:] + np.cross(arms, wrenches[:, :3])])
    return summed(label, about, len(moved.solids))


def add_forces(total: FloatArray, moved: MovedSolids, bodies: IntArray, points: FloatArray, forces: FloatArray) -> None:
    """Add forces (m, 3) on bodies at points to wrenches about mass centres, (n, 6); on grounds nothing."""
    on = bodies < len(total)
    arms = points[on] - moved.centres[bodies[on]]
    np.add.at(total, bodies[on], np.hstack([forces[on], np.cross(arms, forces[on])]))


def tie_points(moved: MovedSolids, ties: Ties, rows: IntArray) -> tuple[IntArray, BoolArray]:
    """Bodies at all points of ties where they are, and whether each is one of a body and of the ties ``rows``."""
    on = (ties.bodies != OUTSIDE) & np.isin(ties.tie_of_point, rows)
    return np.where(on, moved.solids.label[np.where(on, ties.bodies, 0)], -1), on


def senses(ties: Ties) -> FloatArray:
    """1 where a positive force is a tension, −1 of what can only push."""
    return np.where(ties.greatest > 0.0, 1.0, -1.0)


def tie_limits(ties: Ties) -> FloatArray:
    """Least and greatest normal force of ties, (n, 2)."""
    return np.sort(senses(ties)[:, None] * np.column_stack([ties.least, ties.greatest]), axis=1)


def free_fall(case: LoadCase, solids: Solids) -> float:
    """Mean acceleration that the dead load gives to what can move, length/s2; not 0."""
    load = float(np.linalg.norm(case.dead_load[solids.free[solids.label], :3], axis=1).sum())
    return max(load / max(float(solids.masses[solids.free].sum()), 1e-300), 1e-300)
