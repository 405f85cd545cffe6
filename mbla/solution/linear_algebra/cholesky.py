"""Factorisation of symmetric positive definite matrices of one pattern, by whichever library is there.

Seconds of one factorisation on one thread, and of the analysis before the first, for the condensed matrices of
running-bond walls whose joints differ by sixteen decades::

                               qdldl             superlu           cholmod
    unknowns              first     each     first     each    first     each
      630                 0.0006   0.0006    0.003    0.0014   0.0009   0.0003
    2,460                 0.003    0.0062    0.013    0.012    0.005    0.0016
    6,072                 0.005    0.031     0.040    0.040    0.010    0.0060
   21,780                 0.12     0.31      0.26     0.25     0.052    0.038
   30,150 planar          0.022    0.23      0.23     0.22     0.034    0.032
   60,300                 0.77     2.7       1.7      1.2      0.15     0.16

A solution takes 0.1 (small) to 0.01 (large) of a factorisation by qdldl, with every library. All leave a residual of
rounding. CHOLMOD is the one optional library: the fastest, 0.03 s to load, and below 300 unknowns little is to be won
over qdldl. MKL Pardiso was close behind for definite matrices (the run of a spatial wall of 3,630 blocks takes 33 s of
the processor without either, 12 with CHOLMOD, 13 with Pardiso) and won nothing on flow without dilatancy (walls of 410
and 1,012 blocks: 4.4 and 6.3 s without either, 4.3 and 6.2 with CHOLMOD, 4.5 and 6.6 with Pardiso).

Of the two that are always there SuperLU is the faster from 12,000 unknowns on. Its column is that of its own order of
elimination; in the one that it is given now (``elimination_order``) it takes 0.7 of that where matrices are large, and
the analysis less than a factorisation. Side by side in one process it took 1.2 of qdldl's time for 10,890 unknowns of a
planar wall, 0.8 for 9,720 of a spatial and for 19,320 of a planar one, 0.7 for 30,150 planar, 0.55 for 21,780 spatial.
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
