"""Restriction of a program to fewer unknowns: u = S q, x = P y, and the exact way back.

Guided blocks in a program: motions u = S q that the guides allow, and nothing but them.

The columns of S are orthonormal in the units of the program, and S q are exactly the motions that the guides allow:
equilibrium then has to hold against these alone, SᵀA x + Sᵀ(f_D + λ f_L) = 0. Smaller unknowns of reductions, u = B q,
are restricted in the same way: Bᵀ S Sᵀ B is the projector on those of them that the guides allow wherever the guides
share the symmetry that B stands for.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.model import Model
from mbla.program.lift import Lift
from mbla.program.program import Program, Scaling
from mbla.program.yield_conditions.limits import YieldLimits


def restricted(
    program: Program,
    velocities: sp.csr_array | None,
    forces: sp.csr_array | None,
    limits: YieldLimits,
    *,
    components: int | None = None,
) -> Program:
    """The program in unknowns q and y: equilibrium is SᵀA P y + Sᵀf = 0, its dual the velocities PᵀAᵀS q.

    velocities : S, (n_rows, n_new_rows); forces : P, (components n_points, new components times new points); None for
                 unknowns that stay
    limits     : of the new points
    """
    components = components or program.components
    loads = program.dead_load, program.live_load
    dead, live = loads if velocities is None else (np.asarray(velocities.T @ load) for load in loads)
    return Program(
        equilibrium_matrix=_in_unknowns(program.equilibrium_matrix, velocities, forces),
        dead_load=dead,
        live_load=live,
        limits=limits,
        scaling=program.scaling,
        facts=program.facts,
        components=components,
        reduction=Lift.after(program.reduction, program, velocities, forces, components),
    )


def _in_unknowns(matrix: sp.csr_array, velocities: sp.csr_array | None, forces: sp.csr_array | None) -> sp.csr_array:
    """SᵀA P."""
    found = matrix if velocities is None else velocities.T @ matrix
    return tidy(found if forces is None else found @ forces)


def chosen_limits(limits: YieldLimits, points: IntArray) -> YieldLimits:
    """Limits of the points with the given numbers, (n_chosen,)."""
    return YieldLimits(**{name: values[points] for name, values in vars(limits).items()})


@dataclass(frozen=True)
class ChosenPart:
    """Some blocks and points of a program as one of their own.

    points     : (n_chosen,) numbers of the points in the whole
    velocities : from those of the part to those of the whole, (n_rows of the whole, n_rows)
    """

    program: Program
    points: IntArray
    velocities: sp.csr_array

    @staticmethod
    def of(whole: Program, moves: BoolArray, points: IntArray) -> ChosenPart:
        """The part of a program without guides.

        moves : (n_blocks,) blocks that are not held; points : numbers of the chosen ones
        """
        ways = selection(np.flatnonzero(moves), len(moves), len(whole.dead_load) // len(moves))
        forces = selection(points, whole.n_points, whole.components)
        return ChosenPart(restricted(whole, ways, forces, chosen_limits(whole.limits, points)), points, ways)

    def lifted(self, velocities: FloatArray) -> FloatArray:
        """Velocities of the whole, (n_rows,), from those of the part."""
        return np.asarray(self.velocities @ velocities)


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
    """A matrix, (n_rows, n_columns), without entries that are rounding of zero: they would fill the factorisations."""
    clean = sp.csr_array(sp.csc_array(matrix))
    largest = np.abs(clean.data).max(initial=0.0)
    clean.data[np.abs(clean.data) < 1e-14 * largest] = 0.0
    clean.eliminate_zeros()
    return clean


DEPENDENT = 1e-10
"""Singular value, over the largest, below which a way of a body to move is the sum of others."""

ACROSS = 1e-12
"""load along a way to move, over the loads whose components add up to it, that is rounding: they act across it"""

ALLOWED = 0.5
"""Eigenvalue of a projector: 1 for motions that are allowed, 0 for the others."""


def guide_projector(model: Model, free: IntArray, scaling: Scaling) -> sp.csr_array | None:
    """S Sᵀ, (6 n_free, 6 n_free), in the units of the program; None where no block is guided."""
    guides = model.guides
    if not len(guides):
        return None
    row_of_block = np.full(len(model.blocks), -1, dtype=np.int64)
    row_of_block[free] = np.arange(len(free))
    rows = (6 * row_of_block[guides.blocks][:, None] + np.arange(6)).ravel()
    # velocities in the deck's units are those of the program times row
    ways = guides.motions / scaling.row.reshape(-1, 6)[row_of_block[guides.blocks]][:, :, None] / scaling.force
    n = 6 * len(free)
    allowed = np.ones(n)
    allowed[rows] = 0.0
    order = np.argsort(guides.bodies, kind="stable")
    members = np.split(order, np.flatnonzero(np.diff(guides.bodies[order])) + 1)
    entries = [_projector(ways[of_body].reshape(-1, 6)) for of_body in members]
    places = [(6 * row_of_block[guides.blocks[of_body]][:, None] + np.arange(6)).ravel() for of_body in members]
    row = np.concatenate([np.repeat(place, len(place)) for place in places])
    column = np.concatenate([np.tile(place, len(place)) for place in places])
    values = np.concatenate([entry.ravel() for entry in entries])
    guided = sp.csr_array(sp.coo_array((values, (row, column)), shape=(n, n)))
    return sp.csr_array(guided + sp.diags_array(allowed))


def guided_program(program: Program, projector: sp.csr_array | None) -> Program:
    """The program in the motions that a projector on its rows allows; the same one where it allows all."""
    if projector is None:
        return program
    basis = _basis(projector)
    found = restricted(program, basis, None, program.limits)
    dead, live = (
        np.where(np.abs(along) > ACROSS * (abs(basis).T @ np.abs(loads)), along, 0.0)
        for along, loads in ((found.dead_load, program.dead_load), (found.live_load, program.live_load))
    )
    of_blocks = Lift.after(program.of_blocks, program, basis, None, program.components)
    return replace(found, dead_load=dead, live_load=live, of_blocks=of_blocks, guided=True)


def _projector(ways: FloatArray) -> FloatArray:
    """On the space of the columns of ``ways``."""
    left, size, _ = np.linalg.svd(ways, full_matrices=False)
    basis = left[:, size > DEPENDENT * size.max(initial=0.0)]
    return np.asarray(basis @ basis.T)


def _basis(projector: sp.csr_array) -> sp.csr_array:
    """Orthonormal basis of the space on which a sparse projector projects, block by block of its pattern."""
    n = projector.shape[0]
    count, label = connected_components(projector, directed=False)
    order = np.argsort(label, kind="stable")
    sizes = np.bincount(label, minlength=count)
    alone = order[np.repeat(sizes == 1, sizes)]
    kept = np.sort(alone[projector.diagonal()[alone] > ALLOWED])
    rows, columns, values, n_columns = [kept], [np.arange(len(kept))], [np.ones(len(kept))], len(kept)
    starts = np.cumsum(sizes) - sizes
    for part in np.flatnonzero(sizes > 1):
        place = order[starts[part] : starts[part] + sizes[part]]
        eigenvalues, vectors = np.linalg.eigh(projector[place][:, place].toarray())
        allowed = vectors[:, eigenvalues > ALLOWED]
        rows.append(np.repeat(place, allowed.shape[1]))
        columns.append(np.tile(n_columns + np.arange(allowed.shape[1]), len(place)))
        values.append(allowed.ravel())
        n_columns += allowed.shape[1]
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return sp.csr_array(sp.coo_array(entries, shape=(n, n_columns)))
