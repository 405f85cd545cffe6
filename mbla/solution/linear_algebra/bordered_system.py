"""A sparse positive semidefinite matrix with a border: the linear system of repairs of forces and mechanisms.

From ``CHOLESKY_FROM`` unknowns on the matrix is factorised by Cholesky, then the border is eliminated, and the solution
refined against the bordered system. Smaller systems, and those where Cholesky breaks down, are factorised with their
border by SuperLU, which is slower for large systems alone.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.solution.linear_algebra import Factorization, factorization
from mbla.solution.linear_algebra.pattern import lower_triangle
from mbla.solution.linear_algebra.superlu import factorize

Solve = Callable[[FloatArray], FloatArray]

ROUNDS = 6
"""Corrections in a row of one repair; each solves one sparse system. Two are usual."""

PROGRESS = 0.2
"""Share of what is wrong that a round may leave and still be followed by another."""

DIAGONAL_REGULARIZATION = 1e-15
"""On the unit diagonal of the factorised matrix; refinement removes its trace."""

STRONGER = (1.0, 1e2, 1e4)
"""Multiples of it that are tried in turn where the matrix is not positive definite in double precision."""

CHOLESKY_FROM = 5_000
"""Unknowns from which the border is eliminated after the matrix."""

REFINED, REFINEMENTS = 1e-9, 4
"""Residual, relative to the right-hand side, at which refinement ends, and rounds of it at most: repairs refine
further, against what they mend."""

POOR = 1e-6
"""Residual of a trial beyond which the bordered matrix is factorised as one."""


def bordered_solver(normal: sp.csc_array, live: FloatArray, weight: float) -> Solve | None:
    """Solver of [[N, f], [fᵀ, −1/weight]] (y, t) = (rhs, 0); weight inf makes f·y = 0 a constraint.

    N is scaled to unit diagonal first; its one tiny eigenvalue is the collapse mechanism, which the border controls.

    normal : (n, n) N
    live   : (n,) f

    The solver takes rhs, (n,), and returns y with t behind it, (n + 1,). None where the system cannot be factorised.
    """
    diagonal = normal.diagonal()
    largest = float(diagonal.max(initial=0.0))
    if not 0.0 < largest < np.inf:
        return None
    scale = 1.0 / np.sqrt(np.maximum(diagonal, 1e-16 * largest))
    border = scale * live
    size = float(np.linalg.norm(border))
    corner = -1.0 / (weight * size**2) if size > 0.0 and np.isfinite(weight) else 0.0
    if not size > 0.0:  # no live load: the border says nothing
        size, corner = 1.0, -1.0
    border = border / size
    found = _border_last(normal, scale, border, corner) if len(scale) >= CHOLESKY_FROM else None
    solve_scaled = found or factorize(_bordered(normal, scale, border, corner), symmetric=True)
    if solve_scaled is None:
        return None

    def solve(rhs: FloatArray) -> FloatArray:
        solution = solve_scaled(np.append(scale * rhs, 0.0))
        return np.append(scale * solution[:-1], solution[-1] / size)

    return solve


def _bordered(normal: sp.csc_array, scale: FloatArray, border: FloatArray, corner: float) -> sp.csc_array:
    """The matrix that is factorised: S N S with its regularisation, the border and its corner."""
    n = len(scale)
    row, column = normal.indices.astype(np.int64), np.repeat(np.arange(n), np.diff(normal.indptr))
    every, there = np.arange(n), np.flatnonzero(border)
    last, end = np.full(len(there), n), np.full(1 if corner else 0, n)
    entries = [
        scale[row] * normal.data * scale[column],
        np.full(n, DIAGONAL_REGULARIZATION),
        border[there],
        border[there],
    ]
    rows: list[IntArray] = [row, every, there, last, end]
    columns: list[IntArray] = [column, every, last, there, end]
    entries.append(np.full(len(end), corner))
    places = np.concatenate(rows), np.concatenate(columns)
    return sp.csc_array((np.concatenate(entries), places), shape=(n + 1, n + 1))


def _border_last(normal: sp.csc_array, scale: FloatArray, border: FloatArray, corner: float) -> Solve | None:
    """The bordered system by factors of the matrix alone; None where these are not good enough."""
    scaled = _scaled(normal, scale)
    factors = _factors(scaled)
    if factors is None:
        return None
    spread = factors.solve(border)
    inner = float(border @ spread) - corner
    if not (np.isfinite(spread).all() and 0.0 < inner < np.inf):
        return None

    def once(rhs: FloatArray) -> FloatArray:
        free = factors.solve(rhs[:-1])
        t = (float(border @ free) - float(rhs[-1])) / inner
        return np.append(free - t * spread, t)

    def left(rhs: FloatArray, x: FloatArray) -> FloatArray:
        inside = rhs[:-1] - scaled @ x[:-1] - border * x[-1]
        return np.append(inside, rhs[-1] - float(border @ x[:-1]) - corner * x[-1])

    def solve(rhs: FloatArray) -> FloatArray:
        return _refined(once, left, rhs)

    trial = np.append(scaled @ np.ones(len(border)), 0.0)
    off = float(np.abs(left(trial, solve(trial))).max(initial=0.0))
    return solve if off <= POOR * float(np.abs(trial).max(initial=0.0)) else None


def _scaled(normal: sp.csc_array, scale: FloatArray) -> sp.csc_array:
    """S N S with its regularisation, whole diagonal stored, rows sorted."""
    n = len(scale)
    held = normal.sorted_indices()
    column = np.repeat(np.arange(n), np.diff(held.indptr))
    held.data = scale[held.indices] * held.data * scale[column]
    on_diagonal = np.flatnonzero(held.indices == column)
    if len(on_diagonal) < n:
        return sp.csc_array(held + DIAGONAL_REGULARIZATION * sp.eye_array(n))
    held.data[on_diagonal] += DIAGONAL_REGULARIZATION
    held.eliminate_zeros()
    return held


def _refined(once: Solve, left: Callable[[FloatArray, FloatArray], FloatArray], rhs: FloatArray) -> FloatArray:
    x = once(rhs)
    residual, wanted = left(rhs, x), REFINED * float(np.abs(rhs).max(initial=0.0))
    for _ in range(REFINEMENTS):
        if float(np.abs(residual).max(initial=0.0)) <= wanted:
            break
        trial = x + once(residual)
        now = left(rhs, trial)
        if not np.abs(now).max() < 0.5 * np.abs(residual).max():
            break
        x, residual = trial, now
    return x


def _factors(scaled: sp.csc_array) -> Factorization | None:
    """Of a matrix that has its whole diagonal, regularised more strongly where it must be."""
    pattern, values = lower_triangle(scaled)
    factors = factorization(pattern)
    for stronger in STRONGER:
        shifted = values.copy()
        shifted[pattern.pointers[:-1]] += (stronger - 1.0) * DIAGONAL_REGULARIZATION
        if factors.factorize(shifted):
            return factors
    return None
