"""Sums of many small products XᵀX in one sparse matrix of fixed pattern, and many small groups and triangles at once.

Each block X, (…, C), belongs to C rows of the matrix. Blocks of one shape are multiplied together, and one map, made
once, adds their products up at their places in the matrix. Inverses of many blocks and block-diagonal matrices stand
here too.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray, distinct, starts
from mbla.solution.linear_algebra import SymmetricPattern


@dataclass(frozen=True)
class PlacedProducts:
    """Pattern of the sum, and where each batch of products goes.

    lower    : for each batch, places of the lower triangle in a flat C × C matrix
    place    : for each batch, (n_blocks C (C + 1) / 2,) entry of the pattern
    diagonal : (n,) entries of the diagonal
    """

    pattern: SymmetricPattern
    lower: tuple[IntArray, ...]
    place: tuple[IntArray, ...]
    diagonal: IntArray

    def summed(self, batches: list[FloatArray]) -> FloatArray:
        """Values of Σ XᵀX in the order of the pattern; each batch is (n_blocks, n_rows of X, C)."""
        values = np.zeros(len(self.pattern.indices))
        for x, lower, place in zip(batches, self.lower, self.place, strict=True):
            products = np.matmul(x.transpose(0, 2, 1), x).reshape(len(x), -1)
            values += np.bincount(place, products[:, lower].ravel(), len(values))
        return values


def placed_products(n: int, columns: list[IntArray]) -> PlacedProducts:
    """Places for batches whose blocks belong to these rows of the matrix, (n_blocks, C) ascending each."""
    triangles = [np.tril_indices(held.shape[1]) for held in columns]
    keys = [
        (held[:, column] * n + held[:, row]).ravel() for held, (row, column) in zip(columns, triangles, strict=True)
    ]
    stored = distinct(np.concatenate([*keys, np.arange(n) * (n + 1)]))
    pointers = np.searchsorted(stored, np.arange(n + 1) * n).astype(np.int32)
    pattern = SymmetricPattern(n, (stored % n).astype(np.int32), pointers)
    return PlacedProducts(
        pattern=pattern,
        lower=tuple(row * held.shape[1] + column for held, (row, column) in zip(columns, triangles, strict=True)),
        place=tuple(np.searchsorted(stored, key) for key in keys),
        diagonal=pattern.pointers[:-1].astype(np.int64),
    )


@dataclass(frozen=True)
class DenseRows:
    """Rows of a sparse matrix gathered into dense blocks, one for each of some groups of rows.

    columns : for each group its columns, ascending, as one array with ``pointers``
    """

    columns: IntArray
    pointers: IntArray
    group: IntArray
    row: IntArray
    local_column: IntArray
    values: FloatArray

    @property
    def widths(self) -> IntArray:
        """(n_groups,) columns of each."""
        return np.diff(self.pointers)

    def columns_of(self, groups: IntArray) -> IntArray:
        """(n_groups, C) for groups of one width."""
        width = int(self.widths[groups[0]]) if len(groups) else 0
        return np.asarray(self.columns[self.pointers[groups][:, None] + np.arange(width)])

    def blocks(self, groups: IntArray, place_of_row: IntArray, n_rows: int) -> FloatArray:
        """(n_groups, n_rows, C) for groups of one width; ``place_of_row`` is the row's place in its block."""
        index = np.full(len(self.pointers) - 1, -1)
        index[groups] = np.arange(len(groups))
        width = int(self.widths[groups[0]]) if len(groups) else 0
        mine = index[self.group] >= 0
        result = np.zeros((len(groups), n_rows, width))
        result[index[self.group[mine]], place_of_row[self.row[mine]], self.local_column[mine]] = self.values[mine]
        return result


def sets_of_alike(shape_of: IntArray, rows: DenseRows) -> Iterator[tuple[IntArray, IntArray, int]]:
    """Groups of one shape whose sets of equal columns are of one size: groups, columns of each set, size of the sets.

    shape_of : (n_groups,) number of the shape of each, from 0
    Groups of one set follow each other; columns are (n_sets, C).
    """
    for number in range(int(shape_of.max(initial=-1)) + 1):
        here = np.flatnonzero(shape_of == number)
        columns = rows.columns_of(here)
        of_set = alike(columns)
        size_of_set = np.bincount(of_set, minlength=1)
        order = np.argsort(of_set, kind="stable")
        for size in np.unique(size_of_set[of_set]).tolist():
            chosen = order[size_of_set[of_set[order]] == size]
            yield here[chosen], columns[chosen[::size]], size


