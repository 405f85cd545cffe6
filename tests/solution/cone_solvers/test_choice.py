"""Cone solvers behind one door: the other method where one breaks down, data that change, words that are not known."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram
from mbla.solution.associative.associative_form import associative_form
from mbla.solution.cone_solvers import choice, clarabel_adapter
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.cone_solution import ConeSolution, ConeSolver, Log
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of

SETTINGS = SolverSettings(1e-8)


def sliding() -> tuple[ConeProgram, float]:
    """The program of a block that slides at 0.5, and the unit of its load factor."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    return associative_form(program).cone_program, program.scaling.live


def silent(record: object) -> None:
    """A log that nobody reads."""


@pytest.fixture
def either(monkeypatch: pytest.MonkeyPatch) -> Callable[[ConeProgram, Log], ConeSolver]:
    """Small programs are given to the condensed method first as well."""
    monkeypatch.setattr(choice, "OWN_FROM", 0)
    return lambda program, log: cone_solver(program, SETTINGS, log)


def broken(solve: Callable[..., ConeSolution]) -> Callable[..., ConeSolution]:
    def solved(*arguments: Any, **named: Any) -> ConeSolution:
        return replace(solve(*arguments, **named), status=Status.NUMERICAL_ERROR, solver_status="broken")

    return solved


def test_one_method_after_the_other_is_told_of_changes(
    either: Callable[[ConeProgram, Log], ConeSolver],
) -> None:
    """Twice the cost is twice the load factor, whether or not the program was solved before."""
    program, live = sliding()
    for solved_before in (False, True):
        solver = either(program, silent)
        if solved_before:
            assert solver.solve(1, live).objective * live == pytest.approx(0.5, rel=1e-6)
        solver.update(cost=2.0 * program.cost)
        assert np.array_equal(solver.cone_program.cost, 2.0 * program.cost)
        solution = solver.solve_once(2, live)
        assert solution.solver == "mbla"
        assert solution.objective * live == pytest.approx(1.0, rel=1e-6)


def test_clarabel_steps_in_where_the_condensed_method_breaks_down(
    either: Callable[[ConeProgram, Log], ConeSolver], monkeypatch: pytest.MonkeyPatch
) -> None:
    program, live = sliding()
    monkeypatch.setattr(CondensedProgram, "solve", broken(CondensedProgram.solve))
    own = either(program, silent)
    solution = own.solve(1, live)
    assert solution.solver == "clarabel"
    assert solution.status is Status.SOLVED
    assert solution.objective * live == pytest.approx(0.5, rel=1e-6)
    alone = ClarabelProgram(program, SETTINGS, silent).solve(1, live)
    assert solution.iterations > alone.iterations
    monkeypatch.setattr(ClarabelProgram, "solve", broken(ClarabelProgram.solve))
    solution = own.solve(1, live)
    assert solution.solver == "mbla"
    assert solution.status is Status.NUMERICAL_ERROR


def test_a_word_of_clarabel_that_is_not_known_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    program, live = sliding()
    monkeypatch.setattr(clarabel_adapter, "STATUS_MAP", {})
    with pytest.raises(SolverError, match="a status that is not known: Solved"):
        ClarabelProgram(program, SETTINGS, silent).solve(1, live)


@pytest.mark.parametrize("solved_before", [False, True])
def test_a_right_hand_side_changes_alone(solved_before: bool) -> None:
    """Twice the live power asked for, and twice the load factor; the cost is what it was."""
    program, live = sliding()
    solver = ClarabelProgram(program, SETTINGS, silent)
    if solved_before:
        solver.solve(1, live)
    solver.update(rhs=2.0 * program.rhs)
    assert np.array_equal(solver.cone_program.cost, program.cost)
    assert solver.solve(2, live).objective * live == pytest.approx(1.0, rel=1e-6)
