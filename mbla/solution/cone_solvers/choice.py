"""Which solver takes a cone program: the one that the deck names, or the one that measurements favour.

- ``mbla``: the interior-point method of :mod:`mbla.solution.cone_solvers.interior_point`, for programs of its shape
- ``clarabel``: any program; those of other shapes, and those of which ``mbla`` comes to no answer, under ``mbla`` too
- ``auto``: ``mbla`` from ``OWN_FROM`` unknowns, programs with a quadratic cost only with a fast factorisation, those
  with conditions on interfaces not first; else ``clarabel``

Measured side by side (tests/performance/accuracy.md): below that size either takes milliseconds and clarabel, compiled,
has the smaller overhead; above it the condensed method is faster and its bounds are closer to each other.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram, condensed_size, fits
from mbla.solution.linear_algebra import best_library
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status

SOLVERS = ("auto", "mbla", "clarabel")

OWN_FROM = 1000
"""Rows of the condensed matrix from which ``auto`` takes the condensed method."""

FAST = "cholmod"
"""Factorisation with which programs of few iterations, those with a quadratic cost, are faster too."""


def cone_solver(cone_program: ConeProgram, settings: SolverSettings, log: Log) -> ConeSolver:
    """The program held by ``settings.solver``.

    Raises SolverError where there is no solver of the name ``settings.solver``.
    """
    if settings.solver not in SOLVERS:
        raise SolverError(
            "unknown-solver", f"there is no cone solver {settings.solver}; there are {', '.join(SOLVERS)}"
        )
    if interior_point_method(cone_program, settings.solver) == "clarabel":
        return ClarabelProgram(cone_program, settings, log)
    return _OneThenOther(CondensedProgram(cone_program, settings, log), settings, log)


def interior_point_method(cone_program: ConeProgram, solver: str) -> str:
    """Whether mbla or clarabel takes a program, by what was asked for, by its shape and by its size."""
    if solver == "clarabel" or not fits(cone_program):
        return "clarabel"
    return "mbla" if solver == "mbla" or _pays(cone_program) else "clarabel"


def _pays(cone_program: ConeProgram) -> bool:
    """Whether ``auto`` takes the condensed method for a program that fits."""
    if cone_program.further_cones:
        return False
    size = condensed_size(cone_program)
    return size >= OWN_FROM and (cone_program.quadratic is None or best_library(size) == FAST)


def other_method(solver: str) -> str:
    """The other one of the two interior-point methods."""
    return "mbla" if solver == "clarabel" else "clarabel"


@dataclass
class _OneThenOther:
    """The condensed method, and clarabel where it breaks down."""

    first: CondensedProgram
    settings: SolverSettings
    log: Log

    @property
    def cone_program(self) -> ConeProgram:
        return self.first.cone_program

    def solve(self, program_number: int, to_load_factor: float) -> ConeSolution:
        return self._either(self.first.solve(program_number, to_load_factor), program_number, to_load_factor)

    def solve_once(self, program_number: int, to_load_factor: float) -> ConeSolution:
        return self._either(self.first.solve_once(program_number, to_load_factor), program_number, to_load_factor)

    def update(self, *, cost: FloatArray | None = None, rhs: FloatArray | None = None) -> None:
        """Change cost, (n_unknowns,), or right-hand side, (n_constraints,); the matrix stays."""
        self.first.update(cost=cost, rhs=rhs)

    def _either(self, solution: ConeSolution, program_number: int, to_load_factor: float) -> ConeSolution:
        if solution.status is not Status.NUMERICAL_ERROR:
            return solution
        other = ClarabelProgram(self.first.cone_program, self.settings, self.log).solve(program_number, to_load_factor)
        if other.status is Status.NUMERICAL_ERROR:
            return solution
        iterations, seconds = solution.iterations + other.iterations, solution.seconds + other.seconds
        return replace(other, iterations=iterations, seconds=seconds)
