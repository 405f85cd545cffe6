"""What the associative analysis says where its programs end without an answer."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.program.program import Program
from mbla.program.static import StaticForm
from mbla.solution.associative import solve_associative as associative
from mbla.solution.associative.associative_form import associative_form
from mbla.solution.associative.proved_solution import AssociativeRun
from mbla.solution.associative.solve_associative import AssociativeResult, solve_associative
from mbla.solution.associative.taken_conditions import TakenConditions
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of
from tests.solution.failing_solver import said
from tests.solution.standing_structures import WALLS, box, deck

SETTINGS = SolverSettings(1e-8)
ACROSS = "load_cases.push.live=[{acceleration: [1, 0, 0]}]"
HELD = deck(box(0, 1, 0, 1), WALLS + "  - {ground: {z: 0}}\n", "friction: 0")
"""A block between two smooth walls, on the ground: no multiple of a push across moves it, of either sign."""
HANGING = deck(box(0, 1, 0, 1), WALLS, "friction: 0")
"""The same without the ground."""


def sliding() -> Program:
    """A block that slides at 0.5."""
    return line_of(BLOCK, "parameters.h=0.5").program


def result_of(program: Program, settings: SolverSettings = SETTINGS) -> AssociativeResult:
    return solve_associative(program, settings, lambda record: None)


def answer(program: Program, status: Status) -> ConeSolution:
    """The answer of the program of a load case with another status."""
    form = associative_form(program)
    solution = cone_solver(form.cone_program, SETTINGS, lambda record: None).solve(1, 1.0)
    return replace(solution, status=status, solver_status=f"said {status}")


@pytest.mark.parametrize(
    ("status", "claimed", "words"),
    [
        (Status.TIME_LIMIT, Status.TIME_LIMIT, "could not be decided: the time limit was reached (clarabel: said"),
        (Status.ITERATION_LIMIT, Status.ITERATION_LIMIT, "the solver reached its limit of iterations"),
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED, "the structure is within rounding of falling under its dead load"),
    ],
)
def test_without_a_proof_that_the_dead_load_is_carried_there_is_no_load_factor(
    status: Status, claimed: Status, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A lack of equilibrium that no mechanism proves is none either."""
    program = sliding()
    without = answer(program, status)
    monkeypatch.setattr(associative, "solved_once", lambda *arguments: without)
    monkeypatch.setattr(associative, "_carried", lambda *arguments: None)
    monkeypatch.setattr(associative, "proved_certificate", lambda *arguments: None)
    result = result_of(program)
    assert result.status is claimed
    assert result.state is None
    assert result.certificate is None
    assert words in result.reason


def test_forces_that_are_no_numbers_carry_nothing() -> None:
    program = sliding()
    form, run = (
        associative_form(program),
        AssociativeRun(TakenConditions.least(program), SETTINGS, lambda record: None, 1, []),
    )
    right = answer(program, Status.SOLVED)
    none = replace(right, z=np.full_like(right.z, np.nan))
    assert associative._carried(run, form, none) is None


@pytest.mark.parametrize(("text", "status"), [(HELD, Status.UNBOUNDED), (HANGING, Status.NO_EQUILIBRIUM)])
def test_what_no_push_of_either_sign_moves_may_fall_all_the_same(text: str, status: Status) -> None:
    program = line_of(text, ACROSS).program
    result = result_of(program)
    assert result.status is status
    assert result.state is None
    if status is Status.NO_EQUILIBRIUM:
        assert result.certificate is not None
        assert program.dead_load @ result.certificate > 0.0


def test_where_no_solver_says_whether_it_falls_nothing_is_claimed(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(HANGING, ACROSS).program
    run = AssociativeRun(TakenConditions.least(program), SETTINGS, lambda record: None, 1, [])
    monkeypatch.setattr(associative, "falling_motion", lambda *arguments: None)
    assert associative._locked_both_ways(run, SETTINGS).status is Status.NOT_VERIFIED
    monkeypatch.setattr(associative, "cone_solver", said(Status.TIME_LIMIT))
    result = associative._locked_both_ways(run, SETTINGS)
    assert result.status is Status.TIME_LIMIT
    assert result.certificate is None
    assert [record.kind for record in result.programs] == ["gravity", "gravity"]


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_the_motion_of_a_fall_is_found_in_either_sense(sense: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """A ray of the dual may come with either sign: the dead load does work in one of them."""
    program = line_of(HANGING, ACROSS).program
    run = AssociativeRun(TakenConditions.least(program), SETTINGS, lambda record: None, 1, [])
    velocities = StaticForm.velocities
    monkeypatch.setattr(StaticForm, "velocities", lambda form, z: sense * velocities(form, z))
    result = associative._locked_both_ways(run, SETTINGS)
    assert result.status is Status.NO_EQUILIBRIUM
    assert result.certificate is not None
    assert program.dead_load @ result.certificate > 0.0
