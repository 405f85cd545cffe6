"""Where a symmetric sparse matrix has its entries: the lower triangle, compressed by columns."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
import scipy.sparse as sp
from numpy.typing import NDArray

from mbla.arrays import FloatArray, IntArray, starts

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

    def columns(self) -> IntArray:
        """Column of every entry, (nnz,)."""
        return np.repeat(np.arange(self.n), np.diff(self.pointers))

    def matrix(self, values: FloatArray) -> sp.csc_array:
        """Both triangles, (n, n), for products, from the entries of the lower one, (nnz,)."""
        lower = sp.csc_array((values, self.indices, self.pointers), shape=(self.n, self.n))
        return sp.csc_array(lower + sp.tril(lower, -1).T)


def lower_triangle(matrix: sp.csc_array) -> tuple[SymmetricPattern, FloatArray]:
    """Pattern and values, (nnz,), of the lower triangle of a matrix.

    matrix : (n, n), its whole diagonal stored, and every entry once
    """
    held = matrix if matrix.has_sorted_indices else matrix.sorted_indices()
    n = int(held.shape[0])
    columns = np.repeat(np.arange(n), np.diff(held.indptr))
    lower = held.indices >= columns
    pointers = starts(np.bincount(columns[lower], minlength=n)).astype(np.int32)
    return SymmetricPattern(n, held.indices[lower].astype(np.int32), pointers), held.data[lower]
