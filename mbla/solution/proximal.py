"""Non-associative flow by proximal steps from the gravity state, and Newton's method on the exact law.

1. Gravity state x̄: the least forces, in the sense of ½ ‖x‖², that carry the dead load alone.
2. Proximal step, strictly convex::

       max λ − ρ/2 ‖x − x̄‖²   s.t.   A x + f_D + λ f_L = 0,   ‖T‖ ≤ μ N̄ + c,   −f_t ≤ N ≤ f_c

   x̄ then moves 0.7 of the way to x. The limit of shear does not depend on N, so that sliding does not dilate; every
   point at which the steps stand still is a state of the exact law, for any ρ. The step works as a step of the load:
   ρ = ε/‖x̄‖² with ε = 0.01 is free of units and of the number of contact points.
3. Now and then the step is repeated with the exact law (:mod:`mbla.solution.exact_law`), and from there on again until
   forces and velocities fit it to 1e-9. Far from the end Newton's method fails and the proximal steps go on.

It starts from the dead load, not from the associative forces: coming down from those, a sequence stays on states in
which joints are locked by forces that nothing but dilatancy would bring about. The load factor is not unique even so.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.static import StaticForm, gravity_form, proximal_data, proximal_form
from mbla.solution.associative import AssociativeResult
from mbla.solution.clarabel_adapter import ClarabelProgram, ConeSolution, Log
from mbla.solution.exact_law import exact_step
from mbla.solution.law_state import LawState, SequenceResult, law_state
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status

STEP = 0.01
"""ε: size of a proximal step relative to the gravity state; 0.003 to 0.03 gave the same."""

MOVE = 0.7
"""Share of each step that the anchor moves."""

FIRST_TRY, TRY_EVERY = 4, 3
"""Newton's method is tried at the fourth step and every third after it."""

NEAR = 0.2
"""Residual below which it is tried at all."""

EXACT_STEPS = 12
"""Steps of the exact law in one try."""

EXACT = 1e-9
"""Residual at which a state counts as one of the exact law."""

ACCEPTED = 1e-4
"""Residual that still counts as solved where Newton's method did not get there."""

QUIET = 1e-8
"""Tolerance of the proximal programs: velocities are divided by ρ, and 1e-6 leaves Newton's method nowhere to start."""


@dataclass
class _Run:
    """What the sequence has so far."""

    program: Program
    records: list[ProgramRecord]
    best: LawState | None = None

    def keep(self, state: LawState) -> None:
        """Remember the state that fits the law best."""
        if self.best is None or state.residual < self.best.residual:
            self.best = state


def solve_proximal(
    program: Program, associative: AssociativeResult, max_programs: int, settings: SolverSettings, log: Log
) -> SequenceResult:
    """Run the scheme; the associative result only gives the records it continues."""
    run = _Run(program, list(associative.programs))
    settings = replace(settings, tolerance=min(settings.tolerance, QUIET))
    anchor = _gravity_state(run, settings, log)
    if isinstance(anchor, SequenceResult):
        return anchor
    rho = STEP / max(float((anchor**2).sum()), 1e-300)
    form = proximal_form(program, rho)
    solver = ClarabelProgram(form.cone_program, settings, log)
    for step in range(1, max_programs + 1):
        limit = np.maximum(program.limits.friction * anchor[:, 0] + program.limits.cohesion, 0.0)
        cost, rhs = proximal_data(form, rho, anchor, limit)
        solver.update(cost=cost, rhs=rhs)
        solution = solver.solve(len(run.records) + 1, -program.scaling.live)
        if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
            return _broken_off(run, solution)
        state = _state_of(form, solution)
        run.keep(state)
        _record(run, "proximal", solution, state)
        if step >= FIRST_TRY and (step - FIRST_TRY) % TRY_EVERY == 0 and state.residual < NEAR:
            exact = _exact_state(run, anchor, rho, state)
            if exact is not None:
                return SequenceResult(Status.SOLVED, exact, "", tuple(run.records))
        anchor = MOVE * state.forces + (1.0 - MOVE) * anchor
    assert run.best is not None  # there is at least one step
    status = Status.SOLVED if run.best.residual <= ACCEPTED else Status.APPROXIMATE
    reason = (
        f"the proximal steps did not come to rest in {max_programs} programs: "
        f"forces and velocities miss the law by {run.best.residual:.2g}"
    )
    return SequenceResult(status, run.best, reason, tuple(run.records))


def _gravity_state(run: _Run, settings: SolverSettings, log: Log) -> FloatArray | SequenceResult:
    """Forces of the gravity state, (n_points, components), or how the scheme ends where there is none."""
    form = gravity_form(run.program)
    solution = ClarabelProgram(form.cone_program, settings, log).solve(len(run.records) + 1, 0.0)
    _record(run, "gravity", solution, None)
    if solution.status in (Status.SOLVED, Status.APPROXIMATE):
        return form.forces(solution.x)
    return _broken_off(run, solution)


def _state_of(form: StaticForm, solution: ConeSolution) -> LawState:
    velocities = form.velocities(solution.z)
    return law_state(form.program, 0.0, form.forces(solution.x), velocities, form.load_factor(solution.x))


def _exact_state(run: _Run, anchor: FloatArray, rho: float, state: LawState) -> LawState | None:
    """Steps of the exact law from the anchor of a proximal step, until one fits it; None where they do not."""
    started = time.perf_counter()
    velocities, factor, count, exact = state.velocities, state.load_factor, 0, None
    for _ in range(EXACT_STEPS):
        step = exact_step(run.program, anchor, rho, velocities, factor)
        count += step.factorizations
        if step.residual > EXACT:
            break
        velocities, factor, anchor = step.velocities, step.load_factor, step.forces
        exact = law_state(run.program, 0.0, step.forces, velocities, factor)
        run.keep(exact)
        if exact.residual <= EXACT:
            break
    fits = exact is not None and exact.residual <= EXACT
    value = run.program.scaling.load_factor(factor)
    status = Status.SOLVED if fits else Status.APPROXIMATE
    seconds = time.perf_counter() - started
    run.records.append(ProgramRecord(len(run.records) + 1, "exact law", status, value, np.nan, count, seconds))
    return exact if fits else None


def _record(run: _Run, kind: str, solution: ConeSolution, state: LawState | None) -> None:
    value = np.nan if state is None else run.program.scaling.load_factor(state.load_factor)
    before = [record.load_factor for record in run.records if record.kind == kind]
    change = abs(value - before[-1]) / max(abs(value), 1e-300) if before and state is not None else np.nan
    number = len(run.records) + 1
    run.records.append(
        ProgramRecord(number, kind, solution.status, value, change, solution.iterations, solution.seconds)
    )


def _broken_off(run: _Run, solution: ConeSolution) -> SequenceResult:
    status = solution.status
    if status in (Status.NO_EQUILIBRIUM, Status.UNBOUNDED):  # said of a program of the scheme, not of the structure
        status = Status.NOT_VERIFIED
    reason = (
        f"program {len(run.records) + 1} of the sequence ended without a solution (clarabel: {solution.solver_status})"
    )
    return SequenceResult(status, run.best, reason, tuple(run.records))
