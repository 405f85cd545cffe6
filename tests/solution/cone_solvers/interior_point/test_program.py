"""Cone programs with known answers, and how runs end."""

from __future__ import annotations

import time
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from mbla.errors import SolverError
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.cone_solvers.interior_point.condensation import Condensation
from mbla.solution.cone_solvers.interior_point.cones import ConeProduct, NesterovToddScaling, cone_data
from mbla.solution.cone_solvers.interior_point.iterates import Ended, IterationControl, Outcome
from mbla.solution.cone_solvers.interior_point.method import solve_cone_program
from mbla.solution.cone_solvers.interior_point.program import CondensedProgram, fits
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import IterationRecord, Status
from tests.line import BLOCK, line_of
from tests.solution.cone_solvers.interior_point.programs import Known, held, known_program, least_in_cones, small, wall

quick = settings(max_examples=25, derandomize=True)

seeds = st.integers(0, 2**32 - 1)

RUN = IterationControl(1e-9, 100, None, lambda number, measures, length: None)


def kinematic(seed: int, quadratic: bool) -> Known:
    rng = np.random.default_rng(seed)
    product = ConeProduct(int(rng.integers(0, 12)), int(rng.integers(6, 12)))
    return known_program(rng, int(rng.integers(4, 13)), int(rng.integers(0, 4)), product, quadratic)


@pytest.mark.parametrize("quadratic", [False, True], ids=["linear", "quadratic"])
@quick
@given(seed=seeds)
def test_programs_made_around_a_solution_give_its_value(seed: int, quadratic: bool) -> None:
    """Some end at 1.02e-9 instead of 1e-9 and say so: the value is as good."""
    known = kinematic(seed, quadratic)
    solution = held(known.program).solve(1, 1.0)
    assert solution.status in (Status.SOLVED, Status.APPROXIMATE), solution.verdict
    size = 1.0 + abs(known.optimum)
    assert solution.objective == pytest.approx(known.optimum, abs=1e-7 * size)
    program = known.program
    bent = 0.0 if program.quadratic is None else program.quadratic * solution.x
    stationary = program.cost + bent + program.matrix.T @ solution.z
    assert np.abs(stationary).max() <= 1e-7 * (1.0 + np.abs(solution.z).max() + np.abs(program.cost).max())
    slack = program.rhs - program.matrix @ solution.x
    assert np.abs(slack[: program.n_equations]).max(initial=0.0) <= 1e-7 * (1.0 + np.abs(solution.x).max())
    cones = ConeVectors.of(program)
    assert least_in_cones(program, solution.z[program.n_equations :]) >= 0.0
    assert least_in_cones(program, slack[program.n_equations :]) >= -1e-7 * (1.0 + np.abs(slack).max())
    assert abs(slack @ solution.z) <= 1e-6 * size * len(cones.sizes)


@quick
@given(a=st.floats(-5.0, 5.0), b=st.floats(-5.0, 5.0), radius=st.floats(0.1, 10.0))
def test_a_linear_function_over_a_disc(a: float, b: float, radius: float) -> None:
    """min a x + b y, x² + y² ≤ r²: −r √(a² + b²)."""
    program = small([a, b, 0.0], [[0, 0, 1.0], [0, 0, -1.0], [-1.0, 0, 0], [0, -1.0, 0]], [radius, 0, 0, 0], 0, 1)
    solution = held(program).solve(1, 1.0)
    assert solution.status is Status.SOLVED
    assert solution.objective == pytest.approx(-radius * np.hypot(a, b), abs=1e-7 * (1.0 + radius))


@quick
@given(target=st.lists(st.floats(-3.0, 3.0), min_size=2, max_size=5))
def test_the_projection_on_a_simplex(target: list[float]) -> None:
    """min ½‖x − t‖², Σ x = 1, x ≥ 0: max(t − θ, 0), found by sorting."""
    t = np.array(target)
    n = len(t)
    program = replace(
        small((-t).tolist(), [[1.0] * n, *(-np.eye(n)).tolist()], [1.0, *[0.0] * n], n), quadratic=np.ones(n)
    )
    ordered = np.sort(t)[::-1]
    theta = (np.cumsum(ordered) - 1.0) / np.arange(1, n + 1)
    expected = np.maximum(t - theta[np.flatnonzero(ordered > theta)[-1]], 0.0)
    solution = held(program).solve(1, 1.0)
    assert solution.status is Status.SOLVED
    np.testing.assert_allclose(solution.x, expected, atol=1e-4)
    assert solution.objective == pytest.approx(0.5 * expected @ expected - t @ expected, abs=1e-7)


