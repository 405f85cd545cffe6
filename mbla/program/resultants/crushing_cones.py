"""Crushing of interfaces in a program as cones: the conditions of stress blocks, piece by piece.

The conditions are those of :mod:`mbla.program.resultants.stress_blocks`. With τ a force of the size of what stands in
them, as second-order cones::

    edge    (Q/τ + 1, Q/τ − 1, 2 N'/√(τF), 2√3 P/√(τF))
    corner  L³ ≤ κ Q_1 Q_2 in units of τ, κ = K F/τ, with auxiliary variables g² ≤ L, h² ≤ Q_1 Q_2, L² ≤ √κ g h::
            (L + 1, L − 1, 2 g),  (φ(g + h), φ(g − h), 2 L),  (Q_1 + Q_2, Q_1 − Q_2, 2 h),  φ = κ^¼

and Q_1, Q_2 at most each of their bounds, which are half-lines. Multipliers of an edge are free; of a corner α_0, α_1
of the first cone, β of the second and q_e of the bounds are, and leave α_2 = −φ(β_0 + β_1)/2 and γ = (Σq, Σ ± q,
−φ(β_0 − β_1))/2.

Each piece moves as its interface does, Gᵀζ = ψ. As many multipliers as ψ has components follow from the others: the
first of edges, whose G is Q, or q_e of different bounds.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.conditions import Conditions
from mbla.program.resultants.interface_motions import CrushingOfProgram
from mbla.program.resultants.stress_blocks import OF_TRIANGLE, Pieces

HEAD = 5
"""Free multipliers of a corner before those of its bounds: α_0, α_1, β_0, β_1, β_2."""


@dataclass(frozen=True)
class _Corner:
    """A corner condition of m pieces.

    lead     : (1 + c, m) L
    bounds   : (n_bounds, 1 + c, m) of Q_1 and Q_2
    side     : (n_bounds,) 0 or 1: of Q_1 or Q_2
    unit     : (m,) τ
    """

    lead: FloatArray
    bounds: FloatArray
    side: IntArray
    unit: FloatArray


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


def crushing_conditions(found: CrushingOfProgram) -> Conditions:
    """The conditions of all interfaces of a program that crush; unknowns ψ of the interfaces, then multipliers."""
    n = found.resultants.shape[0]
    cones, sizes, cost, count = [], [], [np.zeros(n)], n
    for pieces in found.pieces:
        given, free, of_cost, vectors = _eliminated(pieces)
        m, n_rows, n_free = free.shape
        c = given.shape[2]
        columns = c * pieces.owner[:, None] + np.arange(c), count + np.arange(m * n_free).reshape(m, n_free)
        of_rows = np.arange(m * n_rows).reshape(m, n_rows, 1)
        places = [np.broadcast_arrays(of_rows, each[:, None, :]) for each in columns]
        row, column = (np.concatenate([place[k].ravel() for place in places]) for k in (0, 1))
        count += m * n_free
        values = np.concatenate([given.ravel(), free.ravel()])
        kept = values != 0.0
        cones.append((values[kept], (row[kept], column[kept]), m * n_rows))
        sizes.append(np.tile(vectors.sizes, m))
        np.add.at(cost[0], columns[0], of_cost[:, :c])
        cost.append(of_cost[:, c:].ravel())
    motions = sp.csr_array(sp.hstack([found.motions, sp.csr_array((found.motions.shape[0], count - n))]))
    taken = sp.csr_array(found.resultants.T)
    return Conditions(
        velocities=sp.csr_array(sp.hstack([taken, sp.csr_array((taken.shape[0], count - n))])),
        cost=np.concatenate(cost),
        cones=sp.csr_array(
            sp.vstack([sp.coo_array((values, place), shape=(rows, count)) for values, place, rows in cones])
        ),
        cone_sizes=np.concatenate(sizes),
        motions=(sp.csr_array(motions.shape), motions),
    )


def _eliminated(pieces: Pieces) -> tuple[FloatArray, FloatArray, FloatArray, _Vectors]:
    """ζ from ψ, (m, n_rows, c), and from the multipliers that remain, (m, n_rows, n_free); what both cost, side by
    side, (m, c + n_free); the vectors.
    """
    vectors, follow = _vectors(pieces)
    g, big = vectors.forms[:, :, 0], vectors.forms[:, :, 1:]
    of_motion = big.transpose(0, 2, 1) @ vectors.free  # (m, c, n): Gᵀζ
    rest = np.setdiff1d(np.arange(of_motion.shape[2]), follow)
    inverse = np.linalg.inv(of_motion[:, :, follow])
    given = vectors.free[:, :, follow] @ inverse
    free = vectors.free[:, :, rest] - given @ of_motion[:, :, rest]
    free[np.abs(free) < 1e-15 * np.abs(free).max(initial=0.0)] = 0.0
    cost = (g[:, None, :] @ np.concatenate([given, free], axis=2))[:, 0]
    return given, free, cost, vectors


def _vectors(pieces: Pieces) -> tuple[_Vectors, IntArray]:
    """The vectors of pieces of one kind, and which of their multipliers follow from ψ."""
    unit = np.minimum(pieces.strength, 1.0)
    strip = not np.any(pieces.edges[:, 2])
    parts = [_edge(edge, pieces.strength, unit, strip) for edge in pieces.edges]
    parts += [_corner_vectors(corner, pieces) for corner in _corners(pieces, unit)]
    firsts = np.cumsum([0, *(part.free.shape[2] for part in parts)])
    free = np.zeros((len(unit), sum(part.free.shape[1] for part in parts), int(firsts[-1])))
    row = 0
    for part, column in zip(parts, firsts, strict=False):
        n_rows, n_free = part.free.shape[1:]
        free[:, row : row + n_rows, column : column + n_free] = part.free
        row += n_rows
    forms = np.concatenate([part.forms for part in parts], axis=1)
    components = forms.shape[2] - 1
    follow = firsts[:components]
    if not len(pieces.edges):  # triangles: forces at their corners bound the first two conditions
        first = HEAD + np.array([firsts[0], firsts[0] + 1, firsts[1] + 1])
        follow = first if components == 3 else first[[0, 2]]
    return _Vectors(forms, free, np.concatenate([part.sizes for part in parts])), follow


def _edge(edge: FloatArray, strength: FloatArray, unit: FloatArray, strip: bool) -> _Vectors:
    q, normal, across = edge[0] / unit, edge[1], edge[2]
    one = np.zeros_like(q)
    one[0] = 1.0
    size = np.sqrt(unit * strength)
    rows = [q + one, q - one, 2.0 * normal / size, 2.0 * np.sqrt(3.0) * across / size][: 3 if strip else 4]
    n = len(rows)
    free = np.broadcast_to(np.eye(n), (len(unit), n, n))
    return _Vectors(np.stack(rows).transpose(2, 0, 1), free, np.array([n]))


def _corners(pieces: Pieces, unit: FloatArray) -> list[_Corner]:
    """Corner conditions; those of the complement to full stress, in units of the strength, are the second half."""
    corners, half = pieces.corners, len(pieces.corners) // 2
    found = []
    for first, each in ((0, unit), (half, pieces.strength)):
        own = corners[first : first + half]
        if pieces.factor == OF_TRIANGLE:
            found += [_Corner(one[2], one[:2], np.array([0, 1]), each) for one in own]
        elif half:  # four conditions that differ by the bound of Q_1 and of Q_2
            bounds = np.stack([own[0, 0], own[3, 0], own[0, 1], own[3, 1]])
            found.append(_Corner(own[0, 2], bounds, np.array([0, 0, 1, 1]), each))
    return found


def _corner_vectors(corner: _Corner, pieces: Pieces) -> _Vectors:
    """Bounds, α, β, γ."""
    phi = (pieces.factor * pieces.strength / corner.unit) ** 0.25
    lead, bounds = corner.lead / corner.unit, corner.bounds / corner.unit
    one, none = np.zeros_like(lead), np.zeros_like(lead)
    one[0] = 1.0
    forms = np.stack([*bounds, lead + one, lead - one, none, none, none, 2.0 * lead, none, none, none])
    n = len(bounds)
    free = np.zeros((len(phi), n + 9, HEAD + n))
    free[:, np.arange(n), HEAD + np.arange(n)] = 1.0
    alpha, beta, gamma = n, n + 3, n + 6
    free[:, alpha, 0] = free[:, alpha + 1, 1] = 1.0
    free[:, [beta, beta + 1, beta + 2], [2, 3, 4]] = 1.0
    free[:, alpha + 2, 2] = free[:, alpha + 2, 3] = -0.5 * phi
    free[:, gamma + 2, 2], free[:, gamma + 2, 3] = -0.5 * phi, 0.5 * phi
    free[:, gamma, HEAD:] = 0.5
    free[:, gamma + 1, HEAD:] = np.where(corner.side == 0, 0.5, -0.5)
    return _Vectors(forms.transpose(2, 0, 1), free, np.array([*np.ones(n), 3, 3, 3]).astype(np.int64))
