"""The change of least cost that keeps equilibrium and compatibility: a symmetric system of twice the block unknowns.

min Σ ½ zᵀH z + G·z over z = (dx, dq) of every contact, subject to A dx + dλ f_L = −r_1, dq = Aᵀdu − r_q and
f_L·du = −r_0, with multipliers p of equilibrium and θ of the live power. With X = H_xx⁻¹, W = X H_xq and
S = H_qq − H_qx W::

    A S Aᵀ du − A Wᵀ Aᵀ p + θ f_L = −A (G_q − Wᵀ G_x − S r_q)
   −A W Aᵀ du − A X Aᵀ p + dλ f_L = −r_1 + A (X G_x − W r_q)
    f_L·p = 0,   f_L·du = −r_0,   dx = −X (G_x + Aᵀ p) − W dq

The matrix is quasi-definite, so that every pivot order works (Vanderbei 1995, doi:10.1137/0805005). It stays regular
where the Newton matrix of the path is singular.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.solution.linear_algebra.small_blocks import inverses
from mbla.solution.linear_algebra.superlu import factorize
from mbla.solution.nonassociative.interior_path.central_path import CentralPath, Residuals
from mbla.solution.nonassociative.interior_path.condensed_matrix import MatrixMap
from mbla.solution.nonassociative.interior_path.products import LocalCost

REFINEMENTS = 2

INVERSE = 1e-13
"""Addition to the scaled diagonal of H_xx before it is inverted: rounding."""


@dataclass(frozen=True)
class SaddleMap:
    """Pattern of the system; unknowns alternate du, p, then dλ, θ.

    core    : stored entries of the bordered pattern that belong to A C Aᵀ
    rows, columns : of all entries in the order core for S, −Wᵀ, −W, −X, then four borders
    order   : sorts them by column and row
    """

    pattern: MatrixMap
    core: IntArray
    rows: IntArray
    columns: IntArray
    order: IntArray
    indices: np.typing.NDArray[np.int32]
    pointers: np.typing.NDArray[np.int32]


def saddle_map(pattern: MatrixMap) -> SaddleMap:
    """Work out the pattern once."""
    n = len(pattern.live_load)
    column = np.repeat(np.arange(n + 1), np.diff(pattern.pointers))
    core = np.flatnonzero((pattern.indices < n) & (column < n))
    r, c = pattern.indices[core].astype(np.int64), column[core].astype(np.int64)
    u, p, load, power = 2 * np.arange(n), 2 * np.arange(n) + 1, np.full(n, 2 * n), np.full(n, 2 * n + 1)
    rows = np.concatenate([2 * r, 2 * r, 2 * r + 1, 2 * r + 1, u, power, p, load])
    columns = np.concatenate([2 * c, 2 * c + 1, 2 * c, 2 * c + 1, power, u, load, p])
    size = 2 * n + 2
    key = columns * size + rows
    order = np.argsort(key, kind="stable")
    counts = np.bincount(columns, minlength=size)
    pointers = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    return SaddleMap(pattern, core, rows, columns, order, (key[order] % size).astype(np.int32), pointers)


@dataclass(frozen=True)
class LeastChange:
    """Changes of velocities, load factor, forces and slacks (dq), of least cost."""

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    slacks: FloatArray


def least_change(path: CentralPath, saddle: SaddleMap, cost: LocalCost, left: Residuals) -> LeastChange | None:
    """Solve for the change of least cost; None where the system breaks down."""
    program, c = path.program, path.program.components
    matrix, n = program.equilibrium_matrix, len(program.live_load)
    hxx, hxq, hqq = cost.hessian[:, :c, :c], cost.hessian[:, :c, c:], cost.hessian[:, c:, c:]
    gx, gq = cost.gradient[:, :c], cost.gradient[:, c:]
    inverse = _inverse(hxx, cost.held)
    through = inverse @ hxq
    stiff = hqq - hxq.transpose(0, 2, 1) @ through
    known = -left.kinematic
    right = np.zeros(2 * n + 2)
    right[0 : 2 * n : 2] = -(matrix @ (gq - _turned(through, gx) + _times(stiff, known)).ravel())
    right[1 : 2 * n : 2] = -left.balance + matrix @ (_times(inverse, gx) + _times(through, known)).ravel()
    right[2 * n + 1] = -left.power
    blocks = (stiff, -through.transpose(0, 2, 1), -through, -inverse)
    answer = _solved(saddle, [_assembled(saddle, block) for block in blocks], right)
    if answer is None:
        return None
    velocities, multipliers = answer[0 : 2 * n : 2], answer[1 : 2 * n : 2]
    slacks = path.velocities_of_points(velocities) + known
    forces = -_times(inverse, gx + path.velocities_of_points(multipliers)) - _times(through, slacks)
    return LeastChange(velocities, float(answer[2 * n]), forces, slacks)


def _assembled(saddle: SaddleMap, blocks: FloatArray) -> FloatArray:
    pattern = saddle.pattern
    products = pattern.columns @ blocks @ pattern.columns.transpose(0, 2, 1)
    entries = products.ravel()[pattern.used]
    return np.bincount(pattern.position, entries, len(pattern.indices))[saddle.core].astype(np.float64)


def _solved(saddle: SaddleMap, parts: list[FloatArray], right: FloatArray) -> FloatArray | None:
    """Scale, factorise, solve and refine."""
    load = saddle.pattern.live_load
    values, size, n = np.concatenate([*parts, load, load, load, load]), len(right), len(load)
    if not np.isfinite(values).all():
        return None
    on_diagonal = saddle.rows == saddle.columns
    scale = np.ones(size)
    scale[saddle.rows[on_diagonal]] = 1.0 / np.sqrt(np.maximum(np.abs(values[on_diagonal]), 1e-300))
    for border, start in ((2 * n, 1), (2 * n + 1, 0)):
        scale[border] = 1.0 / max(float(np.abs(load * scale[start : 2 * n : 2]).max()), 1e-300)
    values = values * scale[saddle.rows] * scale[saddle.columns]
    system = sp.csc_array((values[saddle.order], saddle.indices, saddle.pointers), shape=(size, size))
    solve = factorize(system, symmetric=True)
    if solve is None:
        return None
    scaled = right * scale
    answer = solve(scaled)
    for _ in range(REFINEMENTS):
        answer += solve(scaled - system @ answer)
    return answer * scale if np.isfinite(answer).all() else None


def _inverse(blocks: FloatArray, held: np.typing.NDArray[np.bool_]) -> FloatArray:
    """Inverses of positive blocks, scaled by their diagonals; zero in rows and columns that are held."""
    scale = 1.0 / np.sqrt(np.einsum("kii->ki", np.where(held[:, :, None], np.eye(held.shape[1]), blocks)))
    free = np.where(held[:, :, None] | held[:, None, :], np.eye(held.shape[1]), blocks * _outer(scale))
    inverse = inverses(free + INVERSE * np.eye(held.shape[1])) * _outer(scale)
    return np.where(held[:, :, None] | held[:, None, :], 0.0, inverse)


def _outer(scale: FloatArray) -> FloatArray:
    return scale[:, :, None] * scale[:, None, :]


def _times(blocks: FloatArray, vectors: FloatArray) -> FloatArray:
    return np.asarray((blocks @ vectors[:, :, None])[:, :, 0])


def _turned(blocks: FloatArray, vectors: FloatArray) -> FloatArray:
    return np.asarray(np.einsum("kij,ki->kj", blocks, vectors))
