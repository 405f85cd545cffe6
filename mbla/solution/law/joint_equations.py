"""The equations of elastic joints in one implicit step: its terms, products of the law, what a state leaves of them."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import ElasticJoints, Memory, StepState
from mbla.solution.law.masses import Masses


@dataclass(frozen=True)
class JointStep:
    """An implicit step.

    memory : of the joints before it
    length : h
    driven : whether the live work f_L·u is given; else the load factor stays and the structure finds its rest
    work   : that work: 1, or 0 of a support that is held
    held   : (n_rows,) stiffness of springs that hold the blocks; default: none
    holds_at : (n_rows,) velocities with which these carry nothing
    masses : of the blocks, which resist a change of their motion in time; None where nothing moves in time
    """

    joints: ElasticJoints
    memory: Memory
    length: float
    driven: bool = True
    work: float = 1.0
    held: FloatArray | float = 0.0
    holds_at: FloatArray | float = 0.0
    masses: Masses | None = None

    @cached_property
    def normal_compliance(self) -> FloatArray:
        """1/(k_N h), (n_points,)."""
        return 1.0 / (self.joints.normal * self.length)

    @cached_property
    def shear_compliance(self) -> FloatArray:
        """1/(k_T h), (n_points,)."""
        return 1.0 / (self.joints.shear * self.length)

    def balance(self, state: StepState) -> FloatArray:
        """A x + f_D + λ f_L − ε (u − ū) − M (u − u_f), and f_L·u − w, 0 where the load factor stays; (n_rows + 1,)."""
        work = float(self.joints.program.live_load @ state.u) - self.work if self.driven else 0.0
        left = self.joints.unbalanced(state) - self.held * (state.u - self.holds_at)
        return np.append(left if self.masses is None else left - self.masses.resistance(state.u), work)

    def openings(self, state: StepState, velocities: FloatArray) -> FloatArray:
        """Openings y of a state by the velocities of its contacts and its normal forces, (n_points,)."""
        opening = velocities[0] + self.normal_compliance * (state.normal - self.memory.normal)
        if self.joints.dilates:
            opening = opening - self.joints.dilatancy * state.speed
        opening[self.joints.crushable] += state.crushing
        return np.asarray(opening)

    def motions(self, u: FloatArray) -> list[FloatArray]:
        """v_r + Ψ̄/h of each law of interfaces, (components, m)."""
        return [
            v + before / self.length for v, before in zip(self.joints.motions(u), self.memory.interfaces, strict=True)
        ]


@dataclass(frozen=True)
class Products:
    """Products of the law, or changes wanted of them.

    normal   : (n_points,) N y                crushing : (n_crushable,) (f_c − n) z
    sliding  : (n_points,) l s + t·w          turning  : (components − 1, n_points) l w + s t
    interfaces : g z of each law of interfaces, (k, m)
    """

    normal: FloatArray
    sliding: FloatArray
    turning: FloatArray
    crushing: FloatArray
    interfaces: tuple[FloatArray, ...] = ()

    def plus(self, other: Products) -> Products:
        """The sum of both."""
        sums = {key: mine + getattr(other, key) for key, mine in vars(self).items() if key != "interfaces"}
        of_laws = tuple(a + b for a, b in zip(self.interfaces, other.interfaces, strict=True))
        return Products(**sums, interfaces=of_laws)

    def mean(self, joints: ElasticJoints) -> float:
        """Of all products."""
        total = self.normal.sum() + self.sliding.sum() + self.crushing.sum() + sum(one.sum() for one in self.interfaces)
        return float(total) / (joints.n_products + len(self.crushing))

    def towards(self, sigma: float, joints: ElasticJoints) -> Products:
        """Changes that bring them all to σ."""
        return Products(
            normal=sigma - self.normal,
            sliding=sigma - self.sliding,
            turning=-self.turning,
            crushing=sigma - self.crushing,
            interfaces=tuple(
                law.conditions.weight * sigma - one for law, one in zip(joints.laws, self.interfaces, strict=True)
            ),
        )


@dataclass(frozen=True)
class Residual:
    """What a state leaves of the equations.

    balance       : (n_rows + 1,) unbalanced forces, and f_L·u − 1
    normal, shear : (n_points,), (components − 1, n_points) incompatible velocities m_n, m_t
    products      : of the law
    interfaces    : of the flow of each law of interfaces, (components, m)
    """

    balance: FloatArray
    normal: FloatArray
    shear: FloatArray
    products: Products
    interfaces: tuple[FloatArray, ...] = ()

    @property
    def unbalanced(self) -> float:
        """Largest entry of the balance, in mean loads of a block."""
        return float(np.abs(self.balance).max(initial=0.0))

    def incompatible(self, joints: ElasticJoints, state: StepState) -> float:
        """Largest incompatible velocity over the largest velocity of a contact."""
        most = max(float(np.abs(self.normal).max(initial=0.0)), float(np.abs(self.shear).max(initial=0.0)))
        return most / max(float(np.abs(joints.velocities(state.u)).max(initial=0.0)), 1e-300)


def residual_of(step: JointStep, state: StepState) -> Residual:
    """What a state leaves of the equations of a step."""
    v, sheared = step.joints.velocities(state.u), step.shear_compliance * (state.shear - step.memory.shear)
    flows = zip(step.joints.laws, state.interfaces, step.motions(state.u), strict=True)
    return Residual(
        balance=step.balance(state),
        normal=step.openings(state, v) - state.opening,
        shear=v[1:] + sheared - state.slip,
        products=products_of(step.joints, state),
        interfaces=tuple(law.residual(one, state.normal, motion) for law, one, motion in flows),
    )


def products_of(joints: ElasticJoints, state: StepState) -> Products:
    """Products of the law in a state."""
    limit = joints.limit(state.normal)
    return Products(
        normal=(state.normal + joints.program.limits.tension) * state.opening,
        sliding=limit * state.speed + (state.shear * state.slip).sum(axis=0),
        turning=limit * state.slip + state.speed * state.shear,
        crushing=joints.room(state.normal) * state.crushing,
        interfaces=tuple(
            law.products(one, state.normal) for law, one in zip(joints.laws, state.interfaces, strict=True)
        ),
    )
