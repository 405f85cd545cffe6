"""The load path: ends where closed forms and the proximal scheme say, stalls in words, and its points fit the law."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mbla.deck.sections.analysis import PathScheme
from mbla.program.program import Program
from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.nonassociative import load_path
from mbla.solution.nonassociative.law_state import SequenceResult
from mbla.solution.nonassociative.load_path import solve_path
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of, verified
from tests.program.reductions.test_planar import FIXED_COURSE
from tests.solution.nonassociative.test_dilatancy import groove, wall_3
from tests.solution.nonassociative.test_proximal import FERRIS_3
from tests.solution.nonassociative_cases import CASES

SETTINGS = SolverSettings(1e-8)


def path_of(program: Program, steps: int = 20) -> SequenceResult:
    associative = solve_associative(program, SETTINGS, lambda record: None)
    return solve_path(program, associative, PathScheme(steps=steps), SETTINGS, lambda record: None)


def factor_of(program: Program, result: SequenceResult) -> float:
    assert result.status is Status.SOLVED, result.reason
    assert result.state is not None
    assert result.state.residual < 1e-9
    assert result.path[-1].load_factor == pytest.approx(program.scaling.load_factor(result.state.load_factor), rel=2e-4)
    return program.scaling.load_factor(result.state.load_factor)


def test_a_block_sticks_until_it_slides() -> None:
    program = line_of(BLOCK, "parameters.h=0.5").program
    result = path_of(program, 10)
    assert factor_of(program, result) == pytest.approx(0.5, rel=1e-8)
    assert result.path[0].load_factor == 0.0
    assert [point.slide for point in result.path[:3]] == [0, 0, 0]
    assert [point.step for point in result.path] == list(range(len(result.path)))


def test_a_load_that_nothing_carries_ends_a_step_without_a_word() -> None:
    """Beyond tipping at 0.1/0.25 velocities grow to 1e13 and rounding puts joints outside their cones: no crash."""
    spatial = ("analysis.scheme=path", "analysis.reductions=false")
    solution, checks, status = verified(line_of(FIXED_COURSE, *spatial, case=1))
    assert status is Status.SOLVED, checks.failures
    assert solution.mechanics is not None
    assert solution.mechanics.load_factor == pytest.approx(0.4, rel=1e-8)


def test_a_tall_block_opens_at_one_edge() -> None:
    """On four corner points of equal stiffness the far ones lose their force at b/h, when it tips over."""
    program = line_of(BLOCK, "parameters.h=4").program
    result = path_of(program, 10)
    assert factor_of(program, result) == pytest.approx(0.25, rel=1e-8)
    assert all(point.open == 0 for point in result.path if point.load_factor < 0.2499)


def test_a_wedge_in_a_groove() -> None:
    b = math.radians(30)
    program = groove(0.5, b)
    assert factor_of(program, path_of(program)) == pytest.approx(0.5 / math.cos(b), rel=1e-8)


@pytest.mark.parametrize("steps", [7, 20])
def test_wall_3_comes_to_the_published_factor(steps: int) -> None:
    """MPEC of 2001: 0.356; the path and the proximal scheme meet on wall 3, whose mechanism has a lowest factor."""
    program = wall_3()
    result = path_of(program, steps)
    assert factor_of(program, result) == pytest.approx(0.35582, abs=2e-5)
    factors = [point.load_factor for point in result.path]
    assert np.all(np.diff(factors) > 0)
    assert max(point.residual for point in result.path) < 1e-8
    assert result.path[-1].open > result.path[0].open


def test_a_path_with_a_peak_is_said_to_have_stalled() -> None:
    """Pushed askew, the wedge is turned against one side of its groove first; the forces then fall off."""
    program = line_of(CASES["wedge in a groove, seed 11"]()).program
    result = path_of(program)
    assert result.status is Status.NOT_VERIFIED
    assert "stalled" in result.reason
    assert "peak" in result.reason
    assert result.state is not None
    assert result.state.residual > 1e-6
    assert result.path


def test_where_associative_flow_locks_the_path_has_an_end() -> None:
    program = line_of(CASES["flat arch out of plane"]()).program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    assert associative.status is Status.UNBOUNDED
    result = solve_path(program, associative, PathScheme(steps=10), SETTINGS, lambda record: None)
    assert factor_of(program, result) == pytest.approx(1.81625, abs=1e-4)


def test_a_load_that_presses_down_has_no_end() -> None:
    """Downwards on a block that stands: every load factor is carried, and the path says that it did not end."""
    program = line_of(BLOCK, "load_cases.push.live=[{acceleration: [0, 0, -1]}]").program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    result = solve_path(program, associative, PathScheme(steps=5), SETTINGS, lambda record: None)
    assert result.status is Status.NOT_VERIFIED
    assert "did not end" in result.reason


def test_a_time_limit_ends_the_path() -> None:
    program = wall_3()
    associative = solve_associative(program, SETTINGS, lambda record: None)
    settings = replace(SETTINGS, deadline=0.0)
    result = solve_path(program, associative, PathScheme(steps=5), settings, lambda record: None)
    assert result.status is Status.TIME_LIMIT


def test_a_deck_asks_for_the_path_and_its_end_is_verified() -> None:
    solution, checks, status = verified(
        line_of(FERRIS_3, "analysis={scheme: path, path: {steps: 10}, standing: false, range: false}")
    )
    assert status is Status.SOLVED, (solution.reason, checks.failures)
    assert len(solution.path) > 10
    assert checks.complementarity_residual < 1e-9
    assert "load path" in {program.kind for program in solution.programs}


# --- steps made up --------------------------------------------------------------------------------------------------


def test_without_a_state_under_the_dead_load_there_is_no_path(monkeypatch: pytest.MonkeyPatch) -> None:
    program = line_of(BLOCK).program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    monkeypatch.setattr(load_path, "_step_at", lambda *arguments: None)
    result = solve_path(program, associative, PathScheme(steps=5), SETTINGS, lambda record: None)
    assert result.status is Status.NOT_VERIFIED
    assert result.reason == "the path stalled: no state was found under the dead load"
    assert result.state is None
    settings = replace(SETTINGS, deadline=time.monotonic() + 1e6)
    clock = SimpleNamespace(monotonic=lambda: math.inf, perf_counter=time.perf_counter)
    monkeypatch.setattr(load_path, "time", clock)
    result = solve_path(program, associative, PathScheme(steps=5), settings, lambda record: None)
    assert result.status is Status.TIME_LIMIT
    assert result.reason == "the time limit was reached"


@pytest.mark.parametrize("looks", [0, 1, 3])
def test_a_path_cut_short_says_how_far_it_came(looks: int, monkeypatch: pytest.MonkeyPatch) -> None:
    """The limit is reached after some looks at the clock, one for each step of a tenth."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    deadline = time.monotonic() + 1e6
    times = iter([0.0] * looks)
    clock = SimpleNamespace(monotonic=lambda: next(times, 2.0 * deadline), perf_counter=time.perf_counter)
    monkeypatch.setattr(load_path, "time", clock)
    settings = replace(SETTINGS, deadline=deadline)
    result = solve_path(program, associative, PathScheme(steps=5), settings, lambda record: None)
    assert result.status is Status.TIME_LIMIT
    assert [point.load_factor for point in result.path] == pytest.approx([0.1 * step for step in range(looks + 1)])
    assert f"stalled at {0.1 * looks:.6g}," in result.reason
    assert result.reason.endswith("the time limit was reached")
    assert result.state is not None
    assert program.scaling.load_factor(result.state.load_factor) == pytest.approx(0.1 * looks, abs=1e-8)


