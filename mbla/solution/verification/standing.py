"""Standing: the dead load is carried from the stress-free assembly.

Forces balance the dead load within the yield conditions, and displacements of the blocks show how they arise. On joints
of unit stiffness each is pressed by closing, sheared against its sliding, and by no more than that asks for::

    N v_N ≤ 0,  |N| ≤ |v_N|,      T = −α v_T,  0 ≤ α ≤ 1

Less is allowed: a planar program has one point where the model has several, and shear is limited. A bar between two
walls fails here whatever thrust is assumed, because it cannot move against both. These are the conditions of coupled
rigid-block analysis (Kao et al. 2022, doi:10.1016/j.cad.2022.103216), with the displacements given.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.model.soil.names import body_in_words
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.verification.statics import (
    contact_resultants,
    contact_velocities,
    left_to_balance,
    load_scale,
    load_sizes,
    off_guides,
)
from mbla.solution.verification.strengths import excess

ASTRAY = Message(
    "standing-not-proved", "forces under the dead load alone do not come from the displacements of the blocks"
)

UNBALANCED = 3e-6
"""Share of a block's dead load that may be left unbalanced: the rest on springs, measured in another norm."""

FORCE_ROUNDING = 1e-12
"""The same over the forces that act on the block."""

STRAY, AGAINST = 1e-6, 1e-9
"""What may be off, over the largest force, to which elastic joints are solved, and over the largest displacement at any
contact point: rounding leaves 1e-12 of it where whole structures settle far more than their joints."""

HIDDEN = 1e6
"""Displacement over the largest force that counts at most: beyond it any force would be within ``AGAINST``."""


HELD = 1e-9
"""Displacement of a support that is held, over the largest of a block."""


def standing_failures(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    forces: FloatArray,
    settlement: FloatArray,
    limits: YieldLimits,
) -> tuple[Message, ...]:
    """Why forces and displacements do not show that the structure stands; nothing where they do.

    forces     : (n_points, 3) N, T1, T2 [N] under the dead load alone
    settlement : (n_blocks, 6) displacements and rotations of the blocks on joints of unit stiffness
    limits     : of the contact points
    """
    if not np.any(load_case.dead_load[model.free]):
        return ()
    if not (np.isfinite(forces).all() and np.isfinite(settlement).all()):
        return (Message("standing-not-proved", "the forces or displacements under the dead load are not finite"),)
    scale = load_scale(model, contacts, load_case, limits)
    allowed = np.where(model.fixed, np.inf, scale.allowed(contacts, forces, UNBALANCED, FORCE_ROUNDING))
    acting = contact_resultants(model, contacts, forces) + load_case.dead_load
    failures = []
    blocks, way = load_case.question.giving_way, load_case.question.ways
    if len(blocks):  # a settling support later is held, whatever its reaction
        live = load_case.live_load
        acting = acting - live * float((acting[blocks] * way).sum() / (live[blocks] * way).sum())
        along = float((settlement[blocks] * way).sum()) / float(np.linalg.norm(way))
        if abs(along) > HELD * float(np.linalg.norm(settlement, axis=1).max(initial=0.0)):
            failures.append("the settling support is displaced under the dead load alone")
    unbalanced = load_sizes(left_to_balance(model, acting, scale.arms), scale.arms)
    worst = int((unbalanced / allowed).argmax())
    if unbalanced[worst] > allowed[worst]:
        which = body_in_words(worst, model.blocks)
        share = unbalanced[worst] / scale.own[worst]
        failures.append(f"under the dead load alone {share:.2g} of the load of {which} is not balanced")
    if np.any(excess(forces, limits) > scale.of_lighter(contacts, allowed)):
        failures.append("forces under the dead load alone exceed the yield conditions")
    if np.any(model.fixed[:, None] & (settlement != 0)):
        failures.append("fixed blocks are displaced")
    if off_guides(model, settlement, scale.arms) > AGAINST:
        failures.append("guided blocks are displaced against their guides")
    displaced = contact_velocities(model, contacts, settlement)
    if _astray(forces, displaced) > 1.0:
        failures.append(ASTRAY.words)
    return tuple(Message("standing-not-proved", words) for words in failures)


def _astray(forces: FloatArray, displaced: FloatArray) -> float:
    """How far a force is from any that its joint's displacement can cause, over what it may be.

    That is a share of the largest force, and one of the largest displacement, which counts up to ``HIDDEN`` times that.
    """
    normal, shear = forces[:, 0], forces[:, 1:]
    closing, sliding = -displaced[:, 0], np.linalg.norm(displaced[:, 1:], axis=1)
    least, most = np.minimum(closing, 0.0), np.maximum(closing, 0.0)
    normal_off = normal - np.clip(normal, least, most)
    direction = -displaced[:, 1:] / np.maximum(sliding, 1e-300)[:, None]
    along = np.clip((shear * direction).sum(axis=1), 0.0, sliding)
    shear_off = np.linalg.norm(shear - along[:, None] * direction, axis=1)
    off = float(max(np.abs(normal_off).max(initial=0.0), shear_off.max(initial=0.0)))
    force, displacement = float(np.abs(forces).max(initial=0.0)), float(np.abs(displaced).max(initial=0.0))
    allowed = STRAY * force + AGAINST * min(displacement, HIDDEN * force)
    return off / max(allowed, 1e-300)
