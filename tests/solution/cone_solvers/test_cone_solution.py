"""A program's record says which solver took it and which library factorised for it."""

from __future__ import annotations

from dataclasses import replace

import pytest

from mbla.program.kinematic import kinematic_form
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.linear_algebra.cholesky import installed
from mbla.solution.settings import SolverSettings
from tests.line import BLOCK, line_of
from tests.solution.planar import planar_program

SETTINGS = SolverSettings(tolerance=1e-9)


@pytest.mark.parametrize(
    ("settings", "solver", "factorization"),
    [
        (replace(SETTINGS, solver="clarabel"), "clarabel", "qdldl"),
        *((replace(SETTINGS, solver="mbla", cholesky=library), "mbla", library) for library in installed()),
    ],
)
def test_the_record_names_solver_and_factorisation(settings: SolverSettings, solver: str, factorization: str) -> None:
    program = planar_program(line_of(BLOCK))
    form = kinematic_form(program, program.limits)
    solution = cone_solver(form.cone_program, settings, lambda record: None).solve(1, program.scaling.live)
    record = solution.record(7, "associative", 0.5)
    assert (record.solver, record.factorization) == (solver, factorization)
    assert (record.program, record.kind, record.status, record.load_factor) == (
        7,
        "associative",
        solution.status,
        0.5,
    )
