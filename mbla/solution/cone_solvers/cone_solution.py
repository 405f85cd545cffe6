"""Interface of every cone solver: the program that it is given, the solution that it returns."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram
from mbla.solution.solution import WITH_VALUE, IterationRecord, ProgramRecord, Status

Log = Callable[[IterationRecord], None]


@dataclass(frozen=True)
class ConeSolution:
    """What the solver returned.

    x      : primal variables; a ray where the status is NO_EQUILIBRIUM
    z      : dual variables, cost + matrixᵀ z = 0, z ≥ 0 on half-lines; a ray where the status is UNBOUNDED
    solver : the library's name, for words about its status
    factorization : the library that factorised the linear systems; empty where the solver keeps that to itself
    """

    status: Status
    solver_status: str
    x: FloatArray
    z: FloatArray
    objective: float
    iterations: int
    seconds: float
    solver: str = "clarabel"
    factorization: str = ""

    @property
    def usable(self) -> bool:
        """Whether it has a value, and numbers to go on with."""
        return self.status in WITH_VALUE and bool(np.isfinite(self.x).all() and np.isfinite(self.z).all())

    @property
    def verdict(self) -> str:
        """The library's own word for the outcome, ``clarabel: Solved``."""
        return f"{self.solver}: {self.solver_status}"

    @property
    def shortfall(self) -> str:
        """Why it is not solved, in words."""
        return {
            Status.APPROXIMATE: "the solver ended short of its tolerance",
            Status.ITERATION_LIMIT: "the solver reached its limit of iterations",
            Status.TIME_LIMIT: "the time limit was reached",
            Status.NUMERICAL_ERROR: "the solver broke down numerically",
        }.get(self.status, str(self.status)) + f" ({self.verdict})"

    def record(self, number: int, kind: str, load_factor: float, change: float = np.nan) -> ProgramRecord:
        """The solution as one program of a sequence."""
        outcome = (self.status, load_factor, change, self.iterations, self.seconds)
        return ProgramRecord(number, kind, *outcome, self.solver.lower(), self.factorization)


class ConeSolver(Protocol):
    """A cone program held by a solver: ``solve`` it, ``update`` its data, solve it again.

    Statuses are given for a program in kinematic form: UNBOUNDED where it is infeasible (no mechanism in which the live
    load does work), NO_EQUILIBRIUM where its objective has no lower bound. A static form has them the other way round.
    """

    @property
    def cone_program(self) -> ConeProgram:
        """The program as it was last updated."""
        ...

    def solve(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded.

        program_number : number in the sequence of the load case, for the log
        to_load_factor : factor from the objective to the load factor, for the log

        Raises SolverError if the data are not finite or the solver's status is not known.
        """
        ...

    def update(self, *, cost: FloatArray | None = None, rhs: FloatArray | None = None) -> None:
        """Change cost, (n_unknowns,), or right-hand side, (n_constraints,); the matrix stays."""
        ...

    def solve_once(self, program_number: int, to_load_factor: float) -> ConeSolution:
        """Solve what is loaded once, for callers that judge the answer themselves."""
        ...
