"""From parts that cannot interact to the whole structure: the part that collapses first gives the load factor.

The other parts are at rest. Their contact forces at that load factor are the least in the sense of ½ ‖x‖² in
equilibrium with f_D + λ f_L, by one program each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.flow.resting_forces import resting_forces
from mbla.solution.full_model.mechanics import lifted
from mbla.solution.law.interfaces import NONE, Interfaces
from mbla.solution.nonassociative.collapse_state import CollapseState, StepHistory
from mbla.solution.settings import SolverSettings

SAME_FACTOR = 1e-9
"""Relative difference of load factors within which a part is about to collapse as well: it has the forces of its own
collapse."""

NEAR = 1e-3
"""Relative difference up to which a part collapses soon after. At the load factor a program that looks for the least
forces has hardly an interior then."""

BELOW = 1e-2
"""Share of the load factor by which such a part is examined below it. Forces of there and of its own collapse,
combined to the load factor between the two, balance the loads and keep within the yield conditions as both do."""


def assemble_parts(
    parts: Sequence[Program],
    part: int,
    state: CollapseState,
    settings: SolverSettings,
    log: Log,
    collapse: Sequence[CollapseState | None] = (),
    interfaces: Interfaces = NONE,
    below: Sequence[tuple[FloatArray, float] | None] = (),
) -> tuple[Program, CollapseState] | None:
    """A state of one part as one of the full model, the other parts at rest; None where these do not carry it.

    A single part is returned as it is.

    collapse   : of each part its own state at collapse, None where there is none; nothing where none is known
    interfaces : of the model that have a law of their own
    below      : of each part forces at a load factor of zero or below, None where there are none
    """
    if len(parts) == 1:
        return parts[0], state
    total: CollapseState | None = None
    for number, other in enumerate(parts):
        own: CollapseState | None = state
        if number != part:
            known = collapse[number] if collapse else None, below[number] if below else None
            own = _between(other, *known, state.load_factor)
            if own is None:
                own = _resting(other, known[0], state.load_factor, settings, log, interfaces)
            own = own if own is None or state.history is None else _remembered(other, own, state.history)
        if own is None:
            return None
        own = lifted(other, own)
        total = own if total is None else _together(total, own, state)
    assert total is not None
    return parts[part].full, total


def _remembered(program: Program, resting: CollapseState, beside: StepHistory) -> CollapseState:
    """A part at rest beside one of elastic joints: it remembers its forces, and keeps them for it does not move."""
    stiff = np.ones(program.n_points)
    in_shear = float(np.median(beside.shear / beside.normal))
    return replace(resting, history=StepHistory(resting.forces, stiff, in_shear * stiff))


def _together(one: CollapseState, other: CollapseState, deciding: CollapseState) -> CollapseState:
    """States of two parts of the full model, each nothing where the other is."""
    history = None
    if one.history is not None and other.history is not None:
        first, second = one.history, other.history
        history = StepHistory(
            first.remembered + second.remembered,
            first.normal + second.normal,
            first.shear + second.shear,
            _sum(first.motions, second.motions),
        )
    forces, velocities = one.forces + other.forces, one.velocities + other.velocities
    motions = _sum(one.motions, other.motions)
    return CollapseState(forces, velocities, deciding.load_factor, deciding.residual, motions, history)


def _sum(one: FloatArray | None, other: FloatArray | None) -> FloatArray | None:
    """Of what each may lack."""
    if one is None or other is None:
        return one if other is None else other
    return one + other


def _between(
    program: Program, collapse: CollapseState | None, below: tuple[FloatArray, float] | None, load_factor: float
) -> CollapseState | None:
    """Forces of a part with conditions on interfaces between two that are proved; None without such.

    Both keep within all conditions and balance the loads at their load factors, and so does what lies between.
    """
    if program.conditions is None or below is None:
        return None
    if not np.any(program.live_load):
        return CollapseState(below[0], np.zeros_like(program.dead_load), load_factor, 0.0)
    if collapse is None or not below[1] <= load_factor <= collapse.load_factor:
        return None
    return _without_motion(collapse, collapse.forces_between(below, load_factor), load_factor)


def _resting(
    program: Program,
    collapse: CollapseState | None,
    load_factor: float,
    settings: SolverSettings,
    log: Log,
    interfaces: Interfaces,
) -> CollapseState | None:
    """Forces of a part that does not move at a load factor; from its own collapse where that is near."""
    apart = np.inf if collapse is None else abs(collapse.load_factor - load_factor)
    if collapse is not None and apart <= SAME_FACTOR * abs(load_factor):
        return _without_motion(collapse, collapse.forces, load_factor)
    if collapse is not None and apart <= NEAR * abs(load_factor):
        lower = load_factor - BELOW * abs(load_factor)
        below = at_rest(program, lower, settings, log, interfaces)
        if below is not None:
            return _without_motion(collapse, collapse.forces_between((below.forces, lower), load_factor), load_factor)
    return at_rest(program, load_factor, settings, log, interfaces)


def _without_motion(collapse: CollapseState, forces: FloatArray, load_factor: float) -> CollapseState:
    return CollapseState(forces, np.zeros_like(collapse.velocities), load_factor, collapse.residual)


def at_rest(
    program: Program, load_factor: float, settings: SolverSettings, log: Log, interfaces: Interfaces = NONE
) -> CollapseState | None:
    """Forces that carry the load, no motion; None where the solver finds none.

    interfaces : of the model that have a law of their own
    """
    load = program.dead_load + load_factor * program.live_load
    at_rest = np.zeros_like(program.dead_load)
    if not np.any(load):
        return CollapseState(np.zeros((program.n_points, program.components)), at_rest, load_factor, 0.0)
    alone = replace(program, dead_load=load, live_load=np.zeros_like(load))
    found = resting_forces(alone, interfaces, settings, log)
    return None if found is None else CollapseState(found, at_rest, load_factor, 0.0)
