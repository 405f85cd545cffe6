"""Where a symmetric sparse matrix has its entries: the lower triangle, compressed by columns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from mbla.arrays import FloatArray, IntArray

IndexArray: TypeAlias = NDArray[np.int32]


@dataclass(frozen=True)
class SymmetricPattern:
    """Lower triangle, whole diagonal included, compressed by columns, rows sorted.

    The first entry of every column is thus its diagonal. Read by rows the same arrays are the upper triangle.

    n        : number of rows and columns
    indices  : (nnz,) int32, rows
    pointers : (n + 1,) int32, where the columns start
    """

    n: int
    indices: IndexArray
    pointers: IndexArray

    def __post_init__(self) -> None:
        n, indices, pointers = self.n, self.indices, self.pointers
        if indices.dtype != np.int32 or pointers.dtype != np.int32:
            raise ValueError("indices and pointers of a pattern are int32")
        if pointers.shape != (n + 1,) or pointers[0] != 0 or pointers[-1] != len(indices):
            raise ValueError("pointers of a pattern go from 0 to its number of entries")
        if n and (np.diff(pointers) < 1).any():
            raise ValueError("every column of a pattern has its diagonal")
        key = self.columns().astype(np.int64) * n + indices
        if (indices[pointers[:-1]] != np.arange(n)).any() or (np.diff(key) <= 0).any() or (indices >= n).any():
            raise ValueError("columns of a pattern are sorted and start on the diagonal")

    def columns(self) -> IntArray:
        """Column of every entry, (nnz,)."""
        return np.repeat(np.arange(self.n), np.diff(self.pointers))

    def matrix(self, values: FloatArray) -> sp.csc_array:
        """Both triangles, for products."""
        lower = sp.csc_array((values, self.indices, self.pointers), shape=(self.n, self.n))
        return sp.csc_array(lower + sp.tril(lower, -1).T)


def lower_triangle(matrix: sp.csc_array | sp.csr_array | sp.coo_array) -> tuple[SymmetricPattern, FloatArray]:
    """Pattern and values of the lower triangle of a symmetric matrix, its whole diagonal included."""
    n = int(matrix.shape[0])
    held = sp.coo_array(matrix)
    row, column = (np.asarray(part, dtype=np.int64) for part in held.coords)
    lower, every = row >= column, np.arange(n)
    keys = np.concatenate([column[lower] * n + row[lower], every * (n + 1)])
    stored, place = np.unique(keys, return_inverse=True)
    values = np.bincount(place, np.concatenate([held.data[lower], np.zeros(n)]), len(stored))
    counts = np.bincount(stored // max(n, 1), minlength=n)
    pointers = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
    return SymmetricPattern(n, (stored % max(n, 1)).astype(np.int32), pointers), values.astype(np.float64)


def stored_lower_triangle(matrix: sp.csc_array) -> tuple[SymmetricPattern, FloatArray]:
    """The same of a matrix that stores its whole diagonal and every entry once: nothing has to be looked for."""
    held = matrix if matrix.has_sorted_indices else matrix.sorted_indices()
    n = int(held.shape[0])
    columns = np.repeat(np.arange(n), np.diff(held.indptr))
    lower = held.indices >= columns
    pointers = np.concatenate([[0], np.cumsum(np.bincount(columns[lower], minlength=n))]).astype(np.int32)
    return SymmetricPattern(n, held.indices[lower].astype(np.int32), pointers), held.data[lower]
