"""Condensation onto the unknowns, for programs of few equations: the kinematic form.

N = Q + G̃ᵀ G̃, one row and column for each unknown (velocities of the blocks, multipliers of cohesive joints), with the
equations, usually f_L·u = 1 alone, as a border. Half-lines and cones with the same columns, those of one interface, are
one dense block, so that N is the sum of as many small products as there are interfaces.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.solution.condensed.condensation import RELATIVE_SHIFT, SHIFT, bordered
from mbla.solution.condensed.cone_data import ConeData, Units
from mbla.solution.condensed.products import DenseRows, PlacedProducts, alike, dense_rows, placed_products
from mbla.solution.condensed.scaling import Scaling, boosted
from mbla.solution.linear_algebra import Factorization, factorization


@dataclass(frozen=True)
class _Batch:
    """Sets of half-lines and cones with the same columns, equally many of each in every set.

    lines, cones : (n_sets, a), (n_sets, b) numbers of the half-lines and of the cones
    of_lines     : (n_sets, a, C) rows of G
    of_cones     : (3, n_sets, b, C)
    """

    lines: IntArray
    cones: IntArray
    of_lines: FloatArray
    of_cones: FloatArray

    def scaled(self, scaling: Scaling) -> FloatArray:
        """W⁻¹ of the rows, (n_sets, a + 3 b, C)."""
        n_sets, a, width = self.of_lines.shape
        b = self.cones.shape[1]
        x = np.empty((n_sets, a + 3 * b, width))
        np.divide(self.of_lines, scaling.line[self.lines][:, :, None], out=x[:, :a])
        if b:
            out = x[:, a:].reshape(n_sets, 3, b, width).transpose(1, 0, 2, 3)
            boosted(scaling.w[:, self.cones][..., None], self.of_cones, -1.0, out)
            out /= scaling.eta[self.cones][None, :, :, None]
        return x


class OnUnknowns:
    """See ``Condensation``."""

    def __init__(self, data: ConeData, library: str | None, threads: int) -> None:
        self._data = data
        self._batches, columns = _batches(data)
        self._products: PlacedProducts = placed_products(len(data.cost), columns)
        self.factors: Factorization = factorization(self._products.pattern, library, threads)
        identity = Scaling.identity(data.product)
        diagonal = self._products.summed([batch.scaled(identity) for batch in self._batches])
        self._shift = SHIFT * float(diagonal[self._products.diagonal].mean())
        self._border = data.equations.toarray().T
        self._spread = np.zeros_like(self._border)
        self._inner = np.zeros((self._border.shape[1],) * 2)

    def factorize(self, scaling: Scaling) -> bool:
        """Assemble and factorise N."""
        values = self._products.summed([batch.scaled(scaling) for batch in self._batches])
        diagonal = self._products.diagonal
        values[diagonal] += self._data.quadratic
        values[diagonal] += RELATIVE_SHIFT * values[diagonal] + self._shift
        if not self.factors.factorize(values):
            return False
        self._spread = self.factors.solve(self._border)
        self._inner = self._border.T @ self._spread
        return bool(np.isfinite(self._inner).all())

    def solve(self, r_x: FloatArray, r_e: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Dx and dy, not refined."""
        free = self.factors.solve(r_x)
        if not len(r_e):
            return free, np.zeros(0)
        y = bordered(self._inner, self._border.T @ free - r_e)
        return free - self._spread @ y, y


def _batches(data: ConeData) -> tuple[list[_Batch], list[IntArray]]:
    """Batches of sets, and the columns of each set."""
    product, units = data.product, Units.of(data.product)
    rows = dense_rows(data.cone_matrix, units.unit_of_row, units.n_units)
    batches, columns = [], []
    for width in np.unique(rows.widths[rows.widths > 0]):
        here = np.flatnonzero(rows.widths == width)
        held = rows.columns_of(here)
        of_set = alike(held)
        is_cone = here >= product.n_lines
        n_sets = int(of_set.max()) + 1
        n_lines = np.bincount(of_set[~is_cone], minlength=n_sets)
        n_cones = np.bincount(of_set[is_cone], minlength=n_sets)
        for a, b in np.unique(np.column_stack([n_lines, n_cones]), axis=0):
            sets = np.flatnonzero((n_lines == a) & (n_cones == b))
            lines, cones = (_members(here[kind], of_set[kind], sets) for kind in (~is_cone, is_cone))
            first = np.zeros(n_sets, dtype=np.int64)
            first[of_set] = np.arange(len(here))
            batches.append(_batch(rows, units, product.n_lines, lines, cones))
            columns.append(held[first[sets]])
    return batches, columns


def _members(units: IntArray, of_set: IntArray, sets: IntArray) -> IntArray:
    """Units of each of the sets, (n_sets, as many as each has)."""
    chosen = np.isin(of_set, sets)
    order = np.argsort(of_set[chosen], kind="stable")
    return units[chosen][order].reshape(len(sets), -1)


def _batch(rows: DenseRows, units: Units, n_lines: int, lines: IntArray, cones: IntArray) -> _Batch:
    n_sets, width = len(lines), int(rows.widths[np.concatenate([lines.ravel(), cones.ravel()])[0]])
    of_lines = np.zeros((n_sets, lines.shape[1], width))
    of_cones = np.zeros((3, n_sets, cones.shape[1], width))
    if lines.size:
        of_lines = rows.blocks(lines.ravel(), units.place_of_row, 1).reshape(of_lines.shape)
    if cones.size:
        blocks = rows.blocks(cones.ravel(), units.place_of_row, 3)
        of_cones = np.ascontiguousarray(blocks.transpose(1, 0, 2)).reshape(of_cones.shape)
    return _Batch(lines, cones - n_lines, of_lines, of_cones)
