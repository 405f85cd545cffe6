"""Condensation onto the multipliers of the equations, for programs whose unknowns are local: the static forms.

Unknowns that share a half-line or a cone, the forces of one contact point, form a group; H = Q + G̃ᵀ G̃ is one small
block for each. Unknowns in no cone, or alone in theirs and in most equations (the load factor), stay as a border F::

    N = E H⁻¹ Eᵀ,      N dy − F dx_F = E H⁻¹ r − r_e,      Fᵀ dy + H_F dx_F = r_F

So do equations that have unknowns of the border alone.

H is never formed: with [G̃; √Q] = U R, R triangular (modified Gram–Schmidt), H⁻¹ = R⁻¹ R⁻ᵀ, and N is the sum of the
products of R⁻ᵀ Eᵀ. Near the end H is beyond what double precision can invert; R is as accurate as its columns.
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
    PlacedProducts,
    alike,
    dense_rows,
    placed_products,
    sets_of_alike,
)
from mbla.solution.cone_solvers.interior_point.scaling import Scaling, boosted
from mbla.solution.linear_algebra import Factorization, factorization

LARGEST_GROUP = 8
"""Unknowns of a group up to which they count as local."""

MOST_FREE = 8
"""Unknowns that can be a border."""

MOST_EQUATIONS = 48
"""Equations in which the unknowns of a group are; a point between two blocks is in twelve."""


@dataclass(frozen=True)
class _Batch:
    """Groups of unknowns of like shape.

    unknowns : (n_groups, g)
    lines, cones : (n_groups, a), (n_groups, b) their half-lines and cones
    of_lines : (n_groups, a, g) rows of G
    of_cones : (3, n_groups, b, g)
    root     : (n_groups, g) √q
    columns  : (n_groups, g, C) columns of E at the rows of each set
    members  : groups with the same rows, which stand one after the other
    """

    unknowns: IntArray
    lines: IntArray
    cones: IntArray
    of_lines: FloatArray
    of_cones: FloatArray
    root: FloatArray
    columns: FloatArray
    members: int

    def triangular(self, scaling: Scaling) -> FloatArray:
        """R of each group, (g, g, n_groups)."""
        n, a, g = self.of_lines.shape
        b = self.cones.shape[1]
        x = np.zeros((a + 3 * b + g, g, n))
        x[:a] = (self.of_lines / scaling.line[self.lines][:, :, None]).transpose(1, 2, 0)
        if b:
            out = np.empty_like(self.of_cones)
            boosted(scaling.w[:, self.cones][..., None], self.of_cones, -1.0, out)
            out /= scaling.eta[self.cones][None, :, :, None]
            x[a : a + 3 * b] = out.transpose(0, 2, 3, 1).reshape(3 * b, g, n)
        x[range(a + 3 * b, a + 3 * b + g), range(g)] = self.root.T
        return triangular_factor(x)


class OnMultipliers:
    """See ``Condensation``."""

    def __init__(self, data: ConeData, library: str | None) -> None:
        self._data = data
        group, self._free = local_groups(data)
        self._batches, rows = _batches(data, group)
        self._products: PlacedProducts = placed_products(data.equations.shape[0], rows)
        self.factors: Factorization = factorization(self._products.pattern, library)
        self._border = data.equations[:, self._free].toarray()
        local = data.equations[:, np.flatnonzero(group >= 0)]
        self._apart = np.flatnonzero(np.diff(sp.csr_array(local).indptr) == 0)
        self._given = self._border[self._apart]
        self._border[self._apart] = 0.0
        self._free_rows = data.cone_matrix[:, self._free].toarray()[: data.product.n_lines]
        self._r: list[FloatArray] = []
        self._spread = np.zeros_like(self._border)
        self._inner = np.zeros((len(self._free) + len(self._apart),) * 2)

    def factorize(self, scaling: Scaling) -> bool:
        """Assemble and factorise N."""
        self._r = [batch.triangular(scaling) for batch in self._batches]
        if not all(np.isfinite(r).all() for r in self._r):
            return False
        blocks = []
        for batch, r in zip(self._batches, self._r, strict=True):
            y = forward(r, batch.columns.transpose(1, 0, 2))
            n, g, width = batch.columns.shape
            blocks.append(y.transpose(1, 0, 2).reshape(n // batch.members, batch.members * g, width))
        values = self._products.summed(blocks)
        diagonal = self._products.diagonal
        values[diagonal[self._apart]] = 1.0
        if not factorized(self.factors, values, diagonal, SHIFT * float(values[diagonal].mean())):
            return False
        self._spread = self.factors.solve(self._border)
        free = self._data.quadratic[self._free] + np.square(self._free_rows / scaling.line[:, None]).sum(axis=0)
        n = len(self._free)
        self._inner[:n, :n] = across(self._border, self._spread) + np.diag(free)
        self._inner[:n, n:], self._inner[n:, :n] = self._given.T, self._given
        return bool(np.isfinite(self._inner).all())

    def solve(self, r_x: FloatArray, r_e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Dx and dy, not refined."""
        data = self._data
        y = self.factors.solve(data.equations @ self._locally(r_x) - r_e)
        y[self._apart] = 0.0
        free = np.zeros(0)
        if len(self._inner):
            small = bordered(self._inner, np.append(r_x[self._free] - across(self._border, y), r_e[self._apart]))
            free = small[: len(self._free)]
            y = y + np.einsum("ik,k->i", self._spread, free)
            y[self._apart] = small[len(self._free) :]
        x = self._locally(r_x - data.equations_t @ y)
        x[self._free] = free
        return x, y

    def _locally(self, rhs: FloatArray) -> FloatArray:
        """H⁻¹ of the local unknowns, zero elsewhere."""
        result = np.zeros_like(rhs)
        for batch, r in zip(self._batches, self._r, strict=True):
            right = rhs[batch.unknowns].T[:, :, None]
            result[batch.unknowns] = backward(r, forward(r, right))[:, :, 0].T
        return result


