"""A load factor proved from both sides: the associative program solved again until its bounds meet.

What the solver returns is repaired (``bounds``): forces that balance the loads prove the factor from
below, compatible velocities from above. Where the two lie too far apart the program is solved by the other
interior-point method, then with a sharper tolerance, in units of the load factor where that is small, since the
solver's tolerance is absolute there, and with the equilibrium of light blocks in units of what they carry.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import product

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative.associative_form import AssociativeForm, in_own_units
from mbla.solution.associative.bounds import CertifiedGap, certified_gap, factor_size, falling_motion
from mbla.solution.cone_solvers.choice import cone_solver, other_method, sharpen
from mbla.solution.cone_solvers.clarabel_adapter import regularization
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.thresholds import GAP_TOLERANCE

STANDS_MARGIN = 1e-7
"""A load factor is taken as negative only beyond this share of (dead load over live load): below it is solver noise."""

SMALL = 1e-3
"""Share of dead over live load below which a load factor is computed again in units of its own size."""

NOISE = 1e-10
"""Share below which its size is not known from the solver, and the unit is the next one."""

ZERO_SIZE = 1e-7
"""Size, as a share, that is taken for a load factor of zero."""

SHARPER = ((0.0, 1e-2, None), (1.0, 1e-2, None), (0.5, 1e-4, 1e-8), (0.0, 1e-4, 1e-9))
"""How a program is solved again, in turn: power of the load factor's size that is its unit, factor on the solver's
tolerance, regularisation. An arch at its least thickness is sharpest in units of its own size, which is too much for a
stack at its greatest overhang: half-way, or the unit of dead loads, does better there."""

FURTHER = 0.1
"""Factor on the tolerance with which a solved program continues where its bounds are too far apart: a few iterations
each time. On a planar wall of 10,050 blocks the bounds met after 6 more of them; solving again took 80 by either
method."""

WORTHWHILE = 0.5
"""Share of the distance of the bounds that may be left for the program to continue once more."""

SHARPEST = 1e-12
"""Least tolerance of the solver."""

ACCEPTED_GAP = GAP_TOLERANCE
"""Distance of the bounds, relative, up to which a load factor counts as solved."""

LARGE = 30_000
"""Rows of equilibrium, 10,000 planar blocks, beyond which solving again takes minutes: bounds within ACCEPTED_GAP are
enough there, unless bounds closer than CLOSE are asked for. The results say how far apart they are."""

FIRST_OF_LARGE = 1e-8
"""Tolerance at which the bounds of a large program are first evaluated; it continues where they lie too far apart. A
planar wall of 19,951 blocks came to it in 76 iterations, bounds 1.7e-8 apart; it stalled at 2.8e-9 thirty later."""

CLOSE = 1e-7
"""A wanted distance of the bounds below this justifies every try, at any size."""


@dataclass
class AssociativeRun:
    """What every step needs, and the programs solved so far.

    first : number of the first program in the sequence of the load case
    """

    program: Program
    settings: SolverSettings
    log: Log
    first: int
    records: list[ProgramRecord]

    @property
    def size(self) -> float:
        """Of load factors."""
        return factor_size(self.program)


@dataclass(frozen=True)
class ProvedAnswer:
    """What the solver returned, and what of it could be proved.

    gap         : bounds of the load factor, where there is one
    certificate : compatible velocities in which the dead load does work, where there is no equilibrium
    """

    solution: ConeSolution
    gap: CertifiedGap | None = None
    certificate: FloatArray | None = None

    @property
    def distance(self) -> float:
        """Of the bounds, infinite where there are none."""
        return float("inf") if self.gap is None or not self.gap.gap >= 0.0 else self.gap.gap


def solve_until_proved(run: AssociativeRun, form: AssociativeForm) -> ProvedAnswer:
    """The program itself, solved until its bounds meet or no settings are left."""
    best = _answer(run, form, 1.0, run.settings)
    methods = [run.settings.solver]
    if methods == ["auto"]:
        methods = [best.solution.solver]
        if not (_is_large(run) and best.gap is not None):
            methods.append(other_method(best.solution.solver))
            unsure = run.program.conditions is not None and best.solution.status is Status.UNBOUNDED
            if unsure or _is_open(run, best):
                best = better(best, _answer(run, form, 1.0, replace(run.settings, solver=methods[1])))
    if run.program.conditions is not None and best.distance <= ACCEPTED_GAP:
        return best
    tried: set[tuple[str, float, float | None, bool]] = set()
    if best.solution.solver == "mbla" and best.solution.status is not Status.SOLVED:
        tried.add(("mbla", 1.0, None, True))
    for (power, share, shift), method in product(SHARPER, methods):
        if not _is_open(run, best):
            break
        own = None if best.gap is None else in_own_units(run.program, best.gap.forces)
        unit = _size(run, best) ** power
        shifted = regularization(form.cone_program, replace(run.settings, regularization=shift))
        kind = (
            method,
            unit,
            None if method == "mbla" else shifted,
            own is None,
        )  # mbla has no regularisation to choose
        if kind in tried:
            continue
        tolerance = max(share * run.settings.tolerance, SHARPEST)
        sharper = replace(run.settings, solver=method, tolerance=tolerance, regularization=shifted)
        answer = _answer(run, own or form, unit, sharper)
        if answer.solution.status is not Status.SOLVED:  # a tolerance still smaller would change nothing
            tried.add(kind)
        best = better(best, answer)
    return best


def _is_open(run: AssociativeRun, best: ProvedAnswer) -> bool:
    """Whether another try is wanted, and allowed."""
    return not is_decided(run, best) and best.solution.status not in (Status.TIME_LIMIT, Status.ITERATION_LIMIT)


def _answer(run: AssociativeRun, form: AssociativeForm, unit: float, settings: SolverSettings) -> ProvedAnswer:
    """The program in the given unit of the load factor, and what of its solution can be proved."""
    if _is_large(run):  # no finer than is worthwhile
        settings = replace(settings, tolerance=max(settings.tolerance, FIRST_OF_LARGE))
    solver = cone_solver(form.cone_program if unit == 1.0 else form.in_units(unit), settings, run.log)
    answer, tolerance = _once(run, form, solver, unit), settings.tolerance
    while answer.solution.status is Status.SOLVED and _is_open(run, answer):
        before, tolerance = (answer.distance, tolerance), max(FURTHER * tolerance, SHARPEST)
        if tolerance >= before[1] or not sharpen(solver, tolerance):
            break
        again = _once(run, form, solver, unit, answer)
        if again is answer:  # it was that accurate already
            continue
        answer = better(answer, again)
        if not answer.distance <= WORTHWHILE * before[0]:
            break
    return answer


def _once(
    run: AssociativeRun,
    form: AssociativeForm,
    solver: ConeSolver,
    unit: float,
    before: ProvedAnswer | None = None,
) -> ProvedAnswer:
    """One run of a solver, and what of its solution can be proved; ``before`` where it takes no further step."""
    solution = solved_once(run, solver, "associative", unit)
    if before is not None and not solution.iterations:
        return before
    if unit != 1.0:
        solution = replace(solution, x=solution.x * unit, objective=solution.objective * unit)
    if solution.status in (Status.TIME_LIMIT, Status.ITERATION_LIMIT, Status.UNBOUNDED):
        return ProvedAnswer(solution)
    certificate = proved_certificate(run, form, solution)
    has_value = certificate is None and solution.status in WITH_VALUE and not says_it_falls(run, solution)
    return ProvedAnswer(solution, _proved(form, solution) if has_value else None, certificate)


def is_decided(run: AssociativeRun, answer: ProvedAnswer) -> bool:
    """Whether solving again could bring nothing: proved as sharply as asked for, a small factor relatively too."""
    if answer.certificate is not None or answer.solution.status is Status.UNBOUNDED:
        return True
    if answer.gap is None or not answer.gap.gap <= wanted_gap(run):
        return False
    share = max(ACCEPTED_GAP, run.settings.gap)
    return abs(answer.gap.kinematic - answer.gap.static) <= share * abs(answer.gap.kinematic)


def wanted_gap(run: AssociativeRun) -> float:
    """Distance of the bounds, relative, at which no other try is made."""
    wanted = run.settings.gap
    return max(wanted, ACCEPTED_GAP) if _is_large(run) else wanted


def _is_large(run: AssociativeRun) -> bool:
    """Whether solving again takes minutes, and bounds so close are not asked for."""
    return len(run.program.dead_load) > LARGE and run.settings.gap >= CLOSE


def better(first: ProvedAnswer, second: ProvedAnswer) -> ProvedAnswer:
    """The answer with the stronger proof, the earlier one of equals; with conditions on interfaces both bounds count.

    Of such programs one method has the closer forces, the other the closer velocities.
    """
    if first.gap is not None and second.gap is not None and first.gap.of_interfaces:
        first, second = (replace(one, gap=first.gap.with_bounds_of(second.gap)) for one in (first, second))

    def weakness(answer: ProvedAnswer) -> tuple[int, float]:
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


def solved_once(run: AssociativeRun, solver: ConeSolver, kind: str, unit: float, enough: float = 0.0) -> ConeSolution:
    """Solve the loaded program once and record it; ``unit`` times the objective is the load factor of the program."""
    number, to_load_factor = run.first + len(run.records), unit * run.program.scaling.live
    solution = solver.solve_once(number, to_load_factor, enough)
    value = to_load_factor * solution.objective if solution.status in WITH_VALUE else np.nan
    status = Status.SOLVED if enough > 0.0 and solution.status is Status.APPROXIMATE else solution.status
    run.records.append(replace(solution, status=status).record(number, kind, value))
    return solution


def says_it_falls(run: AssociativeRun, solution: ConeSolution) -> bool:
    """Whether a program, of either sign of the live load, shows that there is no equilibrium without live load."""
    if not run.program.dead_load.any():  # no forces balance no load
        return False
    negative = solution.objective < -STANDS_MARGIN * run.size
    return solution.status is Status.NO_EQUILIBRIUM or (solution.status in WITH_VALUE and negative)


def _proved(form: AssociativeForm, solution: ConeSolution) -> CertifiedGap:
    """Bounds that a solution proves."""
    state = LawState(form.forces(solution), form.velocities(solution), form.load_factor(solution), np.nan)
    return certified_gap(form.program, state, form.slacks(solution))


def _size(run: AssociativeRun, answer: ProvedAnswer) -> float:
    """Size of the load factor: 1, or its own where that is small."""
    size, value = run.size, abs(answer.solution.objective)
    if answer.gap is None or value > SMALL * size:
        return 1.0
    return value if value > NOISE * size else ZERO_SIZE * size
