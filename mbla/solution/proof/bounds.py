"""Bounds of the associative load factor that forces and velocities prove once they are repaired.

They are repaired in ``static_repair`` and ``kinematic_repair``. Nothing there needs to be trusted: what the repaired
forces and velocities prove is evaluated by ``verify`` with its own statics and kinematics. ``proved_bounds`` is the
solver stage's own evaluation of the same, on the program alone.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.process.stopwatch import stage
from mbla.program.program import Program
from mbla.solution.associative.condition_cones import ConditionCones
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.proof.kinematic_repair import repaired_mechanisms
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.thresholds import LOCKED_IN, ZERO_FACTOR

CHARGED = 2.0
"""Normal force, over the largest of the solution, with which rounding in a mechanism's compatibility is charged."""

WORK_ROUNDING = 1e-13
"""Work of the dead load, over the sum of its parts, that may be rounding."""


@dataclass(frozen=True)
class ProvedBounds:
    """What the repaired forces and velocities of a state prove about the associative factor of a program.

    static, kinematic : bounds, NaN where none could be proved
    gap               : their distance over the load factor, or over a thousandth of dead over live load if that is more
    forces, load_factor: the repaired forces, (n_points, components), and what they carry; as given where not repaired
    velocities        : (n_rows,) of the least kinematic bound
    least             : load factor up to which it is taken for that in the gap
    of_interfaces     : there are conditions on interfaces
    """

    static: float
    kinematic: float
    gap: float
    forces: FloatArray
    load_factor: float
    velocities: FloatArray
    least: float = 0.0
    of_interfaces: bool = False

    def with_bounds_of(self, other: ProvedBounds) -> ProvedBounds:
        """The greater static bound of two with its forces, and the lesser kinematic one with its velocities."""
        forces = self if not other.static > self.static and np.isfinite(self.static) else other
        velocities = self if not other.kinematic < self.kinematic and np.isfinite(self.kinematic) else other
        static, kinematic = forces.static, velocities.kinematic
        gap = abs(kinematic - static) / max(abs(kinematic), self.least, 1e-300)
        return replace(forces, static=static, kinematic=kinematic, gap=gap, velocities=velocities.velocities)


@stage("repair")
def proved_bounds(program: Program, state: CollapseState, slacks: FloatArray | None = None) -> ProvedBounds:
    """Bounds of the associative load factor that a state proves; no solver is called.

    state  : its velocities are (n_rows + n_unknowns,), those of conditions on interfaces behind those of the blocks
    slacks : (n_slacks,) of these conditions
    """
    repaired = repaired_forces(program, state.forces, state.load_factor, slacks)
    forces, factor = (state.forces, state.load_factor) if repaired is None else repaired
    charge = CHARGED * float(np.abs(state.forces[:, 0]).max(initial=0.0))
    if slacks is not None:
        charge = max(charge, CHARGED * float(np.abs(slacks).max(initial=0.0)))
    mechanisms = list(repaired_mechanisms(program, state.velocities))
    values = [kinematic_value(program, u, charge) for u in mechanisms]
    best = int(np.argmin(np.nan_to_num(values, nan=np.inf)))
    static, kinematic = (np.nan if repaired is None else factor), values[best]
    if not static >= 0.0 and not program.dead_load.any():  # no forces balance no load
        forces, factor, static = np.zeros_like(forces), 0.0, 0.0
    least = ZERO_FACTOR * factor_size(program)
    gap = abs(kinematic - static) / max(abs(kinematic), least, 1e-300)
    return ProvedBounds(static, kinematic, gap, forces, factor, mechanisms[best], least, slacks is not None)


def factor_size(program: Program) -> float:
    """Size of load factors: dead load over live load; the strength of the joints for want of it, 1 for want of that."""
    strength = float((program.limits.cohesion + program.limits.tension).sum())
    sizes = (float(np.linalg.norm(program.dead_load)), strength, 1.0)
    return next(size for size in sizes if size > 0.0) / float(np.linalg.norm(program.live_load))


def falling_motion(program: Program, velocities: FloatArray) -> FloatArray | None:
    """Velocities near the given ones, (n_rows,), proving that the dead load alone is not carried; None where none do.

    They are compatible, what rounding leaves is charged as if the total dead load were locked in many times over, and
    the dead load does more work in them than the joints dissipate. They are scaled to a largest entry of 1: a solver's
    certificate of infeasibility may have any size, whose square need not be a number.
    """
    largest = float(np.abs(velocities).max(initial=0.0))
    if not 0.0 < largest < np.inf:
        return None
    velocities = velocities / largest
    charge = LOCKED_IN * float(np.abs(program.dead_load).sum())
    for u in repaired_mechanisms(program, velocities):
        blocks = u[: len(program.dead_load)]
        work = float(program.dead_load @ blocks) - dissipation(program, u, charge)
        if work > WORK_ROUNDING * float(np.abs(program.dead_load) @ np.abs(blocks)):
            return u
    return None


def kinematic_value(program: Program, velocities: FloatArray, charge: float) -> float:
    """Load factor that velocities, (n_rows,), prove to be at or above the collapse value, NaN where none.

    charge : normal force with which the remaining incompatibility is charged
    """
    blocks = velocities[: len(program.dead_load)]
    live_power = float(program.live_load @ blocks)
    if not live_power > 0.0:
        return float("nan")
    return float((dissipation(program, velocities, charge) - program.dead_load @ blocks) / live_power)


def dissipation(program: Program, velocities: FloatArray, charge: float) -> float:
    """Power of the joints by associative flow; incompatibility where they cannot crush costs ``charge`` as force.

    velocities : (n_rows,)  non-dimensional, as is the power
    """
    limits, further = program.limits, ConditionCones.of(program)
    v = further.moving.contact_velocities(velocities)
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    surplus = v[:, 0] - limits.friction * sliding
    crushes, short = np.isfinite(limits.compression), np.maximum(-surplus, 0.0)
    crushed = np.where(crushes, limits.compression, 0.0) * short
    power = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0) + crushed
    lack = short[~crushes].sum() + further.lack(further.held.T @ velocities).sum()
    own = 0.0 if program.conditions is None else program.conditions.cost @ velocities[len(program.dead_load) :]
    return float(power.sum() + own + charge * lack)
