"""Stiffness of all joints, K = A C Aᵀ, assembled and factorised again and again on one pattern.

The equilibrium matrix A never changes in a sequence, only the tangents C of the joints do, so that the places of all
entries of K, and an elimination order with little fill, are found once. The matrix that is factorised is bordered by
the live load::

    [ −(K + shift)   f_L ]
    [     f_Lᵀ        0  ]

or by an equation that says that the load factor does not change. It need not be symmetric: friction without
dilatancy is not. Points whose columns have the same rows (those of one interface) are assembled together as dense
blocks.
"""

from __future__ import annotations

from collections.abc import Sequence
from copy import copy
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray
from scipy.sparse.linalg import SuperLU

from mbla.arrays import FloatArray, IntArray, distinct
from mbla.program.program import Program
from mbla.solution.linear_algebra.block_products import dense_rows, sets_of_alike
from mbla.solution.linear_algebra.qdldl_factors import elimination_order
from mbla.solution.linear_algebra.superlu import PIVOT_THRESHOLD, factors_on_the_diagonal

LOOSE = 1
"""Columns at most that hold nothing above the border. With more the matrix is singular; SuperLU finds that, too, but
goes on, and may then call BLAS with a negative size, which prints a line of its own."""


@dataclass(frozen=True)
class PointGroup:
    """Sets of equally many points, those of one set having the same rows of A.

    points : (n_sets, n_members)
    block  : (n_sets, n_rows, n_members components) columns of A at those rows
    place  : (n_sets n_rows n_rows,) place of every product among the entries of the matrix
    """

    points: IntArray
    block: FloatArray
    place: IntArray


@dataclass(frozen=True)
class Entries:
    """Values at places among the entries of the matrix, (n,) each; some may be the same."""

    place: IntArray
    values: FloatArray


@dataclass(frozen=True)
class BorderedFactors:
    """The factorised bordered matrix, in the order of elimination."""

    matrix: sp.csc_array
    factors: SuperLU
    order: IntArray

    def __call__(self, rhs: FloatArray) -> FloatArray:
        """Solution of the bordered system, (n_rows + 1,), refined once."""
        ordered = rhs[self.order]
        solution = self.factors.solve(ordered)
        solution += self.factors.solve(ordered - self.matrix @ solution)  # pivots are small where joints are open
        return self._back(solution)

    def unrefined(self, rhs: FloatArray) -> FloatArray:
        """The same without refinement, in half of the time."""
        return self._back(self.factors.solve(rhs[self.order]))

    def _back(self, ordered: FloatArray) -> FloatArray:
        result = np.empty_like(ordered)
        result[self.order] = ordered
        return result


@dataclass(frozen=True)
class Places:
    """Pattern of the bordered matrix of programs of one equilibrium matrix A in the order of elimination, by columns.

    order    : (n_rows + 1,) row of the program at each place, the load factor last
    diagonal : (n_rows,) place of the diagonal entries in the order of the program's rows
    border   : places of column and row of the live load, in the order of the program's rows, and of the corner
    size     : (n_rows,) diagonal of A Aᵀ: stiffness of every row when all joints stick with stiffness 1
    compatibility : Aᵀ, by rows
    """

    groups: tuple[PointGroup, ...]
    indices: NDArray[np.int32]
    pointers: NDArray[np.int32]
    order: IntArray
    diagonal: IntArray
    border: tuple[IntArray, IntArray, int]
    size: FloatArray
    compatibility: sp.csr_array


@dataclass(frozen=True)
class Stiffness(Places):
    """The bordered matrix of one program."""

    program: Program

    def velocities(self, u: FloatArray) -> FloatArray:
        """Velocities at the contact points, (n_points, components)."""
        return (self.compatibility @ u).reshape(-1, self.program.components)

    def factorized(
        self,
        tangents: FloatArray,
        shift: FloatArray,
        *,
        fixed_load: bool = False,
        further: Sequence[Entries] = (),
    ) -> BorderedFactors | None:
        """Factorise with C, (n_points, components, components).

        shift   : (n_rows,) of the diagonal
        further : added to K

        None where the matrix is singular to working accuracy.
        """
        matrix = self._matrix(tangents, shift, fixed_load)
        for entries in further:
            matrix.data -= np.bincount(entries.place, entries.values, len(matrix.data))
        regular = bool(np.isfinite(matrix.data).all()) and len(self._loose_rows(matrix)) <= LOOSE
        factors = factors_on_the_diagonal(matrix, PIVOT_THRESHOLD) if regular else None
        return None if factors is None else BorderedFactors(matrix, factors, self.order)

    def _loose_rows(self, matrix: sp.csc_array) -> list[int]:
        """Places whose column holds nothing above the border: of a block whose joints are all open."""
        places = np.flatnonzero(matrix.data[self.diagonal] == 0.0)
        columns = np.searchsorted(self.pointers, self.diagonal[places], side="right") - 1
        return [each for each in columns if not matrix.data[self.pointers[each] : self.pointers[each + 1] - 1].any()]

    def _matrix(self, tangents: FloatArray, shift: FloatArray, fixed_load: bool) -> sp.csc_array:
        entries = np.zeros(len(self.indices))
        components = self.program.components
        for group in self.groups:
            n_sets, n_rows = group.block.shape[:2]
            columns = group.block.reshape(n_sets, n_rows, -1, components)
            halves = np.matmul(columns.transpose(0, 2, 1, 3), tangents[group.points])
            halves = halves.transpose(0, 2, 1, 3).reshape(n_sets, n_rows, -1)
            products = np.matmul(halves, group.block.transpose(0, 2, 1))
            entries -= np.bincount(group.place, products.ravel(), len(entries))
        entries[self.diagonal] -= shift
        column, row, corner = self.border
        live = self.program.live_load
        entries[column], entries[row] = live, 0.0 if fixed_load else live
        entries[corner] = 1.0 if fixed_load else 0.0
        matrix = copy(self._pattern)
        matrix.data = entries
        return matrix

    def places(self, rows: IntArray, columns: IntArray) -> IntArray:
        """Places of entries among those of the matrix, (n,), by rows and columns of the program; all must be there."""
        place, keys = self._keys
        wanted = place[columns] * len(place) + place[rows]
        found = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
        if not (keys[found] == wanted).all():
            raise ValueError("an entry lies outside of the pattern of the joints")
        return found

    @cached_property
    def _keys(self) -> tuple[IntArray, IntArray]:
        """Place of each row of the program in the order of elimination, and column n + row of every entry there."""
        n = len(self.order)
        place = np.empty(n, dtype=np.int64)
        place[self.order] = np.arange(n)
        return place, np.repeat(np.arange(n), np.diff(self.pointers)) * n + self.indices

    @cached_property
    def _pattern(self) -> sp.csc_array:
        """The matrix with zeros stored: one is copied for each factorisation, for scipy takes longer to make one."""
        shape = (len(self.order), len(self.order))
        pattern = sp.csc_array((np.zeros(len(self.indices)), self.indices, self.pointers), shape=shape)
        assert pattern.has_canonical_format
        return pattern


