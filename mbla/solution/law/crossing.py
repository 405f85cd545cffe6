"""What resultants of interfaces that follow the normal forces of points add to the matrix of a step.

A law whose bounds hang on the normal forces n of its points has dr = −W⁻¹(… + X dn), and dn = −C_n dv of each point, so
that its rows meet those of all blocks that move these points::

    J W⁻¹ X C_n Aᵀ

Blocks of one interface are few: all products are dense and small, and their places in the matrix are found once.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.solution.linear_algebra.stiffness import Entries, Stiffness


@dataclass(frozen=True)
class Crossing:
    """Of one law, m interfaces of c resultants, p points and d rows of the program that move them, at most.

    points : (m, p)
    moved  : (m, p, components, d) from velocities of these rows to those of the points
    acts   : (m, c, 1) with which resultants act on their rows
    place  : (m, c, d) of what is added among the entries of the matrix
    """

    points: IntArray
    moved: FloatArray
    acts: FloatArray
    place: IntArray

    @staticmethod
    def of(matrix: Stiffness, points: IntArray, acts: sp.csc_array) -> Crossing:
        """Of the columns of A, (n_rows, c m), that are the resultants of a law, interface by interface."""
        components, (m, p) = matrix.program.components, points.shape
        columns = (components * points[:, :, None] + np.arange(components)).ravel()
        own = sp.csr_array(matrix.compatibility[columns]).tocoo()
        owner, n_rows = own.coords[0] // (p * components), own.shape[1]
        pairs, which = np.unique(owner * n_rows + own.coords[1], return_inverse=True)
        first = np.searchsorted(pairs, np.arange(m) * n_rows)
        place, rows = which - first[owner], np.zeros((m, int(np.diff(first, append=len(pairs)).max())), dtype=np.int64)
        moved = np.zeros((m, p * components, rows.shape[1]))
        moved[owner, own.coords[0] % (p * components), place] = own.data
        rows[owner, place] = own.coords[1]

        resultants = acts.tocoo()
        row, factor = np.zeros(acts.shape[1], dtype=np.int64), np.zeros(acts.shape[1])
        row[resultants.coords[1]], factor[resultants.coords[1]] = resultants.coords[0], resultants.data
        acting, row_of = factor.reshape(m, -1, 1), row.reshape(m, -1, 1)
        known = (acting != 0.0) & (moved != 0.0).any(axis=1)[:, None]
        at_rows, at_columns = (np.broadcast_to(each, known.shape)[known] for each in (row_of, rows[:, None]))
        among = np.zeros(known.shape, dtype=np.int64)
        among[known] = matrix.places(at_rows, at_columns)
        return Crossing(points, moved.reshape(m, p, components, -1), acting, among)

    def entries(self, by_normal: FloatArray, tangents: FloatArray) -> Entries:
        """What is added to A C Aᵀ.

        by_normal : (m, c, p) of the resultants by the normal forces
        tangents  : (n_points, components, components) C of the points
        """
        follow = np.matmul(tangents[self.points][:, :, :1], self.moved)[:, :, 0]
        return Entries(self.place.ravel(), (self.acts * np.matmul(by_normal, follow)).ravel())
