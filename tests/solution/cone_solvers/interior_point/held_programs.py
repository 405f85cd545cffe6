"""Small cone programs, programs of walls, and the condensed program that holds them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord
from tests.line import WALL, line_of


def held(program: ConeProgram, log: list[IterationRecord] | None = None, **changed: object) -> CondensedProgram:
    records: list[IterationRecord] = [] if log is None else log
    asked = replace(SolverSettings(1e-9, solver="mbla", cholesky="qdldl"), **changed)  # type: ignore[arg-type]
    return CondensedProgram(program, asked, records.append)


def wall(*overrides: str) -> ConeProgram:
    line = line_of(WALL, *overrides)
    return kinematic_form(line.program, line.program.limits).cone_program


def small(cost: list[float], rows: list[list[float]], rhs: list[float], lines: int, cones: int = 0) -> ConeProgram:
    """One equation, then half-lines, then cones."""
    return ConeProgram(np.array(cost), sp.csc_array(np.array(rows)), np.array(rhs), lines, cones)


def least_in_cones(program: ConeProgram, v: np.ndarray) -> float:
    """Least of v on half-lines and of heads over tails."""
    cones = ConeVectors.of(program)
    return float((v[cones.head] - cones.tails(v)).min())
