from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import replace

import highspy
import numpy as np
import pytest

from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram, friction_polygon, kinematic_form
from mbla.solution.cone_solvers import highs_adapter
from mbla.solution.cone_solvers.choice import cone_solver, is_linear
from mbla.solution.cone_solvers.clarabel_adapter import ClarabelProgram
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.cone_solvers.highs_adapter import STATUS_MAP, HighsProgram
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from tests.line import BLOCK, WALL, line_of

INTO_THE_GROUND = "load_cases.push.live=[{acceleration: [0, 0, -1]}]"
SLOPE_BEYOND_FRICTION = "load_cases.push.dead=[{gravity: [9.81, 0, -9.81]}]"


def linear_program(text: str = WALL, *overrides: str) -> ConeProgram:
    program = line_of(text, *overrides).program
    return kinematic_form(program, program.limits, facets=friction_polygon(8, circumscribed=False)).cone_program


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


def highs(program: ConeProgram, settings: SolverSettings | None = None, log: Log = ignored) -> HighsProgram:
    return HighsProgram(program, settings or SolverSettings(1e-8), log)


def test_every_status_of_highs_has_a_row() -> None:
    names = {name for name in dir(highspy.HighsModelStatus) if name.startswith("k")}
    assert names == set(STATUS_MAP)
    assert [name for name, status in STATUS_MAP.items() if status is Status.SOLVED] == ["kOptimal"]


def test_objective_and_duals_have_the_signs_of_clarabel() -> None:
    program = linear_program()
    ours = highs(program).solve(1, 1.0)
    theirs = ClarabelProgram(program, SolverSettings(1e-10), ignored).solve(1, 1.0)
    assert ours.status is Status.SOLVED
    assert ours.verdict == "HiGHS: kOptimal"
    assert ours.objective == pytest.approx(theirs.objective, rel=1e-8)
    assert np.abs(program.cost + program.matrix.T @ ours.z).max() < 1e-9
    assert (ours.z[program.n_equations :] > -1e-12).all()
    assert -program.rhs @ ours.z == pytest.approx(ours.objective, rel=1e-12)
    assert (program.matrix @ ours.x - program.rhs)[program.n_equations :].max() < 1e-12


def test_one_line_of_the_log_carries_the_residuals() -> None:
    log: list[IterationRecord] = []
    solution = highs(linear_program(), log=log.append).solve(7, 2.0)
    (record,) = log
    assert (record.program, record.iteration) == (7, solution.iterations)
    assert solution.iterations > 0
    assert record.load_factor == pytest.approx(2 * solution.objective, rel=1e-12)
    assert max(record.gap, record.primal_residual, record.dual_residual) < 1e-8


def test_update_gives_the_answer_of_a_new_program() -> None:
    held = highs(linear_program())
    first = held.solve(1, 1.0).objective
    held.update(cost=2.0 * held.cone_program.cost)
    assert held.solve(2, 1.0).objective == pytest.approx(2 * first, rel=1e-9)
    held.update(rhs=3.0 * held.cone_program.rhs)
    assert held.solve(3, 1.0).objective == pytest.approx(6 * first, rel=1e-9)


@pytest.mark.parametrize("text", [BLOCK, WALL])
def test_where_no_mechanism_exists_the_dual_ray_is_a_lock(text: str) -> None:
    program = linear_program(text, INTO_THE_GROUND)
    solution = highs(program).solve(1, 1.0)
    assert solution.status is Status.UNBOUNDED
    assert np.abs(program.matrix.T @ solution.z).max() < 1e-8
    assert (solution.z[program.n_equations :] > -1e-9).all()
    assert program.rhs @ solution.z < -1e-3


