"""Ties of a structure that moves: where they lie, which are slack, which have broken.

A tie that has yielded stays as long as it was at most, and carries nothing until it is that long again: its slack is
the greatest length so far less the present one; a strut's the present one less the least. What takes both senses has
none. A strip is as long as the joint that it crosses is open along it, as on the first of its blocks. The push of fill
acts at the same point of its block and stays level, the way it pushes as built; it is never slack.

A tie breaks when it has yielded by more than it can: the sum of its elongations over the steps, beyond its slack, each
by its rate at the beginning of the step. A tie that turns as a rigid body does not get longer by rates. What is pushed
breaks by getting shorter, what takes both senses by either.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.model.pose import Pose
from mbla.model.solids.blocks import Blocks
from mbla.model.ties.ties import OUTSIDE, Ties, pulls_along

NO_YIELD = 1e-6
"""Elongation over length that is none."""


@dataclass(frozen=True)
class TieHistory:
    """What has become of ties, (n,) m each.

    longest, shortest : lengths so far
    yielded           : sum of what they got longer, or shorter, beyond their slack
    """

    longest: FloatArray
    shortest: FloatArray
    yielded: FloatArray

    @staticmethod
    def at_rest(ties: Ties) -> TieHistory:
        """As built."""
        lengths = tie_lengths(ties)
        return TieHistory(lengths, lengths, np.zeros(len(ties)))

    def after(self, blocks: Blocks, ties: Ties, motion: FloatArray, there: Ties) -> TieHistory:
        """After a step from where blocks and ties are by a motion, (n_blocks, 6) about centroids, to ties ``there``."""
        lengths, longer = tie_lengths(there), elongations(blocks, ties, motion)
        pulled, pushed = _senses(ties)
        by = np.where(pulled, longer, np.where(pushed, -longer, np.abs(longer)))
        return TieHistory(
            np.maximum(self.longest, lengths),
            np.minimum(self.shortest, lengths),
            self.yielded + np.maximum(by - self.slack(ties), 0.0),
        )

    def slack(self, ties: Ties) -> FloatArray:
        """Of ties where they are, (n,) m."""
        lengths = tie_lengths(ties)
        pulled, pushed = _senses(ties)
        slack = np.where(pulled, self.longest - lengths, np.where(pushed, lengths - self.shortest, 0.0))
        return np.where(ties.of_fill, 0.0, np.maximum(slack, 0.0))

    def broken(self, ties: Ties) -> BoolArray:
        """Which ties, as built, have broken, (n,)."""
        if not len(ties):
            return np.zeros(0, dtype=np.bool_)
        size = np.where(ties.lengths > 0.0, ties.lengths, 0.0)
        breaks_at = np.where(np.isfinite(ties.breaks_at), ties.breaks_at, 0.0)
        beyond = self.yielded > breaks_at * size + NO_YIELD * np.maximum(size, self.longest)
        return np.asarray(np.isfinite(ties.breaks_at) & beyond)


def _senses(ties: Ties) -> tuple[BoolArray, BoolArray]:
    """Which ties can only pull, and which only push, (n,) each."""
    return np.equal(ties.least, 0.0), np.equal(ties.greatest, 0.0)


def moved_ties(ties: Ties, blocks: Blocks, pose: Pose) -> Ties:
    """Ties whose points move along with their blocks, which are given as built."""
    if not len(ties):
        return ties
    on = ties.bodies != OUTSIDE
    places, pulls = ties.places.copy(), ties.pulls.copy()
    places[on] += pose.displacements(blocks, ties.bodies[on], ties.places[on])
    lines = ties.lengths_known
    for row in range(len(ties)):
        own = slice(int(ties.start[row]), int(ties.start[row + 1]))
        if lines[row]:
            pulls[own] = pulls_along(places[own], closed=bool(ties.closed[row]))
        elif on[own][0] and not ties.of_fill[row]:
            pulls[own] = pulls[own] @ pose.rotation[ties.bodies[own][0]].T
    return replace(ties, places=places, pulls=pulls)


def elongations(blocks: Blocks, ties: Ties, motion: FloatArray) -> FloatArray:
    """By how much ties get longer in a motion of the blocks, (n_blocks, 6) about centroids, to first order, (n,)."""
    on = ties.bodies != OUTSIDE
    block = ties.bodies[on]
    arms = ties.places[on] - blocks.centroids[block]
    speed = motion[block, :3] + np.cross(motion[block, 3:], arms)
    shares = -(speed * ties.pulls[on]).sum(axis=1)
    return np.asarray(np.bincount(ties.tie_of_point[on], shares, len(ties)), dtype=np.float64)


def tie_lengths(ties: Ties) -> FloatArray:
    """Of lines; of strips the opening along them; (n,) m."""
    first, last = ties.start[:-1], ties.start[1:] - 1
    opening = ((ties.places[last] - ties.places[first]) * ties.pulls[first]).sum(axis=1)
    return np.where(ties.lengths_known, ties.lengths, opening)
