"""Factorisation of matrices that need not be symmetric or definite, of one pattern, again and again.

SuperLU is always there. From ``PARDISO_FROM`` unknowns on MKL Pardiso is taken where it is installed: 17 ms in place of
32 for the stiffness of 1,012 blocks in space (6,073 unknowns); smaller matrices would hardly win back the half second
that its trial takes. Pardiso exchanges rows within its dense blocks only, and
replaces pivots that stay too small: a matrix to which that happens goes to SuperLU.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.solution.linear_algebra.cholesky import PARDISO_FROM
from mbla.solution.linear_algebra.mkl import mkl_library, mkl_works
from mbla.solution.linear_algebra.pardiso_factors import GENERAL, Pardiso
from mbla.solution.linear_algebra.superlu import factors_on_the_diagonal

Solve = Callable[[FloatArray], FloatArray]

PIVOT_THRESHOLD = 0.01
"""A diagonal pivot is taken unless it is smaller than this share of the largest one in its column: keeps the order."""


class GeneralFactorization:
    """Factorisations of matrices of one pattern, compressed by columns, in an order of elimination with little fill.

    library : superlu or pardiso; None: the best that is installed for the size
    """

    def __init__(self, pointers: NDArray[np.int32], indices: NDArray[np.int32], library: str | None = None) -> None:
        n = len(pointers) - 1
        if library is None:
            library = "pardiso" if n >= PARDISO_FROM and mkl_works() else "superlu"
        self.library = library
        self._pardiso: Pardiso | None = None
        self._count = 0
        if library == "pardiso":
            runtime = mkl_library()
            if runtime is None or not mkl_works():
                raise SolverError(
                    "factorisation-missing", "the factorisation pardiso does not work here: MKL is not installed"
                )
            self._pardiso = Pardiso(runtime, n, pointers, indices, GENERAL)
            self._pardiso.analyse()

    def factorize(self, matrix: sp.csc_matrix | sp.csc_array) -> Solve | None:
        """Solution for one right-hand side; it holds until the next factorisation. None where singular."""
        self._count += 1
        if not np.isfinite(matrix.data).all():
            return None
        if self._pardiso is not None and self._pardiso.factorize(matrix.data):
            return self._by_pardiso(self._pardiso, self._count)
        factors = factors_on_the_diagonal(matrix, PIVOT_THRESHOLD, ordered=True)
        return None if factors is None else lambda rhs: np.asarray(factors.solve(rhs))

    def _by_pardiso(self, pardiso: Pardiso, count: int) -> Solve:
        def solve(rhs: FloatArray) -> FloatArray:
            if count != self._count:
                raise ValueError("the factors have been overwritten by those of another matrix")
            return pardiso.solve(rhs)

        return solve
