"""Condensation onto the unknowns, for programs of few equations: the kinematic form.

N = Q + G̃ᵀ G̃, one row and column for each velocity of the blocks, with the equations, usually f_L·u = 1 alone, as a
border. Half-lines and cones with the same columns, those of one interface, are one dense block, so that N is the sum of
as many small products as there are interfaces.

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
from mbla.solution.cone_solvers.interior_point.condensation import SHIFT, across, bordered, factorized
from mbla.solution.cone_solvers.interior_point.cone_data import ConeData, Units
from mbla.solution.cone_solvers.interior_point.groups import backward, by_group, forward, taken, triangular_factor
from mbla.solution.cone_solvers.interior_point.products import (
    DenseRows,
    PlacedProducts,
    alike,
    dense_rows,
    placed_products,
    sets_of_alike,
)
from mbla.solution.cone_solvers.interior_point.scaling import Scaling, boosted
from mbla.solution.linear_algebra import Factorization, factorization


@dataclass(frozen=True)
class _Rows:
    """Rows of G of many points over some unknowns of each: half-lines (n, a, C) and cones (3, n, b, C)."""

    of_lines: FloatArray
    of_cones: FloatArray

    def scaled(self, lines: IntArray, cones: IntArray, scaling: Scaling) -> FloatArray:
        """W⁻¹ of the rows, (n, a + 3 b, C)."""
        n, a, width = self.of_lines.shape
        b = cones.shape[1]
        x = np.empty((n, a + 3 * b, width))
        np.divide(self.of_lines, scaling.line[lines][:, :, None], out=x[:, :a])
        if b:
            out = x[:, a:].reshape(n, 3, b, width).transpose(1, 0, 2, 3)
            boosted(scaling.w[:, cones][..., None], self.of_cones, -1.0, out)
            out /= scaling.eta[cones][None, :, :, None]
        return x


@dataclass(frozen=True)
class _Batch:
    """Points of like shape.

    lines, cones : (n, a), (n, b) numbers of the half-lines and of the cones
    rows         : (n, a + 3 b) their components in a vector
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

    def eliminated(self, scaling: Scaling) -> tuple[FloatArray, FloatArray, FloatArray]:
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


class OnUnknowns:
    """See ``Condensation``."""

    def __init__(self, data: ConeData, library: str | None) -> None:
        self._data = data
        n = len(data.cost) - data.n_local
        self._over_all = sp.csr_array(data.cone_matrix[:, :n])
        self._over_all_t = sp.csr_array(self._over_all.T)
        self._batches, columns = _batches(data, self._over_all)
        self._products: PlacedProducts = placed_products(n, columns)
        self.factors: Factorization = factorization(self._products.pattern, library)
        identity = self._scaling = Scaling.identity(data.product)
        diagonal = self._products.summed([batch.eliminated(identity)[0] for batch in self._batches])
        self._shift = SHIFT * float(diagonal[self._products.diagonal].mean())
        self._border = data.equations[:, :n].toarray().T
        self._spread = np.zeros_like(self._border)
        self._inner = np.zeros((self._border.shape[1],) * 2)
        self._local: list[tuple[FloatArray, FloatArray]] = []

    def factorize(self, scaling: Scaling) -> bool:
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
        """Dx and dy, not refined."""
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
    product, units, n = data.product, Units.of(data.product), over_all.shape[1]
    over_local = sp.csr_array(data.cone_matrix[:, n:])
    held = sp.coo_array(over_local)
    unit = units.unit_of_row[held.coords[0]]
    ends = (unit, units.n_units + held.coords[1])
    link = sp.coo_array((np.ones(len(unit)), ends), shape=(units.n_units + data.n_local,) * 2)
    n_points, labels = connected_components(link, directed=False)
    point = labels.astype(np.int64)
    lines = by_group(np.arange(product.n_lines), point[: product.n_lines], n_points)
    cones = by_group(np.arange(product.n_cones), point[product.n_lines : units.n_units], n_points)
    local = by_group(n + np.arange(data.n_local), point[units.n_units :], n_points)
    touched = dense_rows(over_all, point[units.unit_of_row], n_points)
    shape_of = alike(np.column_stack([*(np.diff(part[1]) for part in (lines, cones, local)), touched.widths]))
    batches, columns = [], []
    for points, unknowns, size in sets_of_alike(shape_of, touched):
        members = tuple(taken(part, points) for part in (lines, cones, local))
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
    rows = np.concatenate([lines, *(n_lines + j * n_cones + cones for j in range(3))], axis=1)
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
    both = (_rows(dense, width), _rows(own.reshape(*rows.shape, g), width))
    return _Batch(lines, cones, rows, local, root, *both, size)


def _rows(dense: FloatArray, n_lines: int) -> _Rows:
    n, height, width = dense.shape
    cones = dense[:, n_lines:].reshape(n, 3, (height - n_lines) // 3, width)
    return _Rows(np.ascontiguousarray(dense[:, :n_lines]), np.ascontiguousarray(cones.transpose(1, 0, 2, 3)))
