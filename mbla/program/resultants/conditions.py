"""Form in which a condition on interface resultants enters the cone program.

A condition says that vectors G r + g + H y lie in cones C (second-order cones and half-lines, which are their own
duals), r being the resultants of an interface and y helping unknowns without meaning. With multipliers ζ in C and
Hᵀζ = 0 any admissible r has

    −r·v ≤ −r·(v − Gᵀζ) + g·ζ

so that an interface that moves by v may move by Gᵀζ at the power g·ζ, and its points by the rest. The equation Hᵀζ = 0
is solved beforehand: ζ = cones @ ψ with free unknowns ψ.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray

N, T1, T2, MN, M1, M2 = range(6)
"""Resultants in their order."""

RESULTANTS = (N, M1, M2)
"""Those that linear forms have coefficients of, behind their constant."""


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
class Entries:
    """Entries of a sparse matrix as they come."""

    rows: list[IntArray]
    columns: list[IntArray]
    values: list[FloatArray]

    @classmethod
    def none(cls) -> Entries:
        """Nothing yet."""
        return cls([], [], [])

    def add(self, rows: IntArray, columns: IntArray, values: FloatArray | float) -> None:
        """Add entries, rows, columns and values (n,) each, or one value for all; values of one place are summed up."""
        self.rows.append(rows)
        self.columns.append(columns)
        self.values.append(np.broadcast_to(np.asarray(values, dtype=np.float64), np.shape(rows)))

    def add_forms(self, rows: IntArray, interfaces: IntArray, forms: FloatArray) -> None:
        """Add linear forms in 1, N, M_1, M_2 of interfaces, (n, 4), a row of G each, without their constants."""
        for place, resultant in enumerate(RESULTANTS, start=1):
            self.add(rows, 6 * interfaces + resultant, forms[:, place])

    def matrix(self, shape: tuple[int, int]) -> sp.csr_array:
        """All entries as a matrix of the given shape."""
        place = (np.concatenate(self.rows), np.concatenate(self.columns))
        return sp.csr_array(sp.coo_array((np.concatenate(self.values), place), shape=shape))


@dataclass
class ConeRows:
    """Vectors G r + H y + g in cones, as they come."""

    given: Entries = field(default_factory=Entries.none)
    helping: Entries = field(default_factory=Entries.none)
    parts: list[FloatArray] = field(default_factory=list)
    sizes: list[IntArray] = field(default_factory=list)
    n_rows: int = 0
    n_helpers: int = 0

    def take(self, size: int, count: int, constants: FloatArray) -> IntArray:
        """First rows of ``count`` further cones of one size with constants (count, size)."""
        first = self.n_rows + size * np.arange(count)
        self.n_rows += size * count
        self.parts.append(constants.ravel())
        self.sizes.append(np.full(count, size))
        return first

    def helper(self, count: int) -> IntArray:
        """Numbers, (n_new,), of ``count`` further helping unknowns."""
        self.n_helpers += count
        return np.arange(self.n_helpers - count, self.n_helpers)

    def resultants(self, n_interfaces: int) -> sp.csr_array:
        """G, (n_rows, 6 n_interfaces)."""
        return self.given.matrix((self.n_rows, 6 * n_interfaces))

    @property
    def helpers(self) -> sp.csr_array:
        """H, (n_rows, n_helpers)."""
        return self.helping.matrix((self.n_rows, self.n_helpers))

    @property
    def constants(self) -> FloatArray:
        """g, (n_rows,)."""
        return np.concatenate(self.parts)

    @property
    def cone_sizes(self) -> IntArray:
        """Dimensions of the cones in their order, 1 for half-lines, (n_cones,)."""
        return np.concatenate(self.sizes).astype(np.int64)


def joined(conditions: Sequence[ConditionRows]) -> ConditionRows:
    """Several conditions as one."""
    return ConditionRows(
        motion=sp.csr_array(sp.hstack([condition.motion for condition in conditions])),
        cost=np.concatenate([condition.cost for condition in conditions]),
        cones=sp.csr_array(sp.block_diag([condition.cones for condition in conditions])),
        cone_sizes=np.concatenate([condition.cone_sizes for condition in conditions]),
    )
