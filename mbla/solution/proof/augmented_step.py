"""The least step towards equilibrium by an augmented system, where normal equations have no digits left.

With W = L Lᵀ, the step Δ = L y of least ‖y‖ with E Δ + f_L Δλ = rhs::

    [ α 1   −(E L)ᵀ ] [ y ]   [  0  ]
    [ E L      0    ] [ v ] = [ rhs ]

does not square the condition number of E L if α is as small as the smallest of its singular values that matters (Björck
1996, Numerical methods for least squares problems, section 2.5.3). Three times the unknowns, with pivoting: five to ten
times the cost of normal equations.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.superlu import factorize

ALPHA = 1e-9
"""α, for rows of unit length."""

SINGULAR = 1e-14
"""In place of the zeros on the diagonal: rows that depend on others leave the system regular."""

LEAST_ROW = 1e-16
"""Share of the longest row below which a row is not scaled up any further."""


def augmented_solver(rows: sp.csr_array) -> Callable[[FloatArray], FloatArray] | None:
    """Solver for the least y with rows @ y = rhs; None where the system cannot be factorised.

    rows : (n_rows, n)
    """
    length = np.sqrt(rows.power(2).sum(axis=1))
    longest = float(length.max(initial=0.0))
    if not 0.0 < longest < np.inf:
        return None
    scale = 1.0 / np.maximum(length, LEAST_ROW * longest)
    rows = sp.csr_array(sp.diags_array(scale) @ rows)
    n_rows, n = rows.shape
    system = sp.block_array([[ALPHA * sp.eye_array(n), -rows.T], [rows, SINGULAR * sp.eye_array(n_rows)]])
    solve = factorize(sp.csc_array(system))
    return None if solve is None else lambda rhs: solve(np.append(np.zeros(n), scale * rhs))[:n]
