"""The matrix of one Newton step on the path, A C Aᵀ bordered by the live load, and its factors.

C has one block per contact point, so that the pattern of A C Aᵀ is fixed: which entry each product of two entries of
one point's columns goes to is worked out once, and an assembly is a batched product and one weighted count.
The rows and columns are scaled by the diagonal before they are factorised (SuperLU, minimum degree on the symmetric
pattern: half the time of the column ordering on vaults). The factors themselves are kept, because the sign of the
determinant is wanted, which only they tell.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray, IntArray, distinct
from mbla.program.program import Program
from mbla.solution.linear_algebra.superlu import factors_on_the_diagonal

if TYPE_CHECKING:
    from scipy.sparse.linalg import SuperLU

DIAGONAL = 1e-14
"""Relative addition to the diagonal: rounding, for blocks whose joints all let go."""

PIVOT = 0.1
"""Share of the largest entry of a column at which the diagonal still serves as pivot."""


@dataclass(frozen=True)
class MatrixMap:
    """Where the products of a program's columns go in the bordered matrix.

    columns      : (n_points, most rows of a point, components) its entries of A
    used         : flat mask of the pairs of rows that exist
    position     : place of each used pair among the stored entries
    diagonal, last_column, last_row : places of the diagonal and of the border
    indices, pointers : of the compressed columns
    """

    columns: FloatArray
    used: np.typing.NDArray[np.bool_]
    position: IntArray
    diagonal: IntArray
    last_column: IntArray
    last_row: IntArray
    indices: np.typing.NDArray[np.int32]
    pointers: np.typing.NDArray[np.int32]
    live_load: FloatArray


def matrix_map(program: Program) -> MatrixMap:
    """Work out the pattern of A C Aᵀ with its border."""
    rows, columns = _columns_of_points(program)
    n, size = len(program.live_load), len(program.live_load) + 1
    pairs = np.broadcast_to(rows[:, :, None], (*rows.shape, rows.shape[1]))
    other = np.broadcast_to(rows[:, None, :], pairs.shape)
    used = (pairs >= 0) & (other >= 0)
    entry = other[used] * size + pairs[used]
    row = np.arange(n)
    diagonal, last_column, last_row = row * size + row, n * size + row, row * size + n
    stored = distinct(np.concatenate([entry, diagonal, last_column, last_row, [n * size + n]]))
    counts = np.bincount(stored // size, minlength=size)
    return MatrixMap(
        columns=columns,
        used=used.ravel(),
        position=np.searchsorted(stored, entry),
        diagonal=np.searchsorted(stored, diagonal),
        last_column=np.searchsorted(stored, last_column),
        last_row=np.searchsorted(stored, last_row),
        indices=(stored % size).astype(np.int32),
        pointers=np.concatenate([[0], np.cumsum(counts)]).astype(np.int32),
        live_load=program.live_load,
    )


def _columns_of_points(program: Program) -> tuple[IntArray, FloatArray]:
    """Rows in which each point has entries, −1 where it has fewer than others, and those entries."""
    matrix = sp.coo_array(program.equilibrium_matrix)
    matrix.eliminate_zeros()
    row, column = (part.astype(np.int64) for part in matrix.coords)
    n_rows, components, n_points = matrix.shape[0], program.components, program.n_points
    point = column // components
    keys = distinct(point * n_rows + row)
    of_point = keys // n_rows
    count = np.bincount(of_point, minlength=n_points)
    place = np.arange(len(keys)) - np.concatenate([[0], np.cumsum(count)])[of_point]
    rows = np.full((n_points, int(count.max(initial=1))), -1, dtype=np.int64)
    rows[of_point, place] = keys % n_rows
    columns = np.zeros((*rows.shape, components))
    columns[point, place[np.searchsorted(keys, point * n_rows + row)], column % components] = matrix.data
    return rows, columns


@dataclass(frozen=True)
class Factors:
    """The factorised bordered matrix."""

    lu: SuperLU
    matrix: sp.csc_array
    scale: FloatArray

    def solve(self, right: FloatArray) -> FloatArray:
        """Solve for several right-hand sides, (n_rows + 1, n_sides), with one step of refinement."""
        scaled = right * self.scale[:, None]
        answer = self.lu.solve(scaled)
        answer += self.lu.solve(scaled - self.matrix @ answer)
        return np.asarray(answer * self.scale[:, None])

    def sign(self) -> float:
        """Sign of the determinant of the bordered matrix."""
        signs = float(np.prod(np.sign(self.lu.U.diagonal())))
        return signs * _parity(self.lu.perm_r) * _parity(self.lu.perm_c)


def factorise(pattern: MatrixMap, tangents: FloatArray) -> Factors | None:
    """Factors of [A C Aᵀ, −f_L; f_Lᵀ, 0] for blocks C (n_points, components, components); None where singular."""
    blocks = pattern.columns @ tangents @ pattern.columns.transpose(0, 2, 1)
    entries = blocks.ravel()[pattern.used]
    data = np.bincount(pattern.position, entries, len(pattern.indices)).astype(np.float64)
    if not np.isfinite(data).all():
        return None
    diagonal = np.abs(data[pattern.diagonal])
    data[pattern.diagonal] += DIAGONAL * diagonal + 1e-300
    data[pattern.last_column] -= pattern.live_load
    data[pattern.last_row] += pattern.live_load
    scale = 1.0 / np.sqrt(np.maximum(diagonal, 1e-300))
    scale = np.append(scale, 1.0 / max(float(np.linalg.norm(pattern.live_load * scale)), 1e-300))
    column = np.repeat(np.arange(len(scale)), np.diff(pattern.pointers))
    data *= scale[pattern.indices] * scale[column]
    matrix = sp.csc_array((data, pattern.indices, pattern.pointers), shape=(len(scale), len(scale)))
    lu = factors_on_the_diagonal(matrix, PIVOT)
    return None if lu is None else Factors(lu, matrix, scale)


def _parity(permutation: IntArray) -> float:
    n = len(permutation)
    graph = sp.csr_array((np.ones(n), (np.arange(n), permutation)), shape=(n, n))
    cycles, _ = connected_components(graph, directed=False)
    return -1.0 if (n - cycles) % 2 else 1.0
