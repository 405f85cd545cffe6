"""Crushing of interfaces in a program as cones: the conditions of stress blocks, piece by piece.

The conditions are those of :mod:`mbla.program.resultants.stress_blocks`. With τ a force of the size of what stands in
them, as second-order cones::

    edge    (Q/τ + 1, Q/τ − 1, 2 N'/√(τF), 2√3 P/√(τF))
    corner  L³ ≤ κ Q_1 Q_2 in units of τ, κ = K F/τ, with auxiliary variables g² ≤ L, h² ≤ Q_1 Q_2, L² ≤ √κ g h::
            (L + 1, L − 1, 2 g),  (φ(g + h), φ(g − h), 2 L),  (Q_1 + Q_2, Q_1 − Q_2, 2 h),  φ = κ^¼

and Q_1, Q_2 at most each of their bounds, which are half-lines. Multipliers of an edge are free; of a corner α_0, α_1
of the first cone, β of the second and q_e of the bounds are, and leave α_2 = −φ(β_0 + β_1)/2 and γ = (Σq, Σ ± q,
−φ(β_0 − β_1))/2.

The only piece of an interface moves by the sum of Gᵀζ over its conditions, which can be taken in one by one. Pieces
that act side by side move alike, Gᵀζ = ψ: as many multipliers as ψ has components follow from the others,
the first of edges, whose G is Q, or q_e of different bounds.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.conditions import Conditions, Reserves, joined
from mbla.program.resultants.interface_motions import CrushingOfProgram
from mbla.program.resultants.stress_blocks import Pieces

HEAD = 5
"""Free multipliers of a corner before those of its bounds: α_0, α_1, β_0, β_1, β_2."""


@dataclass(frozen=True)
class _Vectors:
    """Vectors of m pieces in cones.

    forms : (m, n_rows, 1 + c) g and G
    free  : (m, n_rows, n_free) ζ from free multipliers
    sizes : (n_cones,)
    """

    forms: FloatArray
    free: FloatArray
    sizes: IntArray

    @property
    def motion(self) -> FloatArray:
        """Gᵀζ, (m, c, n_free)."""
        return np.asarray(self.forms[:, :, 1:].transpose(0, 2, 1) @ self.free)

    @property
    def cost(self) -> FloatArray:
        """g·ζ, (m, n_free)."""
        return np.asarray((self.forms[:, None, :, 0] @ self.free)[:, 0])


def crushing_conditions(found: CrushingOfProgram) -> Conditions:
    """The conditions of all interfaces of a program that crush."""
    count = np.bincount(np.concatenate([pieces.owner for pieces in found.pieces]))
    alone = [pieces.only(np.flatnonzero(count[pieces.owner] == 1)) for pieces in found.pieces]
    beside = [pieces.only(np.flatnonzero(count[pieces.owner] > 1)) for pieces in found.pieces]
    parts, reserves, number = list[Conditions](), list[Reserves](), 0
    for pieces in (pieces for pieces in alone if len(pieces.owner)):
        components = len(pieces.centre)
        rows = components * pieces.owner[:, None] + np.arange(components)
        reserves.append(Reserves(found.resultants[rows.ravel()], pieces))
        for vectors in _vectors(pieces):
            parts.append(_of_one(found, vectors, rows, number + np.arange(len(rows))))
            number += len(rows)
    if any(len(pieces.owner) for pieces in beside):
        parts.append(_side_by_side(found, [pieces for pieces in beside if len(pieces.owner)]))
    whole = joined(parts)
    assert whole is not None
    return replace(whole, reserves=tuple(reserves))


def _of_one(found: CrushingOfProgram, vectors: _Vectors, rows: IntArray, numbers: IntArray) -> Conditions:
    """One condition of m pieces by itself, whose motions are those of rows, (m, c); its numbers, (m,)."""
    m, n_rows, n_free = vectors.free.shape
    columns = np.arange(m * n_free).reshape(m, n_free)
    motion = _blocks(vectors.motion, rows, columns, (found.motions.shape[1], m * n_free))
    cones = _blocks(vectors.free, np.arange(m * n_rows).reshape(m, n_rows), columns, (m * n_rows, m * n_free))
    return _conditions(
        found, motion, (cones, np.tile(vectors.sizes, m)), vectors.cost.ravel(), np.repeat(numbers, n_free)
    )


def _side_by_side(found: CrushingOfProgram, kinds: list[Pieces]) -> Conditions:
    """Of interfaces of several pieces; unknowns ψ of the interfaces, then multipliers."""
    components = len(kinds[0].centre)
    owners = np.unique(np.concatenate([pieces.owner for pieces in kinds]))
    n = components * len(owners)
    shares, sizes, cost, count, height = [], list[IntArray](), [np.zeros(n)], n, 0
    for pieces in kinds:
        given, free, of_cost, own = _eliminated(pieces)
        m, n_rows, n_free = free.shape
        place = components * np.searchsorted(owners, pieces.owner)[:, None] + np.arange(components)
        columns = np.hstack([place, count + np.arange(m * n_free).reshape(m, n_free)])
        shares.append(
            (np.concatenate([given, free], axis=2), height + np.arange(m * n_rows).reshape(m, n_rows), columns)
        )
        count, height = count + m * n_free, height + m * n_rows
        sizes.append(np.tile(own, m))
        np.add.at(cost[0], place, of_cost[:, :components])
        cost.append(of_cost[:, components:].ravel())
    cones = [_blocks(*share, (height, count)) for share in shares]
    rows = (components * owners[:, None] + np.arange(components)).ravel()
    motion = sp.csr_array((np.ones(n), (rows, np.arange(n))), shape=(found.motions.shape[1], count))
    whole = sp.csr_array(sum(cones[1:], cones[0]))
    return _conditions(found, motion, (whole, np.concatenate(sizes)), np.concatenate(cost), np.full(count, -1))


def _conditions(
    found: CrushingOfProgram,
    motion: sp.csr_array,
    cones: tuple[sp.csr_array, IntArray],
    cost: FloatArray,
    single: IntArray,
) -> Conditions:
    """From what the unknowns do to the interfaces that crush."""
    motions = sp.csr_array(found.motions @ motion)
    return Conditions(
        velocities=sp.csr_array(found.resultants.T @ motion),
        cost=cost,
        cones=cones[0],
        cone_sizes=cones[1],
        motions=(sp.csr_array(motions.shape), motions),
        reserves=(),
        single=single,
    )


def _blocks(values: FloatArray, rows: IntArray, columns: IntArray, shape: tuple[int, int]) -> sp.csr_array:
    """Blocks, (m, r, q), at their rows, (m, r), and columns, (m, q), of a matrix."""
    row, column = np.broadcast_arrays(rows[:, :, None], columns[:, None, :])
    there = values != 0.0
    return sp.csr_array(sp.coo_array((values[there], (row[there], column[there])), shape=shape))


def _eliminated(pieces: Pieces) -> tuple[FloatArray, FloatArray, FloatArray, IntArray]:
    """ζ from ψ, (m, n_rows, c), and from the multipliers that remain, (m, n_rows, n_free); what both cost, side by
    side, (m, c + n_free); sizes of the cones of one piece.
    """
    parts = _vectors(pieces)
    firsts = np.cumsum([0, *(part.free.shape[2] for part in parts)])
    follow = firsts[: len(pieces.centre)]
    if not len(pieces.edges):  # triangles: forces at their corners bound the first two conditions
        follow = HEAD + np.array([firsts[0], firsts[0] + 1, firsts[1] + 1])
        follow = follow if len(pieces.centre) == 3 else follow[[0, 2]]
    rest = np.setdiff1d(np.arange(firsts[-1]), follow)
    free = np.stack([sp.block_diag(each).toarray() for each in zip(*(part.free for part in parts), strict=True)])
    motion = np.concatenate([part.motion for part in parts], axis=2)
    inverse = np.linalg.inv(motion[:, :, follow])
    given = free[:, :, follow] @ inverse
    left = free[:, :, rest] - given @ motion[:, :, rest]
    left[np.abs(left) < 1e-15 * np.abs(left).max(initial=0.0)] = 0.0
    forms = np.concatenate([part.forms for part in parts], axis=1)
    cost = (forms[:, None, :, 0] @ np.concatenate([given, left], axis=2))[:, 0]
    return given, left, cost, np.concatenate([part.sizes for part in parts])


def _vectors(pieces: Pieces) -> list[_Vectors]:
    """The vectors of the conditions of pieces of one kind, edges first."""
    unit, half = np.minimum(pieces.strength, 1.0), len(pieces.corners) // 2
    strip = not np.any(pieces.edges[:, 2])
    found = [_edge(edge, pieces.strength, unit, strip) for edge in pieces.edges]
    for number, corner in enumerate(pieces.corners):  # the second half, of the complement, in units of the strength
        found.append(_corner(corner, pieces, unit if number < half else pieces.strength))
    return found


def _edge(edge: FloatArray, strength: FloatArray, unit: FloatArray, strip: bool) -> _Vectors:
    q, normal, across = edge[0] / unit, edge[1], edge[2]
    one = np.zeros_like(q)
    one[0] = 1.0
    size = np.sqrt(unit * strength)
    rows = [q + one, q - one, 2.0 * normal / size, 2.0 * np.sqrt(3.0) * across / size][: 3 if strip else 4]
    n = len(rows)
    free = np.broadcast_to(np.eye(n), (len(unit), n, n))
    return _Vectors(np.stack(rows).transpose(2, 0, 1), free, np.array([n]))


def _corner(corner: FloatArray, pieces: Pieces, unit: FloatArray) -> _Vectors:
    """Bounds of Q_1 and Q_2, α, β, γ; in units of τ, (m,)."""
    phi = (pieces.factor * pieces.strength / unit) ** 0.25
    first, second, lead = corner / unit
    one, none = np.zeros_like(lead), np.zeros_like(lead)
    one[0] = 1.0
    forms = np.stack([first, second, lead + one, lead - one, none, none, none, 2.0 * lead, none, none, none])
    free = np.zeros((len(phi), 11, HEAD + 2))
    bounds, alpha, beta, gamma = np.arange(2), 2, 5, 8
    free[:, bounds, HEAD + bounds] = 1.0
    free[:, alpha, 0] = free[:, alpha + 1, 1] = 1.0
    free[:, [beta, beta + 1, beta + 2], [2, 3, 4]] = 1.0
    free[:, alpha + 2, 2] = free[:, alpha + 2, 3] = -0.5 * phi
    free[:, gamma + 2, 2], free[:, gamma + 2, 3] = -0.5 * phi, 0.5 * phi
    free[:, gamma, HEAD:] = 0.5
    free[:, gamma + 1, HEAD:] = (0.5, -0.5)
    return _Vectors(forms.transpose(2, 0, 1), free, np.array([1, 1, 3, 3, 3]))
