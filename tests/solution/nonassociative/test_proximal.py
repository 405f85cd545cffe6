"""The default non-associative scheme: closed forms, published walls, and states of the exact law."""

from __future__ import annotations

import math
import time
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from mbla.solution.associative.solve_associative import solve_associative
from mbla.solution.linear_algebra.stiffness import stiffness_of
from mbla.solution.nonassociative import proximal
from mbla.solution.nonassociative.law_steps import Stepper
from mbla.solution.nonassociative.proximal import ProximalRun, gravity_state, solve_proximal, steps_from
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Checks, Solution, Status
from mbla.solution.standing import standing
from mbla.solution.standing.weak_spring_continuation import Outcome, Weakening
from tests.line import BLOCK, HEAD, WALL, line_of, verified
from tests.solution.failing_solver import said

NON_ASSOCIATIVE = "analysis.flow_rule=non_associative"

FERRIS_3 = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall:
      material: stone
      unit: [0.4, 0.2, 0.175]
      length: 1.6
      courses: 11
      openings: [{from: [0.6, 0.525], to: [1.0, 1.4]}]
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)
"""Wall 3 of Ferris and Tin-Loi 2001 (Int. J. Mech. Sci. 43, 209-224)."""


def solved(text: str, *overrides: str, case: int = 0) -> tuple[float, Solution, Checks]:
    """Load factor of a case that must be solved, and that must fit the exact law far better than is asked."""
    solution, checks, status = verified(line_of(text, *overrides, case=case))
    assert status is Status.SOLVED, (status, solution.reason, checks.failures)
    assert solution.mechanics is not None
    assert checks.complementarity_residual < 1e-9
    assert checks.yield_violation < 1e-9
    assert checks.equilibrium_residual < 1e-9
    return solution.mechanics.load_factor, solution, checks


