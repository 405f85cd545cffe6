"""The cone programs that analyses of one structure give rise to, solved as they are by one solver and by another."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace

from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.program.program import Program
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status

TOLERANCE = 1e-8
"""Of both solvers."""

ALIKE = 1e-6
"""Distance of two objectives of that tolerance, relative to their size or to the unit of loads."""

CERTAIN = (Status.SOLVED, Status.UNBOUNDED, Status.NO_EQUILIBRIUM)


def raw_programs(program: Program) -> Mapping[str, ConeProgram]:
    """By kind."""
    kinematic = kinematic_form(program, program.limits).cone_program
    return {"kinematic": kinematic, "reversed": replace(kinematic, rhs=-kinematic.rhs)}


def solved_by_both(program: ConeProgram) -> tuple[ConeSolution, ConeSolution]:
    """By the condensed method and by clarabel."""
    settings = SolverSettings(TOLERANCE)
    return (
        CondensedProgram(program, settings, lambda record: None).solve(1, 1.0),
        ClarabelProgram(program, settings, lambda record: None).solve(1, 1.0),
    )


def disagreement(own: ConeSolution, other: ConeSolution) -> str:
    """In words, how two answers contradict each other; empty where they do not, or one of them is none."""
    if not (own.status in CERTAIN and other.status in CERTAIN):
        return ""
    if own.status is not other.status:
        return f"{own.verdict} and {other.verdict}"
    if own.status is not Status.SOLVED:
        return ""
    apart = abs(own.objective - other.objective)
    return (
        ""
        if apart <= ALIKE * max(1.0, abs(other.objective))
        else f"objectives {own.objective:.9g}, {other.objective:.9g}"
    )
