"""Linear programs solved by HiGHS (only importer of highspy): an answer by another route.

Huangfu and Hall 2018, doi:10.1007/s12532-017-0130-5. Its interior-point method with crossover to a vertex is taken:
on spatial walls with an 8-sided friction polyhedron it took 0.6 s for 105 blocks and 9 s for 410 where simplex took 1.9
and more than 40, and clarabel 0.1 and 1.1. The vertex has the objective to 1e-14. Presolve removes nothing from these
programs and stays off.

Signs: HiGHS has cost = matrixᵀ y for its row duals y, so z = −y. Its interior-point method proves neither
infeasibility nor unboundedness by a ray, and asking simplex for one takes long on large programs. So whatever it says
in these cases is settled by clarabel, whose verdicts come with rays; one that it does not share is none.

HiGHS tells its callbacks neither objective nor residuals, so there is one line in the log for each program, its
residuals computed here.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.process.signals import held_signals
from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status

STATUS_MAP = {
    "kOptimal": Status.SOLVED,
    "kInfeasible": Status.UNBOUNDED,
    "kUnbounded": Status.NO_EQUILIBRIUM,
    "kUnboundedOrInfeasible": Status.UNBOUNDED,
    "kIterationLimit": Status.ITERATION_LIMIT,
    "kTimeLimit": Status.TIME_LIMIT,
    "kInterrupt": Status.TIME_LIMIT,
    "kHighsInterrupt": Status.TIME_LIMIT,
    "kUnknown": Status.NUMERICAL_ERROR,
    "kNotset": Status.NUMERICAL_ERROR,
    "kLoadError": Status.NUMERICAL_ERROR,
    "kModelError": Status.NUMERICAL_ERROR,
    "kPresolveError": Status.NUMERICAL_ERROR,
    "kSolveError": Status.NUMERICAL_ERROR,
    "kPostsolveError": Status.NUMERICAL_ERROR,
    "kModelEmpty": Status.NUMERICAL_ERROR,
    "kMemoryLimit": Status.NUMERICAL_ERROR,
    "kObjectiveBound": Status.NUMERICAL_ERROR,
    "kObjectiveTarget": Status.NUMERICAL_ERROR,
    "kSolutionLimit": Status.NUMERICAL_ERROR,
}
"""HiGHS's word for a program in kinematic form; limits that are never set count as failures."""

WITHOUT_VALUE = (Status.UNBOUNDED, Status.NO_EQUILIBRIUM)

LEAST_TOLERANCE = 1e-10
"""HiGHS takes no smaller feasibility tolerance."""


@dataclass(frozen=True)
class _Run:
    """What HiGHS said of one linear program: name of its status, columns, row duals, objective, iterations."""

    status: str
    columns: FloatArray
    row_duals: FloatArray
    objective: float
    iterations: int


