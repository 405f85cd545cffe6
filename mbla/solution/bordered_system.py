"""A sparse positive semidefinite matrix with a border: what repairs of forces and of mechanisms solve."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.solution.linear_algebra.superlu import factorize

ROUNDS = 6
"""Corrections in a row of one repair; each solves one sparse system. Two are usual."""

PROGRESS = 0.2
"""Share of what is wrong that a round may leave and still be followed by another."""

REGULARIZATION = 1e-15
"""On the unit diagonal of the factorised matrix; refinement removes its trace."""


def bordered_solver(normal: sp.csc_array, live: FloatArray, weight: float) -> Callable[[FloatArray], FloatArray] | None:
    """Solver of [[N, f], [fᵀ, −1/weight]] (y, t) = (rhs, 0); weight inf makes f·y = 0 a constraint.

    N is scaled to unit diagonal first; its one tiny eigenvalue is the collapse mechanism, which the border controls.
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
    solve_scaled = factorize(_bordered(normal, scale, border / size, corner), symmetric=True)
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
    entries = [scale[row] * normal.data * scale[column], np.full(n, REGULARIZATION), border[there], border[there]]
    rows: list[IntArray] = [row, every, there, last, end]
    columns: list[IntArray] = [column, every, last, there, end]
    entries.append(np.full(len(end), corner))
    places = np.concatenate(rows), np.concatenate(columns)
    return sp.csc_array((np.concatenate(entries), places), shape=(n + 1, n + 1))
