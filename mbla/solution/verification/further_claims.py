"""What is claimed in addition to the load factor, each judged with statics and kinematics of its own.

*Standing*: the dead load is carried from the stress-free assembly. Forces balance the dead load within the yield
conditions, and displacements of the blocks show how they arise. On joints of unit stiffness each is pressed by
closing, sheared against its sliding, and by no more than that asks for::

    N v_N ≤ 0,  |N| ≤ |v_N|,      T = −α v_T,  0 ≤ α ≤ 1

Less is allowed: a planar program has one point where the model has several, and shear is limited. A bar between two
walls fails here whatever thrust is assumed, because it cannot move against both. These are the conditions of coupled
rigid-block analysis (Kao et al. 2022, doi:10.1016/j.cad.2022.103216), with the displacements given.

*Lock*: contact forces z carry every multiple of the live load if they balance the live load alone on every free block
and stay within the yield conditions however often they are taken: ‖T‖ ≤ μN, and no force where the joint can crush.
Each block is judged by its own live load, the mean of the others' where it has none: a light block that breaks away
must not be lost in the mean.

*Least*: the least state without normality that a search found is accepted where its own forces balance the loads at its
load factor, keep to the yield conditions and fit its own mechanism by the flow rule claimed, of rigid joints. That none
lies below is claimed by nobody.

*Tilt*: the loads at collapse are those of the tilting table at the angle stated.
"""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model, Tilt
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.solution import WITH_VALUE, Checks, Solution
from mbla.solution.thresholds import SOLVED_RESIDUAL
from mbla.solution.tilt_circle import chord, never_left
from mbla.solution.verification.case import Case
from mbla.solution.verification.residuals import residuals_of
from mbla.solution.verification.statics import (
    contact_resultants,
    contact_velocities,
    forces_on_blocks,
    left_to_balance,
    load_scale,
    load_sizes,
    off_guides,
)
from mbla.solution.verification.strengths import excess, point_strengths

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
    if load_case.settlement is not None:  # a support that gives way later is held, whatever its reaction
        blocks, way = load_case.settlement.blocks, load_case.settlement.motions
        live = load_case.live_load
        acting = acting - live * float((acting[blocks] * way).sum() / (live[blocks] * way).sum())
        along = float((settlement[blocks] * way).sum()) / float(np.linalg.norm(way))
        if abs(along) > HELD * float(np.linalg.norm(settlement, axis=1).max(initial=0.0)):
            failures.append("the support that gives way is displaced under the dead load alone")
    unbalanced = load_sizes(left_to_balance(model, acting, scale.arms), scale.arms)
    worst = int((unbalanced / allowed).argmax())
    if unbalanced[worst] > allowed[worst]:
        share = unbalanced[worst] / scale.own[worst]
        failures.append(f"under the dead load alone {share:.2g} of the load of block {worst} is not balanced")
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


HELD = 1e-9
"""Displacement of a support that is held, over the largest of a block."""

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
        failures.append(
            f"the forces that should show that the structure locks leave {unbalanced[worst] / scale.own[worst]:.2g} of "
            f"the live load of block {worst} unbalanced"
        )
    if np.any(_lasting_excess(lock, limits) > scale.of_lighter(contacts, allowed)):
        failures.append("the forces that should show that the structure locks do not stay within the yield conditions")
    return tuple(Message("lock-not-proved", words) for words in failures)


def _lasting_excess(lock: FloatArray, limits: YieldLimits) -> FloatArray:
    """Excess over the conditions that hold for every multiple of the forces, (n_points,) [N]."""
    normal, shear = lock[:, 0], np.linalg.norm(lock[:, 1:], axis=1)
    dry = np.maximum(shear - limits.friction * normal, -normal)
    return np.asarray(np.where(np.isfinite(limits.compression), np.linalg.norm(lock, axis=1), np.maximum(dry, 0.0)))


def least_check(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> float:
    """Load factor of the least state where it fits the law of rigid joints; NaN where not, and where there is none."""
    least = solution.least
    if least is None:
        return np.nan
    case = Case(model, contacts, load_case)
    dilatancy = case.limits.dilatancy if solution.flow_rule == "dilatancy" else np.zeros(len(contacts.points))
    fits = residuals_of(case, least, dilatancy).largest <= SOLVED_RESIDUAL
    return least.load_factor if fits else np.nan


SAME_LOADS = 1e-6
"""difference of the loads, relative to the turning ones, up to which the angle is the right one"""


def never_failures(load_case: LoadCase, checks: Checks) -> tuple[Message, ...]:
    """What is wrong with the claim that a table collapses at no angle, proved by the loads of the one turned over."""
    tilt = load_case.tilt
    assert tilt is not None  # needed for such cases only
    failures = checks.failures
    off = float(np.abs(load_case.live_load - chord(tilt, math.pi)).max(initial=0.0))
    if off > SAME_LOADS * float(np.abs(tilt.turning).max(initial=0.0)):
        failures += (
            Message("tilt-not-proved", "the live load is not the change from the level table to the one turned over"),
        )
    if not never_left(tilt.upright, checks.static_bound):
        failures += (Message("tilt-not-proved", "nothing proves that the table bears every angle up to 180 degrees"),)
    return failures


def only_direction_counts(model: Model, contacts: Contacts, tilt: Tilt) -> bool:
    """Whether loads can be borne in any multiple if in one: no strength but friction, and nothing but gravity."""
    laws = [model.joints[name] for name in contacts.joint_names]
    strength = any(law.cohesion or law.tensile_strength or math.isfinite(law.compressive_strength) for law in laws)
    strength |= bool(len(model.ties))
    size = float(np.abs(tilt.turning).max(initial=0.0))
    return not strength and float(np.abs(tilt.fixed[model.free]).max(initial=0.0)) <= 1e-12 * size


def tilt_failures(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> tuple[Message, ...]:
    """What is wrong with the angle of a case that claims one."""
    tilt, mechanics = load_case.tilt, solution.mechanics
    if tilt is None or mechanics is None or solution.status not in WITH_VALUE:
        return ()
    if tilt.tangent and abs(mechanics.load_factor) > SAME_LOADS and not only_direction_counts(model, contacts, tilt):
        return (
            Message(
                "tilt-not-proved", "the load factor is not the tangent of the angle: the size of the loads counts, too"
            ),
        )
    angle = math.degrees(math.atan(mechanics.load_factor)) if tilt.tangent else tilt.angle
    if math.isnan(angle):
        return ()
    loads = load_case.dead_load + mechanics.load_factor * load_case.live_load
    scale = math.hypot(1.0, mechanics.load_factor) if tilt.tangent else 1.0
    off = float(np.abs(loads / scale - tilt.loads_at(angle)).max(initial=0.0))
    size = float(np.abs(tilt.turning).max(initial=0.0))
    if off <= SAME_LOADS * size:
        return ()
    words = f"the loads at collapse are not those at {angle:.6g} degrees: they differ by {off / size:.1e}"
    return (Message("tilt-not-proved", words),)
