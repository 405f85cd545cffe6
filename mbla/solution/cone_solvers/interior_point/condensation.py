"""The linear system of an iteration, condensed onto the unknowns: N = Q + G̃ᵀ G̃, bordered by the equations.

Every iteration solves, with G̃ = W⁻¹ G and Q = diag(q)::

    (Q + G̃ᵀ G̃) dx + Eᵀ dy = r_x
     E dx                 = r_e

N has one row and column for each velocity of the blocks; the equations, usually f_L·u = 1 alone, are its border.
Half-lines and cones with the same columns, those of one interface, are one dense block, so that N is the sum of as many
small products as there are interfaces. Its answer is refined against the system itself, whose residual is formed with
W⁻¹ applied twice: N only has to be good enough as a preconditioner, and the regularisation that its factorisation needs
does not show in the answer.

Local unknowns, the multipliers m of cohesive joints, never get there. In the rows of one contact point G̃ = [X_u X_m];
with [X_m; √Q] = U R (modified Gram–Schmidt) they leave the projected rows X_u − U Uᵀ X_u, and::

    r_u := r_u − X_uᵀ U R⁻ᵀ r_m,      dm = R⁻¹ (R⁻ᵀ r_m − Uᵀ X_u du)
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray, IntArray
from mbla.solution.cone_solvers.interior_point.cones import ConeData, NesterovToddScaling, boosted, largest_entry
from mbla.solution.linear_algebra import Factorization, factorization
from mbla.solution.linear_algebra.block_products import (
    DenseRows,
    PlacedProducts,
    alike,
    backward,
    by_group,
    dense_rows,
    forward,
    placed_products,
    sets_of_alike,
    taken,
    triangular_factor,
)

REFINED = 1e-12
"""Residual of the linear system, relative to its right-hand side, at which refinement ends."""

ROUNDS = 5
"""Refinements at most; one or two do far from the end."""

RELATIVE_SHIFT = 1e-14
SHIFT = 1e-15
"""Regularisation of N: of each diagonal entry, and of all by this share of the mean one where W = I."""


STRONGER = (1.0, 1e2, 1e4)
"""Multiples of the regularisation that are tried in turn."""


def refined_solution(
    data: ConeData, condensation: Condensation, scaling: NesterovToddScaling, r_x: FloatArray, r_e: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """The step dx, (n_unknowns,), and dy, (n_equations,), refined against the system until that brings nothing more.

    r_x, r_e : right-hand sides, (n_unknowns,) and (n_equations,)
    """
    scale_x, scale_e = largest_entry(r_x), largest_entry(r_e)
    total = max(scale_x, scale_e)
    if total == 0.0:
        return np.zeros_like(r_x), np.zeros_like(r_e)
    x, y = condensation.solve(r_x, r_e)
    left = _left(data, scaling, x, y, r_x, r_e)
    error = max(largest_entry(left[0]), largest_entry(left[1])) / total
    for _ in range(ROUNDS):
        if not error > REFINED:
            break
        dx, dy = condensation.solve(*left)
        trial = x + dx, y + dy
        now = _left(data, scaling, *trial, r_x, r_e)
        new = max(largest_entry(now[0]), largest_entry(now[1])) / total
        if not new < error:
            break
        slow, error = new > 0.5 * error, new
        (x, y), left = trial, now
        if slow:
            break
    return x, y


def factorized(factors: Factorization, values: FloatArray, diagonal: IntArray, shift: float) -> bool:
    """Factorise N regularised, more strongly where it turns out not to be positive definite in double precision.

    values   : (nnz,) of N, in the order of the pattern
    diagonal : (n,) where the entries of its diagonal are among them
    shift    : added to the diagonal, besides a share of itself

    False where it is not positive definite in the end either.
    """
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

    inner : (k, k); rhs : (k,), or (k, m) for several
    """
    if not (np.isfinite(inner).all() and np.isfinite(rhs).all()):
        return np.full((inner.shape[1], *rhs.shape[1:]), np.nan)
    return np.asarray(np.linalg.lstsq(inner, rhs, rcond=None)[0], dtype=np.float64)


def _left(
    data: ConeData, scaling: NesterovToddScaling, x: FloatArray, y: FloatArray, r_x: FloatArray, r_e: FloatArray
) -> tuple[FloatArray, FloatArray]:
    bent = scaling.inverse(scaling.inverse(data.cone_matrix @ x))
    left = r_x - data.quadratic * x - data.cone_matrix_t @ bent - data.equations_t @ y
    return left, r_e - data.equations @ x


