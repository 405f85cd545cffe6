"""Associative flow under loads of hundreds of times the weights, in the unit of force of the collapse.

A joint may carry all of a strength of thousands of block loads when it crushes. Its conditions are then differences of
numbers of that size, of which nothing is left in the unit of the mean load: the largest load at collapse takes its
place, or the greatest strength where the first unit led to no load factor. That the dead load is carried was shown in
the first unit.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.program.program import Program
from mbla.program.reductions.restrict import restricted
from mbla.program.resultants.conditions_of import with_conditions_of
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.law.interfaces import Interfaces
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status

HEAVY = 100.0
"""Load at collapse, in mean dead loads of a block, up to which these are the unit of force."""


def solved_under_heavy_loads(
    program: Program, result: AssociativeResult, interfaces: Interfaces, settings: SolverSettings, log: Log
) -> AssociativeResult:
    """The result, or that in the unit of force of the collapse where interfaces crush under heavy loads."""
    crushing = interfaces.crushing
    if crushing is None or program.conditions is None:
        return result
    if result.state is not None:
        loads = program.dead_load + result.state.load_factor * program.live_load
        unit = float(np.abs(loads).max(initial=0.0))
    elif result.status is Status.UNBOUNDED:
        strengths = crushing.compression[np.isfinite(crushing.compression)]
        unit = float(strengths.max(initial=0.0)) / program.scaling.force
    else:
        return result
    if unit <= HEAVY:
        return result
    scaled = with_conditions_of(_in_unit(program, unit), crushing, interfaces.twisting)
    again = solve_associative(scaled, settings, log, first=len(result.programs) + 1, carried=True)
    programs = (*result.programs, *again.programs)
    state = again.state
    if state is None or state.motions is None:
        return replace(result, programs=programs)
    state = replace(
        state, forces=unit * state.forces, load_factor=unit * state.load_factor, motions=unit * state.motions
    )
    return replace(again, state=state, programs=programs, stress_free=result.stress_free, below=result.below)


def _in_unit(program: Program, unit: float) -> Program:
    """The program with forces in a unit, and the load factor counted in it."""
    rows = sp.eye_array(len(program.dead_load), format="csr")
    forces = sp.eye_array(program.components * program.n_points, format="csr")
    scaled = restricted(
        program, sp.csr_array(rows / unit), sp.csr_array(unit * forces), program.limits.scaled(1.0 / unit)
    )
    return replace(scaled, live_load=program.live_load, guided=program.guided)
