"""The proof that a structure locks: contact forces that carry every multiple of the live load.

Forces z that balance the live load alone, A z + f_L = 0, and stay within the yield conditions however often they are
taken (‖T‖ ≤ μN, without cohesion and tension, none where the joint can crush) carry every load factor λ > 0: added λ
times to forces that carry the dead load they stay within the yield conditions, because those are convex.

These forces are the least of their kind with a slightly reduced friction, so that they lie inside the cones, and are
then repaired to exact equilibrium (``repaired_forces``). Other code evaluates them:
:mod:`mbla.solution.verification.lock`.

Without dilatancy the load factor may be bounded where friction with normality locks the structure: what is confined
cannot slide where sliding dilates. The path of elastic joints shows it (:mod:`mbla.solution.flow.path_of_part`).

Joints that can crush carry nothing for ever, and count as open.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import guided_program
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.standing import least_forces

FRICTIONS = (0.99, 0.9999, 1.0)
"""Shares of the friction with which forces are looked for: the less, the further inside the cones."""

NEGLIGIBLE = (0.0, 1e-9, 1e-6)
"""Shares of the largest force below which points are left out: where forces must be zero, behind joints that crush, the
solver leaves some, and there are none inside the cones to repair them to."""


def locking_forces(parts: Sequence[Program], settings: SolverSettings, log: Log) -> FloatArray | None:
    """Contact forces of the model, (n_points, 3), in balance with its live load alone, by the parts of one load case.

    None where none were found that can be proved: the live load brings collapse, or the structure locks by a hair.
    """
    loaded = [_lasting(program) for program in parts if np.any(program.live_load)]
    for share in FRICTIONS:
        found = [_least_forces(program, share, settings, log) for program in loaded]
        forces = [program.lift.contact_forces(x) for program, x in zip(loaded, found, strict=True) if x is not None]
        if not forces or len(forces) < len(loaded):
            continue
        whole = _lasting(loaded[0].full)
        exact = _in_balance(guided_program(whole, whole.facts.allowed), np.sum(forces, axis=0))
        if exact is not None:
            return whole.scaling.forces(exact) / whole.scaling.live
    return None


def locking_forces_of_part(program: Program, settings: SolverSettings, log: Log) -> FloatArray | None:
    """The same of one part without conditions on interfaces, (n_points, components) for a load factor of 1."""
    for share in FRICTIONS:
        found = _least_forces(program, share, settings, log)
        exact = None if found is None else _in_balance(program, found)
        if exact is not None:
            return exact
    return None


def locks_at_dilatancy(program: Program, settings: SolverSettings, log: Log) -> bool:
    """Whether forces within cones of the dilatancy angles carry every multiple of the live load, as the solver finds.

    Then no mechanism that dilates by these angles gains work from the live load.
    """
    flat = replace(program, limits=replace(program.limits, friction=program.limits.dilatancy))
    return any(_least_forces(flat, share, settings, log) is not None for share in FRICTIONS)


def _lasting(program: Program) -> Program:
    """The program without conditions on interfaces, those that crush as open as points that do."""
    conditions, limits = program.conditions, program.limits
    if conditions is None:
        return program
    crush = np.diff(sp.csc_array(conditions.motions[1]).indptr) > 0
    points = np.unique(sp.csc_array(conditions.velocities)[:, np.flatnonzero(crush)].indices // program.components)
    compression = limits.compression.copy()
    compression[points] = 0.0
    return replace(program, limits=replace(limits, compression=compression), conditions=None)


def _least_forces(program: Program, share: float, settings: SolverSettings, log: Log) -> FloatArray | None:
    """Least forces, (n_points, components), with a share of the friction."""
    lasting = recession_cone(program.limits)
    inside = replace(program, dead_load=program.live_load, limits=replace(lasting, friction=share * lasting.friction))
    found = least_forces(_without_points(inside, np.isinf(lasting.compression)), settings, log, [])
    if isinstance(found, ConeSolution):
        return None
    forces = np.zeros((program.n_points, program.components))
    forces[np.isinf(lasting.compression)] = found
    return forces


def _in_balance(whole: Program, forces: FloatArray) -> FloatArray | None:
    """Forces that balance the live load exactly, from some that nearly do, (n_points, 3)."""
    lasting = recession_cone(whole.limits)
    alone = replace(whole, dead_load=np.zeros_like(whole.dead_load), limits=lasting)
    size = np.linalg.norm(forces, axis=1)
    for share in NEGLIGIBLE:
        kept = np.isinf(lasting.compression) & (size >= share * size.max(initial=0.0))
        repaired = repaired_forces(_without_points(alone, kept), forces[kept], 1.0)
        if repaired is not None and repaired[1] > 0.0:
            exact = np.zeros_like(forces)
            exact[kept] = repaired[0] / repaired[1]
            return exact
    return None


def _without_points(program: Program, kept: FloatArray) -> Program:
    """The program with the chosen points, (n_points,), alone."""
    columns = np.flatnonzero(np.repeat(kept, program.components))
    limits = YieldLimits(*(values[kept] for values in vars(program.limits).values()))
    return replace(program, equilibrium_matrix=program.equilibrium_matrix[:, columns], limits=limits)


def recession_cone(limits: YieldLimits) -> YieldLimits:
    """What is left of the limits at forces that grow for ever: friction, where the joint cannot crush."""
    none = np.zeros_like(limits.friction)
    lasting = np.where(np.isfinite(limits.compression), 0.0, np.inf)
    return replace(limits, cohesion=none, tension=none, compression=lasting)