@dataclass
class HighsProgram:
    """A linear cone program (half-lines and equations alone) held for HiGHS; see ``ConeSolver``.

    log : called once per program
    Raises SolverError for a program with cones or a quadratic term.
    """

    cone_program: ConeProgram
    settings: SolverSettings
    log: Log
    _started: float = field(init=False, default=0.0)

    def __post_init__(self) -> None:
        if self.cone_program.n_cones or self.cone_program.quadratic is not None:
            raise SolverError(
                "solver-unfit", "HiGHS solves linear programs only, and this one has cones or a quadratic term"
            )

    def solve(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded; a verdict without a load factor comes with the ray that proves it.

        Raises SolverError if the data are not finite, HiGHS refuses an option or its status is not known.
        """
        self._check_finite()
        self._started = time.perf_counter()
        run = self._run()
        if run.status not in STATUS_MAP:
            raise SolverError("solver-status", f"HiGHS returned a status that is not known: {run.status}")
        solution = self._solution(run, STATUS_MAP[run.status])
        if solution.status in WITHOUT_VALUE:
            solution = self._with_ray(solution)
        self._write_log(solution, program_number, to_load_factor)
        return solution

    def update(self, *, cost: FloatArray | None = None, rhs: FloatArray | None = None) -> None:
        """Change cost, (n_unknowns,), or right-hand side, (n_constraints,); the matrix stays.

        Nothing is kept between programs: simplex from the last vertex took five times as long as a new start.
        """
        old = self.cone_program
        self.cone_program = replace(old, cost=old.cost if cost is None else cost, rhs=old.rhs if rhs is None else rhs)

    def _check_finite(self) -> None:
        program = self.cone_program
        if not all(np.isfinite(part).all() for part in (program.cost, program.matrix.data, program.rhs)):
            raise SolverError("program-not-finite", "the linear program holds numbers that are not finite")

    def _run(self) -> _Run:
        import highspy

        highs: Any = highspy.Highs()  # type: ignore[no-untyped-call]
        self._set_options(highs)
        highs.passModel(_model(highspy, self.cone_program))
        with held_signals() as signalled:

            def interrupt(event: Any) -> None:
                if signalled():
                    event.interrupt()

            highs.cbIpmInterrupt += interrupt
            highs.cbSimplexInterrupt += interrupt
            highs.run()
        info, solution = highs.getInfo(), highs.getSolution()
        counts = (info.ipm_iteration_count, info.crossover_iteration_count, info.simplex_iteration_count)
        return _Run(
            status=highs.getModelStatus().name,
            columns=np.asarray(solution.col_value),
            row_duals=np.asarray(solution.row_dual),
            objective=float(info.objective_function_value),
            iterations=sum(max(int(count), 0) for count in counts),
        )

    def _set_options(self, highs: Any) -> None:
        settings = self.settings
        tolerance = max(settings.tolerance, LEAST_TOLERANCE)
        options: dict[str, Any] = {
            "output_flag": False,
            "solver": "ipm",
            "run_crossover": "on",
            "presolve": "off",
            "threads": 1,  # both methods are serial
            "ipm_iteration_limit": settings.max_iterations,
            "primal_feasibility_tolerance": tolerance,
            "dual_feasibility_tolerance": tolerance,
            "ipm_optimality_tolerance": tolerance,
        }
        if settings.deadline is not None:
            options["time_limit"] = max(settings.deadline - time.monotonic(), 0.0)
        for name, value in options.items():
            if highs.setOptionValue(name, value).name != "kOk":
                raise SolverError("solver-option", f"HiGHS refuses the option {name} = {value}")

    def _solution(self, run: _Run, status: Status) -> ConeSolution:
        rows, columns = self.cone_program.matrix.shape
        complete = len(run.columns) == columns and len(run.row_duals) == rows
        return ConeSolution(
            status=status,
            solver_status=run.status,
            x=run.columns if complete else np.zeros(columns),
            z=-run.row_duals if complete else np.zeros(rows),
            objective=run.objective,
            iterations=run.iterations,
            seconds=time.perf_counter() - self._started,
            solver="HiGHS",
        )

    def _with_ray(self, solution: ConeSolution) -> ConeSolution:
        """The verdict that a ray proves; NUMERICAL_ERROR where there is none, or the limit that stopped its search."""
        ray = ClarabelProgram(self.cone_program, self.settings, lambda record: None).solve_once(1, 0.0)
        said = (*WITHOUT_VALUE, Status.TIME_LIMIT, Status.ITERATION_LIMIT)
        return replace(
            solution,
            status=ray.status if ray.status in said else Status.NUMERICAL_ERROR,
            x=ray.x,
            z=ray.z,
            iterations=solution.iterations + ray.iterations,
            seconds=time.perf_counter() - self._started,
        )

    def _write_log(self, solution: ConeSolution, program: int, to_load_factor: float) -> None:
        data, x, z = self.cone_program, solution.x, solution.z
        excess = data.matrix @ x - data.rhs
        excess[data.n_equations :] = np.maximum(excess[data.n_equations :], 0.0)
        valued = solution.status is Status.SOLVED
        gap = abs(float(data.cost @ x + data.rhs @ z)) / max(abs(solution.objective), 1e-300) if valued else np.nan
        record = IterationRecord(
            program=program,
            iteration=solution.iterations,
            load_factor=solution.objective * to_load_factor if valued else np.nan,
            gap=gap,
            primal_residual=float(np.abs(excess).max(initial=0.0)) if valued else np.nan,
            dual_residual=float(np.abs(data.cost + data.matrix.T @ z).max(initial=0.0)) if valued else np.nan,
            step=np.nan,
            seconds=solution.seconds,
        )
        self.log(record)


def _model(highspy: Any, program: ConeProgram) -> Any:
    (rows, columns), model = program.matrix.shape, highspy.HighsLp()
    row_lower, free = np.full(rows, -np.inf), np.full(columns, np.inf)
    row_lower[: program.n_equations] = program.rhs[: program.n_equations]
    model.num_row_, model.num_col_ = rows, columns
    model.col_cost_ = program.cost
    model.col_lower_, model.col_upper_ = -free, free
    model.row_lower_, model.row_upper_ = row_lower, program.rhs
    model.a_matrix_.format_ = highspy.MatrixFormat.kColwise
    model.a_matrix_.num_row_, model.a_matrix_.num_col_ = rows, columns
    model.a_matrix_.start_ = program.matrix.indptr
    model.a_matrix_.index_ = program.matrix.indices
    model.a_matrix_.value_ = program.matrix.data
    return model
