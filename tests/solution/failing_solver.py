"""Cone solvers whose answers are given another status, for what a scheme does without them."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any

from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status


def said(status: Status, after: int = 0) -> Callable[..., Any]:
    """In the place of ``cone_solver``: every answer after the first few has this status."""
    answers = [0]

    def make(cone_program: ConeProgram, settings: SolverSettings, log: Log, **others: bool) -> _Said:
        return _Said(cone_solver(cone_program, settings, log, **others), status, after, answers)

    return make


@dataclass
class _Said:
    """A solver that is not taken at its word; ``answers`` counts those of all programs together."""

    solver: ConeSolver
    status: Status
    after: int
    answers: list[int]

    def update(self, **changes: Any) -> None:
        self.solver.update(**changes)

    def solve(self, program_number: int, to_load_factor: float) -> ConeSolution:
        self.answers[0] += 1
        solution = self.solver.solve(program_number, to_load_factor)
        if self.answers[0] <= self.after:
            return solution
        return replace(solution, status=self.status, solver_status=f"said {self.status}")
