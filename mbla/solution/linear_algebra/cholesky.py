"""Factorisation of symmetric positive definite matrices of one pattern, by whichever library is there."""

from __future__ import annotations

from typing import Protocol

from mbla.arrays import FloatArray
from mbla.errors import SolverError
from mbla.solution.linear_algebra.pattern import SymmetricPattern

LIBRARIES = ("qdldl",)


class Factorization(Protocol):
    """Factors of matrices of one pattern; the analysis is made once, factorisations and solutions many times."""

    library: str

    def factorize(self, values: FloatArray) -> bool:
        """Factorise the matrix with these entries, (nnz,), in the order of the pattern; False where it broke down."""

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k), not refined; after a good ``factorize``."""


def factorization(pattern: SymmetricPattern, library: str | None = None, threads: int = 1) -> Factorization:
    """Factorisation with that library; None: the best that is installed for the size.

    Raises SolverError where the library is unknown or does not work here.
    """
    if library not in (None, *LIBRARIES):
        raise SolverError(f"unknown factorisation {library!r}; there are {', '.join(LIBRARIES)}")
    from mbla.solution.linear_algebra.qdldl_factors import QdldlFactors

    return QdldlFactors(pattern)


def installed() -> tuple[str, ...]:
    """Names of the libraries that are installed and work here."""
    return LIBRARIES
