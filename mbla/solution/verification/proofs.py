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

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.solution.solution import Mechanics
from mbla.solution.thresholds import LOCKED_IN
from mbla.solution.verification.case import LoadedModel, Motion
from mbla.solution.verification.statics import largest_on_interface


def associative_bounds(case: LoadedModel, associative: Mechanics) -> tuple[float, float]:
    """Static and kinematic bound of the associative load factor, NaN where none is proved."""
    forces, factor, static = associative.contact_forces, associative.load_factor, np.nan
    motion = case.admissible(case.motion_of(associative))
    kinematic = kinematic_bound(case, motion, forces)
    if case.forces_prove(forces, factor):
        static = factor - (case.charge(forces, factor, motion) if np.isfinite(kinematic) else 0.0)
    if not np.any(case.load_case.dead_load[case.model.free]):
        static = float(np.fmax(static, 0.0))  # no forces balance no load
    return static, kinematic


def kinematic_bound(case: LoadedModel, motion: Motion, forces: FloatArray) -> float:
    """Load factor at or above the collapse value that an admissible motion proves; NaN where it proves none.

    forces : (n_points, 3) N of the state, which say with what rounding is charged, and what strengths count as at most
    """
    dead_power, live_power = case.powers(motion[0])
    if not live_power > 0.0:
        return np.nan
    largest = 2.0 * float(np.abs(forces[:, 0]).max(initial=0.0))
    dissipated, lack = case.dissipation(motion, 2.0 * largest_on_interface(case.contacts, forces))
    bound = (dissipated + largest * lack - dead_power) / live_power
    return bound if np.isfinite(bound) else np.nan


def certificate_failures(case: LoadedModel, certificate: Motion) -> tuple[Message, ...]:
    """Why a motion does not prove that the dead load alone is not carried; nothing where it does."""
    motion = case.admissible(certificate)
    dissipated, lack = case.dissipation(motion)
    work = case.powers(motion[0])[0] - dissipated
    if work > LOCKED_IN * float(case.scale.own.sum()) * lack:
        return ()
    words = "the dead load does no work in the mechanism that should show the lack of equilibrium"
    if work > 0:
        share = lack / float(np.abs(case.velocities(motion[0])).max(initial=0.0))
        words = f"the mechanism that shows the lack of equilibrium closes joints by {share:.1g} of its speed"
    return (Message("collapse-not-proved", words),)
