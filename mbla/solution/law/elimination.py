"""Linearised equations of elastic joints with every joint eliminated: one factorisation of A C Aᵀ remains.

Each joint is eliminated from the linearised equations of :mod:`mbla.solution.law.elastic_joints`, so that one
factorisation of A C Aᵀ, bordered by the live load, remains. With cone = l I − t tᵀ/l::

    H = cone/(k_T h) + s I − t wᵀ/l,   h_v = H⁻¹ μ (w − s t/l),   b = (δ/l)(t/(k_T h) + w)
    a = 1/(k_N h) + y/N + z/room + δ s μ/l − b·h_v
    g_t' = H⁻¹(r_q − t r_p/l − cone m_t),   g_n = [r_n/N − m_n − r_z/room + (δ/l)(r_p − t·m_t) − b·g_t']/a
    dn = g_n + [−dv_n − (δ/l) t·dv_t + b·H⁻¹cone dv_t]/a,    dt = g_t' − H⁻¹cone dv_t − h_v dn

m are the residuals of compatibility, r the changes wanted of the products. Without dilatancy the normal force does not
see the sliding while the sliding sees the normal force: the matrix is not symmetric.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.interface_law import EliminatedInterface, InterfaceState
from mbla.solution.law.joint_equations import JointStep, Products, Residual
from mbla.solution.linear_algebra.stiffness import BorderedFactors

SHIFT = 1e-14
"""Share of the stiffness of all joints that is added on the diagonal: a block whose joints all open has none."""


@dataclass(frozen=True)
class Eliminated:
    """The equations linearised at a state, joints eliminated and the rest factorised.

    tangents : (n_points, components, components) C, with dx = −C dv + …
    inverse  : (components − 1, components − 1, n_points) H⁻¹
    across   : the same of H⁻¹ cone
    follows  : (components − 1, n_points) h_v
    lifts    : (components − 1, n_points) b, None without dilatancy
    interfaces : each law of interfaces by itself
    """

    step: JointStep
    state: StepState
    solve: BorderedFactors
    tangents: FloatArray
    cone: FloatArray
    inverse: FloatArray
    across: FloatArray
    follows: FloatArray
    lifts: FloatArray | None
    over: FloatArray
    interfaces: tuple[EliminatedInterface, ...] = ()

    @staticmethod
    def at(step: JointStep, state: StepState) -> Eliminated | None:
        """At a state; None where the matrix is singular."""
        joints = step.joints
        over = 1.0 / joints.limit(state.normal)
        size, n = joints.program.components, joints.program.n_points
        every = np.eye(size - 1)[:, :, None]
        cone = every / over - over * state.shear[:, None] * state.shear[None, :]
        h = step.shear_compliance * cone + every * state.speed - over * state.shear[:, None] * state.slip[None, :]
        inverse = small_inverses(h)
        across = _products(inverse, cone)
        follows = _applied(inverse, joints.friction * (state.slip - state.speed * over * state.shear))
        stiff = step.normal_compliance + state.opening / joints.margin(state.normal)
        stiff[joints.crushable] += state.crushing / joints.room(state.normal)
        lifts, tangents = None, np.zeros((n, size, size))
        if joints.dilates:
            slope = joints.dilatancy * over
            lifts = slope * (step.shear_compliance * state.shear + state.slip)
            stiff = stiff + slope * state.speed * joints.friction - (lifts * follows).sum(axis=0)
            tangents[:, 0, 1:] = ((slope * state.shear - np.einsum("in,ijn->jn", lifts, across)) / stiff).T
        tangents[:, 0, 0] = 1.0 / stiff
        tangents[:, 1:, 1:] = across.transpose(2, 0, 1)
        tangents[:, 1:, :] -= follows.T[:, :, None] * tangents[:, 0, None, :]
        own = [
            EliminatedInterface.at(law, one, state.normal)
            for law, one in zip(joints.laws, state.interfaces, strict=True)
        ]
        interfaces = tuple(one for one in own if one is not None)
        every_tangent = np.concatenate([tangents, *(one.tangents for one in interfaces)])
        if len(interfaces) < len(own) or not np.isfinite(every_tangent).all():
            return None
        shift = SHIFT * float(np.mean(tangents[:, 0, 0])) * joints.matrix.size + step.held
        further = [
            crossing.entries(one.by_normal, tangents)
            for crossing, one in zip(joints.crossings, interfaces, strict=True)
            if crossing is not None
        ]
        further += [] if step.masses is None else [step.masses.entries]
        solve = joints.matrix.factorized(every_tangent, shift, fixed_load=not step.driven, further=further)
        if solve is None:
            return None
        return Eliminated(step, state, solve, tangents, cone, inverse, across, follows, lifts, over, interfaces)

    def direction(self, residual: Residual, wanted: Products) -> StepState:
        """Direction that changes the products as told and makes up for what else is missing."""
        step, state, joints = self.step, self.state, self.step.joints
        margin, room = joints.margin(state.normal), joints.room(state.normal)
        alone = wanted.normal / margin - residual.normal
        alone[joints.crushable] -= wanted.crushing / room
        turned = wanted.turning - state.shear * (wanted.sliding * self.over) - _applied(self.cone, residual.shear)
        free_shear = _applied(self.inverse, turned)
        if self.lifts is not None:
            slope = joints.dilatancy * self.over
            alone = alone + slope * (wanted.sliding - (state.shear * residual.shear).sum(axis=0))
            alone = alone - (self.lifts * free_shear).sum(axis=0)
        free = self.tangents[:, 0, 0] * alone
        free_shear = free_shear - self.follows * free
        rhs, driving = -residual.balance, self._driving(residual, wanted)
        alone_too = [one.resultants(drive, 0.0, free) for one, drive in zip(self.interfaces, driving, strict=True)]
        rhs[:-1] -= joints.carried(free, free_shear, alone_too)
        answer = self.solve.unrefined(rhs)
        dv = joints.velocities(answer[:-1])
        change = np.einsum("nij,jn->in", self.tangents, dv)
        normal, shear = free - change[0], free_shear - change[1:]
        slip = dv[1:] + step.shear_compliance * shear + residual.shear
        friction = joints.friction
        speed = wanted.sliding - state.speed * friction * normal
        speed = self.over * (speed - (state.shear * slip).sum(axis=0) - (state.slip * shear).sum(axis=0))
        return StepState(
            u=answer[:-1],
            factor=float(answer[-1]),
            normal=normal,
            opening=(wanted.normal - state.opening * normal) / margin,
            shear=shear,
            slip=slip,
            speed=speed,
            crushing=(wanted.crushing + state.crushing * normal[joints.crushable]) / room,
            interfaces=self._interfaces(wanted, driving, answer[:-1], normal),
        )

    def _driving(self, residual: Residual, wanted: Products) -> list[FloatArray]:
        """What drives the resultants of each law of interfaces besides motion and normal forces."""
        each = zip(self.interfaces, residual.interfaces, wanted.interfaces, strict=True)
        return [one.driving(flow, products) for one, flow, products in each]

    def _interfaces(
        self, wanted: Products, driving: list[FloatArray], u: FloatArray, normal: FloatArray
    ) -> tuple[InterfaceState, ...]:
        """Changes of the laws of interfaces, with those of velocities and normal forces."""
        each = zip(self.interfaces, driving, self.step.joints.motions(u), wanted.interfaces, strict=True)
        return tuple(
            one.change(one.resultants(drive, motion, normal), normal, products) for one, drive, motion, products in each
        )


def small_inverses(matrices: FloatArray) -> FloatArray:
    """Inverses of 1 × 1 or 2 × 2 matrices that stand last, (k, k, n)."""
    if len(matrices) == 1:
        return 1.0 / matrices
    (a, b), (c, d) = matrices
    return np.asarray(np.stack([np.stack([d, -b]), np.stack([-c, a])]) / (a * d - b * c))


def _applied(matrices: FloatArray, vectors: FloatArray) -> FloatArray:
    """(k, k, n) times (k, n)."""
    return np.asarray((matrices * vectors[None]).sum(axis=1))


def _products(first: FloatArray, second: FloatArray) -> FloatArray:
    """(k, k, n) times (k, k, n)."""
    return np.asarray((first[:, :, None] * second[None]).sum(axis=1))
