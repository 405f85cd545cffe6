from __future__ import annotations

from typing import Any

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.solution.linear_algebra import superlu
from mbla.solution.linear_algebra.superlu import factorize
from tests.solution.linear_algebra.matrices import random_matrix


def bordered(rng: np.random.Generator) -> sp.csc_array:
    """A definite matrix with a border and a zero in its corner."""
    half = random_matrix((40, 60), 0.1, rng)
    definite = half @ half.T + 1e-3 * sp.eye_array(40)
    column = sp.csc_array(rng.normal(size=(40, 1)))
    blocks: list[list[sp.sparray | None]] = [[definite, column], [column.T, None]]
    return sp.csc_array(sp.block_array(blocks))


@pytest.mark.parametrize("symmetric", [True, False])
def test_solves_a_definite_matrix_with_a_border(symmetric: bool) -> None:
    rng = np.random.default_rng(1)
    matrix, rhs = bordered(rng), rng.normal(size=41)
    solve = factorize(matrix, symmetric=symmetric)
    assert solve is not None
    assert matrix @ solve(rhs) == pytest.approx(rhs, abs=1e-9)


def test_what_cannot_be_factorised_on_its_diagonal_is_factorised_with_exchanges() -> None:
    matrix = sp.csc_array(np.array([[0.0, 2.0, 0.0], [2.0, 0.0, 1.0], [0.0, 1.0, 3.0]]))
    solve = factorize(matrix, symmetric=True)
    assert solve is not None
    assert matrix @ solve(np.array([1.0, 2.0, 3.0])) == pytest.approx([1.0, 2.0, 3.0])


@pytest.mark.parametrize("symmetric", [True, False])
def test_a_singular_matrix_has_no_solver(symmetric: bool) -> None:
    assert factorize(sp.csc_array(np.array([[1.0, 1.0], [1.0, 1.0]])), symmetric=symmetric) is None


def test_factors_that_give_no_numbers_are_made_again_with_exchanges(monkeypatch: pytest.MonkeyPatch) -> None:
    matrix, real = sp.csc_array(np.diag([1.0, 2.0])), superlu._solver
    made: list[Any] = []

    def solver(factors: Any) -> Any:
        made.append(factors)
        return (lambda rhs: np.full_like(rhs, np.nan)) if len(made) == 1 else real(factors)

    monkeypatch.setattr(superlu, "_solver", solver)
    solve = superlu.factorize(matrix, symmetric=True)
    assert solve is not None
    assert solve(np.array([1.0, 1.0])) == pytest.approx([1.0, 0.5])
    assert len(made) == 2
    made.clear()
    assert superlu.factorize(matrix) is None
