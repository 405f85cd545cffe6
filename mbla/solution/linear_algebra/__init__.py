"""Sparse factorisations behind one door.

::

    pattern, values = lower_triangle(matrix)
    factors = factorization(pattern)          # the analysis, once for a structure
    if factors.factorize(values):             # again and again with other values
        x = factors.solve(rhs)

``installed()`` names the libraries that are there and work, ``factorization`` picks one by size.
"""

from mbla.solution.linear_algebra.cholesky import Factorization, best_library, factorization, installed
from mbla.solution.linear_algebra.pattern import SymmetricPattern, lower_triangle

__all__ = ["Factorization", "SymmetricPattern", "best_library", "factorization", "installed", "lower_triangle"]
