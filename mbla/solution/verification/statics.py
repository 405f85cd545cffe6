"""Statics and kinematics of the verification, written a second time on purpose, without the program stage.

Forces are summed over bodies and velocities taken from rigid-body motion directly, so that an error in the equilibrium
matrix that the solver used cannot hide here.

What guides allow, for the verification: written a second time on purpose, without the program stage.

With the ways of a guided body as the columns of V (its blocks below one another, rotations times the lever arm of their
block), forces f with moments over the arms do work in Pf alone, P = V (VᵀV)⁻¹ Vᵀ, and a motion u is allowed where
Pu = u.

What the relative measures of the verification are relative to.

A residual is judged by the loads and forces of the block it acts on, not by the mean of the structure alone: a light
block on a heavy one may fall with an unbalanced force that is negligible relative to the heavy block's weight.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.thresholds import ZERO_FACTOR


def bodies_of_points(contacts: Contacts) -> IntArray:
    """Bodies a and b of every contact point, (n_points, 2)."""
    return contacts.bodies[contacts.interface_of_point]


def contact_resultants(model: Model, contacts: Contacts, contact_forces: FloatArray) -> FloatArray:
    """Force and moment about the centroid that the contacts exert on each block, (n_blocks, 6) N, N m.

    contact_forces : (n_points, 3)  N, T1, T2, compression positive
    """
    n_blocks = len(model.blocks)
    bodies = bodies_of_points(contacts)
    force = np.einsum("pj,pjx->px", contact_forces, contacts.frames)
    total = np.zeros((n_blocks, 6))
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = np.flatnonzero(bodies[:, side] < n_blocks)
        block = bodies[here, side]
        arm = contacts.points[here] - model.blocks.centroids[block]
        on_block = sign * force[here]
        np.add.at(total, block, np.concatenate([on_block, np.cross(arm, on_block)], axis=1))
    if contacts.cut_of_point is not None:  # the load cell of an objective measures what passes through its cut
        total[-1, :3] += contacts.cut_of_point @ force
    if contacts.ties is not None:  # N alone, along their lines and at further points
        ties = contacts.ties
        moving = ties.bodies < n_blocks
        block = ties.bodies[moving]
        pull = contact_forces[ties.points[moving], :1] * ties.forces[moving]
        arm = ties.places[moving] - model.blocks.centroids[block]
        np.add.at(total, block, np.concatenate([pull, np.cross(arm, pull)], axis=1))
    return total


def contact_velocities(model: Model, contacts: Contacts, mechanism: FloatArray) -> FloatArray:
    """Velocity of body b relative to body a at every contact point in its frame, (n_points, 3), opening positive.

    mechanism : (n_blocks, 6)  velocity of the centroid and angular velocity
    """
    n_blocks = len(model.blocks)
    bodies = bodies_of_points(contacts)
    relative = np.zeros((len(bodies), 3))
    for side, sign in ((0, -1.0), (1, 1.0)):
        here = np.flatnonzero(bodies[:, side] < n_blocks)
        block = bodies[here, side]
        arm = contacts.points[here] - model.blocks.centroids[block]
        motion = mechanism[block]
        relative[here] += sign * (motion[:, :3] + np.cross(motion[:, 3:], arm))
    if contacts.cut_of_point is not None:  # and opens it
        relative += contacts.cut_of_point[:, None] * mechanism[-1, :3]
    found = np.einsum("pjx,px->pj", contacts.frames, relative)
    if contacts.ties is not None:
        ties = contacts.ties
        moving = ties.bodies < n_blocks
        motion = mechanism[ties.bodies[moving]]
        arm = ties.places[moving] - model.blocks.centroids[ties.bodies[moving]]
        speed = motion[:, :3] + np.cross(motion[:, 3:], arm)
        np.add.at(found[:, 0], ties.points[moving], (speed * ties.forces[moving]).sum(axis=1))
        found[contacts.tie_points, 1:] = 0.0
    return np.asarray(found)


def power(load: FloatArray, mechanism: FloatArray) -> float:
    """Power of a load (n_blocks, 6) on a mechanism (n_blocks, 6)."""
    return float((load * mechanism).sum())


def left_to_balance(model: Model, wrenches: FloatArray, arms: FloatArray) -> FloatArray:
    """The part of forces and moments about centroids, (n_blocks, 6) N, N m, that no guide takes.

    arms : (n_blocks,) lever arms that make moments comparable to forces
    """
    if not len(model.guides):
        return wrenches
    sizes = _sizes(arms)
    return _projected(model, wrenches / sizes, sizes) * sizes


def allowed_motion(model: Model, mechanism: FloatArray, arms: FloatArray) -> FloatArray:
    """The nearest motion, (n_blocks, 6), that all guides allow; blocks without a guide keep theirs."""
    if not len(model.guides):
        return mechanism
    sizes = _sizes(arms)
    return _projected(model, mechanism * sizes, sizes) / sizes


def off_guides(model: Model, mechanism: FloatArray, arms: FloatArray) -> float:
    """Largest velocity of a guided block against its guide, over the largest of any block; 0 where none moves.

    mechanism : (n_blocks, 6)
    arms      : (n_blocks,) lever arm of each block
    """
    across = np.abs((mechanism - allowed_motion(model, mechanism, arms)) * _sizes(arms)).max(initial=0.0)
    largest = np.abs(mechanism * _sizes(arms)).max(initial=0.0)
    return float(across / largest) if largest > 0 else 0.0


def _sizes(arms: FloatArray) -> FloatArray:
    """(n_blocks, 6): 1 for translations, the lever arm for rotations."""
    return np.column_stack([np.ones((len(arms), 3)), np.repeat(arms[:, None], 3, axis=1)])


def _projected(model: Model, values: FloatArray, sizes: FloatArray) -> FloatArray:
    """Values, (n_blocks, 6) in comparable components, on the ways of their bodies."""
    blocks, bodies, n = model.guides.blocks, model.guides.bodies, model.guides.n_bodies
    ways = model.guides.motions * sizes[blocks][:, :, None]
    length = np.zeros((n, ways.shape[2]))
    np.add.at(length, bodies, (ways**2).sum(axis=1))
    ways = ways / np.sqrt(np.where(length > 0, length, 1.0))[bodies][:, None, :]
    gram, along = np.zeros((n, ways.shape[2], ways.shape[2])), np.zeros((n, ways.shape[2]))
    np.add.at(gram, bodies, np.einsum("mij,mik->mjk", ways, ways))
    np.add.at(along, bodies, np.einsum("mij,mi->mj", ways, values[blocks]))
    shares = np.einsum("bij,bj->bi", np.linalg.pinv(gram, hermitian=True), along)
    result = values.copy()
    result[blocks] = np.einsum("mij,mj->mi", ways, shares[bodies])
    return result


@dataclass(frozen=True)
class LoadScale:
    """Sizes of the loads of a case, moments counted over the lever arms of their blocks.

    arms : (n_blocks,) mean distance of a block's contact points from its centroid, its size where it has none
    own  : (n_blocks,) dead load of each free block, the mean of the others' where it has none; zero on fixed blocks.
           Without any dead load the strength of the joints is used instead, and without strength the live load
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

        No more of that than the mean and the live load, or self-stress could prove anything.
        """
        passed_on = forces_on_blocks(
            contacts, contact_forces, len(self.own)
        )  # of each block: elsewhere they may be huge
        rounding = np.minimum(share * passed_on, self.mean + abs(factor) * self.live)
        return np.maximum(self.block_scale(contacts, contact_forces), rounding)

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
    if contacts.cut is not None:  # a load cell has none: it holds a force that may be nothing
        dead[-1] = 0.0
    strength = float((limits.cohesion + limits.tension).sum()) / len(model.free)
    candidates = (dead, np.where(model.fixed, 0.0, strength), live)
    own = next(sizes for sizes in candidates if np.any(sizes > 0))
    mean = float(own[own > 0].mean())
    own = np.where(model.fixed | (own > 0), own, mean)
    return LoadScale(arms, own, mean, float(np.linalg.norm(live)))


def largest_on_interface(contacts: Contacts, contact_forces: FloatArray) -> float:
    """Largest sum of the sizes of the contact forces on an interface, forces (n_points, 3)."""
    if not len(contact_forces):
        return 0.0
    sizes = np.linalg.norm(contact_forces, axis=1)
    return float(np.bincount(contacts.interface_of_point, sizes).max())


def forces_on_blocks(contacts: Contacts, contact_forces: FloatArray, n_blocks: int) -> FloatArray:
    """Sum of the sizes of the contact forces on each block, (n_blocks,)."""
    size, total = np.linalg.norm(contact_forces, axis=1), np.zeros(n_blocks)
    for bodies in bodies_of_points(contacts).T:
        here = bodies < n_blocks
        total += np.bincount(bodies[here], size[here], n_blocks)
    if contacts.cut_of_point is not None:
        total[-1] += np.abs(contacts.cut_of_point) @ size
    return total


def load_sizes(load: FloatArray, arms: FloatArray) -> FloatArray:
    """Forces and moments over the lever arms of loads, (n_blocks, 6), as one size each, (n_blocks,)."""
    return np.asarray(np.hypot(np.linalg.norm(load[:, :3], axis=1), np.linalg.norm(load[:, 3:], axis=1) / arms))


def lever_arms(model: Model, contacts: Contacts) -> FloatArray:
    """Mean distance of each block's contact points from its centroid, its size where it has none, (n_blocks,).

    Ties do not count, which may lead far away.
    """
    surfaces = ~contacts.tie_points
    bodies, points = bodies_of_points(contacts)[surfaces], contacts.points[surfaces]
    return _arms(model.blocks.centroids, model.blocks.sizes, bodies, points)


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
