"""The associative load factor: one cone program, and one more to see whether the dead load is carried at all.

With associative flow the static and the kinematic theorem hold, so that the optimum is unique. The load factors under
which the structure is in equilibrium form an interval; the second program finds its lower end. If zero is not in the
interval the dead load alone is not carried, and the mechanism of the violated end shows how it falls.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.kinematic import KinematicForm, kinematic_form
from mbla.program.program import Program
from mbla.solution.clarabel_adapter import ClarabelProgram, ConeSolution, Log
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


def solve_associative(program: Program, settings: SolverSettings, log: Log) -> AssociativeResult:
    """Solve the program of one load case with associative flow."""
    return solve_associative_form(kinematic_form(program, program.limits), program, settings, log)


def solve_associative_form(
    form: KinematicForm, program: Program, settings: SolverSettings, log: Log
) -> AssociativeResult:
    """The same for a kinematic form that may have more unknowns than the program whose loads and units it has."""
    solver = ClarabelProgram(form.cone_program, settings, log)
    forward = solver.solve(1, program.scaling.live)
    records = [_record(program, 1, "associative", forward)]
    if forward.status not in (Status.SOLVED, Status.APPROXIMATE, Status.UNBOUNDED, Status.NO_EQUILIBRIUM):
        return AssociativeResult(forward.status, None, None, _words_of(forward), tuple(records))
    if forward.status is Status.NO_EQUILIBRIUM:
        return _no_equilibrium(form, forward.x, records)
    if forward.status in WITH_VALUE and _negative(program, forward.objective):
        return _no_equilibrium(form, forward.x, records)

    solver.update(rhs=-form.cone_program.rhs)
    reverse = solver.solve(2, -program.scaling.live)
    records.append(_record(program, 2, "reverse", reverse, sign=-1.0))
    if reverse.status is Status.NO_EQUILIBRIUM or (
        reverse.status in WITH_VALUE and _negative(program, reverse.objective)
    ):
        return _no_equilibrium(form, reverse.x, records)
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


def _state(form: KinematicForm, solution: ConeSolution) -> LawState:
    program, velocities = form.program, form.velocities(solution.x)
    forces = form.contact_forces(solution.z)
    return law_state(program, program.limits.friction, forces, velocities, solution.objective)


def _no_equilibrium(form: KinematicForm, x: FloatArray, records: list[ProgramRecord]) -> AssociativeResult:
    """The mechanism that proves it: compatible, and the dead load does more work than the joints dissipate."""
    certificate = form.velocities(x)
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
    }.get(solution.status, str(solution.status)) + f" (clarabel: {solution.solver_status})"
