"""The associative load factor with the convex contact model, and whether the dead load is carried at all.

The program is solved in its stabilised form first, which has a value even where the plain one has none; where that
gives no load factor, or none to the solver's satisfaction, the plain form decides: its rays are certificates. Where the
forces found leave light blocks out of balance all is solved again in their own units. A second
program, with the live load reversed, finds the least load factor under which there is equilibrium; if zero is not
between the two the dead load alone is not carried.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.kinematic import KinematicForm
from mbla.program.resultants import ConvexProgram, convex_form
from mbla.program.resultants.assemble import near_crushing
from mbla.program.resultants.crushing import crushing_violation
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.resultants.convex_repair import repaired_convex_forces
from mbla.solution.resultants.convex_units import (
    HEAVY,
    in_units,
    loses_light_blocks,
    unit_at_collapse,
    units_of_unknowns,
)
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status

STANDS_MARGIN = 1e-7
"""A load factor is taken as negative only beyond this share of (dead load over live load): below it is solver noise."""

DOUBTFUL = 1e-4
"""Share below which the sign of a load factor is not certain where the solver ended short of its tolerance. A factor
itself need not be solved to tolerance: its verified bounds tell what it is worth."""

KKT_REGULARIZATION, STRONGER = 1e-8, 1e-7
"""Static regularisation: with 1e-11 the solver broke down on a wall of 410 blocks; with 1e-8 on a locked vault, where
ten times that proved in one of two units of length, as it did in the other, that there is no mechanism."""

MOVED = 1e-4
"""Share of the load factor by which a repair may move it: beyond it another state was found."""

ROUNDS = 30
"""Times that conditions on crushing are taken in; each time at least one."""

BEYOND = 1e-9
"""Excess over what an interface carries, in mean block loads, that is rounding where others are at their limit."""

OWN_UNITS = 2
"""Times that it is solved again in units which give light blocks their due, each from the forces of the time before."""

FAR, CHANGES = 10.0, 3
"""How far from the load at collapse a unit of force is not good, and how often it is changed."""

DECIDED = (Status.SOLVED, Status.NO_EQUILIBRIUM, Status.UNBOUNDED)
BROKEN = (Status.NUMERICAL_ERROR, Status.ITERATION_LIMIT)


@dataclass(frozen=True)
class ConvexAssociative:
    """What the associative program says.

    state    : where there is a load factor
    velocities, motions : without equilibrium, of a motion in which the dead load does more work than is dissipated
    lock     : (n_points, 3) unbounded: forces that balance the live load alone, for a load factor of 1 of the program
    """

    status: Status
    reason: str
    programs: tuple[ProgramRecord, ...]
    state: LawState | None = None
    velocities: FloatArray | None = None
    motions: FloatArray | None = None
    lock: FloatArray | None = None


@dataclass
class _Run:
    """What is being solved; ``forces`` in the unit of ``convex``, ``unit`` of force for the live load as it is."""

    convex: ConvexProgram
    settings: SolverSettings
    log: Log
    records: list[ProgramRecord]
    forces: FloatArray | None = None
    unit: float = 1.0

    def unit_for(self, sense: float) -> float:
        """Unit of force: the common one for the live load reversed, which asks whether the dead load is carried."""
        return self.unit if sense > 0 else 1.0

    def program(self, sense: float) -> ConvexProgram:
        """The program in the unit of force for the live load as it is, or reversed."""
        return self.convex.in_unit_of_force(self.unit_for(sense))

    def solve(self, convex: ConvexProgram, form: KinematicForm, sense: float) -> ConeSolution:
        """A program with the live load as it is, or reversed; in own units where ``forces`` give them."""
        units = None
        if self.forces is not None:
            units = units_of_unknowns(form, convex, self.forces / self.unit_for(sense))
        own = form.cone_program if units is None else in_units(form.cone_program, units)
        program = replace(own, rhs=sense * own.rhs)
        number, live = len(self.records) + 1, sense * convex.points.scaling.live
        solution = cone_solver(program, self.settings, self.log).solve(number, live)
        value = solution.objective * live if solution.status in WITH_VALUE else np.nan
        kind = "associative" if sense > 0 else "reverse"
        self.records.append(solution.record(number, kind, value))
        return solution if units is None else replace(solution, x=solution.x / units)

    def result(self, status: Status, reason: str) -> ConvexAssociative:
        """A result without state."""
        return ConvexAssociative(status, reason, tuple(self.records))


def solve_convex_associative(convex: ConvexProgram, settings: SolverSettings, log: Log) -> ConvexAssociative:
    """Solve the program of one load case with associative flow.

    Conditions on crushing are taken in where the forces without them need them: most interfaces are far from crushing.
    """
    everything = np.isin(np.arange(convex.n_interfaces), convex.crushing.interfaces)
    run = _Run(convex, replace(settings, regularization=KKT_REGULARIZATION), log, [])
    crushing = np.zeros(convex.n_interfaces, dtype=bool)
    for _ in range(ROUNDS):
        run.convex = convex.with_crushing_of(crushing)
        result = _attempt(run)
        more = everything if result.status is Status.UNBOUNDED else _crushing_too(convex, result, crushing)
        if not np.any(more & ~crushing):
            break
        crushing |= more
    return _in_own_units(run, result)


def _in_own_units(run: _Run, result: ConvexAssociative) -> ConvexAssociative:
    """The result, solved again where it loses light blocks, with repaired forces."""
    convex = run.convex
    for _ in range(OWN_UNITS):
        state = result.state
        if state is None:
            break
        forces, factor = state.forces / run.unit, state.load_factor / run.unit
        if not loses_light_blocks(run.program(1.0), forces, factor):
            break
        run.forces = state.forces
        again = _attempt(run)
        result = replace(result, programs=again.programs) if again.state is None else again
    return result if result.state is None else replace(result, state=_repaired(convex, result.state))


def _crushing_too(convex: ConvexProgram, result: ConvexAssociative, crushing: BoolArray) -> BoolArray:
    """Interfaces that crush, or nearly, by forces; no more where none other is beyond what it carries."""
    if result.state is None:
        return crushing
    resultants = convex.resultants_of(result.state.forces)
    beyond = np.zeros(len(crushing), dtype=bool)
    beyond[convex.crushing.interfaces] = crushing_violation(convex.crushing, resultants) > BEYOND
    return near_crushing(convex, result.state.forces) if np.any(beyond & ~crushing) else crushing


def _repaired(convex: ConvexProgram, state: LawState) -> LawState:
    """The state with the forces that its static bound will be proved with, and the load factor that these carry.

    The solver's own miss equilibrium and conditions by its tolerance, and its load factor may lie above both bounds.
    """
    found = repaired_convex_forces(convex, state.forces, state.load_factor)
    if found is None or abs(found[1] - state.load_factor) > MOVED * abs(state.load_factor):
        return state
    repaired = replace(state, forces=found[0], load_factor=found[1])
    return min(repaired, state, key=lambda one: unbalanced(convex, one))


def unbalanced(convex: ConvexProgram, state: LawState) -> float:
    """Largest force or moment that is out of balance, in mean block loads."""
    program = convex.points
    loads = program.dead_load + state.load_factor * program.live_load
    return float(np.abs(program.equilibrium_matrix @ state.forces.ravel() + loads).max(initial=0.0))


def _attempt(run: _Run) -> ConvexAssociative:
    """The program and, with the live load reversed, whether the dead load is carried."""
    form, forward = _forward(run)
    if forward.status not in (*WITH_VALUE, Status.UNBOUNDED):
        return _without_value(run, form, forward, 1.0, forward.shortfall)
    back, reverse = _solved(run, -1.0)
    if reverse.status not in (*WITH_VALUE, Status.UNBOUNDED):
        words = f"whether the dead load alone is carried is not known: {reverse.shortfall}"
        return _without_value(run, back, reverse, -1.0, words)
    for found, solution, sense in ((form, forward, 1.0), (back, reverse, -1.0)):
        if solution.status in WITH_VALUE and _negative(run.program(sense), solution.objective):
            return _without_equilibrium(run, found, solution, sense)
    if forward.status is Status.UNBOUNDED:
        return _unbounded(run, form, forward)
    doubtful = reverse.status is Status.APPROXIMATE and _near_zero(run.convex, reverse.objective)
    status, reason = (Status.APPROXIMATE, reverse.shortfall) if doubtful else (Status.SOLVED, "")
    velocities = form.velocities(forward.x)
    state = LawState(
        forces=form.contact_forces(forward.z) * run.unit,
        velocities=velocities[: run.convex.n_block_rows],
        motions=run.program(1.0).flows(velocities),
        load_factor=forward.objective * run.unit,
        residual=np.nan,
    )
    return replace(run.result(status, reason), state=state)


def _forward(run: _Run) -> tuple[KinematicForm, ConeSolution]:
    """The program with the live load as it is, in the unit of the loads at collapse where these are far larger."""
    form, solution = _solved(run, 1.0)
    for _ in range(CHANGES):
        unit = _unit_after(run, solution)
        if run.unit / FAR <= unit <= FAR * run.unit:
            break
        run.unit = unit
        form, solution = _solved(run, 1.0)
    return form, solution


def _unit_after(run: _Run, solution: ConeSolution) -> float:
    """Unit of force by what was found; that of the greatest strength where the solver broke down.

    It stays where nothing crushes: no difference of large numbers is lost then, and the term that makes the solution
    unique would weigh more than the dead load of blocks 1,000 times as wide as high.
    """
    if not len(run.convex.crushing.interfaces):
        return run.unit
    if solution.status in WITH_VALUE:
        return unit_at_collapse(run.convex, solution.objective * run.unit)
    strongest = float(run.convex.crushing.strength.max(initial=0.0))
    return strongest if solution.status in BROKEN and strongest > HEAVY else run.unit


def _solved(run: _Run, sense: float) -> tuple[KinematicForm, ConeSolution]:
    """The stabilised program, or the plain one where that decides more.

    Both have the same constraints: a proof that there is no mechanism is one for both, and stays one where the solver
    breaks down on the plain program.
    """
    convex = run.program(sense)
    form = convex_form(convex, stabilised=1.0 / run.unit_for(sense))
    solution = run.solve(convex, form, sense)
    if solution.status is Status.SOLVED and not _negative(convex, solution.objective):
        return form, solution
    plain_form = convex_form(convex)
    plain = run.solve(convex, plain_form, sense)
    if plain.status in BROKEN and solution.status in BROKEN:
        plain = replace(run, settings=replace(run.settings, regularization=STRONGER)).solve(convex, plain_form, sense)
    if plain.status in DECIDED or solution.status not in (*WITH_VALUE, Status.UNBOUNDED):
        return plain_form, plain
    return form, solution


def _negative(convex: ConvexProgram, objective: float) -> bool:
    """Whether the optimum says that equilibrium needs a live load of the other sign."""
    return objective < -_noise(convex)


def _noise(convex: ConvexProgram) -> float:
    program = convex.points
    return STANDS_MARGIN * program.dead_over_live


def _near_zero(convex: ConvexProgram, objective: float) -> bool:
    return abs(objective) < DOUBTFUL / STANDS_MARGIN * _noise(convex)


def _without_value(
    run: _Run, form: KinematicForm, solution: ConeSolution, sense: float, words: str
) -> ConvexAssociative:
    if solution.status is Status.NO_EQUILIBRIUM:
        return _without_equilibrium(run, form, solution, sense)
    return run.result(solution.status, words)


def _without_equilibrium(run: _Run, form: KinematicForm, solution: ConeSolution, sense: float) -> ConvexAssociative:
    """The mechanism that proves it."""
    velocities = form.velocities(solution.x)
    reason = (
        "the dead load alone is not carried: a mechanism exists in which it does more work than the joints dissipate"
    )
    blocks, motions = velocities[: run.convex.n_block_rows], run.program(sense).flows(velocities)
    return replace(run.result(Status.NO_EQUILIBRIUM, reason), velocities=blocks, motions=motions)


def _unbounded(run: _Run, form: KinematicForm, solution: ConeSolution) -> ConvexAssociative:
    """The dual ray: −z_0 is a load factor, and the forces of z balance that multiple of the live load alone."""
    reason = "no mechanism exists in which the live load does work: friction locks the structure under any multiple"
    ray = solution.z / max(-float(solution.z[0]), 1e-300)
    return replace(run.result(Status.UNBOUNDED, reason), lock=_homogeneous(form).contact_forces(ray))


def _homogeneous(form: KinematicForm) -> KinematicForm:
    """The form that reads rays: tension, from which normal forces are counted, has no part in them."""
    return replace(form, limits=replace(form.limits, tension=np.zeros_like(form.limits.tension)))