def dense_rows(matrix: sp.csr_array, group_of_row: IntArray, n_groups: int) -> DenseRows:
    """Gather the rows of each group; rows of group −1 are left out."""
    held = sp.coo_array(matrix)
    row, column = (np.asarray(part, dtype=np.int64) for part in held.coords)
    here = group_of_row[row] >= 0
    row, column, values = row[here], column[here], held.data[here]
    group, width = group_of_row[row], int(matrix.shape[1])
    keys, place = np.unique(group * width + column, return_inverse=True)
    pointers = np.searchsorted(keys, np.arange(n_groups + 1) * width)
    return DenseRows(keys % width, pointers, group, row, place - pointers[group], values)


def alike(columns: IntArray) -> IntArray:
    """Number of the set of equal rows to which each row of (n, C) belongs."""
    if not columns.size:
        return np.zeros(len(columns), dtype=np.int64)
    return np.asarray(np.unique(columns, axis=0, return_inverse=True)[1]).reshape(-1)


def by_group(members: IntArray, group: IntArray, n_groups: int) -> tuple[IntArray, IntArray]:
    """Members of all groups, one after the other, (n_kept,), and where each group starts, (n_groups + 1,).

    members : (n,)
    group   : (n,) to which each belongs, negative: to none, and it is left out
    """
    here = group >= 0
    order = np.argsort(group[here], kind="stable")
    return members[here][order], starts(np.bincount(group[here], minlength=n_groups))


def taken(part: tuple[IntArray, IntArray], groups: IntArray) -> IntArray:
    """(n_groups, as many as each has)."""
    members, pointers = part
    count = int(pointers[groups[0] + 1] - pointers[groups[0]])
    return np.asarray(members[pointers[groups][:, None] + np.arange(count)])


def triangular_factor(x: FloatArray) -> FloatArray:
    """R of x = U R by modified Gram–Schmidt, (g, g, n), from x (rows, g, n), which is overwritten."""
    g = x.shape[1]
    r = np.zeros((g, g, x.shape[2]))
    for i in range(g):
        r[i, i] = np.sqrt(np.einsum("rn,rn->n", x[:, i], x[:, i]))
        x[:, i] /= r[i, i]
        for j in range(i + 1, g):
            r[i, j] = np.einsum("rn,rn->n", x[:, i], x[:, j])
            x[:, j] -= r[i, j] * x[:, i]
    return r


def forward(r: FloatArray, rhs: FloatArray) -> FloatArray:
    """R⁻ᵀ rhs, of the shape of rhs, (g, n, k), for n upper triangles R at once, (g, g, n)."""
    result = np.empty_like(rhs)
    for i in range(len(r)):
        result[i] = rhs[i]
        for j in range(i):
            result[i] -= r[j, i][:, None] * result[j]
        result[i] /= r[i, i][:, None]
    return result


def backward(r: FloatArray, rhs: FloatArray) -> FloatArray:
    """R⁻¹ rhs, of the shape of rhs, (g, n, k), for n upper triangles R at once, (g, g, n)."""
    result = np.empty_like(rhs)
    for i in reversed(range(len(r))):
        result[i] = rhs[i]
        for j in range(i + 1, len(r)):
            result[i] -= r[i, j][:, None] * result[j]
        result[i] /= r[i, i][:, None]
    return result


def inverses(blocks: FloatArray) -> FloatArray:
    """Inverse of each block, (n, k, k); not-a-number throughout a block that is exactly singular.

    Whoever asks sees by ``np.isfinite`` that there is no inverse, as where the entries have overflowed.
    """
    try:
        return np.asarray(np.linalg.inv(blocks), dtype=np.float64)
    except np.linalg.LinAlgError:
        found = np.full(blocks.shape, np.nan)
        for number, block in enumerate(blocks):
            try:
                found[number] = np.linalg.inv(block)
            except np.linalg.LinAlgError:
                continue
        return found


def block_diagonal(blocks: FloatArray) -> sp.csr_array:
    """The matrix, (n k, n k), with these blocks, (n, k, k), on its diagonal."""
    n, size = blocks.shape[:2]
    return sp.csr_array(sp.bsr_array((blocks, np.arange(n), np.arange(n + 1)), shape=(size * n, size * n)))
