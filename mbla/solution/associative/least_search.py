"""The programs from which least forces are sought, and Newton's method that goes on from what they leave.

The programs are those of ``unique_forces``, which says in what order they are tried; what one of them
gives counts as the least forces only if it is a state of the law in equilibrium at the load factor that was proved.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from mbla.arrays import FloatArray
from mbla.program.fixed_mechanism import FixedMechanismForm, PointMotion, fixed_mechanism_form
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.associative.associative_form import LIGHT, LIGHTEST
from mbla.solution.associative.bounds import factor_size
from mbla.solution.associative.force_repair import carried_loads, least_carried
from mbla.solution.associative.least_newton import BALANCED as SOLVED_TO
from mbla.solution.associative.least_newton import LeastFound, LeastProblem, least_by_newton
from mbla.solution.cone_solvers.choice import OWN_FROM, interior_point_solver
from mbla.solution.cone_solvers.cone_solution import InteriorPointSolver, Log
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram, condensed_size, fits
from mbla.solution.linear_algebra.stiffness import Stiffness, stiffness_of
from mbla.solution.nonassociative.law_state import LawState, law_state
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status

MOST_OF_MECHANISM = 30
"""Iterations of the program with the mechanism, which takes 10 to 25, and leaves no forces where it takes longer."""

NEAR = 1e-5
"""Change of the load factor up to which a program's multipliers are near those sought; beyond it Newton's method would
take hundreds of steps."""

MOST_STEPS, MOST_OF_LARGE = 100, 25
"""Factorisations of Newton's method in all, and of a program of ``OWN_FROM`` rows or more: there 10 are enough where it
finds them soon, and 100 cost three times the load factor on a wall of 1,021 blocks and found nothing."""

SLOWLY = 10.0
"""Fall of the load factor, over that allowed, from which a smaller ε is not tried: it falls with ε or faster."""

FITS = 1e-6
"""Residual up to which the least forces are a state of the law; that of the state found where that is larger."""

RISE, FALL = 1e-7, 2e-8
"""Share of the load factor (at least of dead load over live load) by which theirs may be above it, being more exact,
and below it: the claim is as exact as the bounds that were proved, and must not lose by the choice of forces."""

SMALL_FACTOR = 1e-3
"""Load factors below this share of dead over live load are taken for that share in relative measures."""

BALANCED = 1e-9
"""Unbalanced force, in mean block loads, at which they are accepted."""

BALANCED_LIGHT = 1e-7
"""The same over what the row of equilibrium carries where that is less: a hundredth of what verification allows. A
light block may fall with a force that is nothing beside the load of its neighbours."""


LESS = 0.1
"""Share of the regularisation with which a program is solved again that the solver left short of its tolerance."""


@dataclass(frozen=True)
class Candidate:
    """What one program gave.

    multipliers : (n_rows,) of equilibrium, less the mechanism over ε where the load factor is in the cost
    fits        : the state has the least forces
    near        : it does not, but its multipliers are a start for Newton's method
    """

    state: LawState
    multipliers: FloatArray
    fits: bool
    near: bool


@dataclass
class Search:
    """Programs solved so far for the least forces of one state.

    weights : (n_points,) of the squares of their forces
    first   : number of the first program in the sequence of the load case
    """

    program: Program
    state: LawState
    weights: FloatArray
    settings: SolverSettings
    log: Log
    first: int
    records: list[ProgramRecord] = field(default_factory=list)

    @property
    def large(self) -> bool:
        """What is not found soon is not sought further."""
        return len(self.program.dead_load) >= OWN_FROM

    def solve(self, motion: PointMotion, share: float) -> Candidate:
        """Least forces among those that fit a motion, with the load factor in the cost if share > 0."""
        form, rows = _in_own_units(fixed_mechanism_form(self.program, motion), self.state.forces)
        number = self.first + len(self.records)
        cone_program = self._with_cost(form, share)
        settings = self.settings if share else replace(self.settings, max_iterations=self._most_of_mechanism())
        solution = _solver(cone_program, settings, self.log).solve_once(number, 0.0)
        self.records.append(solution.record(number, "least forces", np.nan))
        if solution.status is Status.APPROXIMATE and settings.regularization is not None:
            less = replace(settings, regularization=LESS * settings.regularization)
            again = _solver(cone_program, less, self.log).solve_once(number + 1, 0.0)
            self.records.append(again.record(number + 1, "least forces", np.nan))
            solution = again if again.status is Status.SOLVED else solution
        multipliers = rows * solution.z[: len(rows)]
        if solution.status not in (Status.SOLVED, Status.APPROXIMATE):
            return Candidate(self.state, multipliers, fits=False, near=False)
        least = _balanced(form, solution.x, self.state)
        near = abs(least.load_factor - self.state.load_factor) <= NEAR * self._factor_size()
        near = near and solution.status is Status.SOLVED and self._power(self.state.velocities) > 0.0
        if share and near:
            multipliers = (multipliers - self._mechanism()) / self._epsilon(share)
        return Candidate(least, multipliers, self._fits(least), near)

    def by_newton(self, start: Candidate, shares: tuple[float, ...]) -> LawState | None:
        """Least forces with the load factor in the cost, with ever smaller shares until it falls by little enough."""
        program, deadline, began = self.program, self.settings.deadline, time.perf_counter()
        stiffness, mechanism = stiffness_of(program), self._mechanism()
        multipliers, factor, left = (
            start.multipliers,
            start.state.load_factor,
            MOST_OF_LARGE if self.large else MOST_STEPS,
        )
        for share in shares:
            problem = LeastProblem(stiffness, mechanism, self.weights, self._epsilon(share))
            found = least_by_newton(problem, multipliers, factor, left, deadline)
            multipliers, factor, left = found.multipliers, found.load_factor, left - found.steps
            forces, velocities = found.forces, self.state.velocities
            least = law_state(program, program.limits.friction, forces, velocities, factor)
            fitting, solved = self._fits(least), found.unbalanced <= SOLVED_TO
            now = time.perf_counter()
            self._record_newton(stiffness, found, solved, now - began)  # pattern and order count, as in cone programs
            began = now
            fall = (self.state.load_factor - factor) / self._factor_size()
            if fitting or not solved or left <= 0 or fall > SLOWLY * FALL:
                return least if fitting else None
        return None

    def _record_newton(self, stiffness: Stiffness, found: LeastFound, solved: bool, seconds: float) -> None:
        number, status = self.first + len(self.records), Status.SOLVED if solved else Status.ITERATION_LIMIT
        library = stiffness.factorization.library
        self.records.append(
            ProgramRecord(number, "least forces", status, np.nan, np.nan, found.steps, seconds, "", library)
        )

    def _most_of_mechanism(self) -> int:
        return min(self.settings.max_iterations, MOST_OF_MECHANISM)

    def _power(self, velocities: FloatArray) -> float:
        return float(self.program.live_load @ velocities)

    def _mechanism(self) -> FloatArray:
        """The mechanism at unit power of the live load."""
        return self.state.velocities / max(self._power(self.state.velocities), 1e-300)

    def _epsilon(self, share: float) -> float:
        """The size of ε for its share."""
        return share * self._factor_size() / max(self.size(self.state), 1e-300)

    def size(self, state: LawState) -> float:
        """Σ w ‖x‖²."""
        return float(np.repeat(self.weights, self.program.components) @ state.forces.ravel() ** 2)

    def _with_cost(self, form: FixedMechanismForm, share: float) -> ConeProgram:
        """½ Σ w ‖E y + x₀‖² or ½ ε Σ w ‖E y + x₀‖² − λ: no two columns of E share a row, so EᵀWE is diagonal."""
        spread = np.repeat(self.weights, self.program.components)
        epsilon = self._epsilon(share) if share else 1.0
        quadratic = np.append(form.expand.power(2).T @ spread, 0.0)
        linear = np.append(form.expand.T @ (spread * form.offset), 0.0)
        linear[-1] = -1.0 / epsilon if share else 0.0
        return replace(form.cone_program, cost=epsilon * linear, quadratic=epsilon * quadratic)

    def _factor_size(self) -> float:
        """Size of the load factor, or of a small one."""
        return max(abs(self.state.load_factor), SMALL_FACTOR * factor_size(self.program))

    def with_proved_factor(self, least: LawState) -> LawState:
        """The same forces with the load factor that was proved, where they carry it to rounding as well.

        They do where it is small beside dead over live load. Their own may then lie outside of its bounds.
        """
        proved = replace(least, load_factor=self.state.load_factor)
        return proved if self._fits(proved) else least

    def _fits(self, least: LawState) -> bool:
        """Residual, unbalanced force and change of load factor within what is allowed."""
        program = self.program
        loads = program.dead_load + least.load_factor * program.live_load
        unbalanced = np.abs(program.equilibrium_matrix @ least.forces.ravel() + loads)
        balanced = np.all(unbalanced <= np.minimum(BALANCED, BALANCED_LIGHT * carried_loads(program, least.forces)))
        excess = yield_violation(least.forces, program.limits)
        admissible = np.all(excess <= max(FITS, self.state.residual) * least_carried(program, least.forces))
        rise = (least.load_factor - self.state.load_factor) / self._factor_size()
        fits = least.residual <= max(FITS, self.state.residual)
        return bool(fits and balanced and admissible and -FALL <= rise <= RISE)


def _solver(cone_program: ConeProgram, settings: SolverSettings, log: Log) -> InteriorPointSolver:
    """The condensed method for large programs, unless clarabel is asked for: its multipliers are better centred.

    Newton's method took 12 steps from them and found nothing in 100 from those of clarabel, on a wall of 1,013 blocks.
    """
    if settings.solver != "clarabel" and fits(cone_program) and condensed_size(cone_program) >= OWN_FROM:
        return CondensedProgram(cone_program, settings, log)
    return interior_point_solver(cone_program, settings, log, has_inside=False)


def _in_own_units(form: FixedMechanismForm, forces: FloatArray) -> tuple[FixedMechanismForm, FloatArray]:
    """The same with the equilibrium of lightly loaded blocks in units of what they carry, where there are such.

    forces : (n_points, components) of the state at hand

    Returns the form, and what its rows of equilibrium are multiplied by, (n_rows,).
    """
    unit = np.clip(carried_loads(form.program, forces), LIGHTEST, 1.0)
    if not np.any(unit < LIGHT):
        return form, np.ones(len(unit))
    data = form.cone_program
    rows = np.ones(data.matrix.shape[0])
    rows[: data.n_equations] = 1.0 / unit
    scaled = replace(data, matrix=sp.csc_array(sp.diags_array(rows) @ data.matrix), rhs=rows * data.rhs)
    return replace(form, cone_program=scaled), 1.0 / unit


def _balanced(form: FixedMechanismForm, y: FloatArray, state: LawState) -> LawState:
    """The forces brought to equilibrium by the least change of the unknowns, the load factor among them."""
    program, data = form.program, form.cone_program
    equations = sp.csr_array(data.matrix)[: data.n_equations]
    unbalanced = data.rhs[: data.n_equations] - equations @ y
    if np.abs(unbalanced).max(initial=0.0) > BALANCED / 10:
        y = y + spla.lsqr(equations, unbalanced, atol=1e-14, btol=1e-14, iter_lim=2000)[0]
    return law_state(program, program.limits.friction, form.forces(y), state.velocities, form.load_factor(y))
