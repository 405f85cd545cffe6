"""A load factor proved from both sides: by one interior-point method, and where that leaves it open by the other.

The solution of a method is repaired (``bounds``): forces that balance the loads prove the load factor from below,
compatible velocities from above. Where the bounds lie too far apart, the other method solves the program again in units
of the first solution, as a method has one tolerance for all equations: the equilibrium of each block in units of the
force that it carries, the live power in units of the load factor. Very large friction is reduced there: its cones lie
within the true ones. Last, the first method solves the program at its smallest tolerance, which is sharpest for a stack
at its greatest overhang. If the bounds are still apart, the load factor is approximate.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative.associative_form import AssociativeForm, associative_form, in_own_units
from mbla.solution.associative.taken_conditions import TakenConditions
from mbla.solution.cone_solvers.choice import cone_solver, other_method
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.proof.bounds import ProvedBounds, factor_size, falling_motion, proved_bounds
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.thresholds import GAP_TOLERANCE

STANDS_MARGIN = 1e-7
"""A load factor is taken as negative only beyond this share of (dead load over live load): below it is solver noise."""


@dataclass
class AssociativeRun:
    """What every step needs, and the programs solved so far.

    conditions : on interfaces, as far as they are taken in
    first      : number of the first program in the sequence of the load case
    exceeded   : conditions with those that forces found for a proof need besides; None where they keep within all
    """

    conditions: TakenConditions
    settings: SolverSettings
    log: Log
    first: int
    records: list[ProgramRecord]
    exceeded: TakenConditions | None = None

    @property
    def program(self) -> Program:
        """With the conditions that are taken in."""
        return self.conditions.program

    @property
    def size(self) -> float:
        """Of load factors."""
        return factor_size(self.program)


@dataclass(frozen=True)
class ProvedSolution:
    """What the solver returned, and what of it could be proved.

    form        : what was solved
    gap         : bounds of the load factor, where there is one
    certificate : compatible velocities in which the dead load does work, where there is no equilibrium
    """

    solution: ConeSolution
    form: AssociativeForm
    gap: ProvedBounds | None = None
    certificate: FloatArray | None = None

    @property
    def distance(self) -> float:
        """Of the bounds, infinite where there are none."""
        return float("inf") if self.gap is None or not self.gap.gap >= 0.0 else self.gap.gap


def proved_solution(run: AssociativeRun) -> ProvedSolution:
    """The proved solution of the program with all conditions, of which only those that its forces exceed are taken in.

    Its velocities are those of the program with all conditions; its form has the conditions that were taken in.
    """
    if not run.conditions.are_all:
        take_in_exceeded(run, 1.0)
    while True:
        run.exceeded = None
        answer = solve_until_proved(run, *_first_solution(run))
        more = run.exceeded
        if answer.gap is None and not run.conditions.are_all:
            more = run.conditions.with_all()
        closed = answer.certificate is not None or answer.solution.status is Status.TIME_LIMIT
        if more is None or closed or (answer.gap is not None and is_decided(run, answer)):
            return _of_whole(run, answer)
        run.conditions = more


def take_in_exceeded(run: AssociativeRun, sense: float) -> tuple[AssociativeForm, ConeSolution]:
    """Take in what rough forces exceed until they exceed nothing; the form and its rough solution then.

    sense : of the live load
    """
    rough = replace(run.settings, tolerance=max(run.settings.tolerance, run.settings.proof.rough_tolerance))
    return _within_all(run, rough, sense, lambda solution: solution.status in WITH_VALUE)


def _first_solution(run: AssociativeRun) -> tuple[AssociativeForm, ConeSolution]:
    """Of the program whose forces keep within all conditions."""

    def has_forces(solution: ConeSolution) -> bool:
        return solution.status in WITH_VALUE and not says_it_falls(run, solution)

    return _within_all(run, run.settings, 1.0, has_forces)


def _within_all(
    run: AssociativeRun, settings: SolverSettings, sense: float, has_forces: Callable[[ConeSolution], bool]
) -> tuple[AssociativeForm, ConeSolution]:
    """The form and its solution once its forces, where it has some that count, exceed no condition."""
    kind = "associative" if sense > 0.0 else "reverse"
    while True:
        form = associative_form(run.program)
        program = form.cone_program if sense > 0.0 else form.reversed_program
        solution = solved_once(run, cone_solver(program, settings, run.log), kind, sense)
        more = run.conditions.with_exceeded(form.forces(solution)) if has_forces(solution) else None
        if more is None:
            return form, solution
        run.conditions = more


def _of_whole(run: AssociativeRun, answer: ProvedSolution) -> ProvedSolution:
    gap, certificate, of_whole = answer.gap, answer.certificate, run.conditions.of_whole
    return replace(
        answer,
        gap=None if gap is None else replace(gap, velocities=of_whole(gap.velocities)),
        certificate=None if certificate is None else of_whole(certificate),
    )


def solve_until_proved(run: AssociativeRun, form: AssociativeForm, solution: ConeSolution) -> ProvedSolution:
    """What one method proves; where that leaves it open the other, then the first as sharply as it can.

    solution : of the form, by the first method
    """
    proof = run.settings.proof
    first = best = _with_proof(run, form, solution)
    sharpest = replace(run.settings, tolerance=min(run.settings.tolerance, proof.sharpest))
    other = replace(run.settings, tolerance=max(proof.sharper * run.settings.tolerance, proof.sharpest))
    if run.settings.solver == "auto":
        own = first.solution.solver
        sharpest, other = replace(sharpest, solver=own), replace(other, solver=other_method(own))
    # of strengths beyond numbers one method may say that they bear everything
    unsure = run.program.conditions is not None and best.solution.status is Status.UNBOUNDED
    tried = set[float]()
    for power in proof.powers:
        unit = _size(run, best) ** power
        if unit not in tried and (unsure or _is_open(run, best)):
            best = better(best, _answer(run, _in_units_of(run, first) or form, unit, other))
            unsure = False
        tried.add(unit)
    if _is_open(run, best):
        best = better(best, _answer(run, form, 1.0, sharpest))
    return best


def _is_open(run: AssociativeRun, best: ProvedSolution) -> bool:
    """Whether another program is wanted, and allowed."""
    return not is_decided(run, best) and best.solution.status is not Status.TIME_LIMIT


def _in_units_of(run: AssociativeRun, found: ProvedSolution) -> AssociativeForm | None:
    """The program in units of what was found, within less friction; None where it would be the same."""
    limits, most = run.program.limits, run.settings.proof.rough
    rough = bool((limits.friction > most).any())
    less = replace(limits, friction=np.minimum(limits.friction, most))
    program = replace(run.program, limits=less) if rough else run.program
    own = None if found.gap is None else in_own_units(program, found.gap.forces)
    if own is None and not rough:
        return None
    return replace(own or associative_form(program), program=run.program)  # what is proved holds of the true friction


def _answer(run: AssociativeRun, form: AssociativeForm, unit: float, settings: SolverSettings) -> ProvedSolution:
    """The program in the given unit of the load factor, and what of its solution can be proved."""
    solver = cone_solver(form.cone_program if unit == 1.0 else form.in_units(unit), settings, run.log)
    solution = solved_once(run, solver, "associative", unit)
    if unit != 1.0:
        solution = replace(solution, x=solution.x * unit, objective=solution.objective * unit)
    return _with_proof(run, form, solution)


def _with_proof(run: AssociativeRun, form: AssociativeForm, solution: ConeSolution) -> ProvedSolution:
    """A solution with its proved bounds, or with a certificate that there is no equilibrium."""
    if solution.status in (Status.TIME_LIMIT, Status.ITERATION_LIMIT, Status.UNBOUNDED):
        return ProvedSolution(solution, form)
    certificate = proved_certificate(run, form, solution)
    has_value = certificate is None and solution.status in WITH_VALUE and not says_it_falls(run, solution)
    return ProvedSolution(solution, form, _proved(run, form, solution) if has_value else None, certificate)


def is_decided(run: AssociativeRun, answer: ProvedSolution) -> bool:
    """Whether it is proved as sharply as asked for, a small load factor relatively too."""
    if answer.certificate is not None or answer.solution.status is Status.UNBOUNDED:
        return True
    if answer.gap is None or not answer.gap.gap <= run.settings.gap:
        return False
    share = max(GAP_TOLERANCE, run.settings.gap)
    return abs(answer.gap.kinematic - answer.gap.static) <= share * abs(answer.gap.kinematic)


def better(first: ProvedSolution, second: ProvedSolution) -> ProvedSolution:
    """The answer with the stronger proof, the earlier one of equals; with conditions on interfaces both bounds count.

    Of such programs one method has the closer forces, the other the closer velocities.
    """
    if first.gap is not None and second.gap is not None and first.gap.of_interfaces:
        first, second = (replace(one, gap=first.gap.with_bounds_of(second.gap)) for one in (first, second))

    def weakness(answer: ProvedSolution) -> tuple[int, float]:
        if answer.certificate is not None or answer.gap is not None:
            return 0 if answer.certificate is not None else 1, answer.distance
        return 2 if answer.solution.status is Status.UNBOUNDED else 3, answer.distance

    return min(first, second, key=weakness)


def proved_certificate(run: AssociativeRun, form: AssociativeForm, solution: ConeSolution) -> FloatArray | None:
    """Velocities, (n_rows,), that prove that the dead load alone is not carried; None where the solution has none."""
    if solution.status in WITH_VALUE and not solution.objective < 0.0:
        return None
    motion = form.velocities(solution)
    return falling_motion(run.program, motion) if np.isfinite(motion).all() else None


def solved_once(run: AssociativeRun, solver: ConeSolver, kind: str, unit: float) -> ConeSolution:
    """Solve the loaded program once and record it; ``unit`` times the objective is the load factor of the program."""
    number, to_load_factor = run.first + len(run.records), unit * run.program.scaling.live
    solution = solver.solve_once(number, to_load_factor)
    value = to_load_factor * solution.objective if solution.status in WITH_VALUE else np.nan
    run.records.append(solution.record(number, kind, value))
    return solution


def says_it_falls(run: AssociativeRun, solution: ConeSolution) -> bool:
    """Whether a program, of either sign of the live load, shows that there is no equilibrium without live load."""
    if not run.program.dead_load.any():  # no forces balance no load
        return False
    negative = solution.objective < -STANDS_MARGIN * run.size
    return solution.status is Status.NO_EQUILIBRIUM or (solution.status in WITH_VALUE and negative)


def _proved(run: AssociativeRun, form: AssociativeForm, solution: ConeSolution) -> ProvedBounds:
    """Bounds that a solution proves; none by forces that exceed conditions that are not taken in."""
    state = CollapseState(form.forces(solution), form.velocities(solution), form.load_factor(solution), np.nan)
    gap = proved_bounds(form.program, state, form.slacks(solution))
    more = run.conditions.with_exceeded(gap.forces)
    if more is None:
        return gap
    run.exceeded = more
    return replace(gap, static=np.nan, gap=np.nan)


def _size(run: AssociativeRun, answer: ProvedSolution) -> float:
    """Size of the load factor: 1, or its own where that is small."""
    proof, size, value = run.settings.proof, run.size, abs(answer.solution.objective)
    if answer.gap is None or value > proof.small * size:
        return 1.0
    return value if value > proof.noise * size else proof.zero_size * size
