"""Cone programs solved by the method of this package, held like those of the other solvers.

Programs of few equations, the kinematic forms, are condensed onto their unknowns; ``fits`` says which.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.cone_solvers.interior_point.condensation import Condensation
from mbla.solution.cone_solvers.interior_point.cones import ConeData, cone_data
from mbla.solution.cone_solvers.interior_point.iterates import Ended, IterationControl, Measures, Outcome, warm_start
from mbla.solution.cone_solvers.interior_point.method import solve_cone_program
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status

NAME = "mbla"

MOST_EQUATIONS = 8
"""Equations up to which a program is condensed onto its unknowns: each is a column of the border."""

STATUSES = {
    Outcome.SOLVED: Status.SOLVED,
    Outcome.ALMOST: Status.APPROXIMATE,
    Outcome.INFEASIBLE: Status.UNBOUNDED,
    Outcome.UNBOUNDED: Status.NO_EQUILIBRIUM,
    Outcome.ITERATIONS: Status.ITERATION_LIMIT,
    Outcome.TIME: Status.TIME_LIMIT,
    Outcome.STALLED: Status.NUMERICAL_ERROR,
    Outcome.NUMERICAL: Status.NUMERICAL_ERROR,
}
"""What an outcome says of a program in kinematic form: no admissible mechanism (infeasible) means that the live load
never brings collapse; an unbounded mechanism means that no equilibrium exists."""


@dataclass
class CondensedProgram:
    """A cone program, its condensation found once; cost and right-hand side may change.

    log : called once per iteration
    """

    cone_program: ConeProgram
    settings: SolverSettings
    log: Log
    _data: ConeData | None = field(init=False, default=None)
    _condensation: Condensation | None = field(init=False, default=None)
    _near: tuple[FloatArray, FloatArray] | None = field(init=False, default=None)

    def solve(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded; see ``ConeSolver``."""
        return self.solve_once(program_number, to_load_factor)

    def solve_once(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded, for callers that judge the answer themselves.

        Raises SolverError if the data are not finite.
        """
        self._check_finite()
        started = time.perf_counter()
        data, condensation = self.prepared()
        progress, settings = self._progress(program_number, to_load_factor, started), self.settings
        run = IterationControl(settings.tolerance, settings.max_iterations, settings.deadline, progress)
        ended, iterations = self._from_near(data, condensation, run)
        if ended is None:
            ended = solve_cone_program(data, condensation, run)
            iterations += ended.iterations
        solution = self._solution(data, ended, iterations, time.perf_counter() - started)
        if ended.outcome is Outcome.SOLVED:
            self._near = solution.x, solution.z  # where the next program of this object starts
        return solution

    def update(self, *, cost: FloatArray | None = None, rhs: FloatArray | None = None) -> None:
        """Change cost, (n_unknowns,), or right-hand side, (n_constraints,); the matrix stays."""
        old = self.cone_program
        self.cone_program = replace(old, cost=old.cost if cost is None else cost, rhs=old.rhs if rhs is None else rhs)
        if self._data is not None:
            self._data = self._data.changed(self.cone_program)

    def _from_near(self, data: ConeData, condensation: Condensation, run: IterationControl) -> tuple[Ended | None, int]:
        """The run from a neighbour's solution; None where there is none or it leads nowhere, and its iterations."""
        if self._near is None:
            return None, 0
        x, z = self._near
        n_e = len(data.equation_rhs)
        near = warm_start(data, x, z[:n_e], np.append(z[n_e:], 0.0)[data.order])
        ended = solve_cone_program(data, condensation, run, near)
        if ended.outcome in (Outcome.SOLVED, Outcome.TIME):
            return ended, ended.iterations
        return None, ended.iterations

    def prepared(self) -> tuple[ConeData, Condensation]:
        """The program as the method wants it, and its condensation, found once."""
        if self._data is None or self._condensation is None:
            self._data = cone_data(self.cone_program)
            self._condensation = Condensation(self._data, self.settings.cholesky)
        return self._data, self._condensation

    def _check_finite(self) -> None:
        program = self.cone_program
        quadratic = np.zeros(0) if program.quadratic is None else program.quadratic
        if not all(np.isfinite(part).all() for part in (program.cost, program.matrix.data, program.rhs, quadratic)):
            raise SolverError("program-not-finite", "the cone program holds numbers that are not finite")

    def _progress(self, program: int, to_load_factor: float, started: float) -> Callable[[int, Measures, float], None]:
        def progress(number: int, measures: Measures, length: float) -> None:
            self.log(
                IterationRecord(
                    program=program,
                    iteration=number,
                    load_factor=measures.primal_objective * to_load_factor,
                    gap=measures.gap,
                    primal_residual=measures.primal,
                    dual_residual=measures.dual,
                    step=length,
                    seconds=time.perf_counter() - started,
                )
            )

        return progress

    def _solution(self, data: ConeData, ended: Ended, iterations: int, seconds: float) -> ConeSolution:
        cones = np.empty(len(self.cone_program.rhs) - len(data.equation_rhs) + 1)
        cones[data.order] = ended.point.z
        assert self._condensation is not None
        return ConeSolution(
            status=STATUSES[ended.outcome],
            solver_status=ended.outcome.value,
            x=ended.point.x,
            z=np.concatenate([ended.point.y, cones[:-1]]),
            objective=ended.measures.primal_objective,
            iterations=iterations,
            seconds=seconds,
            solver=NAME,
            factorization=self._condensation.factors.library,
        )


def fits(program: ConeProgram) -> bool:
    """Whether a program is one that can be condensed."""
    has_cones = program.n_half_lines + program.n_cones + len(program.further_cones) > 0
    return has_cones and program.n_equations <= MOST_EQUATIONS


def condensed_size(program: ConeProgram) -> int:
    """Rows of N for a program that fits: its unknowns that are not local."""
    return len(program.cost) - program.n_local