def test_a_sliding_block_does_not_lift() -> None:
    factor, solution, _ = solved(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5")
    assert factor == pytest.approx(0.5, rel=1e-9)
    assert solution.mechanics is not None
    assert solution.mechanics.contact_velocities[:, 0] == pytest.approx(0, abs=1e-12)


@pytest.mark.parametrize("angle", [0, 25, 45, 70])
def test_sliding_strength_is_the_same_in_every_direction(angle: float) -> None:
    direction = f"[{math.cos(math.radians(angle))!r}, {math.sin(math.radians(angle))!r}, 0]"
    live = f"load_cases.push.live=[{{acceleration: {direction}}}]"
    factor, _, _ = solved(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.3", "parameters.mu=0.4", live)
    assert factor == pytest.approx(0.4, rel=1e-8)


def test_cohesion_is_kept_while_sliding() -> None:
    factor, _, _ = solved(BLOCK, NON_ASSOCIATIVE, "parameters.h=0.5", "parameters.c=1000")
    assert factor == pytest.approx(0.5 + 1000 / (0.5 * 2000 * 9.81), rel=1e-9)


def test_a_wedge_in_a_groove_slides_along_it() -> None:
    """mu / cos b without dilatancy; with it the wedge locks: mu / sqrt(cos^2 b - mu^2 sin^2 b)."""
    b, mu = math.radians(30), 0.5
    text = HEAD + (
        f"joints: {{dry: {{friction: {mu}}}}}\n"
        "blocks:\n"
        "  - polyhedron:\n"
        "      material: stone\n"
        f"      vertices: [[0, 0, 0], [4, 0, 0], [0, -1, {math.tan(b)!r}], [0, 1, {math.tan(b)!r}],\n"
        f"                 [4, -1, {math.tan(b)!r}], [4, 1, {math.tan(b)!r}]]\n"
        "      faces: [[0, 2, 3], [1, 4, 5], [0, 1, 4, 2], [0, 1, 5, 3], [2, 3, 5, 4]]\n"
        "supports:\n"
        f"  - ground: {{point: [0, 0, 0], normal: [0, {math.sin(b)!r}, {math.cos(b)!r}]}}\n"
        f"  - ground: {{point: [0, 0, 0], normal: [0, {-math.sin(b)!r}, {math.cos(b)!r}]}}\n"
        "load_cases: {along: {live: [{acceleration: [1, 0, 0]}]}}\n"
    )
    factor, solution, _ = solved(text)
    assert factor == pytest.approx(mu / math.cos(b), rel=1e-6)
    assert solution.associative is not None
    locked = mu / math.sqrt(math.cos(b) ** 2 - (mu * math.sin(b)) ** 2)
    assert solution.associative.load_factor == pytest.approx(locked, rel=1e-6)


def test_wall_with_an_opening_gives_the_published_factor() -> None:
    """MPEC of 2001: 0.356, with 13 % between it and the associative factor; the published scheme ends at 0.373."""
    factor, solution, _ = solved(FERRIS_3)
    assert factor == pytest.approx(0.35582, abs=2e-5)
    assert solution.associative is not None
    assert solution.associative.load_factor == pytest.approx(0.403694, abs=1e-6)
    assert {program.kind for program in solution.programs} == {
        "range, lower",
        "range, upper",
        "associative",
        "gravity",
        "exact step",
    }


@pytest.mark.parametrize(
    "overrides",
    [
        ("units.length=mm", "blocks.0.wall.unit=[400, 200, 175]", "blocks.0.wall.length=2400"),
        ("materials.stone.density=2e-3",),
        ("materials.stone.density=2e9",),
    ],
)
def test_the_factor_does_not_know_units(overrides: tuple[str, ...]) -> None:
    here, _, _ = solved(WALL, NON_ASSOCIATIVE, "parameters.n=6")
    there, _, _ = solved(WALL, NON_ASSOCIATIVE, "parameters.n=6", *overrides)
    assert there == pytest.approx(here, rel=1e-6)


def test_steps_that_may_not_go_on_say_how_far_they_came() -> None:
    solution, _, status = verified(line_of(FERRIS_3, "analysis.scheme=proximal", "analysis.proximal={max_programs: 1}"))
    assert status in (Status.APPROXIMATE, Status.NOT_VERIFIED)
    assert "did not converge in 1 iterations" in solution.reason


def test_a_step_cut_short_by_the_time_limit_is_no_failure_of_the_scheme() -> None:
    """A step that ends at the deadline is given up by its solver without a word of the time."""
    line = line_of(WALL, "parameters.n=3")
    settings = SolverSettings(1e-8)
    associative = solve_associative(line.program, settings, lambda record: None)
    stepper = Stepper(stiffness_of(line.program), np.zeros(line.program.n_points), settings, lambda record: None)
    run = ProximalRun(stepper, list(associative.programs))
    anchor = gravity_state(run)
    assert isinstance(anchor, np.ndarray)
    run.stepper = replace(stepper, settings=replace(settings, deadline=0.0))
    assert steps_from(run, anchor, 10).status is Status.TIME_LIMIT


def test_a_step_beyond_the_time_limit_is_the_last(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is made, and the best state so far is kept."""
    program = line_of(FERRIS_3).program
    settings = SolverSettings(1e-8, deadline=time.monotonic() + 1e6)
    run = ProximalRun(
        Stepper(stiffness_of(program), np.zeros(program.n_points), settings, lambda record: None), records=[]
    )
    anchor = gravity_state(run)
    assert isinstance(anchor, np.ndarray)
    clock = SimpleNamespace(monotonic=lambda: math.inf, perf_counter=time.perf_counter)
    monkeypatch.setattr(proximal, "time", clock)
    result = steps_from(run, anchor, 10)
    assert result.status is Status.TIME_LIMIT
    assert len(run.states) == 1
    assert result.state is run.states[0]


@pytest.mark.parametrize(
    ("said_to_be", "status"),
    [
        (Status.NO_EQUILIBRIUM, Status.NOT_VERIFIED),
        (Status.UNBOUNDED, Status.NOT_VERIFIED),
        (Status.ITERATION_LIMIT, Status.ITERATION_LIMIT),
    ],
)
def test_without_a_gravity_state_the_scheme_does_not_begin(
    said_to_be: Status, status: Status, monkeypatch: pytest.MonkeyPatch
) -> None:
    """No springs say whether the block stands, and the solver says that nothing carries it."""
    program, settings = line_of(BLOCK).program, SolverSettings(1e-8)
    associative = solve_associative(program, settings, lambda record: None)
    undecided = replace(associative, stress_free=Weakening(Outcome.UNDECIDED, None, np.nan, ""))
    monkeypatch.setattr(standing, "interior_point_solver", said(said_to_be))
    result = solve_proximal(program, undecided, 10, settings, lambda record: None)
    assert result.status is status
    assert result.state is None
    assert f"program {len(result.programs)} of the sequence ended without a solution" in result.reason


def run_with(residuals: list[float], factors: list[float], wanted: float = 1e-8) -> ProximalRun:
    """A run that has come to some states of a block."""
    program = line_of(BLOCK).program
    settings = SolverSettings(1e-8, residual=wanted)
    stepper = Stepper(stiffness_of(program), np.zeros(program.n_points), settings, lambda record: None)
    associative = solve_associative(program, settings, lambda record: None)
    assert associative.state is not None
    made = zip(residuals, factors, strict=True)
    states = [replace(associative.state, residual=residual, load_factor=factor) for residual, factor in made]
    return ProximalRun(stepper, [], states)


@pytest.mark.parametrize(("peak", "remarked"), [(0.506, True), (0.504, False)])
def test_a_peak_that_was_passed_is_remarked_on(peak: float, remarked: bool) -> None:
    """By more than a hundredth of it."""
    run = run_with([1e-12], [0.5])
    live = run.program.scaling.live
    run.peak = peak
    result = proximal.finished(run, "")
    assert result.status is Status.SOLVED
    assert [remark.identifier for remark in result.remarks] == ["below-passed-load"] * remarked
    assert all(f"{peak * live:.6g}" in remark for remark in result.remarks)


@pytest.mark.parametrize(("seen", "status"), [(1e-7, Status.SOLVED), (5e-5, Status.SOLVED), (5e-4, Status.APPROXIMATE)])
def test_a_rough_state_is_solved_within_the_residual_of_a_warning(
    seen: float, status: Status, monkeypatch: pytest.MonkeyPatch
) -> None:
    run = run_with([seen], [0.5], wanted=1e-3)
    monkeypatch.setattr(proximal, "residual_with_closing", lambda *arguments: seen)
    result = proximal.rough_result(run.program, 0.0, run.states[0], 1e-3, ())
    words = f"residual {seen:.2g}, within the requested 0.001"
    assert result.status is status
    assert (words in " ".join(result.remarks)) is (seen == 5e-5)
    assert (words in result.reason, result.tolerance_requested) == ((True, 1e-3) if seen == 5e-4 else (False, None))


SLENDER = (
    HEAD
    + """\
joints: {dry: {friction: 0.65}}
blocks:
  - wall: {material: stone, unit: [0.4, 0.2, 0.175], length: 2.0, courses: 10}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
"""
)

FAR = """\
  - wall:
      material: stone
      unit: [2.0, 2.0, 0.875]
      length: 8.0
      courses: 3
      transform: {translate: [1000, 0, 0]}
supports:"""
"""A wall of units five times as large, out of reach of the slender one, that collapses later."""


def test_a_part_comes_to_rest_where_it_does_alone() -> None:
    """The fixed point depends on the size of the steps; that must not follow from parts that cannot interact.

    Where the unit of the load factor was that of the whole model, the second wall moved the fixed point by 2e-5.
    """
    alone, _, _ = solved(SLENDER, NON_ASSOCIATIVE)
    beside, _, _ = solved(SLENDER.replace("supports:", FAR), NON_ASSOCIATIVE)
    assert beside == pytest.approx(alone, rel=1e-9)
