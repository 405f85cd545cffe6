"""What the relative measures of the verification are relative to.

A residual is judged by the loads and forces of the block it acts on, not by the mean of the structure alone: a light
block on a heavy one may fall with an unbalanced force that is nothing beside the heavy block's weight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.verification.statics import bodies_of_points

ZERO_FACTOR = 1e-3
"""Load factors below this share of dead over live load are taken for that share in relative measures."""


@dataclass(frozen=True)
class LoadScale:
    """Sizes of the loads of a case, moments counted over the lever arms of their blocks.

    arms : (n_blocks,) mean distance of a block's contact points from its centroid, its size where it has none
    own  : (n_blocks,) dead load of each free block, the mean of the others' where it has none; zero on fixed blocks.
           Without any dead load the strength of the joints stands in for it, and without strength the live load
    mean : mean of ``own`` over the free blocks that have a load
    live : size of the live load: root of the sum of squares over free blocks
    """

    arms: FloatArray
    own: FloatArray
    mean: float
    live: float

    def allowed(self, contacts: Contacts, contact_forces: FloatArray, share: float, rounding: float) -> FloatArray:
        """What may be left unbalanced on each block: shares of its own load and of the forces on it, (n_blocks,)."""
        return np.asarray(share * self.own + rounding * forces_on_blocks(contacts, contact_forces, len(self.own)))

    def block_scale(self, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
        """Load and contact forces that each block has to balance, at most the mean load, (n_blocks,)."""
        total = self.own + forces_on_blocks(contacts, contact_forces, len(self.own))
        return np.asarray(np.minimum(total, self.mean))

    def rounded_scale(self, contacts: Contacts, contact_forces: FloatArray, factor: float, share: float) -> FloatArray:
        """``block_scale``, but no less than a share of the forces on the block, for their rounding, (n_blocks,).

        No more of that than the mean and the live load, or forces locked in would prove what one likes.
        """
        passed_on = forces_on_blocks(
            contacts, contact_forces, len(self.own)
        )  # of each block: elsewhere they may be huge
        rounding = np.minimum(share * passed_on, self.mean + abs(factor) * self.live)
        return np.maximum(self.block_scale(contacts, contact_forces), rounding)

    def point_scale(self, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
        """The scale of the lighter free block at every contact point, (n_points,)."""
        return self.of_lighter(contacts, self.block_scale(contacts, contact_forces))

    def of_lighter(self, contacts: Contacts, values: FloatArray) -> FloatArray:
        """The lesser of the values, (n_blocks,), of the free blocks at every contact point, (n_points,)."""
        scale = np.where(self.own > 0, values, np.inf)
        bodies = bodies_of_points(contacts)
        outside = np.full(max(int(bodies.max(initial=0)) + 1 - len(scale), 0), np.inf)
        return np.asarray(np.append(scale, outside)[bodies].min(axis=1))

    def least_factor(self, mechanism: FloatArray) -> float:
        """Size below which a load factor counts as zero in relative measures.

        A share of dead over live load: of the blocks that move if they are lighter than the others, of all if not.

        mechanism : (n_blocks, 6) for unit live load power
        """
        speed = np.linalg.norm(mechanism[:, :3], axis=1) + self.arms * np.linalg.norm(mechanism[:, 3:], axis=1)
        everywhere = float(np.linalg.norm(self.own)) / self.live
        return ZERO_FACTOR * min(float(self.own @ speed), everywhere)


def load_scale(model: Model, contacts: Contacts, load_case: LoadCase, limits: YieldLimits) -> LoadScale:
    """Sizes of the loads of one case."""
    arms = lever_arms(model, contacts)
    dead, live = (load_sizes(load, arms) * ~model.fixed for load in (load_case.dead_load, load_case.live_load))
    strength = float((limits.cohesion + limits.tension).sum()) / len(model.free)
    candidates = (dead, np.where(model.fixed, 0.0, strength), live)
    own = next(sizes for sizes in candidates if np.any(sizes > 0))
    mean = float(own[own > 0].mean())
    own = np.where(model.fixed | (own > 0), own, mean)
    return LoadScale(arms, own, mean, float(np.linalg.norm(live)))


def forces_on_blocks(contacts: Contacts, contact_forces: FloatArray, n_blocks: int) -> FloatArray:
    """Sum of the sizes of the contact forces on each block, (n_blocks,)."""
    size, total = np.linalg.norm(contact_forces, axis=1), np.zeros(n_blocks)
    for bodies in bodies_of_points(contacts).T:
        here = bodies < n_blocks
        total += np.bincount(bodies[here], size[here], n_blocks)
    return total


def load_sizes(load: FloatArray, arms: FloatArray) -> FloatArray:
    """Forces and moments over the lever arms of loads, (n_blocks, 6), as one size each, (n_blocks,)."""
    return np.asarray(np.hypot(np.linalg.norm(load[:, :3], axis=1), np.linalg.norm(load[:, 3:], axis=1) / arms))


def lever_arms(model: Model, contacts: Contacts) -> FloatArray:
    """Mean distance of each block's contact points from its centroid, its size where it has none, (n_blocks,)."""
    return _arms(model.blocks.centroids, model.blocks.sizes, bodies_of_points(contacts), contacts.points)


def _arms(centroids: FloatArray, sizes: FloatArray, bodies_of_point: IntArray, points: FloatArray) -> FloatArray:
    """``lever_arms`` of blocks with centroids (n_blocks, 3) and points (n_points, 3)."""
    n_blocks = len(centroids)
    total, count = np.zeros(n_blocks), np.zeros(n_blocks)
    for bodies in bodies_of_point.T:
        here = bodies < n_blocks
        block = bodies[here]
        arm = np.linalg.norm(points[here] - centroids[block], axis=1)
        total += np.bincount(block, arm, n_blocks)
        count += np.bincount(block, minlength=n_blocks)
    return np.where(count > 0, total / np.maximum(count, 1.0), sizes)