@pytest.mark.parametrize(
    ("residual", "share", "words"),
    [
        (1e-3, 1.0, "no mechanism that fits the law was found there"),
        (1e-9, 1.2, "the mechanism that fits the law belongs to 0.6"),
        (1e-9, 0.8, "it has a peak there, and falls to 0.4 before a mechanism fits the law"),
    ],
)
def test_a_path_ends_where_a_mechanism_meets_it(
    residual: float, share: float, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """What the steps with a free load factor come to is made up, from a block that slides at 0.5."""
    program = line_of(BLOCK, "parameters.h=0.5").program
    associative = solve_associative(program, SETTINGS, lambda record: None)
    assert associative.state is not None
    found = replace(associative.state, load_factor=share * associative.state.load_factor, residual=residual)
    sequence = SequenceResult(Status.SOLVED, found, "", ())
    monkeypatch.setattr(load_path, "steps_from", lambda *arguments: sequence)
    monkeypatch.setattr(load_path, "SHORTEST", 1e-3)
    result = solve_path(program, associative, PathScheme(steps=5), SETTINGS, lambda record: None)
    assert result.status is Status.NOT_VERIFIED
    assert result.reason.endswith(words)
    assert result.path[-1].load_factor == pytest.approx(0.5, rel=1e-2)
