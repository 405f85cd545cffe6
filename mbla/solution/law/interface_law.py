"""The law of interfaces with a motion of their own: what it adds to a step, and how it comes back from it.

Between the springs of its points and one of its blocks an interface moves by ψ, which its resultants r bound::

    g_k(r, n) ≥ 0,    v_r + Ψ̄/h = Σ z_k ∇g_k,    g_k z_k = w σ,    ∇ by r alone

v_r are the velocities of what carries r (:mod:`mbla.program.resultants.interface_motions`), n the normal forces of the
points where these bound r without being moved by it (friction without dilatancy). Ψ̄ is the motion so far where the
interface remembers: what is crushed does not become whole again while it is pressed further. In a step::

    W = Σ (z_k/g_k) ∇g_k ∇g_kᵀ − z_k ∇²g_k        X = Σ (z_k/g_k) ∇g_k (∂g_k/∂n)ᵀ − z_k ∂∇g_k/∂n
    dr = W⁻¹(Σ (r_k/g_k) ∇g_k − m − dv_r − X dn)        dz_k = (r_k − z_k dg_k)/g_k

m being the residual of the flow and r_k the change wanted of g_k z_k: one more block of the tangents, W⁻¹, and, where n
matters, one of r by n. z is never raised to a least value: that would move what is far from its bounds.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.solution.cone_solvers.cone_vectors import lines_to_boundary

FACTORS = (0.1, 10.0)
"""Within which multipliers follow the motion when the length of a step changes."""

SHARE = 0.95
"""Share of the way to the bounds that a step goes."""

RIGID = 1e-14
"""Share of the softest way of an interface that every way yields by, where rounding leaves none: a strength that is
never reached bounds hinges no closer than their points do."""

HALVINGS, CLOSE = 30, 1e-3
"""How closely the way to a curved bound is found: halvings at most, and relative distance."""


@dataclass(frozen=True)
class Derivatives:
    """Conditions of an interface at some resultants.

    values    : (k, m) g
    gradients : (k, c, m) by r
    hessians  : (k, c, c, m) by r
    by_normal : (k, p, m) by the normal forces of the points; None where these do not matter
    mixed     : (k, c, p, m) of the gradients by the same
    """

    values: FloatArray
    gradients: FloatArray
    hessians: FloatArray
    by_normal: FloatArray | None = None
    mixed: FloatArray | None = None


class InterfaceBounds(Protocol):
    """What bounds m interfaces: k conditions each on c resultants."""

    @property
    def weight(self) -> float:
        """Weight w."""

    @property
    def remembers(self) -> bool:
        """Whether motion stays."""

    @property
    def points(self) -> IntArray | None:
        """Points whose normal forces bound an interface, (m, p); None where none does."""

    @property
    def n_conditions(self) -> int:
        """Of all interfaces."""

    def only(self, chosen: IntArray) -> InterfaceBounds:
        """Of some interfaces."""

    def start(self, normal: FloatArray) -> FloatArray:
        """Resultants well within the bounds, (c, m), for normal forces of the points, (n_points,)."""

    def share_at_rest(self, normal: FloatArray) -> FloatArray | None:
        """Of what an interface carries at rest the share that these conditions bound, (c, m); None where several share
        it that must be told apart.
        """

    def values(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """g, (k, m)."""

    def gradients(self, resultants: FloatArray, normal: FloatArray) -> FloatArray:
        """∇g, (k, c, m), where g are positive."""

    def derivatives(self, resultants: FloatArray, normal: FloatArray) -> Derivatives:
        """All of them, where g are positive."""


@dataclass(frozen=True)
class InterfaceState:
    """Unknowns of a law, or a change of them: resultants r, (c, m), and multipliers z, (k, m)."""

    resultants: FloatArray
    multipliers: FloatArray

    def plus(self, change: InterfaceState, length: float) -> InterfaceState:
        """The state a length along a direction."""
        return InterfaceState(
            self.resultants + length * change.resultants, self.multipliers + length * change.multipliers
        )


@dataclass(frozen=True)
class InterfaceLaw:
    """Conditions, and the rows that their interfaces act on: J, (n_rows, c m), columns interface by interface."""

    conditions: InterfaceBounds
    rows: sp.csr_array

    def start(self, normal: FloatArray, sigma: float) -> InterfaceState:
        """A state on the central path."""
        resultants = self.conditions.start(normal)
        return self.centred(InterfaceState(resultants, resultants), normal, sigma)

    def centred(self, state: InterfaceState, normal: FloatArray, sigma: float, share: float = 1.0) -> InterfaceState:
        """On the central path at a share of the way from the start to the resultants; less where that is outside."""
        start = self.conditions.start(normal)
        resultants = start + share * (state.resultants - start)
        for _ in range(HALVINGS):
            outside = ~(self.conditions.values(resultants, normal) > 0.0).all(axis=0)
            if not outside.any():
                break
            resultants = np.where(outside, 0.5 * (resultants + start), resultants)
        values = self.conditions.values(resultants, normal)
        return InterfaceState(resultants, self.conditions.weight * sigma / values)

    def following(self, state: InterfaceState, normal: FloatArray, motion: FloatArray) -> InterfaceState:
        """Multipliers as large as the motion, (c, m), that they stand for."""
        if not self.conditions.remembers:
            return state
        flow = self._flow(state, normal)
        ratio = np.sqrt((motion**2).sum(axis=0)) / np.maximum(np.sqrt((flow**2).sum(axis=0)), 1e-300)
        return InterfaceState(state.resultants, state.multipliers * np.clip(ratio, *FACTORS))

    def residual(self, state: InterfaceState, normal: FloatArray, motion: FloatArray) -> FloatArray:
        """m, (c, m), with the motion v_r + Ψ̄/h."""
        return motion - self._flow(state, normal)

    def products(self, state: InterfaceState, normal: FloatArray) -> FloatArray:
        """Products g z, (k, m)."""
        return np.asarray(self.conditions.values(state.resultants, normal) * state.multipliers)

    def misfit(self, state: InterfaceState, normal: FloatArray, length: float) -> float:
        """How far resultants that flow are from their bounds: the lesser of g and h z, a force by a stiffness of 1."""
        values = self.conditions.values(state.resultants, normal)
        return float(np.minimum(values, length * state.multipliers).max(initial=0.0))

    def reach(
        self, state: InterfaceState, direction: InterfaceState, normal: FloatArray, change: FloatArray, most: float
    ) -> float:
        """How much of a direction stays within the bounds, at most ``most``; of normal forces with their change."""
        if not (np.isfinite(direction.resultants).all() and np.isfinite(direction.multipliers).all()):
            return 0.0
        most = min(most, float(lines_to_boundary(state.multipliers, direction.multipliers).min(initial=np.inf)))

        # conditions need not be concave in n: those that a step to there ends beyond are seen as well
        ends = (1.0,) if self.conditions.points is None else (1.0, SHARE)

        def beyond(bounds: InterfaceBounds, which: slice | IntArray, length: float) -> IntArray:
            """Those of some interfaces that are outside."""
            own, turn = state.resultants[:, which], direction.resultants[:, which]
            values = [bounds.values(own + end * length * turn, normal + end * length * change) for end in ends]
            return np.flatnonzero(~(np.concatenate(values) > 0.0).all(axis=0))

        which = beyond(self.conditions, slice(None), most)
        while len(which):
            bounds, low, high = self.conditions.only(which), 0.0, most
            for _ in range(HALVINGS):
                middle = 0.5 * (low + high)
                low, high = (low, middle) if len(beyond(bounds, which, middle)) else (middle, high)
                if high - low < CLOSE * high:
                    break
            most, which = low, beyond(self.conditions, slice(None), low)
            if not most > 0.0:
                return 0.0
        return most

    def _flow(self, state: InterfaceState, normal: FloatArray) -> FloatArray:
        """Σ z ∇g, (c, m)."""
        gradients = self.conditions.gradients(state.resultants, normal)
        return np.asarray((state.multipliers[:, None] * gradients).sum(axis=0))


@dataclass(frozen=True)
class EliminatedInterface:
    """A law linearised at a state.

    tangents : (m, c, c) W⁻¹
    crossed  : (m, c, p) X; None where normal forces do not matter
    """

    law: InterfaceLaw
    state: InterfaceState
    found: Derivatives
    tangents: FloatArray
    crossed: FloatArray | None

    @staticmethod
    def at(law: InterfaceLaw, state: InterfaceState, normal: FloatArray) -> EliminatedInterface | None:
        """At a state; None where W is singular."""
        found, z = law.conditions.derivatives(state.resultants, normal), state.multipliers
        ratio, gradients = z / found.values, found.gradients
        along = gradients.transpose(2, 1, 0)  # (m, c, k)
        weighted = np.ascontiguousarray((ratio[:, None] * gradients).transpose(2, 1, 0))
        w = np.matmul(weighted, along.transpose(0, 2, 1))
        w -= (z[:, None, None] * found.hessians).sum(axis=0).transpose(2, 0, 1)
        w += (RIGID * np.trace(w, axis1=1, axis2=2))[:, None, None] * np.eye(w.shape[1])
        try:
            tangents = np.linalg.inv(w)
        except np.linalg.LinAlgError:
            return None
        crossed = None
        if found.by_normal is not None and found.mixed is not None:
            crossed = np.matmul(weighted, found.by_normal.transpose(2, 0, 1))
            crossed -= (z[:, None, None] * found.mixed).sum(axis=0).transpose(2, 0, 1)
        return EliminatedInterface(law, state, found, tangents, crossed)

    def driving(self, residual: FloatArray, wanted: FloatArray) -> FloatArray:
        """Σ (r_k/g_k) ∇g_k − m, (c, m)."""
        return np.asarray((self.found.gradients * (wanted / self.found.values)[:, None]).sum(axis=0) - residual)

    def resultants(self, driving: FloatArray, velocities: FloatArray | float, change: FloatArray) -> FloatArray:
        """dr, (c, m), at velocities dv_r, (c, m), and a change of the normal forces, (n_points,)."""
        driving = driving - velocities
        if self.crossed is not None:
            driving = driving - np.einsum("map,mp->am", self.crossed, self._at_points(change))
        return np.asarray(np.einsum("mab,bm->am", self.tangents, driving))

    def change(self, resultants: FloatArray, change: FloatArray, wanted: FloatArray) -> InterfaceState:
        """The whole change from that of the resultants."""
        risen = self.risen(resultants, change)
        return InterfaceState(resultants, (wanted - self.state.multipliers * risen) / self.found.values)

    def risen(self, resultants: FloatArray, change: FloatArray) -> FloatArray:
        """dg, (k, m)."""
        risen = (self.found.gradients * resultants).sum(axis=1)
        if self.found.by_normal is not None:
            risen += np.einsum("kpm,mp->km", self.found.by_normal, self._at_points(change))
        return np.asarray(risen)

    def second_order(self, direction: InterfaceState, change: FloatArray) -> FloatArray:
        """What a whole direction adds to the products beyond its first order, (k, m)."""
        beyond = self.risen(direction.resultants, change) * direction.multipliers
        if self.found.by_normal is None:
            r = direction.resultants
            beyond += 0.5 * self.state.multipliers * np.einsum("kabm,am,bm->km", self.found.hessians, r, r)
        return np.asarray(beyond)

    @property
    def by_normal(self) -> FloatArray:
        """Derivatives −W⁻¹ X of the resultants by the normal forces of their points, (m, c, p)."""
        assert self.crossed is not None
        return np.asarray(-np.matmul(self.tangents, self.crossed))

    def _at_points(self, values: FloatArray) -> FloatArray:
        points = self.law.conditions.points
        assert points is not None
        return values[points]