@dataclass(frozen=True)
class _Rows:
    """Rows of G of many points over some unknowns of each: half-lines (n, a, C) and cones (d, n, b, C)."""

    of_lines: FloatArray
    of_cones: FloatArray

    def scaled(self, lines: IntArray, cones: IntArray, scaling: NesterovToddScaling) -> FloatArray:
        """W⁻¹ of the rows, (n, a + d b, C)."""
        n, a, width = self.of_lines.shape
        d, b = len(self.of_cones), cones.shape[1]
        x = np.empty((n, a + d * b, width))
        np.divide(self.of_lines, scaling.line[lines][:, :, None], out=x[:, :a])
        if b:
            out = x[:, a:].reshape(n, d, b, width).transpose(1, 0, 2, 3)
            boosted(scaling.w[:, cones][..., None], self.of_cones, -1.0, out)
            out /= scaling.eta[cones][None, :, :, None]
        return x


@dataclass(frozen=True)
class _Batch:
    """Points of like shape.

    lines, cones : (n, a), (n, b) numbers of the half-lines and of the cones
    rows         : (n, a + d b) their components in a vector
    local        : (n, g) local unknowns
    root         : (n, g) √q of these
    over_all     : rows over the C unknowns that are not local
    over_local   : rows over the local ones
    members      : points with the same unknowns, which stand one after the other
    """

    lines: IntArray
    cones: IntArray
    rows: IntArray
    local: IntArray
    root: FloatArray
    over_all: _Rows
    over_local: _Rows
    members: int

    def eliminated(self, scaling: NesterovToddScaling) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Projected rows in blocks of equal unknowns, U (rows, g, n) and R (g, g, n)."""
        x = self.over_all.scaled(self.lines, self.cones, scaling)
        n, height, width = x.shape
        g = self.local.shape[1]
        u, r = np.zeros((height, 0, n)), np.zeros((0, 0, n))
        if g:
            u = np.zeros((height + g, g, n))
            u[:height] = self.over_local.scaled(self.lines, self.cones, scaling).transpose(1, 2, 0)
            u[range(height, height + g), range(g)] = self.root.T
            r = triangular_factor(u)
            along = np.einsum("hgn,nhw->ngw", u[:height], x)
            x = np.concatenate([x, np.zeros((n, g, width))], axis=1) - np.einsum("hgn,ngw->nhw", u, along)
        return x.reshape(n // self.members, self.members * x.shape[1], width), u[:height], r


class Condensation:
    """N of one structure, factorised for one scaling after another.

    factors : of N
    """

    def __init__(self, data: ConeData, library: str | None) -> None:
        self._data = data
        n = len(data.cost) - data.n_local
        self._over_all = sp.csr_array(data.cone_matrix[:, :n])
        self._over_all_t = sp.csr_array(self._over_all.T)
        self._batches, columns = _batches(data, self._over_all)
        self._products: PlacedProducts = placed_products(n, columns)
        self.factors: Factorization = factorization(self._products.pattern, library)
        identity = self._scaling = NesterovToddScaling.identity(data.product)
        diagonal = self._products.summed([batch.eliminated(identity)[0] for batch in self._batches])
        self._shift = SHIFT * float(diagonal[self._products.diagonal].mean())
        self._border = data.equations[:, :n].toarray().T
        self._spread = np.zeros_like(self._border)
        self._inner = np.zeros((self._border.shape[1],) * 2)
        self._local: list[tuple[FloatArray, FloatArray]] = []

    def factorize(self, scaling: NesterovToddScaling) -> bool:
        """Assemble and factorise N."""
        eliminated = [batch.eliminated(scaling) for batch in self._batches]
        self._scaling, self._local = scaling, [(u, r) for _, u, r in eliminated]
        values = self._products.summed([x for x, _, _ in eliminated])
        diagonal = self._products.diagonal
        values[diagonal] += self._data.quadratic[: len(diagonal)]
        if not factorized(self.factors, values, diagonal, self._shift):
            return False
        self._spread = self.factors.solve(self._border)
        self._inner = across(self._border, self._spread)
        return bool(np.isfinite(self._inner).all())

    def solve(self, r_x: FloatArray, r_e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The step dx, (n_unknowns,), and dy, (n_equations,), not refined, for right-hand sides of these shapes."""
        n = len(self._products.diagonal)
        right, held = r_x[:n], []
        if self._data.n_local:
            w = np.zeros(self._data.product.size)
            for batch, (u, r) in zip(self._batches, self._local, strict=True):
                held.append(forward(r, r_x[batch.local].T[:, :, None])[:, :, 0])
                w[batch.rows] = np.einsum("hgn,gn->nh", u, held[-1])
            right = right - self._over_all_t @ self._scaling.inverse(w)
        free, y = self.factors.solve(right), np.zeros(0)
        if len(r_e):
            y = bordered(self._inner, across(self._border, free) - r_e)
            free = free - np.einsum("ik,k->i", self._spread, y)
        if not self._data.n_local:
            return free, y
        x = np.concatenate([free, np.zeros(self._data.n_local)])
        w = self._scaling.inverse(self._over_all @ free)
        for batch, (u, r), t in zip(self._batches, self._local, held, strict=True):
            along = t - np.einsum("hgn,nh->gn", u, w[batch.rows])
            x[batch.local] = backward(r, along[:, :, None])[:, :, 0].T
        return x, y


