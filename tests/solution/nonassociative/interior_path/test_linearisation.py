"""Newton step and tangent against differences of the residuals, at contacts of every kind."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path import linearisation
from mbla.solution.nonassociative.interior_path.central_path import (
    CentralPath,
    PathVector,
    central_path,
    first_point,
    residuals,
)
from mbla.solution.nonassociative.interior_path.condensed_matrix import Factors, factorise, matrix_map
from mbla.solution.nonassociative.interior_path.linearisation import linear_step
from tests.solution.nonassociative.interior_path.structures import flat, mixed_program


def left_of(path: CentralPath, point: PathVector) -> FloatArray:
    left = residuals(path, point)
    return flat(left.balance, left.power, left.kinematic, left.opening, left.crushing, left.slip_size, left.slip)


def somewhere(path: CentralPath, seed: int) -> PathVector:
    """A point near the first one, inside the law but off the path."""
    point, rng = first_point(path), np.random.default_rng(seed)
    size = 0.05 * np.exp(point.log_sigma)
    slip = np.where(path.frictional[:, None], size * rng.normal(size=point.slip.shape), 0.0)
    shear = np.where(path.frictional[:, None], 0.05 * rng.normal(size=point.slip.shape), 0.0)
    change = PathVector(
        rng.normal(size=len(point.velocities)), 0.1, np.column_stack([0.1 * rng.normal(size=4), shear]),
        0.1 * point.opening, -0.1 * point.crushing, 0.1 * np.where(path.frictional, point.slip_size, 0.0), slip, 0.1,
    )  # fmt: skip
    return point.plus(change)


@pytest.mark.parametrize("components", [2, 3])
@pytest.mark.parametrize("kappa", [0.0, 5.0])
def test_the_tangent_keeps_the_residuals(components: int, kappa: float) -> None:
    """d residual / d ln σ along the tangent is zero: central differences, relative to the change of each block."""
    program = mixed_program(components)
    path = central_path(program, 0.2, 1, np.full((4, components), 0.3), kappa)
    point = somewhere(path, 2)
    linear = linear_step(path, matrix_map(program), point, residuals(path, point))
    assert linear is not None
    h = 1e-5
    slope = (left_of(path, point.plus(linear.tangent, h)) - left_of(path, point.plus(linear.tangent, -h))) / (2 * h)
    assert np.abs(slope).max() < 1e-7


@pytest.mark.parametrize("components", [2, 3])
@pytest.mark.parametrize("kappa", [0.0, 5.0])
def test_the_newton_step_removes_the_residuals(components: int, kappa: float) -> None:
    """d residual / dh along the step is minus the residual, and a tenth of a step leaves nine tenths of it."""
    program = mixed_program(components)
    path = central_path(program, 0.2, 1, np.full((4, components), 0.3), kappa)
    point = somewhere(path, 3)
    left = left_of(path, point)
    linear = linear_step(path, matrix_map(program), point, residuals(path, point))
    assert linear is not None
    assert linear.newton.log_sigma == 0.0
    h = 1e-5
    slope = (left_of(path, point.plus(linear.newton, h)) - left_of(path, point.plus(linear.newton, -h))) / (2 * h)
    assert slope == pytest.approx(-left, abs=1e-7 * float(np.abs(left).max()))


def test_the_bordered_matrix_and_the_sign_of_its_determinant() -> None:
    """Against the dense matrix [A C Aᵀ, −f_L; f_Lᵀ, 0], for random unsymmetric C of both signs of the determinant."""
    program, rng = mixed_program(), np.random.default_rng(0)
    matrix, live = program.equilibrium_matrix.toarray(), program.live_load[:, None]
    signs = set()
    for _ in range(12):
        tangents = rng.normal(size=(4, 3, 3))
        blocks = np.zeros((12, 12))
        for k in range(4):
            blocks[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] = tangents[k]
        dense = np.block([[matrix @ blocks @ matrix.T, -live], [live.T, np.zeros((1, 1))]])
        factors = factorise(matrix_map(program), tangents)
        assert factors is not None
        right = rng.normal(size=(7, 2))
        assert factors.solve(right) == pytest.approx(np.linalg.solve(dense, right), rel=1e-6, abs=1e-8)
        assert factors.sign() == np.linalg.slogdet(dense)[0]
        signs.add(factors.sign())
    assert signs == {-1.0, 1.0}


def test_a_matrix_that_is_not_finite_has_no_factors() -> None:
    program = mixed_program()
    assert factorise(matrix_map(program), np.full((4, 3, 3), np.nan)) is None


@pytest.mark.parametrize("cause", ["singular", "not finite"])
def test_without_an_answer_there_is_no_step(cause: str, monkeypatch: pytest.MonkeyPatch) -> None:
    program = mixed_program()
    path = central_path(program, 0.2, 1, None, 0.0)
    point = somewhere(path, 2)
    if cause == "singular":
        monkeypatch.setattr(linearisation, "factorise", lambda *arguments: None)
    else:
        monkeypatch.setattr(Factors, "solve", lambda factors, right: np.full_like(right, np.inf))
    assert linear_step(path, matrix_map(program), point, residuals(path, point)) is None