def test_where_no_equilibrium_exists_the_primal_ray_is_a_mechanism() -> None:
    """A wall on a slope of 45 degrees with friction 0.65, pushed across: no push along y holds it."""
    program = linear_program(WALL, SLOPE_BEYOND_FRICTION, "load_cases.push.live=[{acceleration: [0, 1, 0]}]")
    solution = highs(program).solve(1, 1.0)
    assert solution.status is Status.NO_EQUILIBRIUM
    moved = program.matrix @ solution.x
    assert np.abs(moved[: program.n_equations]).max() < 1e-9
    assert moved[program.n_equations :].max() < 1e-9
    assert program.cost @ solution.x < -1e-3


def test_a_verdict_without_a_ray_is_none(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(STATUS_MAP, "kOptimal", Status.UNBOUNDED)
    solution = highs(linear_program()).solve(1, 1.0)
    assert solution.status is Status.NUMERICAL_ERROR


def test_a_status_that_is_not_known_is_an_error(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.delitem(STATUS_MAP, "kOptimal")
    with pytest.raises(SolverError, match="not known: kOptimal"):
        highs(linear_program()).solve(1, 1.0)


def test_limits_of_iterations_and_time_have_their_own_status() -> None:
    assert (
        highs(linear_program(), SolverSettings(1e-8, max_iterations=2)).solve(1, 1.0).status is Status.ITERATION_LIMIT
    )
    assert highs(linear_program(), SolverSettings(1e-8, deadline=0.0)).solve(1, 1.0).status is Status.TIME_LIMIT


@pytest.mark.parametrize("part", ["cost", "rhs"])
def test_numbers_that_are_not_finite_never_reach_the_solver(part: str) -> None:
    program = linear_program()
    values = getattr(program, part).copy()
    values[0] = np.nan
    with pytest.raises(SolverError, match="not finite"):
        highs(replace(program, **{part: values})).solve(1, 1.0)


def test_an_option_that_highs_does_not_take_is_an_error() -> None:
    with pytest.raises(SolverError, match="ipm_iteration_limit = -5"):
        highs(linear_program(), SolverSettings(1e-8, max_iterations=-5)).solve(1, 1.0)


def test_a_signal_stops_it(monkeypatch: pytest.MonkeyPatch) -> None:
    """The signal is noted while HiGHS runs, stops it at its next callback, and is delivered afterwards."""

    @contextmanager
    def held() -> Iterator[Callable[[], bool]]:
        yield lambda: True

    monkeypatch.setattr(highs_adapter, "held_signals", held)
    solution = highs(linear_program()).solve(1, 1.0)
    assert (solution.status, solution.solver_status) == (Status.TIME_LIMIT, "kInterrupt")


def test_the_deck_s_solver_is_taken_and_cones_are_refused_in_words() -> None:
    program = line_of(WALL).program
    cones = kinematic_form(program, program.limits).cone_program
    chosen = SolverSettings(1e-8, solver="highs")
    assert isinstance(cone_solver(linear_program(), chosen, ignored), HighsProgram)
    assert isinstance(cone_solver(cones, SolverSettings(1e-8), ignored), ClarabelProgram)
    with pytest.raises(SolverError, match=f"{program.n_points} friction cones .* use friction_cone: polyhedral"):
        cone_solver(cones, chosen, ignored)
    with pytest.raises(SolverError, match="linear programs only"):
        HighsProgram(replace(linear_program(), quadratic=np.ones(162)), chosen, ignored)
    with pytest.raises(SolverError, match="no cone solver simplex"):
        cone_solver(cones, replace(chosen, solver="simplex"), ignored)
    assert is_linear(linear_program())
    assert not is_linear(cones)


@pytest.mark.parametrize("status", [Status.TIME_LIMIT, Status.ITERATION_LIMIT])
def test_a_search_for_a_ray_that_is_stopped_says_by_what(status: Status, monkeypatch: pytest.MonkeyPatch) -> None:
    held = highs(linear_program())
    solution = held.solve(1, 1.0)
    ended = replace(solution, status=status, iterations=3)
    monkeypatch.setattr(ClarabelProgram, "solve_once", lambda *arguments: ended)
    stopped = held._with_ray(solution)
    assert stopped.status is status
    assert stopped.iterations == solution.iterations + 3
