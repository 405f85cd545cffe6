"""Lock: contact forces carry every multiple of the live load.

They balance the live load alone on every free block and stay within the yield conditions however often they are taken:
‖T‖ ≤ μN, and no force where the joint can crush. Each block is judged by its own live load, the mean of the others'
where it has none: a light block that breaks away must not be lost in the mean.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.soil.names import body_in_words
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.verification.standing import FORCE_ROUNDING
from mbla.solution.verification.statics import (
    contact_resultants,
    forces_on_blocks,
    left_to_balance,
    load_scale,
    load_sizes,
)
from mbla.solution.verification.strengths import point_strengths

LASTING = 1e-6
"""Unbalanced share of a block's live load, and excess over the yield conditions, with which forces still prove it: they
carry a million times what they are asked for before it matters."""

MOST = 1e-3
"""What rounding may leave at most, over the mean live load of a block: relative to forces large enough any load would
be rounding."""


def lock_failures(model: Model, contacts: Contacts, load_case: LoadCase, lock: FloatArray) -> tuple[Message, ...]:
    """Why forces, (n_points, 3) [N], do not prove that every multiple of the live load is carried; nothing if they do.

    For a load factor of 1: they balance ``load_case.live_load``.
    """
    if not np.isfinite(lock).all():
        return (Message("lock-not-proved", "the forces that should show that the structure locks are not finite"),)
    limits = point_strengths(model, contacts)
    if not np.any(load_case.live_load[model.free]):
        return (Message("lock-not-proved", "there is no live load on blocks that can move"),)
    scale = load_scale(model, contacts, replace(load_case, dead_load=load_case.live_load), limits)
    rounding = np.minimum(FORCE_ROUNDING * forces_on_blocks(contacts, lock, len(model.blocks)), MOST * scale.mean)
    allowed = np.where(model.fixed, np.inf, LASTING * scale.own + rounding)
    acting = contact_resultants(model, contacts, lock) + load_case.live_load
    unbalanced = load_sizes(left_to_balance(model, acting, scale.arms), scale.arms)
    failures = []
    worst = int((unbalanced / allowed).argmax())
    if unbalanced[worst] > allowed[worst]:
        which = body_in_words(worst, model.blocks)
        failures.append(
            f"the forces that should show that the structure locks leave {unbalanced[worst] / scale.own[worst]:.2g} of "
            f"the live load of {which} unbalanced"
        )
    if np.any(_lasting_excess(lock, limits) > scale.of_lighter(contacts, allowed)):
        failures.append("the forces that should show that the structure locks do not stay within the yield conditions")
    return tuple(Message("lock-not-proved", words) for words in failures)


def _lasting_excess(lock: FloatArray, limits: YieldLimits) -> FloatArray:
    """Excess over the conditions that hold for every multiple of the forces, (n_points,) [N]."""
    normal, shear = lock[:, 0], np.linalg.norm(lock[:, 1:], axis=1)
    dry = np.maximum(shear - limits.friction * normal, -normal)
    return np.asarray(np.where(np.isfinite(limits.compression), np.linalg.norm(lock, axis=1), np.maximum(dry, 0.0)))
