"""The linear system of an iteration, condensed: what both ways of condensing share.

Every iteration solves, with G̃ = W⁻¹ G and Q = diag(q)::

    (Q + G̃ᵀ G̃) dx + Eᵀ dy = r_x
     E dx                 = r_e

A condensation reduces that to one sparse symmetric positive definite matrix N and a border of a few columns. Its answer
is refined against the system itself, whose residual is formed with W⁻¹ applied twice: N only has to be good enough as a
preconditioner, and the regularisation that its factorisation needs does not show in the answer.
"""

from __future__ import annotations

from typing import Protocol

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.solution.cone_solvers.interior_point.cone_data import ConeData
from mbla.solution.cone_solvers.interior_point.scaling import Scaling
from mbla.solution.linear_algebra import Factorization

REFINED = 1e-12
"""Residual of the linear system, relative to its right-hand side, at which refinement ends."""

ROUNDS = 5
"""Refinements at most; one or two do far from the end."""

RELATIVE_SHIFT = 1e-14
SHIFT = 1e-15
"""Regularisation of N: of each diagonal entry, and of all by this share of the mean one where W = I."""


STRONGER = (1.0, 1e2, 1e4)
"""Multiples of the regularisation that are tried in turn."""


class Condensation(Protocol):
    """N of one structure, factorised for one scaling after another.

    factors : of N
    """

    factors: Factorization

    def factorize(self, scaling: Scaling) -> bool:
        """Assemble and factorise N; False where it broke down."""

    def solve(self, r_x: FloatArray, r_e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Dx and dy as far as N goes, not refined."""


def refined_solution(
    data: ConeData, condensation: Condensation, scaling: Scaling, r_x: FloatArray, r_e: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Dx and dy, refined against the system itself until that brings nothing more."""
    scale_x, scale_e = _size(r_x), _size(r_e)
    total = max(scale_x, scale_e)
    if total == 0.0:
        return np.zeros_like(r_x), np.zeros_like(r_e)
    x, y = condensation.solve(r_x, r_e)
    left = _left(data, scaling, x, y, r_x, r_e)
    error = max(_size(left[0]), _size(left[1])) / total
    for _ in range(ROUNDS):
        if not error > REFINED:
            break
        dx, dy = condensation.solve(*left)
        trial = x + dx, y + dy
        now = _left(data, scaling, *trial, r_x, r_e)
        new = max(_size(now[0]), _size(now[1])) / total
        if not new < error:
            break
        slow, error = new > 0.5 * error, new
        (x, y), left = trial, now
        if slow:
            break
    return x, y


def factorized(factors: Factorization, values: FloatArray, diagonal: IntArray, shift: float) -> bool:
    """Factorise N regularised, more strongly where it turns out not to be positive definite in double precision."""
    for stronger in STRONGER:
        shifted = values.copy()
        shifted[diagonal] += stronger * (RELATIVE_SHIFT * values[diagonal] + shift)
        if factors.factorize(shifted):
            return True
    return False


def across(border: FloatArray, v: FloatArray) -> FloatArray:
    """borderᵀ v for a border of a few columns, (n, k), and a vector or as many columns; see ``cones.dot``."""
    return np.asarray(np.einsum("ik,i...->k...", border, v))


def bordered(inner: FloatArray, rhs: FloatArray) -> FloatArray:
    """Solution of the small system of the border, which has no more than a few unknowns and may be singular.

    Not-a-number where an entry has overflowed, on which least squares would end with an error.
    """
    if not (np.isfinite(inner).all() and np.isfinite(rhs).all()):
        return np.full((inner.shape[1], *rhs.shape[1:]), np.nan)
    return np.asarray(np.linalg.lstsq(inner, rhs, rcond=None)[0], dtype=np.float64)


def _left(
    data: ConeData, scaling: Scaling, x: FloatArray, y: FloatArray, r_x: FloatArray, r_e: FloatArray
) -> tuple[FloatArray, FloatArray]:
    bent = scaling.inverse(scaling.inverse(data.cone_matrix @ x))
    left = r_x - data.quadratic * x - data.cone_matrix_t @ bent - data.equations_t @ y
    return left, r_e - data.equations @ x


def _size(v: FloatArray) -> float:
    return float(np.abs(v).max(initial=0.0))
