"""The least change of dual variables, in the metric of the cones' barrier, that restores equilibrium.

z = (z_0, z_1 ...): −load factor, then vectors inside their cones. Sought is the least step Δ in ::

    live Δ_0 + MᵀΔ = −(live z_0 + Mᵀz + cost)        weighted by W⁻¹

with the inverse Hessian W of the barrier, for a cone z_0 ≥ ‖z̄‖: z zᵀ − ½ (z_0² − ‖z̄‖²) diag(1, −1, ...). Two ways:

- *Normal equations*, Δ = W M y with (MᵀW M) y = rhs: small and cheap. Where most joints of a structure are on the
  borders of their cones W has eigenvalues 1e20 apart, and MᵀW M no digits left for the smallest: on a dome of slices
  corrections came to rest at 1.5e-8 mean block loads.
- *Augmented system*, Δ = L y with L L = W, of the unknowns y themselves::

      [ α 1   −L M ] [ y ]   [  0  ]
      [ MᵀL     0  ] [ v ] = [ rhs ]

  does not square the condition number if α is as small as the smallest singular value of MᵀL that matters (Björck
  1996, Numerical methods for least squares problems, section 2.5.3): 1e-14 on the same dome. Three times the unknowns,
  with pivoting: five to ten times the cost.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.cone_vectors import ConeVectors
from mbla.solution.linear_algebra.bordered_system import bordered_solver
from mbla.solution.linear_algebra.superlu import factorize

REFINEMENTS = 4
"""Solutions with the factors of one step: the metric spans many decades."""

FACTOR_SHARE, LEAST_FACTOR = 1e-4, 1e-3
"""The load factor is free to change by about this share of itself; a small one by the share of ``LEAST_FACTOR``."""

ALPHA = 1e-9
"""α, for rows of unit length. From 1e-8 to 1e-12 a dome, a spiral stair and a wall were balanced to 2e-12 or better,
with 1e-4 to 6e-10."""

SINGULAR = 1e-14
"""In place of the zeros on the diagonal: rows that depend on others leave the system regular."""

LEAST_ROW = 1e-16
"""Share of the longest row below which a row is not scaled up any further."""


@dataclass(frozen=True)
class Equilibrium:
    """live z_0 + matrixᵀ z = −cost.

    matrix : (n_dual, n_rows); live, cost : (n_rows,)
    """

    matrix: sp.csr_array
    live: FloatArray
    cost: FloatArray

    def unbalanced(self, z: FloatArray) -> FloatArray:
        """What z leaves of equilibrium, (n_rows,)."""
        return np.asarray(self.matrix.T @ z[1:] + self.live * z[0] + self.cost)


StepOf = Callable[[Equilibrium, ConeVectors, FloatArray], FloatArray | None]


def normal_step(equilibrium: Equilibrium, cones: ConeVectors, z: FloatArray) -> FloatArray | None:
    """The step of z, (n_dual + 1,), by normal equations; None where they cannot be solved."""
    matrix, weights = equilibrium.matrix, cones.inverse_hessian(z[1:])
    normal = sp.csc_array(matrix.T @ weights @ matrix)
    free = _free_change(z)
    solve = bordered_solver(normal, equilibrium.live, free * free)  # not **, which raises beyond numbers
    if solve is None:
        return None
    step = np.zeros_like(z)
    for _ in range(REFINEMENTS):
        change = solve(-equilibrium.unbalanced(z + step))
        if not np.isfinite(change).all():
            return None
        step = step + np.append(change[-1], weights @ (matrix @ change[:-1]))
    return step


def augmented_step(equilibrium: Equilibrium, cones: ConeVectors, z: FloatArray) -> FloatArray | None:
    """The step of z, (n_dual + 1,), by the augmented system; None where it cannot be solved."""
    root, free = cones.root_of_inverse_hessian(z[1:]), _free_change(z)
    rows = sp.csr_array(sp.hstack([sp.csr_array(free * equilibrium.live[:, None]), equilibrium.matrix.T @ root]))
    length = np.sqrt(rows.power(2).sum(axis=1))
    longest = float(length.max(initial=0.0))
    if not 0.0 < longest < np.inf:
        return None
    scale = 1.0 / np.maximum(length, LEAST_ROW * longest)
    rows = sp.csr_array(sp.diags_array(scale) @ rows)
    n_rows, n = rows.shape
    system = sp.block_array([[ALPHA * sp.eye_array(n), -rows.T], [rows, SINGULAR * sp.eye_array(n_rows)]])
    solve = factorize(sp.csc_array(system))
    if solve is None:
        return None
    step, none = np.zeros_like(z), np.zeros(n)
    for _ in range(REFINEMENTS):
        y = solve(np.append(none, -scale * equilibrium.unbalanced(z + step)))[:n]
        if not np.isfinite(y).all():
            return None
        step = step + np.append(free * y[0], root @ y[1:])
    return step


def _free_change(z: FloatArray) -> float:
    return FACTOR_SHARE * max(abs(float(z[0])), LEAST_FACTOR)
