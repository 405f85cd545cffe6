"""Rays that prove a cone program infeasible or unbounded, checked by hand."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.solution.solution import Status
from tests.line import BLOCK, line_of
from tests.solution.cone_solvers.interior_point.held_programs import held, least_in_cones, small, wall


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
