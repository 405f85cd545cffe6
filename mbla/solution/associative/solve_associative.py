"""The associative load factor: a cone program, solved until proved bounds meet, and a proof that the dead load stands.

With associative flow the static and the kinematic theorem hold, so that the optimum is unique. The solution of the
solver is not trusted but repaired (``bounds``): forces that balance the loads prove the load factor from below,
compatible velocities from above (:mod:`mbla.solution.associative.proved_solution`).

The load factors under which the structure is in equilibrium form an interval. The dead load alone is carried if this
interval contains zero. Where standing is assessed (``standing``), its forces, repaired, prove that. Otherwise a second
program looks for the lower end of the interval, with the live load reversed. If zero is not in the interval, a
mechanism shows how the structure falls.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.solution.associative.associative_form import AssociativeForm, associative_form
from mbla.solution.associative.proved_solution import (
    STANDS_MARGIN,
    AssociativeRun,
    ProvedSolution,
    proved_certificate,
    proved_solution,
    says_it_falls,
    solved_once,
    take_in_exceeded,
)
from mbla.solution.associative.taken_conditions import TakenConditions
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.nonassociative.collapse_state import CollapseState, collapse_state
from mbla.solution.proof.bounds import falling_motion
from mbla.solution.proof.static_repair import repaired_forces
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.standing.standing import StressFree, StressFreeStates, stress_free_state
from mbla.solution.thresholds import GAP_TOLERANCE

LOCKED = "no mechanism exists in which the live load does work: friction locks the structure under any multiple"


@dataclass(frozen=True)
class AssociativeResult:
    """Answer of the associative program: a state with a load factor, a certificate without equilibrium.

    certificate : velocities, non-dimensional, of a motion in which the dead load does more work than the joints
                  dissipate: (n_rows,) of the blocks, unknowns of conditions on interfaces behind
    solver      : that the state comes from, empty without one: the program may have been solved by several
    tolerance_requested : approximate: the distance of the bounds that was asked for, and reached; None where it was not
    gap_words   : approximate for no other reason than that the bounds are apart: how far, in words; else empty
    stress_free : what the dead load does to the stress-free assembly, None where that was not examined
    below       : forces, (n_points, components), and a load factor of zero or below that they carry; None where none
                  were needed
    lock        : unbounded with conditions on interfaces: forces that balance the live load alone, for a load factor of
                  1; None where none were found
    """

    status: Status
    state: CollapseState | None
    certificate: FloatArray | None
    reason: str
    programs: tuple[ProgramRecord, ...]
    solver: str = ""
    tolerance_requested: float | None = None
    gap_words: str = ""
    stress_free: StressFree | None = field(default=None, repr=False)
    below: tuple[FloatArray, float] | None = field(default=None, repr=False)
    lock: FloatArray | None = field(default=None, repr=False)


def solve_associative(
    program: Program,
    settings: SolverSettings,
    log: Log,
    *,
    first: int = 1,
    stress_free: bool = False,
    carried: bool = False,
    states: StressFreeStates | None = None,
) -> AssociativeResult:
    """Solve the program of one load case with associative flow.

    first       : number of its first program in the sequence of the load case
    stress_free : the state of the stress-free assembly is wanted as well: it is found before the program with the live
                  load reversed, which it usually saves
    carried     : the dead load alone is known to be carried
    states      : of stress-free assemblies that are known, to which that of this one is added
    """
    settings.proof.validate()
    run = AssociativeRun(TakenConditions.least(program), settings, log, first, [])
    falling = _fall_of_what_nothing_touches(program)
    if falling.any():
        return _no_equilibrium(run, run.conditions.of_blocks(falling))
    answer = proved_solution(run)
    if answer.certificate is not None:
        return _no_equilibrium(run, answer.certificate)
    if answer.gap is None and answer.solution.status is not Status.UNBOUNDED:
        return _undecided(run, answer.solution)
    if carried:
        return _with_dead_load(run, answer, proved=True)
    if not stress_free or settings.deadline is not None:
        # where a support settles, forces at any load factor carry the dead load, with another reaction
        shown = program.facts.settling_support and answer.gap is not None and np.isfinite(answer.gap.static)
        return _with_dead_load(run, answer, proved=bool(shown))
    state = stress_free_state(program, states)
    below = None if program.conditions is None else _carried_at_rest(run, state)
    result = _with_dead_load(run, answer, proved=below is not None or _proves(run, state))
    return replace(result, stress_free=state, below=result.below or below)


def _carried_at_rest(run: AssociativeRun, state: StressFree) -> tuple[FloatArray, float] | None:
    """Forces on the stress-free assembly that carry the dead load alone within all conditions on interfaces."""
    if state.rest is None or run.program.facts.settling_support:
        return None
    points = replace(run.program, conditions=None).without_live_load()
    repaired = repaired_forces(points, state.rest.forces, 0.0)
    return (repaired[0], 0.0) if repaired is not None and run.conditions.keep(repaired[0]) else None


def _proves(run: AssociativeRun, state: StressFree) -> bool:
    """Whether the forces on the stress-free assembly, without springs, prove that the dead load alone is carried."""
    if state.rest is None:
        return False
    if run.conditions.whole.conditions is not None:  # which these forces need not fulfil
        return False
    if run.program.facts.settling_support:  # with the reaction that it has while it is held
        return _carrying(run, state.rest.forces, state.rest.load_factor) is not None
    forces, alone = state.rest.forces, run.program.without_live_load()
    return repaired_forces(alone, forces, 0.0) is not None or _carrying(run, forces, 0.0) is not None


def _with_dead_load(run: AssociativeRun, answer: ProvedSolution, *, proved: bool) -> AssociativeResult:
    """The result, once it is known that the dead load alone is carried.

    proved : it is known already
    """
    reverse, carried, below = answer.solution, proved or not run.program.dead_load.any(), None
    if not carried:
        form, reverse, below = _reversed(run, answer)
        carried = below is not None
    if not carried:
        certificate = proved_certificate(run, form, reverse)
        if certificate is not None:
            return _no_equilibrium(run, run.conditions.of_whole(certificate))
        if says_it_falls(run, reverse):
            return _undecided(run, reverse)
        if reverse.status not in (*WITH_VALUE, Status.UNBOUNDED):
            reason = "whether the dead load alone is carried could not be decided: " + reverse.shortfall
            return _without_state(run, reverse.status, reason)
    if answer.solution.status is Status.UNBOUNDED and reverse.status is Status.UNBOUNDED and not proved:
        locked = _locked_both_ways(run, run.settings)
        return locked if locked.status is not Status.UNBOUNDED else replace(locked, lock=_lock(run, answer))
    if answer.solution.status is Status.UNBOUNDED:
        return replace(_without_state(run, Status.UNBOUNDED, LOCKED), lock=_lock(run, answer))
    return replace(_with_load_factor(run, answer), below=below)


def _reversed(
    run: AssociativeRun, answer: ProvedSolution
) -> tuple[AssociativeForm, ConeSolution, tuple[FloatArray, float] | None]:
    """The program with the live load reversed, its solution, and ``_carried`` of it within all conditions."""
    settings, form = run.settings, answer.form
    if settings.solver == "auto":
        settings = replace(settings, solver=answer.solution.solver)
    if not run.conditions.are_all:
        form, solution = take_in_exceeded(run, -1.0)
        below = _carried(run, form, solution)
        if below is not None and run.conditions.with_exceeded(below[0]) is None:
            return form, solution, below
    while True:
        solution = solved_once(run, cone_solver(form.reversed_program, settings, run.log), "reverse", -1.0)
        below, more = None, None
        if solution.status is Status.UNBOUNDED and not run.conditions.are_all:
            more = run.conditions.with_all()
        elif solution.status in WITH_VALUE:
            more = run.conditions.with_exceeded(form.forces(solution))
        if more is None:
            below = _carried(run, form, solution)
            more = None if below is None else run.conditions.with_exceeded(below[0])
        if more is None:
            return form, solution, below
        run.conditions = more
        form = associative_form(run.program)


def _lock(run: AssociativeRun, answer: ProvedSolution) -> FloatArray | None:
    """Forces of the ray that proves that there is no mechanism, with conditions on interfaces; None without."""
    if run.program.conditions is None:
        return None
    alone = replace(run.program, dead_load=np.zeros_like(run.program.dead_load))
    form, ray = answer.form, answer.solution
    repaired = repaired_forces(alone, form.forces(ray), form.load_factor(ray), form.slacks(ray))
    return None if repaired is None or not repaired[1] > 0.0 else repaired[0] / repaired[1]


def _locked_both_ways(run: AssociativeRun, settings: SolverSettings) -> AssociativeResult:
    """No mechanism in which the live load does work, of either sign: that decides nothing on the dead load."""
    form = gravity_form(run.program)
    solution = cone_solver(form.cone_program, settings, run.log).solve(run.first + len(run.records), 0.0)
    status, number = solution.status, run.first + len(run.records)
    run.records.append(solution.record(number, "gravity", np.nan))
    if status in WITH_VALUE:
        return _without_state(run, Status.UNBOUNDED, LOCKED)
    motion = run.conditions.of_blocks(form.velocities(solution.z))
    certificate = falling_motion(run.program, -motion)
    if certificate is None:
        certificate = falling_motion(run.program, motion)
    return _undecided(run, solution) if certificate is None else _no_equilibrium(run, certificate)


def _with_load_factor(run: AssociativeRun, answer: ProvedSolution) -> AssociativeResult:
    gap, status, reason, asked = answer.gap, Status.SOLVED, "", None
    assert gap is not None
    if not gap.gap <= GAP_TOLERANCE:
        live = run.program.scaling.live
        status = Status.APPROXIMATE
        asked = run.settings.gap if gap.gap <= run.settings.gap else None
        apart = f"they could not be brought together ({answer.solution.verdict})"
        if asked is not None:
            apart = f"that is within the gap of {asked:g} that was asked for"
        reason = (
            f"forces prove a load factor of {gap.static * live:.8g}, velocities one of {gap.kinematic * live:.8g}: "
            f"{apart}"
        )
    program = run.conditions.whole
    conditions = program.conditions
    if conditions is None:
        state = collapse_state(program, program.limits.friction, gap.forces, gap.velocities, gap.load_factor)
    else:
        blocks, unknowns = np.split(gap.velocities, [len(program.dead_load)])
        state = CollapseState(gap.forces, blocks, gap.load_factor, np.nan, conditions.moved(unknowns))
    solver = answer.solution.solver.lower()
    return AssociativeResult(status, state, None, reason, tuple(run.records), solver, asked, reason)


def _carried(run: AssociativeRun, form: AssociativeForm, reverse: ConeSolution) -> tuple[FloatArray, float] | None:
    """Forces that prove that there is equilibrium at a load factor of zero or below, and that; None without."""
    forces, factor = form.forces(reverse), form.load_factor(reverse)
    if not np.isfinite(forces).all() or not np.isfinite(factor):
        return None
    return _carrying(run, forces, factor, form.slacks(reverse))


def _carrying(
    run: AssociativeRun, forces: FloatArray, factor: float, slacks: FloatArray | None = None
) -> tuple[FloatArray, float] | None:
    """Forces in balance with about that load factor repaired to carry one of zero or below; None where they do not."""
    repaired = repaired_forces(run.program, forces, factor, slacks)
    return repaired if repaired is not None and repaired[1] <= STANDS_MARGIN * run.size else None


def _fall_of_what_nothing_touches(program: Program) -> FloatArray:
    """Velocities along the dead load where no contact resists, (n_rows,): no solver is needed for them."""
    untouched = np.diff(program.equilibrium_matrix.indptr) == 0
    return np.where(untouched, program.dead_load, 0.0)


def _without_state(run: AssociativeRun, status: Status, reason: str) -> AssociativeResult:
    return AssociativeResult(status, None, None, reason, tuple(run.records))


def _no_equilibrium(run: AssociativeRun, certificate: FloatArray) -> AssociativeResult:
    """The mechanism that proves it: compatible, and the dead load does more work than the joints dissipate."""
    reason = (
        "the dead load alone is not carried: a mechanism exists in which it does more work than the joints dissipate"
    )
    return AssociativeResult(Status.NO_EQUILIBRIUM, None, certificate, reason, tuple(run.records))


def _undecided(run: AssociativeRun, solution: ConeSolution) -> AssociativeResult:
    """No settings gave an answer; a lack of equilibrium that could not be proved does not count."""
    if solution.status in (Status.TIME_LIMIT, Status.ITERATION_LIMIT):
        return _without_state(run, solution.status, solution.shortfall)
    reason = (
        "whether there is equilibrium could not be decided: the structure is within rounding of falling under its "
        f"dead load, or too ill-conditioned ({solution.verdict})"
    )
    return _without_state(run, Status.NOT_VERIFIED, reason)
