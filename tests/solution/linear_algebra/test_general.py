"""Factorisations of matrices that are not symmetric: against a dense solution, with every library that is there."""

from __future__ import annotations

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.errors import SolverError
from mbla.solution.linear_algebra import general
from mbla.solution.linear_algebra.general import GeneralFactorization
from mbla.solution.linear_algebra.mkl import mkl_works

LIBRARIES = ["superlu", pytest.param("pardiso", marks=pytest.mark.skipif(not mkl_works(), reason="MKL is not there"))]


def chain(seed: int) -> sp.csc_matrix:
    """Blocks of six on a chain, far from symmetric, the last row and column a border with no diagonal."""
    rng, n = np.random.default_rng(seed), 60
    near = np.abs(np.subtract.outer(np.arange(n) // 6, np.arange(n) // 6)) <= 1
    inner = np.where(near, rng.normal(size=(n, n)), 0.0) + 20.0 * np.eye(n)
    border = rng.normal(size=n)
    return sp.csc_matrix(np.block([[-inner, border[:, None]], [border[None, :], np.zeros((1, 1))]]) + 0.0)


def pattern_of(matrix: sp.csc_matrix) -> tuple[np.ndarray, np.ndarray]:
    return matrix.indptr.astype(np.int32), matrix.indices.astype(np.int32)


@pytest.mark.parametrize("library", LIBRARIES)
def test_matrices_of_one_pattern_one_after_the_other(library: str) -> None:
    factors, rhs = GeneralFactorization(*pattern_of(chain(0)), library), np.arange(61.0)
    assert factors.library == library
    for seed in range(3):
        matrix = chain(seed)
        solve = factors.factorize(matrix)
        assert solve is not None
        assert solve(rhs) == pytest.approx(np.linalg.solve(matrix.toarray(), rhs), rel=1e-9, abs=1e-11)


@pytest.mark.parametrize("library", LIBRARIES)
def test_a_singular_matrix_and_one_that_is_not_finite_have_no_factors(library: str) -> None:
    matrix = chain(1)
    factors = GeneralFactorization(*pattern_of(matrix), library)
    for value in (0.0, np.nan):
        broken = matrix.copy()
        broken.data[broken.indptr[7] : broken.indptr[8]] = value
        assert factors.factorize(broken) is None


@pytest.mark.skipif(not mkl_works(), reason="MKL is not there")
def test_factors_that_are_gone_are_not_used() -> None:
    """Pardiso holds the factors of one matrix."""
    factors = GeneralFactorization(*pattern_of(chain(1)), "pardiso")
    first = factors.factorize(chain(1))
    factors.factorize(chain(2))
    assert first is not None
    with pytest.raises(ValueError, match="overwritten"):
        first(np.ones(61))


def test_small_matrices_are_left_to_superlu() -> None:
    assert GeneralFactorization(*pattern_of(chain(1))).library == "superlu"


class Dense:
    """In the place of MKL: dense factors, and none of a matrix whose first entry is zero."""

    def __init__(self, runtime: object, n: int, pointers: np.ndarray, indices: np.ndarray, kind: object) -> None:
        self.n, self.pointers, self.indices, self.analysed = n, pointers, indices, False
        self.matrix = np.zeros((n, n))

    def analyse(self) -> None:
        self.analysed = True

    def factorize(self, data: np.ndarray) -> bool:
        assert self.analysed
        self.matrix = sp.csc_array((data, self.indices, self.pointers), shape=(self.n, self.n)).toarray()
        return bool(data[0] != 0.0)

    def solve(self, rhs: np.ndarray) -> np.ndarray:
        return np.asarray(np.linalg.solve(self.matrix, rhs))


def test_factors_of_pardiso_hold_until_the_next_and_superlu_steps_in(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(general, "mkl_library", object)
    monkeypatch.setattr(general, "mkl_works", lambda: True)
    monkeypatch.setattr(general, "Pardiso", Dense)
    factors, rhs = GeneralFactorization(*pattern_of(chain(0)), "pardiso"), np.arange(61.0)
    first = factors.factorize(chain(1))
    assert first is not None
    assert first(rhs) == pytest.approx(np.linalg.solve(chain(1).toarray(), rhs), rel=1e-9, abs=1e-11)
    other = chain(2)
    other.data[0] = 0.0
    second = factors.factorize(other)
    assert second is not None
    assert second(rhs) == pytest.approx(np.linalg.solve(other.toarray(), rhs), rel=1e-9, abs=1e-11)
    with pytest.raises(ValueError, match="overwritten"):
        first(rhs)


def test_pardiso_cannot_be_had_where_mkl_is_not(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(general, "mkl_library", lambda: None)
    with pytest.raises(SolverError, match="MKL is not installed"):
        GeneralFactorization(*pattern_of(chain(0)), "pardiso")
