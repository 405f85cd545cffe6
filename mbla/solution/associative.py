"""The associative load factor: one cone program, and one more to see whether the dead load is carried at all.

With associative flow the static and the kinematic theorem hold, so that the optimum is unique. The load factors under
which the structure is in equilibrium form an interval; the second program finds its lower end. If zero is not in the
interval the dead load alone is not carried, and the mechanism of the violated end shows how it falls.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative_form import AssociativeForm, in_velocities
from mbla.solution.cone_solution import ConeSolution, Log
from mbla.solution.cone_solver import cone_solver
from mbla.solution.law_state import LawState, law_state
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status

STANDS_MARGIN = 1e-7
"""A load factor is taken as negative only beyond this share of (dead load over live load): below it is solver noise."""

WITH_VALUE = (Status.SOLVED, Status.APPROXIMATE)


@dataclass(frozen=True)
class AssociativeResult:
    """What the associative program says: a state with a load factor, a certificate without equilibrium.

    certificate : (n_rows,) velocities, non-dimensional, of a motion in which the dead load does more work than the
                  joints dissipate
    """

    status: Status
    state: LawState | None
    certificate: FloatArray | None
    reason: str
    programs: tuple[ProgramRecord, ...]


def solve_associative(
    program: Program, settings: SolverSettings, log: Log, *, form: AssociativeForm | None = None, first: int = 1
) -> AssociativeResult:
    """Solve the program of one load case with associative flow.

    form  : kinematic with the friction cone, unless another is given (:mod:`mbla.solution.associative_form`)
    first : number of its first program in the sequence of the load case
    """
    form = form or in_velocities(program)
    settings = replace(settings, tolerance=form.tolerance(settings.tolerance))
    solver = cone_solver(form.cone_program, settings, log)
    forward = form.read(solver.solve(first, form.sign * program.scaling.live))
    records = [_record(program, first, "associative", forward)]
    if forward.status not in (Status.SOLVED, Status.APPROXIMATE, Status.UNBOUNDED, Status.NO_EQUILIBRIUM):
        return AssociativeResult(forward.status, None, None, _words_of(forward), tuple(records))
    if forward.status is Status.NO_EQUILIBRIUM:
        return _no_equilibrium(form, forward, records)
    if forward.status in WITH_VALUE and _negative(program, forward.objective):
        return _no_equilibrium(form, forward, records)

    solver.update(**form.reverse)
    reverse = form.read(solver.solve(first + 1, -form.sign * program.scaling.live))
    records.append(_record(program, first + 1, "reverse", reverse, sign=-1.0))
    if reverse.status is Status.NO_EQUILIBRIUM or (
        reverse.status in WITH_VALUE and _negative(program, reverse.objective)
    ):
        return _no_equilibrium(form, reverse, records)
    if reverse.status not in (Status.SOLVED, Status.APPROXIMATE, Status.UNBOUNDED):
        reason = "whether the dead load alone is carried could not be decided: " + _words_of(reverse)
        return AssociativeResult(reverse.status, None, None, reason, tuple(records))
    if forward.status is Status.UNBOUNDED:
        reason = "no mechanism exists in which the live load does work: friction locks the structure under any multiple"
        return AssociativeResult(Status.UNBOUNDED, None, None, reason, tuple(records))
    almost = next((solution for solution in (forward, reverse) if solution.status is Status.APPROXIMATE), None)
    reason = "" if almost is None else _words_of(almost)
    status = Status.SOLVED if almost is None else Status.APPROXIMATE
    return AssociativeResult(status, _state(form, forward), None, reason, tuple(records))


def _negative(program: Program, objective: float) -> bool:
    """Whether the optimum says that equilibrium needs a live load of the other sign."""
    dead_over_live = float(np.linalg.norm(program.dead_load) / np.linalg.norm(program.live_load))
    return objective < -STANDS_MARGIN * dead_over_live


def _state(form: AssociativeForm, solution: ConeSolution) -> LawState:
    program = form.program
    forces, velocities = form.forces(solution), form.velocities(solution)
    return law_state(program, program.limits.friction, forces, velocities, solution.objective)


def _no_equilibrium(form: AssociativeForm, solution: ConeSolution, records: list[ProgramRecord]) -> AssociativeResult:
    """The mechanism that proves it: compatible, and the dead load does more work than the joints dissipate."""
    certificate = form.velocities(solution)
    reason = (
        "the dead load alone is not carried: a mechanism exists in which it does more work than the joints dissipate"
    )
    return AssociativeResult(Status.NO_EQUILIBRIUM, None, certificate, reason, tuple(records))


def _record(program: Program, number: int, kind: str, solution: ConeSolution, sign: float = 1.0) -> ProgramRecord:
    solved = solution.status in (Status.SOLVED, Status.APPROXIMATE)
    return ProgramRecord(
        program=number,
        kind=kind,
        status=solution.status,
        load_factor=sign * program.scaling.load_factor(solution.objective) if solved else np.nan,
        change=np.nan,
        iterations=solution.iterations,
        seconds=solution.seconds,
    )


def _words_of(solution: ConeSolution) -> str:
    return {
        Status.APPROXIMATE: "the solver ended short of its tolerance",
        Status.ITERATION_LIMIT: "the solver reached its limit of iterations",
        Status.TIME_LIMIT: "the time limit was reached",
        Status.NUMERICAL_ERROR: "the solver broke down numerically",
    }.get(solution.status, str(solution.status)) + f" ({solution.verdict})"
