"""Masses in an implicit step: what blocks resist to a change of their motion.

In a step of time h, whose unknown u are displacements, velocities v_f that the blocks would have without joints lead to
u_f = h v_f, and the balance of the joints has one more term, h̄ the time for which their forces act::

    A x − M (u − u_f)/(h h̄) = 0

In units of the program, whose rows S take up those of the blocks (:mod:`mbla.program.program`), M becomes Sᵀ M S.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray, IntArray
from mbla.solution.linear_algebra.stiffness import Entries, Stiffness


@dataclass(frozen=True)
class Masses:
    """Of a step.

    matrix  : M/(h h̄) by rows, (n_rows, n_rows)
    free    : (n_rows,) M u_f/(h h̄)
    entries : of the matrix among those of the stiffness
    """

    matrix: sp.csr_array
    free: FloatArray
    entries: Entries

    def resistance(self, u: FloatArray) -> FloatArray:
        """M (u − u_f)/(h h̄), (n_rows,)."""
        return np.asarray(self.matrix @ u - self.free)


@dataclass(frozen=True)
class MassPattern:
    """Pattern of masses of a program, and its inverse, by sets of rows that masses couple.

    matrix : ones where entries may be, by rows
    """

    matrix: sp.csr_array

    def filled(self, values: FloatArray) -> sp.csr_array:
        """The matrix with entries, (nnz,)."""
        ones = self.matrix
        return sp.csr_array((values, ones.indices, ones.indptr), shape=ones.shape)

    def places(self, stiffness: Stiffness) -> IntArray:
        """Of the entries among those of a stiffness, (nnz,)."""
        rows = np.repeat(np.arange(self.matrix.shape[0]), np.diff(self.matrix.indptr))
        return stiffness.places(rows, self.matrix.indices.astype(np.int64))

    @cached_property
    def sets(self) -> list[tuple[IntArray, IntArray]]:
        """Coupled rows, (n_sets, C), those of like number together, and places of their blocks among the entries."""
        count, label = connected_components(self.matrix, directed=False)
        order = np.argsort(label, kind="stable")
        sizes = np.bincount(label, minlength=count)
        first = np.concatenate([[0], np.cumsum(sizes)[:-1]])
        n = self.matrix.shape[0]
        keys = np.repeat(np.arange(n), np.diff(self.matrix.indptr)) * n + self.matrix.indices
        found = []
        for size in np.unique(sizes).tolist():
            rows = order[first[sizes == size][:, None] + np.arange(size)]
            wanted = (rows[:, :, None] * n + rows[:, None, :]).ravel()
            place = np.minimum(np.searchsorted(keys, wanted), len(keys) - 1)
            found.append((rows, np.where(keys[place] == wanted, place, len(keys)).reshape(len(rows), size, size)))
        return found

    def inverses(self, values: FloatArray) -> list[FloatArray]:
        """Of the blocks of each set, (n_sets, C, C), from the entries of the matrix, (nnz,)."""
        padded = np.append(values, 0.0)
        return [np.linalg.inv(padded[place]) for _, place in self.sets]

    def solved(self, inverses: list[FloatArray], right: FloatArray) -> FloatArray:
        """M⁻¹ f, (n_rows,)."""
        result = np.empty_like(right)
        for (rows, _), inverse in zip(self.sets, inverses, strict=True):
            result[rows] = np.einsum("nij,nj->ni", inverse, right[rows])
        return result
