from __future__ import annotations

import gc
import weakref
from dataclasses import replace

import clarabel
import numpy as np
import pytest
import scipy.sparse as sp

from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.solution.cone_solvers.clarabel_adapter import STATUS_MAP, ClarabelProgram, regularization
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from tests.line import WALL, line_of


def program_of(log: list[IterationRecord] | None = None) -> ClarabelProgram:
    records = [] if log is None else log
    line = line_of(WALL)
    form = kinematic_form(line.program, line.program.limits)
    return ClarabelProgram(form.cone_program, SolverSettings(1e-8), records.append)


def test_every_status_of_clarabel_has_a_row() -> None:
    names = {name for name in dir(clarabel.SolverStatus) if name[0].isupper()}
    assert names == set(STATUS_MAP)
    assert [name for name, status in STATUS_MAP.items() if status is Status.SOLVED] == ["Solved"]


def test_iterations_are_logged_as_they_go() -> None:
    log: list[IterationRecord] = []
    solution = program_of(log).solve(7, 2.0)
    assert [record.iteration for record in log] == list(range(solution.iterations + 1))
    assert {record.program for record in log} == {7}
    assert log[-1].load_factor == pytest.approx(2 * solution.objective, rel=1e-6)


def test_update_gives_the_answer_of_a_new_program() -> None:
    held = program_of()
    first = held.solve(1, 1.0)
    cost = 2.0 * held.cone_program.cost
    held.update(cost=cost)
    fresh = ClarabelProgram(replace(held.cone_program, cost=cost), held.settings, held.log)
    assert held.solve(2, 1.0).objective == pytest.approx(fresh.solve(1, 1.0).objective, rel=1e-7)
    assert held.solve(3, 1.0).objective == pytest.approx(2 * first.objective, rel=1e-7)


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_numbers_that_are_not_finite_never_reach_the_solver(value: float) -> None:
    held = program_of()
    cost = held.cone_program.cost.copy()
    cost[0] = value
    spoiled = replace(held.cone_program, cost=cost)
    with pytest.raises(SolverError, match="not finite"):
        ClarabelProgram(spoiled, held.settings, held.log).solve(1, 1.0)


@pytest.mark.parametrize("error", [KeyboardInterrupt, OSError("disk full")])
def test_what_the_log_raises_stops_the_solver_and_arrives(error: BaseException | type[BaseException]) -> None:
    """clarabel itself would print the exception and go on solving."""

    def log(record: IterationRecord) -> None:
        if record.iteration == 2:
            raise error

    held = program_of()
    with pytest.raises(type(error) if isinstance(error, BaseException) else error):
        ClarabelProgram(held.cone_program, held.settings, log).solve(1, 1.0)


def test_regularisation_follows_kind_and_size_unless_given() -> None:
    program = program_of().cone_program
    many = replace(program, cost=np.zeros(3001))
    settings = SolverSettings(1e-8)
    quadratic = replace(program, quadratic=np.ones(len(program.cost)))
    assert regularization(program, settings) > regularization(many, settings) > regularization(quadratic, settings)
    assert regularization(quadratic, replace(settings, regularization=1e-5)) == 1e-5


def test_a_program_that_was_solved_is_freed() -> None:
    matrix = sp.csc_array(np.array([[1.0, 1.0], [-1.0, 0.0], [0.0, -1.0]]))
    cone_program = ConeProgram(np.array([1.0, 2.0]), matrix, np.array([1.0, 0.0, 0.0]), n_half_lines=2, n_cones=0)
    program = ClarabelProgram(cone_program, SolverSettings(tolerance=1e-8), lambda record: None)
    assert program.solve(1, 1.0).status is Status.SOLVED
    freed = weakref.ref(program)
    del program
    gc.collect()
    assert freed() is None