def _batches(data: ConeData, over_all: sp.csr_array) -> tuple[list[_Batch], list[IntArray]]:
    """Batches of points, and the unknowns of each set of points with the same ones."""
    product, n = data.product, over_all.shape[1]
    cones, n_units = product.n_lines + np.arange(product.n_cones), product.n_lines + product.n_cones
    unit_of_row = np.concatenate([np.arange(product.n_lines), *(product.dimension * [cones])])
    over_local = sp.csr_array(data.cone_matrix[:, n:])
    held = sp.coo_array(over_local)
    unit = unit_of_row[held.coords[0]]
    ends = (unit, n_units + held.coords[1])
    link = sp.coo_array((np.ones(len(unit)), ends), shape=(n_units + data.n_local,) * 2)
    n_points, labels = connected_components(link, directed=False)
    point = labels.astype(np.int64)
    lines = by_group(np.arange(product.n_lines), point[: product.n_lines], n_points)
    cone_sets = by_group(np.arange(product.n_cones), point[product.n_lines : n_units], n_points)
    local = by_group(n + np.arange(data.n_local), point[n_units:], n_points)
    touched = dense_rows(over_all, point[unit_of_row], n_points)
    shape_of = alike(np.column_stack([*(np.diff(part[1]) for part in (lines, cone_sets, local)), touched.widths]))
    batches, columns = [], []
    for points, unknowns, size in sets_of_alike(shape_of, touched):
        members = tuple(taken(part, points) for part in (lines, cone_sets, local))
        batches.append(_batch(data, touched, points, members, over_local, size))
        columns.append(unknowns)
    return batches, columns


def _batch(
    data: ConeData,
    touched: DenseRows,
    points: IntArray,
    members: tuple[IntArray, ...],
    over_local: sp.csr_array,
    size: int,
) -> _Batch:
    lines, cones, local = members
    n_lines, n_cones = data.product.n_lines, data.product.n_cones
    rows = np.concatenate([lines, *(n_lines + j * n_cones + cones for j in range(data.product.dimension))], axis=1)
    place = np.zeros(data.product.size, dtype=np.int64)
    place[rows] = np.arange(rows.shape[1])
    dense = touched.blocks(points, place, rows.shape[1])
    g, n = local.shape[1], len(data.cost) - data.n_local
    column = np.zeros(data.n_local, dtype=np.int64)
    column[local - n] = np.arange(g)
    picked = sp.coo_array(over_local[rows.ravel()])
    own = np.zeros((rows.size, g))
    if g:
        own[picked.coords[0], column[picked.coords[1]]] = picked.data
    root = np.sqrt(data.quadratic[local])
    width = lines.shape[1]
    d = data.product.dimension
    both = (_rows(dense, width, d), _rows(own.reshape(*rows.shape, g), width, d))
    return _Batch(lines, cones, rows, local, root, *both, size)


def _rows(dense: FloatArray, n_lines: int, d: int) -> _Rows:
    n, height, width = dense.shape
    cones = dense[:, n_lines:].reshape(n, d, (height - n_lines) // d, width)
    return _Rows(np.ascontiguousarray(dense[:, :n_lines]), np.ascontiguousarray(cones.transpose(1, 0, 2, 3)))
