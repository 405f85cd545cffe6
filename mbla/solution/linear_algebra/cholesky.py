"""Factorisation of symmetric positive definite matrices of one pattern, by whichever library is there.

CHOLMOD is the one optional library, and the fastest. Of the two that are always there qdldl is the faster up to 12,000
unknowns, SuperLU beyond (times of each: tests/performance).
"""

from __future__ import annotations

from functools import cache
from typing import Protocol

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.solution.linear_algebra.pattern import SymmetricPattern

LIBRARIES = ("qdldl", "superlu", "cholmod")

CHOLMOD_FROM, SUPERLU_FROM = 300, 12_000
"""Unknowns from which they are taken, the first where it is installed."""


class Factorization(Protocol):
    """Factors of matrices of one pattern; the analysis is made once, factorisations and solutions many times."""

    library: str

    def factorize(self, values: FloatArray) -> bool:
        """Factorise the matrix with these entries, (nnz,), in the order of the pattern.

        False where it is not positive definite to working accuracy, or not finite; then there is nothing to solve with.
        """

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k), in a new array; not refined."""


def factorization(pattern: SymmetricPattern, library: str | None = None) -> Factorization:
    """Factorisation with that library, one of ``LIBRARIES``; None: the best that is installed for the size.

    Raises SolverError where the library is unknown or does not work here.
    """
    if library is None:
        return _made(best_library(pattern.n), pattern)
    if library not in LIBRARIES:
        raise SolverError(
            "factorisation-missing", f"there is no factorisation {library}: it is one of {', '.join(LIBRARIES)}"
        )
    fault = _fault(library)
    if fault is not None:
        raise SolverError("factorisation-missing", f"the factorisation {library} does not work here: {fault}")
    return _made(library, pattern)


def installed() -> tuple[str, ...]:
    """Names of the libraries that are installed and pass a small trial; each is tried once in a process."""
    return tuple(library for library in LIBRARIES if _fault(library) is None)


def best_library(n: int) -> str:
    """The library that ``factorization`` takes for n unknowns."""
    if n >= CHOLMOD_FROM and _fault("cholmod") is None:
        return "cholmod"
    return "superlu" if n >= SUPERLU_FROM else "qdldl"


def _made(library: str, pattern: SymmetricPattern) -> Factorization:
    if library == "cholmod":
        from mbla.solution.linear_algebra.cholmod_factors import CholmodFactors

        return CholmodFactors(pattern)
    if library == "superlu":
        from mbla.solution.linear_algebra.superlu import SuperluFactors

        return SuperluFactors(pattern)
    from mbla.solution.linear_algebra.qdldl_factors import QdldlFactors

    return QdldlFactors(pattern)


@cache
def _fault(library: str) -> str | None:
    """Why a library cannot be used, None where it passes a trial: two matrices of one pattern."""
    pattern = SymmetricPattern(3, np.array([0, 1, 1, 2, 2], np.int32), np.array([0, 2, 4, 5], np.int32))
    rhs = np.array([1.0, 2.0, 3.0])
    try:
        factors = _made(library, pattern)
        for values in (np.array([4.0, 1.0, 5.0, -2.0, 6.0]), np.array([9.0, -1.0, 7.0, 3.0, 8.0])):
            good = factors.factorize(values)
            if not good or not np.allclose(pattern.matrix(values) @ factors.solve(rhs), rhs, rtol=1e-12):
                return "it gave a wrong answer in a small trial"
    except (ImportError, OSError, AttributeError, RuntimeError) as error:
        return str(error)
    return None
