"""The stiffness A C Aᵀ of an assembly with joint stiffnesses C, on a sparsity pattern found once.

Each contact point adds a small dense block, (rows of its two bodies)²; only C changes from one Newton step to the next,
so the places of the entries are computed once per program. At 410 blocks this costs 6 ms a matrix where two sparse
products cost 25.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray


@dataclass(frozen=True)
class StiffnessPattern:
    """Where the entries of A C Aᵀ + κ B go, B a fixed matrix of the same size.

    columns  : (n_points, most_rows, components) entries of A by point, in the rows that the point touches, else zero
    entries  : entries of the points' dense blocks that exist, as indices of the flattened (n_points, most_rows²)
    place    : where each of them goes among the stored entries of the matrix
    added    : B, (n_stored,)
    indices, indptr : compressed columns
    """

    columns: FloatArray
    entries: IntArray
    place: IntArray
    added: FloatArray
    indices: IntArray
    indptr: IntArray

    def matrix(self, joint_stiffness: FloatArray, factor: float) -> sp.csc_matrix:
        """A C Aᵀ + factor B from C, (n_points, components, components)."""
        blocks = np.matmul(np.matmul(self.columns, joint_stiffness), self.columns.transpose(0, 2, 1))
        values = np.bincount(self.place, blocks.reshape(-1)[self.entries], len(self.added)) + factor * self.added
        size = len(self.indptr) - 1
        return sp.csc_matrix((values, self.indices, self.indptr), shape=(size, size))


def stiffness_pattern(equilibrium_matrix: sp.csr_array, components: int, added: sp.csr_array) -> StiffnessPattern:
    """Pattern for an equilibrium matrix, (n_rows, components n_points), and a matrix B, (n_rows, n_rows)."""
    matrix = equilibrium_matrix.tocoo()
    n_rows, n_points = matrix.shape[0], matrix.shape[1] // components
    of_point = matrix.col.astype(np.int64) // components
    touched, which = np.unique(of_point * n_rows + matrix.row, return_inverse=True)
    point, row = touched // n_rows, touched % n_rows
    slot = np.arange(len(touched)) - np.searchsorted(point, np.arange(n_points))[point]
    most_rows = int(slot.max(initial=0)) + 1
    columns = np.zeros((n_points, most_rows, components))
    columns[of_point, slot[which], matrix.col % components] = matrix.data
    rows = np.full((n_points, most_rows), n_rows, dtype=np.int64)
    rows[point, slot] = row

    shape = (n_points, most_rows, most_rows)
    first = np.broadcast_to(rows[:, :, None], shape).ravel()
    second = np.broadcast_to(rows[:, None, :], shape).ravel()
    entries = np.flatnonzero((first < n_rows) & (second < n_rows))
    other = added.tocoo()
    keys = np.concatenate([second[entries] * n_rows + first[entries], other.col.astype(np.int64) * n_rows + other.row])
    stored, place = np.unique(keys, return_inverse=True)
    return StiffnessPattern(
        columns=columns,
        entries=entries,
        place=place[: len(entries)],
        added=np.bincount(place[len(entries) :], other.data, len(stored)).astype(np.float64),
        indices=(stored % n_rows).astype(np.int32),
        indptr=np.searchsorted(stored // n_rows, np.arange(n_rows + 1)).astype(np.int32),
    )
