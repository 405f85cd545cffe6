"""Masses of the solids among the entries of a program: Sᵀ M S, with the rows S that reductions leave."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.law.masses import MassPattern
from mbla.solution.pushover.pose.matrix_at_pose import spread


@dataclass(frozen=True)
class MassesAtPose:
    """Of a program whose full model has the free solids for blocks."""

    reduced: Program

    @property
    def coupled(self) -> sp.coo_array:
        """Entries that masses have, as ones."""
        return sp.coo_array(self.pattern.matrix)

    @property
    def pattern(self) -> MassPattern:
        """Rows that masses couple."""
        return self._summing[0]

    def entries(self, matrices: FloatArray) -> FloatArray:
        """Of Sᵀ M S, by rows, in units of the program, from M of the free solids, (n_free, 6, 6)."""
        return np.asarray(self._summing[1] @ matrices.ravel())

    def load(self, wrenches: FloatArray) -> FloatArray:
        """Of the rows, (n_rows,), from forces and moments on the free solids, (n_free, 6)."""
        return np.asarray(self.reduced.lift.velocities.T @ (self.reduced.full.scaling.row * wrenches.ravel()))

    @cached_property
    def _summing(self) -> tuple[MassPattern, sp.csr_array]:
        full, n = self.reduced.full, len(self.reduced.dead_load)
        rows = np.arange(len(full.scaling.row)).reshape(-1, 6)
        row = np.broadcast_to(rows[:, :, None], (*rows.shape, 6)).ravel()
        column = np.broadcast_to(rows[:, None, :], (*rows.shape, 6)).ravel()
        velocities = self.reduced.lift.velocities
        entry, at_row, at_column, value = spread(velocities, velocities, row, column)
        value = value * full.scaling.row[row[entry]] * (full.scaling.row * full.scaling.live)[column[entry]]
        every, place = np.unique(at_row * n + at_column, return_inverse=True)
        summing = sp.csr_array(sp.coo_array((value, (place.ravel(), entry)), shape=(len(every), len(row))))
        pointers = np.searchsorted(every, np.arange(n + 1) * n)
        ones = sp.csr_array((np.ones(len(every)), every % n, pointers), shape=(n, n))
        return MassPattern(ones), summing
