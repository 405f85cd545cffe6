"""SuperLU, always there: for matrices that need not be symmetric or definite, and as a factorisation of definite ones.

Symmetric matrices that are definite up to a border (regularised normal equations with one row and column
more) are factorised on their diagonal, in an ordering by minimum degree: without exchanges of rows their factors stay
sparse.

Definite matrices of one pattern have their order found once. SuperLU computes both triangles, but by panels of columns
that stay in the processor's cache, where qdldl goes row by row. On its diagonal a definite matrix leaves the pivots of
L D Lᵀ; they are looked at, which takes a copy of the factors.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.pattern import SymmetricPattern
from mbla.solution.linear_algebra.qdldl_factors import elimination_order

Solve = Callable[[FloatArray], FloatArray]

ON_THE_DIAGONAL = {"permc_spec": "MMD_AT_PLUS_A", "options": {"SymmetricMode": True, "DiagPivotThresh": 0.0}}
WITH_EXCHANGES = {"permc_spec": "COLAMD"}

PIVOT_THRESHOLD = 0.01
"""A diagonal pivot is taken unless it is smaller than this share of the largest one in its column: keeps the order."""

SUBTREE = 6
"""Columns at most of a subtree that is factorised as one. The rows of a block stand together anyhow; with the usual ten
and more, neighbours are padded with zeros."""


def factorize(matrix: sp.sparray, *, symmetric: bool = False) -> Solve | None:
    """Solver of matrix y = rhs, None where the matrix is exactly singular.

    symmetric : the matrix is symmetric, definite up to a border, and scaled to a diagonal of about 1
    """
    held = sp.csc_matrix(matrix)
    for settings in (ON_THE_DIAGONAL, WITH_EXCHANGES) if symmetric else (WITH_EXCHANGES,):
        try:
            solve = _solver(spla.splu(held, **settings))
        except RuntimeError:  # exactly singular
            continue
        if np.isfinite(solve(np.ones(held.shape[0]))).all():
            return solve
    return None


def factors_on_the_diagonal(matrix: sp.csc_matrix | sp.csc_array, threshold: float) -> spla.SuperLU | None:
    """Factors of a matrix of symmetric pattern in the order of elimination; None where it is exactly singular.

    threshold : a diagonal pivot is taken unless it is smaller than this share of the largest one in its column
    """
    options = {"SymmetricMode": True}
    held = matrix if isinstance(matrix, sp.csc_array) else sp.csc_array(matrix)
    try:
        factors = spla.splu(held, permc_spec="NATURAL", diag_pivot_thresh=threshold, relax=SUBTREE, options=options)
    except RuntimeError:
        return None
    return factors


def negative_pivots(matrix: sp.sparray) -> int | None:
    """How many pivots of a symmetric matrix on its diagonal are negative; None where that breaks down.

    By Sylvester's law of inertia so many of its eigenvalues are negative. No row is exchanged: a pivot next to nothing
    is as likely to have the wrong sign as the right one.
    """
    held = sp.csc_array(matrix)
    order = elimination_order(sp.csc_array(abs(held) + sp.eye_array(held.shape[0])))
    factors = factors_on_the_diagonal(sp.csc_array(held[order][:, order]), 0.0)
    if factors is None or not np.array_equal(factors.perm_r, factors.perm_c):
        return None
    pivots = factors.U.diagonal()
    return int((pivots < 0.0).sum()) if np.isfinite(pivots).all() else None


def _solver(factors: spla.SuperLU) -> Solve:
    def solve(rhs: FloatArray) -> FloatArray:
        return np.asarray(factors.solve(rhs))

    return solve


class SuperluFactors:
    """Factors of matrices of one pattern; see ``Factorization``."""

    library = "superlu"

    def __init__(self, pattern: SymmetricPattern) -> None:
        n_entries = len(pattern.indices)
        self._order = elimination_order(pattern.matrix(np.ones(n_entries)))
        places = sp.csc_array(pattern.matrix(np.arange(1.0, n_entries + 1.0))[self._order][:, self._order])
        places.sort_indices()
        self._place = places.data.astype(np.int64) - 1
        self._matrix = sp.csc_matrix((np.zeros(len(self._place)), places.indices, places.indptr), shape=places.shape)
        self._factors: spla.SuperLU | None = None

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite.

        values : (nnz,) in the order of the pattern
        """
        self._factors = None
        if not np.isfinite(values).all():
            return False
        np.take(values, self._place, out=self._matrix.data)
        factors = factors_on_the_diagonal(self._matrix, 0.0)
        if factors is None or not _is_definite(factors):
            return False
        self._factors = factors
        return True

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k).

        Raises ValueError without a good factorisation, and where rhs has another number of rows.
        """
        if self._factors is None:
            raise ValueError("solve without a good factorisation")
        if len(rhs) != len(self._order):
            raise ValueError(f"a right-hand side of {len(rhs)} rows for a matrix of {len(self._order)}")
        answer = np.empty(rhs.shape)
        answer[self._order] = self._factors.solve(np.asarray(rhs[self._order], dtype=np.float64))
        return answer


def _is_definite(factors: spla.SuperLU) -> bool:
    """No pivot was taken off the diagonal, and all are positive."""
    pivots = factors.U.diagonal()
    on_diagonal = np.array_equal(factors.perm_r, factors.perm_c)
    return bool(on_diagonal and (pivots > 0.0).all() and np.isfinite(pivots).all())
