"""qdldl: L D Lᵀ without exchanges in an approximate minimum degree order; always there. Only importer of qdldl.

Its library takes the upper triangle by columns. That is what the lower one becomes when the unknowns are counted from
the end, and its stored entries then stand in the reverse order: nothing has to be sorted. Order, elimination tree and
the place of every entry are found once, at the first factorisation, and kept.

The pivots are not given out without a copy of the whole factor, half as long as a factorisation. Instead one system is
solved with b_i = ± √a_ii. In the matrix scaled to a diagonal of ones no pivot d exceeds 1, and bᵀ N⁻¹ b = Σ y_i² / d_i
with y = L⁻¹ b. A pivot that rounding has made negative is small, so that its term stands out against all others.
"""

from __future__ import annotations

import numpy as np
import qdldl
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.pattern import SymmetricPattern

SEED = 20210  # of the signs of the trial's right-hand side: the same in every run


class QdldlFactors:
    """Factors of matrices of one pattern; see ``Factorization``."""

    library = "qdldl"

    def __init__(self, pattern: SymmetricPattern) -> None:
        self._n = pattern.n
        self._diagonal = pattern.pointers[:-1]
        pointers = (pattern.pointers[-1] - pattern.pointers[::-1]).astype(np.int32)
        indices = (pattern.n - 1 - pattern.indices[::-1]).astype(np.int32)
        self._upper = sp.csc_matrix((np.zeros(len(indices)), indices, pointers), shape=(pattern.n, pattern.n))
        self._signs = np.random.default_rng(SEED).choice([-1.0, 1.0], pattern.n)
        self._solver: qdldl.Solver | None = None

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite."""
        diagonal = values[self._diagonal]
        if not (np.isfinite(values).all() and (diagonal > 0.0).all()):
            return False
        self._upper.data[:] = values[::-1]
        try:
            if self._solver is None:
                self._solver = qdldl.Solver(self._upper, upper=True)
            else:
                self._solver.update(self._upper, upper=True)
        except RuntimeError:  # a pivot is exactly zero
            return False
        rhs = self._signs * np.sqrt(diagonal)
        answer = self.solve(rhs)
        return bool(np.isfinite(answer).all() and rhs @ answer > 0.0)

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k)."""
        if self._solver is None:
            raise ValueError("solve before a factorisation")
        solve = self._solver.solve
        if rhs.ndim == 1:
            return np.asarray(solve(rhs[::-1])[::-1]).copy()
        answer = np.empty(rhs.shape)
        for number in range(rhs.shape[1]):
            answer[::-1, number] = solve(rhs[::-1, number])
        return answer
