"""Which library solves a cone program: the one that the deck names, HiGHS for linear programs only."""

from __future__ import annotations

from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram
from mbla.solution.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solution import ConeSolver, Log
from mbla.solution.highs_adapter import HighsProgram
from mbla.solution.settings import SolverSettings

SOLVERS = ("clarabel", "highs")


def cone_solver(cone_program: ConeProgram, settings: SolverSettings, log: Log) -> ConeSolver:
    """The program held by ``settings.solver``; SolverError with the remedy where that cannot take it."""
    if settings.solver == "clarabel":
        return ClarabelProgram(cone_program, settings, log)
    if settings.solver != "highs":
        raise SolverError(f"there is no cone solver {settings.solver}; there are {', '.join(SOLVERS)}")
    if cone_program.n_cones:
        raise SolverError(
            f"analysis.solver = highs solves linear programs only, and this load case has {cone_program.n_cones} "
            "friction cones because it is not planar: use friction_cone: polyhedral, or solver: clarabel"
        )
    return HighsProgram(cone_program, settings, log)


def is_linear(cone_program: ConeProgram) -> bool:
    """Whether either library can solve the program."""
    return cone_program.n_cones == 0 and cone_program.quadratic is None


def other_solver(solver: str) -> str:
    """The library that gives the second opinion."""
    return "highs" if solver == "clarabel" else "clarabel"
