"""What forces and velocities prove, evaluated with the statics and kinematics of the verification.

- Static: forces in equilibrium with λ within the yield conditions prove that collapse needs at least λ.
- Kinematic: velocities compatible with the yield conditions prove that it needs no more than −f_D·u plus dissipation,
  per live power. The same velocities prove that the dead load alone is not carried where it does more work than the
  joints dissipate.

Rounding leaves velocities incompatible by δ = μ s − v_N here and there. By virtual work each δ is worth at most N δ: it
is charged with a normal force that no solution comes near, and so is what gives way by as little where a strength is
larger than any force of the solution. Likewise forces are left out of balance by R and beyond the
yield conditions by e: in the mechanism of collapse these are worth |R·u| + e |v|, and the static bound is charged with
that. Where the load factor is as small as rounding, the static bound is a bound only with that charge.
"""

from __future__ import annotations

import numpy as np

from mbla.errors import Message
from mbla.solution.solution import Mechanics
from mbla.solution.thresholds import LOCKED_IN
from mbla.solution.verification.case import Case, Motion
from mbla.solution.verification.statics import largest_on_interface

LARGE, LARGE_GAP = 30_000, 1e-5
"""Rows of equilibrium, 5,000 blocks in space, beyond which a mechanism that proves a load factor so close to the static
bound is not repaired once more: the solver stage has done that. On a wall of 3,630 blocks it took seven eighths of the
verification and changed neither bound."""


def associative_bounds(case: Case, associative: Mechanics) -> tuple[float, float]:
    """Static and kinematic bound of the associative load factor, NaN where none could be proved."""
    repaired = case.repaired_forces(associative)
    kinematic, motion = _best_motion(case, associative, np.nan if repaired is None else repaired[1])
    static = np.nan
    if repaired is not None and case.forces_prove(*repaired):
        static = repaired[1] - (0.0 if motion is None else case.charge(*repaired, motion))
    if not np.any(case.load_case.dead_load[case.model.free]):
        static = float(np.fmax(static, 0.0))  # no forces balance no load
    return static, kinematic


def _best_motion(case: Case, associative: Mechanics, static: float) -> tuple[float, Motion | None]:
    """The least kinematic bound of the mechanism and its repairs, and the motion that proves it; NaN and None without.

    static : of a large model's mechanism that is already this near no repair is tried
    """
    largest = 2.0 * float(np.abs(associative.contact_forces[:, 0]).max(initial=0.0))
    most = 2.0 * largest_on_interface(case.contacts, associative.contact_forces)
    best: tuple[float, Motion | None] = np.nan, None
    for motion in case.repaired_motions(case.motion_of(associative)):
        bound = _proved_kinematic(case, motion, largest, most)
        if np.isfinite(bound) and not bound >= best[0]:
            best = bound, motion
        if len(case.program.dead_load) > LARGE and abs(bound - static) <= LARGE_GAP * abs(bound):
            break
    return best


def _proved_kinematic(case: Case, motion: Motion, largest: float, most: float) -> float:
    """Load factor at or above the collapse value.

    largest : normal force with which rounding is charged; most : force that strengths count as at most
    """
    dead_power, live_power = case.powers(motion[0])
    if not live_power > 0.0:
        return np.nan
    dissipated, lack = case.dissipation(motion, most)
    return (dissipated + largest * lack - dead_power) / live_power


def certificate_failures(case: Case, certificate: Motion) -> tuple[Message, ...]:
    """Why a motion does not prove that the dead load alone is not carried; nothing where it does."""
    failures: tuple[Message, ...] = ()
    for motion in case.repaired_motions(certificate):
        dissipated, lack = case.dissipation(motion)
        work = case.powers(motion[0])[0] - dissipated
        if work > LOCKED_IN * float(case.scale.own.sum()) * lack:
            return ()
        words = "the dead load does no work in the mechanism that should show the lack of equilibrium"
        if work > 0:
            share = lack / float(np.abs(case.velocities(motion[0])).max(initial=0.0))
            words = f"the mechanism that shows the lack of equilibrium closes joints by {share:.1g} of its speed"
        failures = failures or (Message("collapse-not-proved", words),)
    return failures