def stiffness_of(program: Program, coupled: sp.coo_array | None = None) -> Stiffness:
    """Pattern, places and order of elimination of a program.

    coupled : (n_rows, n_rows) entries that K has besides those of its joints, as those of masses; None for none
    """
    matrix = program.equilibrium_matrix
    found = _places(matrix, program.components, program.n_points, coupled)
    return Stiffness(**vars(found), program=program)


def _places(matrix: sp.csr_array, components: int, n_points: int, coupled: sp.coo_array | None) -> Places:
    """Of an equilibrium matrix, (n_rows, components n_points)."""
    n, compatibility = matrix.shape[0], sp.csr_array(matrix.T)
    sets = _point_sets(compatibility, components, n_points)
    pattern = _pattern(n, [(rows, blocks) for _, rows, blocks in sets], coupled)
    order = np.append(elimination_order(pattern), n)
    place_of = np.empty(n + 1, dtype=np.int64)
    place_of[order] = np.arange(n + 1)

    row, column = pattern.coords
    every = np.arange(n)
    rows = place_of[np.concatenate([row, every, np.full(n, n), [n]])]
    columns = place_of[np.concatenate([column, np.full(n, n), every, [n]])]
    keys = distinct(columns * (n + 1) + rows)

    def places(row: IntArray, column: IntArray) -> IntArray:
        return np.searchsorted(keys, place_of[column] * (n + 1) + place_of[row])

    groups = tuple(
        PointGroup(
            points,
            blocks,
            places(np.repeat(rows, rows.shape[1], axis=1).ravel(), np.tile(rows, (1, rows.shape[1])).ravel()),
        )
        for points, rows, blocks in sets
    )
    end = np.full(n, n)
    return Places(
        groups=groups,
        indices=(keys % (n + 1)).astype(np.int32),
        pointers=np.searchsorted(keys, np.arange(n + 2) * (n + 1)).astype(np.int32),
        order=order,
        diagonal=places(every, every),
        border=(places(every, end), places(end, every), int(places(end[:1], end[:1])[0])),
        size=np.asarray(matrix.multiply(matrix).sum(axis=1)),
        compatibility=compatibility,
    )


def _point_sets(
    compatibility: sp.csr_array, components: int, n_points: int
) -> list[tuple[IntArray, IntArray, FloatArray]]:
    """Points, rows and columns of A of all sets, those of like shape together; see ``PointGroup``."""
    rows = dense_rows(compatibility, np.repeat(np.arange(n_points), components), n_points)
    shape_of = np.unique(rows.widths, return_inverse=True)[1]
    place, sets = np.tile(np.arange(components), n_points), []
    for points, columns, size in sets_of_alike(shape_of, rows):
        if columns.shape[1]:
            blocks = rows.blocks(points, place, components).reshape(len(columns), size, components, -1)
            block = blocks.transpose(0, 3, 1, 2).reshape(*columns.shape, -1)
            sets.append((points.reshape(-1, size), columns, np.ascontiguousarray(block)))
    return sets


def _pattern(n: int, sets: list[tuple[IntArray, FloatArray]], coupled: sp.coo_array | None) -> sp.coo_array:
    """Entries of K that can differ from zero, and the whole diagonal, as ones."""
    rows = [np.repeat(rows, rows.shape[1], axis=1).ravel() for rows, _ in sets]
    columns = [np.tile(rows, (1, rows.shape[1])).ravel() for rows, _ in sets]
    if coupled is not None:
        rows, columns = (
            [*own, each.astype(np.int64)] for own, each in zip((rows, columns), coupled.coords, strict=True)
        )
    row, column = np.concatenate([*rows, np.arange(n)]), np.concatenate([*columns, np.arange(n)])
    keys = distinct(row * n + column)
    return sp.coo_array((np.ones(len(keys)), (keys // n, keys % n)), shape=(n, n))