def local_groups(data: ConeData) -> tuple[IntArray, IntArray]:
    """Group of each unknown, −1 for those of the border, and the latter."""
    units, n = Units.of(data.product), len(data.cost)
    held = sp.coo_array(data.cone_matrix)
    link = sp.coo_array(
        (np.ones(held.nnz), (n + units.unit_of_row[held.coords[0]], held.coords[1])),
        shape=(n + units.n_units, n + units.n_units),
    )
    label = connected_components(link, directed=False)[1][:n]
    in_lines = np.bincount(held.coords[1][held.coords[0] < data.product.n_lines], minlength=n)
    in_cones = np.bincount(held.coords[1], minlength=n) > in_lines
    alone = (np.bincount(label, minlength=1)[label] == 1) & ~in_cones
    border = alone & (((in_lines == 0) & (data.quadratic == 0.0)) | (np.diff(data.equations_t.indptr) > MOST_EQUATIONS))
    group = np.full(n, -1)
    group[~border] = np.unique(label[~border], return_inverse=True)[1]
    return group, np.flatnonzero(border)


def is_local(data: ConeData) -> bool:
    """Whether the unknowns fall into small groups with few left over."""
    group, free = local_groups(data)
    n_groups = int(group.max(initial=-1)) + 1
    width = dense_rows(data.equations_t, group, n_groups).widths.max(initial=0)
    largest = np.bincount(group[group >= 0]).max(initial=0)
    return len(free) <= MOST_FREE and int(largest) <= LARGEST_GROUP and int(width) <= MOST_EQUATIONS


def _batches(data: ConeData, group: IntArray) -> tuple[list[_Batch], list[IntArray]]:
    """Batches of groups, and the equations of each set of them."""
    product, units = data.product, Units.of(data.product)
    n_groups = int(group.max(initial=-1)) + 1
    held = sp.coo_array(data.cone_matrix)
    group_of_unit = np.full(units.n_units, -1)
    group_of_unit[units.unit_of_row[held.coords[0]]] = group[held.coords[1]]
    unknowns = by_group(np.arange(len(group)), group, n_groups)
    n_lines = product.n_lines
    lines = by_group(np.arange(n_lines), group_of_unit[:n_lines], n_groups)
    cones = by_group(np.arange(product.n_cones), group_of_unit[n_lines:], n_groups)
    columns = dense_rows(data.equations_t, group, n_groups)
    shapes = np.column_stack([*(np.diff(part[1]) for part in (unknowns, lines, cones)), columns.widths])
    batches, rows = [], []
    shape_of = alike(shapes)
    for groups, touched, size in sets_of_alike(shape_of, columns):
        mine = taken(unknowns, groups), taken(lines, groups), taken(cones, groups)
        place = np.zeros(len(group), dtype=np.int64)
        place[mine[0]] = np.arange(mine[0].shape[1])
        of_lines, of_cones = _dense(data, mine, place)
        blocks = columns.blocks(groups, place, mine[0].shape[1])
        root = np.sqrt(data.quadratic[mine[0]])
        batches.append(_Batch(*mine, of_lines, of_cones, root, blocks, size))
        rows.append(touched)
    return batches, rows


def _dense(
    data: ConeData, members: tuple[IntArray, IntArray, IntArray], place: IntArray
) -> tuple[FloatArray, FloatArray]:
    """Rows of G of each group over its own unknowns, half-lines (n, a, g) and cones (3, n, b, g)."""
    unknowns, lines, cones = members
    n, g = unknowns.shape
    n_lines, n_cones = data.product.n_lines, data.product.n_cones

    def rows(numbers: IntArray) -> FloatArray:
        held = sp.coo_array(data.cone_matrix[numbers.ravel()])
        dense = np.zeros((numbers.size, g))
        dense[held.coords[0], place[held.coords[1]]] = held.data
        return dense.reshape(n, numbers.shape[1], g)

    return rows(lines), np.stack([rows(n_lines + j * n_cones + cones) for j in range(3)])
