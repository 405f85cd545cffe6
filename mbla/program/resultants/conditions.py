"""A condition on the resultants of interfaces as multipliers in cones, before it is one of a program.

See :mod:`mbla.program.conditions`, to whose terms it belongs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray

N, T1, T2, MN, M1, M2 = range(6)
"""Resultants in their order."""


@dataclass(frozen=True)
class ConditionRows:
    """A condition on all interfaces to which it applies.

    motion     : (6 n_interfaces, n_unknowns) Gᵀζ: motion of the interfaces, dual to their resultants
    cost       : (n_unknowns,) g·ζ
    cones      : (n_rows, n_unknowns) ζ
    cone_sizes : dimensions of the cones in their order, 1 for half-lines
    """

    motion: sp.csr_array
    cost: FloatArray
    cones: sp.csr_array
    cone_sizes: IntArray


@dataclass
class Triplets:
    """Entries of a sparse matrix as they come."""

    rows: list[IntArray]
    columns: list[IntArray]
    values: list[FloatArray]

    @classmethod
    def none(cls) -> Triplets:
        """Nothing yet."""
        return cls([], [], [])

    def add(self, rows: IntArray, columns: IntArray, values: FloatArray | float) -> None:
        """Add entries, rows, columns and values (n,) each, or one value for all; values of one place are summed up."""
        self.rows.append(rows)
        self.columns.append(columns)
        self.values.append(np.broadcast_to(np.asarray(values, dtype=np.float64), np.shape(rows)))

    def matrix(self, shape: tuple[int, int]) -> sp.csr_array:
        """All entries as a matrix of the given shape."""
        place = (np.concatenate(self.rows), np.concatenate(self.columns))
        return sp.csr_array(sp.coo_array((np.concatenate(self.values), place), shape=shape))
