"""What is done otherwise on large models, shown on small ones told to be large; and solved programs that go on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import pytest

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.associative import proofs, proved_answer
from mbla.solution.associative.associative_form import associative_form
from mbla.solution.associative.proved_answer import (
    AssociativeRun,
    ProvedAnswer,
    solve_until_proved,
    wanted_gap,
)
from mbla.solution.associative.repair import repaired_mechanisms
from mbla.solution.cone_solvers.choice import cone_solver, sharpen
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from mbla.solution.verification import case
from mbla.solution.verification.verify_points import verify_points
from tests.line import WALL, line_of, solution_of

SETTINGS = SolverSettings(1e-8)


def ignored(record: IterationRecord) -> None:
    """A log that nobody reads."""


@pytest.fixture(scope="module")
def program() -> Program:
    return line_of(WALL, "parameters.n=6").program


def run_of(program: Program, **settings: Any) -> AssociativeRun:
    return AssociativeRun(program, replace(SETTINGS, **settings), ignored, 1, [])


# --- going on from a solution -----------------------------------------------------------------------------------------


def held(program: Program, **settings: Any) -> Any:
    return cone_solver(associative_form(program).cone_program, replace(SETTINGS, **settings), ignored)


@pytest.mark.parametrize("solver", ["mbla", "auto"])
def test_a_sharpened_program_goes_on_where_it_ended(
    program: Program, solver: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Both runs together are the run that the smaller tolerance makes from the beginning."""
    monkeypatch.setattr("mbla.solution.cone_solvers.choice.OWN_FROM", 1)
    rough, sharp = held(program, solver=solver, tolerance=1e-4), held(program, solver=solver, tolerance=1e-9)
    first = rough.solve(1, 1.0)
    assert first.status is Status.SOLVED
    assert sharpen(rough, 1e-9)
    second, whole = rough.solve(2, 1.0), sharp.solve(1, 1.0)
    assert second.status is Status.SOLVED
    assert first.iterations + second.iterations == whole.iterations
    assert second.objective == pytest.approx(whole.objective, rel=1e-12)
    assert abs(first.objective / whole.objective - 1.0) > 1e-9


def test_what_cannot_go_on_says_so(program: Program) -> None:
    assert not sharpen(held(program, solver="mbla"), 1e-9)  # nothing was solved yet
    clarabel = held(program, solver="clarabel")
    clarabel.solve(1, 1.0)
    assert not sharpen(clarabel, 1e-9)


def test_bounds_too_far_apart_are_brought_together_by_going_on(
    program: Program, monkeypatch: pytest.MonkeyPatch
) -> None:
    def iterations() -> int:
        run = run_of(program, solver="mbla", tolerance=1e-4, gap=1e-7)
        answer = solve_until_proved(run, associative_form(program))
        assert answer.distance <= 1e-7
        assert len(run.records) > 1
        return sum(record.iterations for record in run.records)

    gone_on = iterations()
    monkeypatch.setattr(proved_answer, "sharpen", lambda *_: False)
    assert gone_on < iterations()


# --- large models -----------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(("asked", "wanted"), [(1e-3, 1e-3), (3e-7, 1e-5), (1e-7, 1e-5), (5e-8, 5e-8)])
def test_bounds_that_verify_are_enough_on_large_models_unless_closer_ones_are_asked_for(
    program: Program, asked: float, wanted: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = run_of(program, gap=asked)
    assert wanted_gap(run) == asked
    monkeypatch.setattr(proved_answer, "LARGE", len(program.dead_load) - 1)
    assert wanted_gap(run) == wanted


def test_a_large_program_is_first_solved_no_finer_than_pays(program: Program, monkeypatch: pytest.MonkeyPatch) -> None:
    def iterations(large: int, gap: float) -> int:
        monkeypatch.setattr(proved_answer, "LARGE", large)
        run = run_of(program, solver="mbla", tolerance=1e-10, gap=gap)
        answer = solve_until_proved(run, associative_form(program))
        assert answer.solution.status is Status.SOLVED
        assert answer.distance <= wanted_gap(run)
        return run.records[0].iterations

    whole = iterations(10**9, 1e-6)
    assert iterations(0, 1e-6) < whole
    assert iterations(0, 1e-8) == whole  # so close only from the tolerance that was asked for


@pytest.mark.parametrize("large", [True, False])
def test_a_large_program_of_which_something_is_proved_is_not_given_to_the_other_method(
    large: bool, program: Program, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: set[str] = set()
    once = proved_answer._answer

    def kept(run: AssociativeRun, form: Any, unit: float, settings: SolverSettings) -> ProvedAnswer:
        asked.add(settings.solver)
        return once(run, form, unit, settings)

    monkeypatch.setattr("mbla.solution.cone_solvers.choice.OWN_FROM", 1)
    monkeypatch.setattr(proved_answer, "LARGE", 0 if large else 10**9)
    monkeypatch.setattr(proved_answer, "wanted_gap", lambda run: 0.0)  # never close enough
    monkeypatch.setattr(proved_answer, "_answer", kept)
    solve_until_proved(run_of(program, solver="auto", gap=1e-6), associative_form(program))
    assert ("clarabel" in asked) is not large


def test_a_mechanism_that_proves_its_factor_is_not_repaired_again_on_large_models(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    line = line_of(WALL, "parameters.n=6", "analysis.flow_rule=associative")
    solution, tried = solution_of(line), []

    def counted(*arguments: Any) -> Iterator[FloatArray]:
        for motion in repaired_mechanisms(*arguments):
            tried.append(motion)
            yield motion

    def bounds(large: int, near: float) -> tuple[int, float, float]:
        monkeypatch.setattr(proofs, "LARGE", large)
        monkeypatch.setattr(proofs, "LARGE_GAP", near)
        tried.clear()
        checks = verified_checks(line, solution)
        return len(tried), checks.static_bound, checks.kinematic_bound

    monkeypatch.setattr(case, "repaired_mechanisms", counted)
    every, static, kinematic = bounds(10**9, 1e-5)
    assert every > 1
    once = bounds(0, 1e-5)
    assert once[0] == 1
    assert once[1:] == pytest.approx((static, kinematic), rel=1e-5)
    assert bounds(0, 0.0)[0] == every  # none is so near


def verified_checks(line: Any, solution: Any) -> Any:
    return verify_points(line.model, line.contacts, line.load_case, solution)
