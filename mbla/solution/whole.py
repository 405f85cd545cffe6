"""From parts that cannot interact to the whole structure: the part that collapses first gives the load factor.

The others are at rest. What they carry at that load factor is found by one program each: the least contact forces, in
the sense of ½ ‖x‖², in equilibrium with f_D + λ f_L.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.solution.cone_solution import Log
from mbla.solution.cone_solver import interior_point_solver
from mbla.solution.law_state import LawState
from mbla.solution.mechanics import lifted
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status

SAME_FACTOR = 1e-7
"""Relative difference of load factors within which a part is about to collapse as well. Of it no forces but those of
its own collapse are asked for: at its load factor a program that looks for the least ones has hardly an inside, and of
two equal walls the forces found for the second were too rough for a static bound."""


def whole_state(
    parts: Sequence[Program],
    part: int,
    state: LawState,
    settings: SolverSettings,
    log: Log,
    collapse: Sequence[LawState | None] = (),
) -> tuple[Program, LawState] | None:
    """A state of one part as one of the whole model, the other parts at rest; None where these do not carry it.

    A single part is returned as it is.

    collapse : of each part its own state at collapse, None where there is none; nothing where none is known
    """
    if len(parts) == 1:
        return parts[0], state
    total: LawState | None = None
    program = parts[part]
    for number, other in enumerate(parts):
        own: LawState | None = state
        if number != part:
            own = _about_to_collapse(collapse[number] if collapse else None, state.load_factor)
            own = own or at_rest(other, state.load_factor, settings, log)
        if own is None:
            return None
        program, own = to_full(other, own)
        if total is None:
            total = own
        else:
            forces, velocities = total.forces + own.forces, total.velocities + own.velocities
            total = LawState(forces, velocities, state.load_factor, state.residual)
    assert total is not None
    return program, total


def _about_to_collapse(collapse: LawState | None, load_factor: float) -> LawState | None:
    """Forces of a part at its own collapse, without motion, where that is at the load factor given."""
    if collapse is None or abs(collapse.load_factor - load_factor) > SAME_FACTOR * abs(load_factor):
        return None
    return LawState(collapse.forces, np.zeros_like(collapse.velocities), load_factor, collapse.residual)


def to_full(program: Program, state: LawState) -> tuple[Program, LawState]:
    """The program of the whole model, and the state in it."""
    while program.reduction is not None:
        state, program = lifted(program, state), program.reduction.full
    return program, state


def velocities_to_full(program: Program, velocities: FloatArray) -> FloatArray:
    """Velocities of a program in that of the whole model."""
    while program.reduction is not None:
        velocities, program = program.reduction.velocities @ velocities, program.reduction.full
    return velocities


def at_rest(program: Program, load_factor: float, settings: SolverSettings, log: Log) -> LawState | None:
    """Least forces that carry the load, no motion; None where the solver finds none."""
    load = program.dead_load + load_factor * program.live_load
    at_rest = np.zeros_like(program.dead_load)
    if not np.any(load):
        return LawState(np.zeros((program.n_points, program.components)), at_rest, load_factor, 0.0)
    form = gravity_form(replace(program, dead_load=load))
    solution = interior_point_solver(form.cone_program, settings, log).solve(0, 0.0)
    if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
        return None
    return LawState(form.forces(solution.x), at_rest, load_factor, 0.0)
