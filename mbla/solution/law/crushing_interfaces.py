"""Interfaces that crush as stress blocks: conditions on their resultants in a step, by those of their pieces.

    edges    g = Q − (N'² + 3 P²)/F              corners   g = √(Q_1 Q_2) − L^1.5/√(K F)

(:mod:`mbla.program.resultants.stress_blocks`). Both are concave. Where Q_1 or Q_2 is negative the lesser takes the
place of the root. Flow is associative in N and the moments, and what has been crushed stays so as long as it is pressed
further; unloaded it recovers (deformation theory).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.program.resultants.interface_motions import CrushingInterfaces, crushing_of
from mbla.program.resultants.stress_blocks import Pieces
from mbla.solution.law.interface_law import Derivatives, InterfaceLaw
from mbla.solution.law.interface_rows import InterfaceRows

IN_PLANE, IN_SPACE = 1.0, 0.1
"""w: in space an interface has 6 or 12 conditions in the place of 2."""


@dataclass(frozen=True)
class StressBlockBounds:
    """Conditions of pieces, m of them.

    pieces : their conditions
    pressed : (m, n_points) share of the normal forces of the points that each carries
    weight : w
    """

    pieces: Pieces
    pressed: sp.csr_array
    weight: float

    remembers = True
    points: IntArray | None = None

    @property
    def n_conditions(self) -> int:
        """Of all pieces."""
        return self.pieces.n_conditions * len(self.pieces.owner)

    def only(self, chosen: IntArray) -> StressBlockBounds:
        """Of some pieces."""
        return replace(self, pieces=self.pieces.only(chosen), pressed=self.pressed[chosen])

    def start(self, normal: FloatArray) -> FloatArray:
        """In the middle of each piece, at most half of what it can carry."""
        force = np.minimum(self.pressed @ normal, 0.5 * self.pieces.strength - self.pieces.tension)
        return np.asarray(force * self.pieces.centre)

    def share_at_rest(self, normal: FloatArray) -> FloatArray | None:
        """All of it where each interface is one piece."""
        owner = self.pieces.owner
        whole = len(np.unique(owner)) == len(owner)
        return np.ones((self.pieces.centre.shape[0], len(owner))) if whole else None

    def values(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """g, (k, m)."""
        return self.pieces.values(resultants)

    def gradients(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """∇g, (k, c, m)."""
        (_, n, p), (first, second, lead) = self.pieces.forms(resultants)
        (dq, dn, dp), (d_first, d_second, d_lead) = self._slopes
        at_edges = dq - (2.0 / self.pieces.strength) * (n[:, None] * dn + 3.0 * p[:, None] * dp)
        turn = 0.5 * np.sqrt(first * second)[:, None]
        at_corners = turn * (d_first / first[:, None] + d_second / second[:, None])
        at_corners -= (1.5 * np.sqrt(lead) / self.pieces.root)[:, None] * d_lead
        return np.concatenate([at_edges, at_corners])

    def derivatives(self, resultants: FloatArray, normal: FloatArray) -> Derivatives:
        """Values, gradients and Hessians."""
        _, (first, second, lead) = self.pieces.forms(resultants)
        _, (d_first, d_second, d_lead) = self._slopes
        turn = d_first / first[:, None] - d_second / second[:, None]
        at_corners = -(0.25 * np.sqrt(first * second))[:, None, None] * _squares(turn)
        at_corners -= (0.75 / (np.sqrt(lead) * self.pieces.root))[:, None, None] * _squares(d_lead)
        hessians = np.concatenate([self._of_edges, at_corners])
        return Derivatives(self.values(resultants, normal), self.gradients(resultants, normal), hessians)

    @cached_property
    def _slopes(self) -> tuple[FloatArray, FloatArray]:
        """Derivatives of the forms, (3, n_edges, c, m) and (3, n_corners, c, m)."""
        edges, corners = self.pieces.edges[:, :, 1:], self.pieces.corners[:, :, 1:]
        return edges.transpose(1, 0, 2, 3), corners.transpose(1, 0, 2, 3)

    @cached_property
    def _of_edges(self) -> FloatArray:
        """Hessians of the conditions of edges, which are constant, (n_edges, c, c, m)."""
        _, dn, dp = self._slopes[0]
        return np.asarray(-2.0 * (_squares(dn) + 3.0 * _squares(dp)) / self.pieces.strength)


def _squares(vectors: FloatArray) -> FloatArray:
    """Squares v vᵀ of vectors (k, c, m)."""
    return np.asarray(vectors[:, :, None] * vectors[:, None])


def crushing_rows(program: Program, interfaces: CrushingInterfaces) -> InterfaceRows | None:
    """Of the interfaces of a program that crush; None where there are none."""
    found = crushing_of(program, interfaces)
    if found is None:
        return None
    size, n_rows = program.components, found.resultants.shape[0]
    pressing = sp.csr_array(found.resultants[::size, ::size])
    strength = np.sum([np.bincount(one.owner, one.strength, n_rows // size) for one in found.pieces], axis=0)
    laws = []
    for pieces in found.pieces:
        owner, own = pieces.owner, np.arange(size * len(pieces.owner))
        pressed = sp.csr_array(sp.diags_array(pieces.strength / strength[owner]) @ pressing[owner])
        rows = (size * owner[:, None] + np.arange(size)).ravel()
        acts = sp.csr_array(sp.coo_array((np.ones(len(own)), (rows, own)), shape=(n_rows, len(own))))
        laws.append(InterfaceLaw(StressBlockBounds(pieces, pressed, IN_PLANE if size == 2 else IN_SPACE), acts))
    return InterfaceRows(found.resultants, tuple(laws), found.points, found.motions)
