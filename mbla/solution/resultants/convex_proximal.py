"""Non-associative flow with the convex contact model: proximal steps from the gravity state, and the exact law.

1. Gravity state x̄: the least forces that carry the dead load alone, by the conditions of the points.
2. Proximal step (:mod:`mbla.program.resultants.static`), with the friction of points and interfaces that belongs to x̄,
   after which x̄ moves 0.7 of the way. Every forces at which the steps stand still are a state of the exact law.
3. Now and then the step is repeated with the exact law (``convex_law``), and from there on again until
   forces and motions fit it.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Message
from mbla.program.resultants import ConvexProgram
from mbla.program.resultants.friction_limit import friction_limit
from mbla.program.resultants.static import ConvexStaticForm, convex_proximal_data, convex_proximal_form
from mbla.solution.cone_solvers.choice import interior_point_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.law_state import LawState, SequenceResult, as_asked, not_at_rest, spread_of
from mbla.solution.resultants.convex_law import ConvexLaw, convex_law, exact_convex_step, state_without_dilatancy
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.standing import least_forces
from mbla.solution.thresholds import EXACT_RESIDUAL

STEP = 0.01
"""ε: size of a proximal step relative to the gravity state."""

MOVE = 0.7
"""Share of each step that the anchor moves."""

MOST_STEPS = 60
"""Steps before the scheme is given up."""

FIRST_TRY, TRY_EVERY = 4, 3
"""The exact law is tried at the fourth step and every third after it."""

NEAR_LAW = 0.2
"""Residual below which it is tried at all."""

MOST_WORK = 600
"""Factorisations of one try of the exact law."""

EXACT, NEARLY_EXACT = 1e-9, 1e-8
"""Residual at which a state counts as one of the exact law, and at which it does after a try of the law in vain: where
an interface is all but wholly crushed convex steps come to 3e-9, and tries, of 600 factorisations each, to no less."""

BALANCED = 1e-4
"""Unbalanced force, in mean block loads, up to which a step of the exact law leads to the next: velocities over ρ are
up to 1e7 times as large as forces where interfaces crush, and the last of a step is found from a nearer anchor."""

LONGER, EASY, SHORTER = 3.0, 4, 10.0
"""How ρ falls after a step of the exact law that took few factorisations, down to what it grows to where one was not
found. Near their end steps of one length creep: on a wall of 33 blocks with a strength of 5 MPa the residual fell by
8 % a step."""

QUIET = 1e-8
"""Tolerance of the proximal programs: velocities are divided by ρ."""

PATIENCE = 15
"""Proximal steps in which the least residual must fall to half of what it was, or the sequence is given up: walls of
ten courses creep between 1e-3 and 1e-2 for as many steps as they are given."""


@dataclass
class _Run:
    """What a sequence has so far; ``states`` in the order in which they were reached, ``of_steps`` residuals."""

    convex: ConvexProgram
    settings: SolverSettings
    log: Log
    records: list[ProgramRecord]
    states: list[LawState] = field(default_factory=list)
    of_steps: list[float] = field(default_factory=list)

    def add(self, kind: str, solution: ConeSolution, factor: float) -> None:
        """Record a cone program."""
        self.records.append(solution.record(len(self.records) + 1, kind, *self._value(kind, factor)))

    def add_exact(self, status: Status, factor: float, work: int, seconds: float) -> None:
        """Record steps of the exact law."""
        kind = "exact step"
        value, change = self._value(kind, factor)
        self.records.append(ProgramRecord(len(self.records) + 1, kind, status, value, change, work, seconds))

    def _value(self, kind: str, factor: float) -> tuple[float, float]:
        """Load factor, and how far that is from the one of the last program of its kind."""
        before = [record.load_factor for record in self.records if record.kind == kind]
        value = self.convex.points.scaling.load_factor(factor)
        return value, abs(value - before[-1]) / max(abs(value), 1e-300) if before else np.nan


def solve_convex_proximal(
    convex: ConvexProgram,
    records: tuple[ProgramRecord, ...],
    settings: SolverSettings,
    log: Log,
    unit: float = 1.0,
) -> SequenceResult:
    """Run the scheme; ``records`` are those of the programs before it.

    unit : of force, in that of the program, in which states are given; of the loads at collapse if it is not 1
    """
    run = _Run(convex, replace(settings, tolerance=min(settings.tolerance, QUIET)), log, list(records))
    gravity = least_forces(convex.points, run.settings, log, run.records)
    if isinstance(gravity, ConeSolution):
        return _broken_off(run, gravity, len(run.records))
    run.convex = convex = convex.in_unit_of_force(unit)
    anchor, least = gravity / unit, 1e-300 if unit == 1.0 else 1.0
    rho = STEP / max(float((anchor**2).sum()), least)
    form, law = convex_proximal_form(convex, rho), convex_law(convex)
    solver = interior_point_solver(form.cone_program, run.settings, log)
    for step in range(1, MOST_STEPS + 1):
        cost, rhs = _data(form, rho, anchor)
        solver.update(cost=cost, rhs=rhs)
        solution = solver.solve(len(run.records) + 1, -convex.points.scaling.live)
        if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
            return _broken_off(run, solution, len(run.records) + 1)
        state = _state_of(form, solution)
        run.states.append(state)
        run.of_steps.append(state.residual)
        run.add("convex step", solution, state.load_factor)
        if state.residual <= EXACT or _is_enough(run):
            break
        due = step >= FIRST_TRY and (step - FIRST_TRY) % TRY_EVERY == 0 and state.residual < NEAR_LAW
        if due and (_exact(run, law, anchor, rho, state) or _is_nearly_exact(run)):
            break
        if _is_stuck(run):
            break
        anchor = MOVE * state.forces + (1.0 - MOVE) * anchor
    return _finished(run)


def _data(form: ConvexStaticForm, rho: float, anchor: FloatArray) -> tuple[FloatArray, FloatArray]:
    convex, limits = form.convex, form.convex.points.limits
    limit = np.maximum(limits.friction * anchor[:, 0] + limits.cohesion, 0.0)
    size = friction_limit(convex.torsion, convex.resultants_of(anchor))
    return convex_proximal_data(form, rho, anchor, limit, size.share, np.maximum(size.total - size.share, 0.0))


def _state_of(form: ConvexStaticForm, solution: ConeSolution) -> LawState:
    """State of a proximal step; its velocities are those of unit live power."""
    x, z = solution.x, solution.z
    return state_without_dilatancy(
        form.convex, form.forces(x), form.velocities(z), form.motions(z), form.load_factor(x)
    )


def _exact(run: _Run, law: ConvexLaw, anchor: FloatArray, rho: float, state: LawState) -> bool:
    """Steps of the exact law from the anchor of a proximal step; whether they came to rest."""
    started, count, least, found = time.perf_counter(), 0, 0.0, False
    assert state.motions is not None
    u, factor = np.concatenate([state.velocities, law.own_of(state.motions)]), state.load_factor
    n_blocks, fits = run.convex.n_block_rows, False
    while count < MOST_WORK:
        step = exact_convex_step(law, anchor, rho, u, factor)
        count += step.factorizations
        if step.residual > BALANCED:
            if not found or least > 0.0:
                break
            rho *= SHORTER
            least = rho
            continue
        found = True
        rho = max(rho / LONGER, least) if step.factorizations <= EASY else rho
        u, factor, anchor = step.velocities, step.load_factor, step.forces
        motions = law.motions(u[n_blocks:])
        found_state = state_without_dilatancy(run.convex, anchor, u[:n_blocks], motions, factor)
        run.states.append(replace(found_state, residual=max(found_state.residual, step.residual)))
        fits = run.states[-1].residual <= EXACT
        if fits:
            break
    status = Status.SOLVED if fits else Status.APPROXIMATE
    run.add_exact(status, factor, count, time.perf_counter() - started)
    return fits


def _is_enough(run: _Run) -> bool:
    """Whether a rough state is asked for and here: residual and change of the load factor at most that."""
    wanted, states = run.settings.residual, run.states[-2:]
    if wanted <= EXACT_RESIDUAL or len(states) < 2 or states[-1].residual > wanted:
        return False
    return abs(states[-1].load_factor - states[-2].load_factor) <= wanted * abs(states[-1].load_factor)


def _is_stuck(run: _Run) -> bool:
    """Whether the last steps have not halved the least residual, those of the exact law left out."""
    earlier, last = run.of_steps[:-PATIENCE], run.of_steps[-PATIENCE:]
    return bool(earlier) and min(last) > 0.5 * min(earlier)


def _is_nearly_exact(run: _Run) -> bool:
    """Whether a state fits the law so well that no more is tried after a try in vain."""
    return min(state.residual for state in run.states) <= NEARLY_EXACT


def _finished(run: _Run) -> SequenceResult:
    best = min(run.states, key=lambda state: state.residual)
    records, wanted = tuple(run.records), run.settings.residual
    if best.residual > EXACT_RESIDUAL and _is_enough(run):
        return as_asked(run.states[-1], run.states[-1].residual, wanted, records)
    if best.residual <= EXACT_RESIDUAL:
        return SequenceResult(Status.SOLVED, best, "", records)
    words = f"did not converge in {len(run.of_steps)} iterations: residual of the joint law {best.residual:.2g}"
    return not_at_rest(best, Message("law-missed", words), records, spread_of(best, run.states))


def _broken_off(run: _Run, solution: ConeSolution, number: int) -> SequenceResult:
    status = solution.status
    if status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):  # said of a program of the scheme, not of the structure
        status = Status.NOT_VERIFIED
    reason = f"program {number} of the sequence ended without a solution ({solution.verdict})"
    best = min(run.states, key=lambda state: state.residual, default=None)
    return SequenceResult(status, best, reason, tuple(run.records))
