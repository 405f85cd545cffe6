"""Restriction of a program to fewer unknowns: u = S q, x = P y, and the exact way back."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.process.sharing import shared
from mbla.program.program import Program, Reduction
from mbla.program.yield_conditions.limits import YieldLimits


def restricted(
    program: Program,
    velocities: sp.csr_array,
    forces: sp.csr_array,
    limits: YieldLimits,
    *,
    components: int | None = None,
) -> Program:
    """The program in unknowns q and y: equilibrium is SᵀA P y + Sᵀf = 0, its dual the velocities PᵀAᵀS q.

    velocities : S, (n_rows, n_new_rows); forces : P, (components n_points, new components times new points)
    limits     : of the new points
    """
    return Program(
        equilibrium_matrix=_in_unknowns(program.equilibrium_matrix, velocities, forces),
        dead_load=np.asarray(velocities.T @ program.dead_load),
        live_load=np.asarray(velocities.T @ program.live_load),
        limits=limits,
        free=program.free,
        n_blocks=program.n_blocks,
        scaling=program.scaling,
        components=components or program.components,
        settles=program.settles,
        reduction=Reduction(program, sp.csr_array(velocities), sp.csr_array(forces)),
    )


@shared("restricted")
def _in_unknowns(matrix: sp.csr_array, velocities: sp.csr_array, forces: sp.csr_array) -> sp.csr_array:
    """SᵀA P."""
    return tidy(velocities.T @ matrix @ forces)


def chosen_limits(limits: YieldLimits, points: IntArray) -> YieldLimits:
    """Limits of the given points."""
    return YieldLimits(**{name: values[points] for name, values in vars(limits).items()})


def selection(kept: IntArray, total: int, size: int) -> sp.csr_array:
    """(size total, size len(kept)): puts the entries of the kept items back among all."""
    rows = (size * kept[:, None] + np.arange(size)).ravel()
    n = len(rows)
    return sp.csr_array(sp.coo_array((np.ones(n), (rows, np.arange(n))), shape=(size * total, n)))


def block_matrix(blocks: FloatArray, rows: IntArray, columns: IntArray, shape: tuple[int, int]) -> sp.csr_array:
    """Sparse matrix of dense blocks (n, r, c) at block rows and block columns; shape counts blocks."""
    n, r, c = blocks.shape
    row = np.broadcast_to((r * rows[:, None] + np.arange(r))[:, :, None], (n, r, c))
    column = np.broadcast_to((c * columns[:, None] + np.arange(c))[:, None, :], (n, r, c))
    entries = (blocks.ravel(), (row.ravel(), column.ravel()))
    return tidy(sp.coo_array(entries, shape=(r * shape[0], c * shape[1])))


def tidy(matrix: sp.sparray) -> sp.csr_array:
    """Entries that are rounding of zero left out: they would fill the factorisations."""
    clean = sp.csr_array(sp.csc_array(matrix))
    largest = np.abs(clean.data).max(initial=0.0)
    clean.data[np.abs(clean.data) < 1e-14 * largest] = 0.0
    clean.eliminate_zeros()
    return clean