def test_strengths_far_beyond_the_weights_leave_the_answer_alone() -> None:
    """Costs of 1e8 beside loads of 1: the first motions looked like rays along which the cost falls without end."""
    text = BLOCK.replace("tensile_strength", "compressive_strength: 1.e+13, tensile_strength")
    line = line_of(text, "parameters.mu=0.3", "parameters.h=0.5")
    program = kinematic_form(line.program, line.program.limits).cone_program
    assert np.abs(program.cost).max() > 1e7
    solution = held(program).solve(1, 1.0)
    assert solution.status in (Status.SOLVED, Status.APPROXIMATE), solution.verdict
    assert line.program.scaling.load_factor(solution.objective) == pytest.approx(0.3, rel=1e-5)


def test_a_deadline_that_has_passed_ends_the_run() -> None:
    solution = held(wall(), deadline=time.monotonic() - 1.0).solve(1, 1.0)
    assert solution.status is Status.TIME_LIMIT
    assert np.isfinite(solution.x).all()


def test_the_limit_of_iterations_is_kept() -> None:
    log: list[IterationRecord] = []
    solution = held(wall(), log, max_iterations=4).solve(1, 1.0)
    assert solution.status is Status.ITERATION_LIMIT
    assert solution.iterations == 4
    assert len(log) == 5


def test_every_iteration_is_logged_once() -> None:
    log: list[IterationRecord] = []
    solution = held(wall(), log).solve(7, 2.0)
    assert [record.iteration for record in log] == list(range(solution.iterations + 1))
    assert {record.program for record in log} == {7}
    assert log[-1].load_factor == pytest.approx(2.0 * solution.objective, rel=1e-12)
    assert max(log[-1].gap, log[-1].primal_residual, log[-1].dual_residual) <= 1e-9


def test_what_the_log_raises_arrives() -> None:
    def log(record: IterationRecord) -> None:
        if record.iteration == 2:
            raise OSError("disk full")

    with pytest.raises(OSError, match="disk full"):
        CondensedProgram(wall(), SolverSettings(1e-9, solver="mbla"), log).solve(1, 1.0)


@pytest.mark.parametrize("part", ["cost", "rhs"])
def test_an_update_gives_the_answer_of_a_new_program(part: str) -> None:
    program = wall()
    solver = held(program)
    first = solver.solve(1, 1.0)
    change = {part: 2.0 * getattr(program, part)}
    solver.update(**change)
    again, fresh = solver.solve(2, 1.0), held(replace(program, **change)).solve(1, 1.0)
    assert (again.status, fresh.status) == (Status.SOLVED, Status.SOLVED)
    assert again.objective == pytest.approx(fresh.objective, rel=1e-8)
    assert again.objective == pytest.approx(2.0 * first.objective, rel=1e-8)


def test_an_update_may_take_the_solution_away_and_bring_it_back() -> None:
    """What is remembered of the first program must not pass for an answer of the next."""
    feasible, missed = np.array([2.0, 3.0, 0.0]), np.array([2.0, 1.0, 0.0])
    solver = held(small([1.0, 1.0], [[1.0, 0.0], [1.0, 0.0], [0.0, -1.0]], feasible.tolist(), 2))
    assert solver.solve(1, 1.0).objective == pytest.approx(2.0)
    solver.update(rhs=missed)
    assert solver.solve(2, 1.0).status is Status.UNBOUNDED
    solver.update(rhs=feasible)
    assert solver.solve(3, 1.0).objective == pytest.approx(2.0)


@pytest.mark.parametrize("part", ["cost", "matrix", "rhs", "quadratic"])
@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_numbers_that_are_not_finite_are_refused(part: str, value: float) -> None:
    program = replace(wall(), quadratic=np.ones(wall().matrix.shape[1]))
    if part == "matrix":
        spoiled = program.matrix.copy()
        spoiled.data[0] = value
        program = replace(program, matrix=spoiled)
    else:
        vector = getattr(program, part).copy()
        vector[0] = value
        program = replace(program, **{part: vector})
    with pytest.raises(SolverError, match="not finite"):
        held(program).solve(1, 1.0)


def test_the_best_iterate_is_kept_where_the_method_breaks_down() -> None:
    data = cone_data(wall())

    class Failing(Condensation):
        """Breaks down after as many factorisations."""

        left = 8

        def factorize(self, scaling: NesterovToddScaling) -> bool:
            self.left -= 1
            return self.left >= 0 and super().factorize(scaling)

    seen: list[float] = []
    run = IterationControl(1e-9, 100, None, lambda number, measures, length: seen.append(measures.worst))
    condensation = Failing(data, "qdldl")
    ended: Ended = solve_cone_program(data, condensation, run)
    assert ended.outcome is Outcome.NUMERICAL
    assert ended.measures.worst == min(seen)
    nothing = Failing(data, "qdldl")
    nothing.left = 0
    at_once = solve_cone_program(data, nothing, run)
    assert at_once.outcome is Outcome.NUMERICAL
    assert np.isfinite(at_once.point.x).all()


