"""Cone programs solved by clarabel (only importer of clarabel); its words become ours, its iterations are logged."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import groupby
from typing import Any

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.process.signals import held_signals
from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution as ConeSolution
from mbla.solution.cone_solvers.cone_solution import Log as Log
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status

STATUS_MAP = {
    "Solved": Status.SOLVED,
    "AlmostSolved": Status.APPROXIMATE,
    "PrimalInfeasible": Status.UNBOUNDED,
    "DualInfeasible": Status.NO_EQUILIBRIUM,
    "AlmostPrimalInfeasible": Status.NUMERICAL_ERROR,
    "AlmostDualInfeasible": Status.NUMERICAL_ERROR,
    "MaxIterations": Status.ITERATION_LIMIT,
    "MaxTime": Status.TIME_LIMIT,
    "NumericalError": Status.NUMERICAL_ERROR,
    "InsufficientProgress": Status.NUMERICAL_ERROR,
    "CallbackTerminated": Status.TIME_LIMIT,
    "Unsolved": Status.NUMERICAL_ERROR,
}
"""clarabel's word for a program in kinematic form: no admissible mechanism (primal infeasible) means that the live load
never brings collapse; an unbounded mechanism (dual infeasible) means that no equilibrium exists."""


FACTORIZATION = "qdldl"
"""Of its linear systems."""

UNDECIDED = (Status.APPROXIMATE, Status.NUMERICAL_ERROR, Status.ITERATION_LIMIT)

QUADRATIC_REGULARIZATION = 1e-11
"""Static regularisation of strictly convex programs."""

LINEAR_REGULARIZATION = 1e-8
"""Of programs with a linear cost: of 123 small structures 1e-11 left 42 short of a tolerance of 1e-8, this one."""

MANY, LINEAR_REGULARIZATION_OF_MANY = 3000, 1e-9
"""Unknowns from which the larger value costs iterations."""

REGULARIZATION_OF_CONDITIONS = 1e-7
"""Of programs with conditions on interfaces, which are often at their limit together with points: with 1e-8 the solver
broke down on vaults that crush."""

FALLBACK_REGULARIZATION = 1e-8
"""Second try where the solver does not finish: programs whose feasible set has no interior want the larger value."""

FALLBACK_TOLERANCE = 1e-8
"""Third try: beyond this the solver often ends short; the verified bounds tell what the answer is worth."""


@dataclass
class ClarabelProgram:
    """A cone program held by the solver, so that the next of a sequence reuses its structure.

    log : called once per iteration
    """

    cone_program: ConeProgram
    settings: SolverSettings
    log: Log
    _solver: Any = field(init=False, default=None)
    _raised: BaseException | None = field(init=False, default=None)
    _logged: int = field(init=False, default=-1)

    def solve(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded; where the solver does not finish, again with settings that are easier for it.

        to_load_factor : factor from the objective to the load factor, for the log
        Raises SolverError if the data are not finite (the solver would answer with a confident verdict).
        """
        solution = self.solve_once(program_number, to_load_factor)
        for easier in _easier(self.settings, regularization(self.cone_program, self.settings)):
            if solution.status not in UNDECIDED:
                break
            self.settings, self._solver = easier, None
            again = self.solve_once(program_number, to_load_factor)
            solution = again if again.status not in UNDECIDED or solution.status is not Status.APPROXIMATE else solution
        return solution

    def solve_once(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded once, for callers that judge the answer themselves.

        Raises SolverError if the data are not finite or the solver's status is not known, and whatever ``log`` raises.
        """
        import clarabel

        self._check_finite()
        started, self._logged = time.perf_counter(), -1
        if self._solver is None:
            self._solver = self._new_solver(clarabel)
        with held_signals() as signalled:
            callback = self._callback(program_number, to_load_factor, started, signalled)
            self._solver.set_termination_callback(callback)
            try:
                result = self._solver.solve()
            finally:  # the callback holds this object, and the solver in it the callback: no collector sees into that
                self._solver.unset_termination_callback()
        if self._raised is not None:
            raised, self._raised = self._raised, None
            raise raised
        if self._logged < result.iterations:  # the callback misses the last one where that is converged
            self._log(self._solver.get_info(), program_number, to_load_factor, started)
        name = str(result.status)
        if name not in STATUS_MAP:
            raise SolverError("solver-status", f"clarabel returned a status that is not known: {name}")
        return ConeSolution(
            status=STATUS_MAP[name],
            solver_status=name,
            x=np.asarray(result.x),
            z=np.asarray(result.z),
            objective=float(result.obj_val),
            iterations=int(result.iterations),
            seconds=time.perf_counter() - started,
            factorization=FACTORIZATION,
        )

    def update(self, *, cost: FloatArray | None = None, rhs: FloatArray | None = None) -> None:
        """Change cost, (n_unknowns,), or right-hand side, (n_constraints,); the matrix stays.

        Raises SolverError if the new data are not finite, once the solver holds the program.
        """
        changed: dict[str, FloatArray] = {}
        if cost is not None:
            changed["q"] = cost
        if rhs is not None:
            changed["b"] = rhs
        old = self.cone_program
        self.cone_program = replace(old, cost=old.cost if cost is None else cost, rhs=old.rhs if rhs is None else rhs)
        if self._solver is not None:
            self._check_finite()
            self._solver.update(**changed)

    def _check_finite(self) -> None:
        program = self.cone_program
        if not all(np.isfinite(part).all() for part in (program.cost, program.matrix.data, program.rhs)):
            raise SolverError("program-not-finite", "the cone program holds numbers that are not finite")

    def _new_solver(self, clarabel: Any) -> Any:
        program = self.cone_program
        n, quadratic = len(program.cost), program.quadratic
        cones = [clarabel.ZeroConeT(program.n_equations)]
        if program.n_half_lines:
            cones.append(clarabel.NonnegativeConeT(program.n_half_lines))
        cones += [clarabel.SecondOrderConeT(3)] * program.n_cones
        for size, run in groupby(program.further_cones):
            count = len(list(run))
            cones += [clarabel.NonnegativeConeT(count)] if size == 1 else [clarabel.SecondOrderConeT(size)] * count
        return clarabel.DefaultSolver(
            sp.csc_matrix((n, n)) if quadratic is None else sp.csc_matrix(sp.diags_array(quadratic)),
            program.cost,
            sp.csc_matrix(program.matrix),
            program.rhs,
            cones,
            self._clarabel_settings(clarabel),
        )

    def _clarabel_settings(self, clarabel: Any) -> Any:
        settings = clarabel.DefaultSettings()
        settings.verbose = False
        settings.presolve_enable = False  # would forbid update()
        # not "auto", which may take faer: its digits depend on threads, qdldl reruns bit-identically
        settings.direct_solve_method = FACTORIZATION
        settings.max_threads = 1
        settings.static_regularization_constant = regularization(self.cone_program, self.settings)
        settings.max_iter = self.settings.max_iterations
        for name in ("tol_gap_abs", "tol_gap_rel", "tol_feas"):
            setattr(settings, name, self.settings.tolerance)
        return settings

    def _callback(
        self, program: int, to_load_factor: float, started: float, signalled: Callable[[], bool]
    ) -> Callable[[Any], bool]:
        deadline = self.settings.deadline

        def callback(info: Any) -> bool:
            try:
                self._log(info, program, to_load_factor, started)
            except BaseException as error:  # the solver would print it and go on: kept, and raised after solve()
                self._raised = error
                return True
            return signalled() or (deadline is not None and time.monotonic() > deadline)

        return callback

    def _log(self, info: Any, program: int, to_load_factor: float, started: float) -> None:
        record = IterationRecord(
            program=program,
            iteration=int(info.iterations),
            load_factor=float(info.cost_primal) * to_load_factor,
            gap=float(info.gap_rel),
            primal_residual=float(info.res_primal),
            dual_residual=float(info.res_dual),
            step=float(info.step_length),
            seconds=time.perf_counter() - started,
        )
        self._logged = record.iteration
        self.log(record)


def regularization(program: ConeProgram, settings: SolverSettings) -> float:
    """The one asked for, or the one that kind and size of the program want."""
    if settings.regularization is not None:
        return settings.regularization
    if program.quadratic is not None:
        return QUADRATIC_REGULARIZATION
    if program.further_cones:
        return REGULARIZATION_OF_CONDITIONS
    return LINEAR_REGULARIZATION_OF_MANY if len(program.cost) > MANY else LINEAR_REGULARIZATION


def _easier(settings: SolverSettings, used: float) -> tuple[SolverSettings, ...]:
    """Settings to try in turn where a program was not decided with regularisation ``used``; none tried already."""
    first = replace(settings, regularization=used)
    regular = replace(settings, regularization=FALLBACK_REGULARIZATION)
    loose = replace(regular, tolerance=max(settings.tolerance, FALLBACK_TOLERANCE))
    return tuple(dict.fromkeys(easier for easier in (regular, loose) if easier != first))
