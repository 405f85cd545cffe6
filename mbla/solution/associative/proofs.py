"""What forces and velocities prove, evaluated with the statics and kinematics of the verification.

- Static: forces in equilibrium with λ within the yield conditions prove that collapse needs at least λ.
- Kinematic: velocities compatible with the yield conditions prove that it needs no more than −f_D·u plus dissipation,
  per live power. The same velocities prove that the dead load alone is not carried where it does more work than the
  joints dissipate.

Rounding leaves velocities incompatible by δ = μ s − v_N here and there. By virtual work each δ is worth at most N δ: it
is charged with a normal force that no solution comes near. Likewise forces are left out of balance by R and beyond the
yield conditions by e: in the mechanism of collapse these are worth |R·u| + e |v|, and the static bound is charged with
that. Where the load factor is as small as rounding, only so is the static bound one.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.errors import Message
from mbla.model.model import LoadCase, Model
from mbla.program import Program, assemble
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.associative.bounds import LOCKED_IN
from mbla.solution.associative.repair import repaired_forces, repaired_mechanisms
from mbla.solution.solution import Mechanics
from mbla.solution.verification.residuals import unbalanced_loads, unbalanced_wrenches
from mbla.solution.verification.statics import LoadScale, allowed_motion, contact_velocities, power

PROVED_RESIDUAL = 2e-9
"""Unbalanced force and excess over yield, relative to the scale of the block, with which forces still prove a bound."""

PASSED_ON_ROUNDING = 1e-6
"""Share of the forces on a block that its scale is not less than there: thin light blocks pass on forces whose rounding
is more than their weight."""

LARGE, LARGE_GAP = 30_000, 1e-5
"""Rows of equilibrium, 5,000 blocks in space, beyond which a mechanism that proves a load factor so close to the static
bound is not repaired once more: the solver stage has done that. On a wall of 3,630 blocks it took seven eighths of the
verification and changed neither bound."""


def associative_bounds(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    associative: Mechanics,
    limits: YieldLimits,
    scale: LoadScale,
) -> tuple[float, float]:
    """Static and kinematic bound of the associative load factor, NaN where none could be proved."""
    program = assemble(model, contacts, load_case)
    scaling = program.scaling
    forces = scaling.scaled_forces(associative.contact_forces)
    repaired = repaired_forces(program, forces, associative.load_factor / scaling.live)
    approximate = np.nan if repaired is None else scaling.load_factor(repaired[1])
    kinematic, motion = _best_motion(model, contacts, load_case, associative, limits, scale, program, approximate)
    static = np.nan
    if repaired is not None:
        forces, factor = scaling.forces(repaired[0]), scaling.load_factor(repaired[1])
        if _forces_prove(model, contacts, load_case, forces, factor, limits, scale):
            static = factor
            if motion is not None:
                static -= _charge(model, contacts, load_case, forces, factor, limits, scale, motion)
    if not np.any(load_case.dead_load[model.free]):
        static = float(np.fmax(static, 0.0))  # no forces balance no load
    return static, kinematic


def _best_motion(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    associative: Mechanics,
    limits: YieldLimits,
    scale: LoadScale,
    program: Program,
    static: float,
) -> tuple[float, FloatArray | None]:
    """The least kinematic bound of the mechanism and its repairs, and the motion that proves it; NaN and None without.

    static : of a large model's mechanism that is already this near no repair is tried
    """
    largest = 2.0 * float(np.abs(associative.contact_forces[:, 0]).max(initial=0.0))
    velocities = program.velocities(associative.mechanism)
    best: tuple[float, FloatArray | None] = np.nan, None
    for u in repaired_mechanisms(program, velocities):
        motion = allowed_motion(model, program.mechanism(u), scale.arms)
        bound = _proved_kinematic(model, contacts, load_case, motion, limits, largest)
        if np.isfinite(bound) and not bound >= best[0]:
            best = bound, motion
        if len(velocities) > LARGE and abs(bound - static) <= LARGE_GAP * abs(bound):
            break
    return best


def _charge(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    forces: FloatArray,
    factor: float,
    limits: YieldLimits,
    scale: LoadScale,
    mechanism: FloatArray,
) -> float:
    """What unbalanced forces and those beyond yield are worth in a mechanism, over its live power."""
    left = unbalanced_wrenches(model, contacts, load_case, forces, factor, scale)
    unbalanced = float(np.abs(np.einsum("bi,bi->b", left, mechanism)).sum())
    v = contact_velocities(model, contacts, mechanism)
    excess = float((yield_violation(forces, limits) * np.sqrt((v**2).sum(axis=1))).sum())
    return (unbalanced + excess) / power(load_case.live_load, mechanism)


def certificate_failures(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    certificate: FloatArray,
    limits: YieldLimits,
    scale: LoadScale,
) -> tuple[Message, ...]:
    """Why a mechanism, (n_blocks, 6), does not prove that the dead load alone is not carried; nothing where it does."""
    program = assemble(model, contacts, load_case)
    velocities = program.velocities(certificate)
    failures: tuple[Message, ...] = ()
    for u in repaired_mechanisms(program, velocities):
        motion = allowed_motion(model, program.mechanism(u), scale.arms)
        v = contact_velocities(model, contacts, motion)
        dissipated, lack = _dissipation(limits, v)
        work = power(load_case.dead_load, motion) - dissipated
        charge = LOCKED_IN * float(scale.own.sum()) * lack
        if work > charge:
            return ()
        words = _words(work, lack, float(np.abs(v).max(initial=0.0)))
        failures = failures or (Message("collapse-not-proved", words),)
    return failures


def _words(work: float, lack: float, speed: float) -> str:
    if not work > 0:
        return "the dead load does no work in the mechanism that should show the lack of equilibrium"
    return f"the mechanism that shows the lack of equilibrium closes joints by {lack / speed:.1g} of its speed"


def _forces_prove(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    forces: FloatArray,
    factor: float,
    limits: YieldLimits,
    scale: LoadScale,
) -> bool:
    """Whether forces balance the loads within the yield conditions up to rounding."""
    unbalanced = unbalanced_loads(model, contacts, load_case, forces, factor, scale)
    excess = yield_violation(forces, limits)
    block_scale = scale.rounded_scale(contacts, forces, factor, PASSED_ON_ROUNDING)
    point_scale = scale.of_lighter(contacts, block_scale)
    return bool(np.all(unbalanced <= PROVED_RESIDUAL * block_scale) and np.all(excess <= PROVED_RESIDUAL * point_scale))


def _proved_kinematic(
    model: Model,
    contacts: Contacts,
    load_case: LoadCase,
    mechanism: FloatArray,
    limits: YieldLimits,
    largest: float,
) -> float:
    """Load factor at or above the collapse value; ``largest`` is the normal force with which rounding is charged."""
    live_power = power(load_case.live_load, mechanism)
    if not live_power > 0.0:
        return np.nan
    dissipated, lack = _dissipation(limits, contact_velocities(model, contacts, mechanism))
    return (dissipated + largest * lack - power(load_case.dead_load, mechanism)) / live_power


def _dissipation(limits: YieldLimits, v: FloatArray) -> tuple[float, float]:
    """Power that the joints dissipate at most by associative flow, and Σ δ over the points that cannot crush."""
    sliding = np.hypot(v[:, 1], v[:, 2])
    surplus = v[:, 0] - limits.friction * sliding
    short = np.maximum(-surplus, 0.0)
    crushable = np.isfinite(limits.compression)
    crushed = np.where(crushable, limits.compression, 0.0) * short
    dissipated = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0) + crushed
    return float(dissipated.sum()), float(short[~crushable].sum())
