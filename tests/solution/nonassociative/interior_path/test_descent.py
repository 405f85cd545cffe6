"""Changes of least cost: constraints kept, cost least, products brought down together, the exact law in the end."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path import descent, saddle_matrix
from mbla.solution.nonassociative.interior_path.central_path import central_path, first_point, residuals, state_of
from mbla.solution.nonassociative.interior_path.condensed_matrix import matrix_map
from mbla.solution.nonassociative.interior_path.descent import descend
from mbla.solution.nonassociative.interior_path.products import local_cost, products_at
from mbla.solution.nonassociative.interior_path.saddle_matrix import least_change, saddle_map
from tests.line import WALL, line_of
from tests.solution.nonassociative.interior_path.structures import mixed_program
from tests.solution.nonassociative.interior_path.test_linearisation import somewhere


@pytest.mark.parametrize("components", [2, 3])
def test_the_change_keeps_the_constraints_and_no_other_costs_less(components: int) -> None:
    """Equilibrium, compatibility and power hold after the step; against random changes in their null space."""
    program = mixed_program(components)
    path = central_path(program, 0.2, 1, None, 0.0)
    point = somewhere(path, 4)
    left = residuals(path, point)
    cost = local_cost(path, point, 0.5 * float(np.exp(point.log_sigma)), 0.1)
    change = least_change(path, saddle_map(matrix_map(program)), cost, left)
    assert change is not None
    matrix = program.equilibrium_matrix.toarray()
    balance = matrix @ change.forces.ravel() + change.load_factor * program.live_load
    assert balance == pytest.approx(-left.balance, abs=1e-10)
    assert program.live_load @ change.velocities == pytest.approx(-left.power, abs=1e-10)
    motion = path.velocities_of_points(change.velocities)
    assert change.slacks == pytest.approx(motion - left.kinematic, abs=1e-10)
    assert not change.forces[cost.held].any()

    def cost_of(forces: FloatArray, slacks: FloatArray) -> float:
        z = np.concatenate([forces, slacks], axis=1)
        return float(0.5 * np.einsum("ki,kij,kj", z, cost.hessian, z) + (cost.gradient * z).sum())

    held = cost.held.ravel()
    constraints = np.column_stack([np.where(held, 0.0, matrix), program.live_load])
    free = np.linalg.svd(constraints)[2][np.linalg.matrix_rank(constraints) :]
    free = free[:, :-1] * ~held  # forces in equilibrium with some live load
    still = np.linalg.svd(program.live_load[None, :])[2][1:]
    rng, least = np.random.default_rng(1), cost_of(change.forces, change.slacks)
    for _ in range(30):
        forces = (rng.normal(size=len(free)) @ free).reshape(change.forces.shape)
        slacks = path.velocities_of_points(rng.normal(size=len(still)) @ still)
        for size in (1e-3, -1e-3, 1.0):
            assert cost_of(change.forces + size * forces, change.slacks + size * slacks) >= least - 1e-9 * abs(least)


@pytest.mark.parametrize("components", [2, 3])
def test_products_of_every_kind_come_down_together(components: int) -> None:
    """The block with four different corners: all products small in the end, the state one of the exact law."""
    program = mixed_program(components)
    path, pattern = central_path(program, 0.1, 2, None, 0.0), matrix_map(program)
    points = list(descend(path, pattern, first_point(path), 120))
    best = min(points, key=lambda point: state_of(program, point).residual)
    assert state_of(program, best).residual < 1e-7
    assert products_at(path, best).largest() < 1e-6


def test_a_wall_comes_down_to_the_law_from_far_away() -> None:
    program = line_of(WALL, "parameters.n=3").program
    path = central_path(program, 0.1, 0, None, 0.0)
    residual = [
        state_of(program, point).residual for point in descend(path, matrix_map(program), first_point(path), 150)
    ]
    assert residual[0] > 0.1
    assert min(residual) < 1e-7


@pytest.mark.parametrize("cause", ["not finite", "singular"])
def test_a_descent_ends_where_its_system_breaks_down(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    program = mixed_program()
    path, pattern = central_path(program, 0.1, 2, None, 0.0), matrix_map(program)
    point = first_point(path)
    cost = local_cost(path, point, 0.5, 0.1)
    if cause == "singular":
        monkeypatch.setattr(saddle_matrix, "factorize", lambda *arguments, **named: None)
    else:
        cost = replace(cost, hessian=np.full_like(cost.hessian, np.inf))
        monkeypatch.setattr(descent, "local_cost", lambda *arguments: cost)
    with np.errstate(invalid="ignore", over="ignore"):
        assert least_change(path, saddle_map(pattern), cost, residuals(path, point)) is None
        assert list(descend(path, pattern, point, 10)) == []


@pytest.mark.parametrize("outside", [1, 3])
def test_a_step_that_ends_outside_is_halved(outside: int, monkeypatch: pytest.MonkeyPatch) -> None:
    program = mixed_program()
    path, pattern = central_path(program, 0.1, 2, None, 0.0), matrix_map(program)
    first = first_point(path)
    whole = next(descend(path, pattern, first, 1))
    answers = iter([False] * outside)
    monkeypatch.setattr(descent, "inside", lambda *arguments: next(answers, True))
    shorter = next(descend(path, pattern, first, 1))
    moved = (shorter.load_factor - first.load_factor) / (whole.load_factor - first.load_factor)
    assert moved == pytest.approx(0.5**outside, rel=1e-9)


def test_a_descent_ends_where_every_step_leads_outside(monkeypatch: pytest.MonkeyPatch) -> None:
    program = mixed_program()
    path, pattern = central_path(program, 0.1, 2, None, 0.0), matrix_map(program)
    monkeypatch.setattr(descent, "inside", lambda *arguments: False)
    assert list(descend(path, pattern, first_point(path), 10)) == []
