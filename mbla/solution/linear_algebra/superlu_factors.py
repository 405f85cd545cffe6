"""SuperLU as a factorisation of definite matrices, in a minimum degree order that is found once; always there.

It computes both triangles, but by panels of columns that stay in the processor's cache, where qdldl goes row by row.
On its diagonal a definite matrix leaves the pivots of L D Lᵀ; they are looked at, which takes a copy of the factors.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.elimination_order import elimination_order
from mbla.solution.linear_algebra.pattern import SymmetricPattern
from mbla.solution.linear_algebra.superlu import factors_on_the_diagonal

if TYPE_CHECKING:
    from scipy.sparse.linalg import SuperLU


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
        self._factors: SuperLU | None = None

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite."""
        self._factors = None
        if not np.isfinite(values).all():
            return False
        np.take(values, self._place, out=self._matrix.data)
        factors = factors_on_the_diagonal(self._matrix, 0.0, ordered=True)
        if factors is None or not _is_definite(factors):
            return False
        self._factors = factors
        return True

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k)."""
        if self._factors is None:
            raise ValueError("solve without a good factorisation")
        if len(rhs) != len(self._order):
            raise ValueError(f"a right-hand side of {len(rhs)} rows for a matrix of {len(self._order)}")
        answer = np.empty(rhs.shape)
        answer[self._order] = self._factors.solve(np.asarray(rhs[self._order], dtype=np.float64))
        return answer


def _is_definite(factors: SuperLU) -> bool:
    """No pivot was taken off the diagonal, and all are positive."""
    pivots = factors.U.diagonal()
    on_diagonal = np.array_equal(factors.perm_r, factors.perm_c)
    return bool(on_diagonal and (pivots > 0.0).all() and np.isfinite(pivots).all())
