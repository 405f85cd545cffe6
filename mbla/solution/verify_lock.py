"""Verification that contact forces carry every multiple of the live load, with statics of its own.

Forces z prove it if they balance the live load alone on every free block and stay within the yield conditions however
often they are taken: ‖T‖ ≤ μN, and no force where the joint can crush. Each block is judged by its own live load, the
mean of the others' where it has none: a light block that breaks away must not be lost in the mean.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.solution.statics import bodies_of_points, contact_resultants

LASTING = 1e-6
"""Unbalanced share of a block's live load, and excess over the yield conditions, with which forces still prove it: they
carry a million times what they are asked for before it matters."""

ROUNDING = 1e-12
"""The same over the forces on the block: of large forces in balance rounding leaves more than of small ones."""


def lock_failures(model: Model, contacts: Contacts, load_case: LoadCase, lock: FloatArray) -> tuple[str, ...]:
    """Why forces, (n_points, 3) [N], do not prove that every multiple of the live load is carried; nothing if they do.

    For a load factor of 1: they balance ``load_case.live_load``.
    """
    if not np.isfinite(lock).all():
        return ("the forces that should show that the structure locks are not finite",)
    arms, gross = _arms_and_gross(model, contacts, lock)
    live = _sizes(load_case.live_load, arms) * ~model.fixed
    if not np.any(live):
        return ("there is no live load on blocks that can move",)
    own = np.where(live > 0, live, live[live > 0].mean())
    allowed = LASTING * own + ROUNDING * gross
    unbalanced = _sizes(contact_resultants(model, contacts, lock) + load_case.live_load, arms) * ~model.fixed
    failures = []
    worst = int((unbalanced / allowed).argmax())
    if unbalanced[worst] > allowed[worst]:
        failures.append(
            f"the forces that should show that the structure locks leave {unbalanced[worst] / own[worst]:.2g} of the "
            f"live load of block {worst} unbalanced"
        )
    excess = _lasting_excess(model, contacts, lock) / _of_lighter(model, contacts, allowed)
    if excess.max(initial=0.0) > 1.0:
        failures.append("the forces that should show that the structure locks do not stay within the yield conditions")
    return tuple(failures)


def _lasting_excess(model: Model, contacts: Contacts, lock: FloatArray) -> FloatArray:
    """Excess over the conditions that hold for every multiple of the forces, (n_points,) [N]."""
    limits = yield_limits(model, contacts)
    normal, shear = lock[:, 0], np.linalg.norm(lock[:, 1:], axis=1)
    dry = np.maximum(shear - limits.friction * normal, -normal)
    return np.asarray(np.where(np.isfinite(limits.compression), np.linalg.norm(lock, axis=1), np.maximum(dry, 0.0)))


def _of_lighter(model: Model, contacts: Contacts, values: FloatArray) -> FloatArray:
    """The lesser value of the free blocks at each point, of (n_blocks,); infinite where both bodies are fixed."""
    bodies = bodies_of_points(contacts)
    outside = np.full(max(int(bodies.max(initial=0)) + 1 - len(values), 0), np.inf)
    return np.asarray(np.append(np.where(model.fixed, np.inf, values), outside)[bodies].min(axis=1))


def _arms_and_gross(model: Model, contacts: Contacts, lock: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Mean distance of each block's points from its centroid, its size where it has none; sum of the forces on it."""
    n_blocks = len(model.blocks)
    arm, gross, count = np.zeros(n_blocks), np.zeros(n_blocks), np.zeros(n_blocks)
    size = np.linalg.norm(lock, axis=1)
    for bodies in bodies_of_points(contacts).T:
        here = bodies < n_blocks
        block = bodies[here]
        distance = np.linalg.norm(contacts.points[here] - model.blocks.centroids[block], axis=1)
        arm += np.bincount(block, distance, n_blocks)
        gross += np.bincount(block, size[here], n_blocks)
        count += np.bincount(block, minlength=n_blocks)
    return np.where(count > 0, arm / np.maximum(count, 1.0), model.blocks.sizes), gross


def _sizes(load: FloatArray, arms: FloatArray) -> FloatArray:
    """Forces, and moments over the lever arms, of loads (n_blocks, 6), (n_blocks,)."""
    return np.asarray(np.hypot(np.linalg.norm(load[:, :3], axis=1), np.linalg.norm(load[:, 3:], axis=1) / arms))
