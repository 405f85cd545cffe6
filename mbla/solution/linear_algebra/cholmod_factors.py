"""CHOLMOD: supernodal Cholesky in an approximate minimum degree order. Only importer of cvxopt, which carries it.

The wheels of cvxopt give it a BLAS of one thread: reruns are identical to the bit. Where another library of the process
offers a BLAS under the same names, as MKL does once it is loaded, CHOLMOD is slower with that and gives other last
digits; so on Linux it is bound to the one that it brings.
"""

from __future__ import annotations

import os
import sys
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.pattern import SymmetricPattern


def _cvxopt() -> Any:
    """The package, imported when it is needed; ImportError where it is not installed."""
    if sys.platform != "linux":
        import cvxopt.cholmod

        return cvxopt
    usual = sys.getdlopenflags()
    sys.setdlopenflags(usual | os.RTLD_DEEPBIND)
    try:
        import cvxopt.cholmod
    finally:
        sys.setdlopenflags(usual)
    return cvxopt


class CholmodFactors:
    """Factors of matrices of one pattern; see ``Factorization``."""

    library = "cholmod"

    def __init__(self, pattern: SymmetricPattern) -> None:
        self._cvxopt = _cvxopt()
        spmatrix, matrix = self._cvxopt.spmatrix, self._cvxopt.matrix
        rows, columns = pattern.indices.astype(np.int64), pattern.columns()
        self._matrix = spmatrix(matrix(np.ones(len(rows))), matrix(rows), matrix(columns), (pattern.n, pattern.n))
        self._factors = self._cvxopt.cholmod.symbolic(self._matrix, uplo="L")
        self._good = False

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite.

        values : (nnz,) in the order of the pattern
        """
        self._good = False
        if not np.isfinite(values).all():
            return False
        self._matrix.V = self._cvxopt.matrix(values)
        try:
            self._cvxopt.cholmod.numeric(self._matrix, self._factors)
        except ArithmeticError:  # a pivot is not positive
            return False
        self._good = True
        return True

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k).

        Raises ValueError without a good factorisation, and where rhs has another number of rows.
        """
        if not self._good:
            raise ValueError("solve without a good factorisation")
        if len(rhs) != self._matrix.size[0]:
            raise ValueError(f"a right-hand side of {len(rhs)} rows for a matrix of {self._matrix.size[0]}")
        answer = self._cvxopt.matrix(np.asfortranarray(rhs, dtype=np.float64))
        self._cvxopt.cholmod.solve(self._factors, answer)
        return np.array(answer).reshape(rhs.shape)
