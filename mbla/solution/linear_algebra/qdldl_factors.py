"""qdldl: L D Lᵀ without exchanges in an approximate minimum degree order; always there. Only importer of qdldl.

Its library takes the upper triangle by columns. That is what the lower one becomes when the unknowns are counted from
the end, and its stored entries then stand in the reverse order: nothing has to be sorted. Order, elimination tree and
the place of every entry are found once, at the first factorisation, and kept.

It goes on past negative pivots, which tell the inertia of a matrix. They are given out with a copy of the factors
alone, which takes as long as one solution.

Order of elimination with little fill, found on the structure of blocks behind a pattern (``elimination_order``): the
three or six rows of a block, and those of blocks glued to it, touch the same columns, and an order by minimum degree
keeps them together. So it may as well be found on a graph with one node for each set of such rows, nine to thirty-six
times fewer entries.

Source: Amestoy, Davis and Duff 1996 (doi:10.1137/S0895479894278952); indistinguishable rows: Ashcraft 1995
(doi:10.1137/0916081).
"""

from __future__ import annotations

import numpy as np
import qdldl
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.ragged import numbered
from mbla.solution.linear_algebra.pattern import SymmetricPattern

SEED = 7
"""Of the numbers that stand for columns: reruns are identical."""


class QdldlFactors:
    """Factors of matrices of one pattern; see ``Factorization``."""

    library = "qdldl"

    def __init__(self, pattern: SymmetricPattern) -> None:
        pointers = (pattern.pointers[-1] - pattern.pointers[::-1]).astype(np.int32)
        indices = (pattern.n - 1 - pattern.indices[::-1]).astype(np.int32)
        self._upper = sp.csc_matrix((np.zeros(len(indices)), indices, pointers), shape=(pattern.n, pattern.n))
        self._solver: qdldl.Solver | None = None
        self._good = False

    def factorize(self, values: FloatArray) -> bool:
        """Factorise; False where the matrix is not positive definite to working accuracy or not finite.

        values : (nnz,) in the order of the pattern
        """
        pivots = self.pivots(values)
        self._good = pivots is not None and bool((pivots > 0.0).all())
        return self._good

    def pivots(self, values: FloatArray) -> FloatArray | None:
        """Factorise a matrix that need not be definite: its pivots, (n,), in the order of elimination.

        As many are negative as eigenvalues are (Sylvester's law of inertia). None where one is zero or not finite.
        """
        self._good = False
        if not np.isfinite(values).all():
            return None
        self._upper.data[:] = values[::-1]
        try:
            if self._solver is None:
                self._solver = qdldl.Solver(self._upper, upper=True)
            else:
                self._solver.update(self._upper, upper=True)
        except RuntimeError:  # a pivot is exactly zero
            return None
        _, pivots, _ = self._solver.factors()
        self._good = bool(np.isfinite(pivots).all())
        return np.asarray(pivots) if self._good else None

    def solve(self, rhs: FloatArray) -> FloatArray:
        """Solution for one right-hand side, (n,), or several, (n, k).

        Raises ValueError without a good factorisation.
        """
        if self._solver is None or not self._good:
            raise ValueError("solve without a good factorisation")
        if rhs.ndim == 1:
            return np.array(self._solver.solve(rhs[::-1])[::-1])
        answer = np.empty(rhs.shape)
        for number in range(rhs.shape[1]):
            answer[::-1, number] = self._solver.solve(rhs[::-1, number])
        return answer


def minimum_degree_order(n: int, row: IntArray, column: IntArray) -> IntArray:
    """Approximate minimum degree order of a graph of n nodes, (n,) numbers of nodes.

    row, column : (n_links,) ends of the links, every link once, row < column

    The library gives it out with the factors of a matrix alone: here of one that cannot break down.
    """
    if n == 0:
        return np.zeros(0, dtype=np.int64)
    links = np.bincount(row, minlength=n) + np.bincount(column, minlength=n)
    every = np.arange(n)
    entries = np.concatenate([links + 1.0, np.full(len(row), -1.0)])
    places = (np.concatenate([every, row]), np.concatenate([every, column]))
    dominant = sp.csc_matrix((entries, places), shape=(n, n))
    return np.asarray(qdldl.Solver(dominant, upper=True).factors()[2], dtype=np.int64)


def elimination_order(pattern: sp.coo_array | sp.csc_array) -> IntArray:
    """Numbers of the rows in the order in which they are eliminated, (n,); rows of one set follow each other.

    pattern : both triangles of a symmetric pattern, diagonal included, every entry stored once; values play no part
    """
    held = sp.coo_array(pattern)
    row, column = (np.asarray(part, dtype=np.int64) for part in held.coords)
    set_of = sets_of_equal_rows(int(held.shape[0]), row, column)
    n_sets = int(set_of.max(initial=-1)) + 1
    links = np.unique(set_of[column] * n_sets + set_of[row])
    below, above = links % max(n_sets, 1), links // max(n_sets, 1)
    upper = below < above
    place = np.empty(n_sets, dtype=np.int64)
    place[minimum_degree_order(n_sets, below[upper], above[upper])] = np.arange(n_sets)
    return np.argsort(place[set_of], kind="stable")


def sets_of_equal_rows(n: int, row: IntArray, column: IntArray) -> IntArray:
    """Number of the set of each row, (n,): rows of one set have their entries in the same columns.

    Rows are told apart by sums of random numbers, one for each column. Two that are wrongly taken for equal, one chance
    in 2⁶⁴ for a pair, would cost fill, not a right answer.
    """
    numbers = np.random.default_rng(SEED).integers(0, 2**64, n, dtype=np.uint64)
    sums = np.zeros(n, dtype=np.uint64)
    np.add.at(sums, row, numbers[column])  # wraps around, as it may
    return numbered(sums.view(np.int64))[0]  # as they come: neighbours stay neighbours