def test_a_program_of_another_shape_does_not_fit() -> None:
    program = wall()
    assert fits(program)
    assert not fits(replace(program, n_half_lines=0, n_cones=0))


# --- Rays that prove a program infeasible or unbounded, checked by hand ---------------------------------------------


def infeasible_by(program: ConeProgram, z: np.ndarray) -> float:
    """How small the ray's own error is beside what it proves: every admissible x is larger than the inverse."""
    assert least_in_cones(program, z[program.n_equations :]) >= 0.0
    assert program.rhs @ z < 0.0
    return float(np.abs(program.matrix.T @ z).max() / -(program.rhs @ z))


def unbounded_by(program: ConeProgram, x: np.ndarray) -> float:
    """Likewise of a motion in which the cost falls without end: how far it leaves the cones, beside the cost."""
    assert program.cost @ x < 0.0
    away = -(program.matrix @ x)
    outside = max(0.0, -least_in_cones(program, away[program.n_equations :]))
    return max(outside, float(np.abs(away[: program.n_equations]).max(initial=0.0))) / float(-(program.cost @ x))


@pytest.mark.parametrize("distance", [1e-3, 1.0, 1e3])
def test_an_infeasible_program_comes_with_the_ray_that_proves_it(distance: float) -> None:
    """x = 1 and x ≤ 1 − d."""
    program = small([1.0, 1.0], [[1.0, 0.0], [1.0, 0.0], [0.0, -1.0]], [1.0, 1.0 - distance, 0.0], 2)
    solution = held(program).solve(1, 1.0)
    assert solution.status is Status.UNBOUNDED, solution.verdict
    assert infeasible_by(program, solution.z) < 1e-6


def test_a_cone_that_an_equation_misses() -> None:
    """(1, x, y) in the cone and x = 2."""
    program = small([0.0, 1.0], [[1.0, 0.0], [0.0, 0.0], [-1.0, 0.0], [0.0, -1.0]], [2.0, 1.0, 0.0, 0.0], 0, 1)
    solution = held(program).solve(1, 1.0)
    assert solution.status is Status.UNBOUNDED
    assert infeasible_by(program, solution.z) < 1e-6


@pytest.mark.parametrize("slope", [1e-3, 1.0, 1e3])
def test_an_unbounded_program_comes_with_the_ray_that_proves_it(slope: float) -> None:
    """min −k y, x = 1, y ≥ 0, and with a cone beside."""
    rows = [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0], [0.0, 0.0, 0.0]]
    program = small([0.0, -slope, 0.0], rows, [1.0, 0.0, 1.0, 0.0, 0.0], 1, 1)
    solution = held(program).solve(1, 1.0)
    assert solution.status is Status.NO_EQUILIBRIUM, solution.verdict
    assert unbounded_by(program, solution.x) < 1e-6


def test_a_block_that_is_pushed_into_the_ground_and_one_that_falls() -> None:
    """Of the structures themselves; the clamped one by self-stress, the other by its own motion."""
    line = line_of(BLOCK, "load_cases.push.live=[{acceleration: [0, 0, -1]}]")
    locked = kinematic_form(line.program, line.program.limits).cone_program
    solution = held(locked).solve(1, 1.0)
    assert solution.status is Status.UNBOUNDED
    assert infeasible_by(locked, solution.z) < 1e-6
    line = line_of(BLOCK, "load_cases.push.dead=[{gravity: [0, 0, 9.81]}]")
    falling = kinematic_form(line.program, line.program.limits).cone_program
    solution = held(falling).solve(1, 1.0)
    assert solution.status is Status.NO_EQUILIBRIUM
    assert unbounded_by(falling, solution.x) < 1e-6


def test_a_huge_vector_beside_which_the_work_vanishes_proves_nothing() -> None:
    """Friction of a million: self-stress so large that what it leaves over looked small (infeasible was the verdict).

    A slender block of width 1 and height 2 rocks at half its weight, however rough the ground is.
    """
    for mu in (1e3, 1e6):
        program = wall("parameters.n=2", f"parameters.mu={mu!r}")
        solution = held(program).solve(1, 1.0)
        assert solution.status is not Status.UNBOUNDED, (mu, solution.verdict)
    block = line_of(BLOCK, "parameters.mu=1e6")
    form = kinematic_form(block.program, block.program.limits)
    factor = block.program.scaling.load_factor(held(form.cone_program).solve(1, 1.0).objective)
    assert factor == pytest.approx(0.5, rel=1e-5)
