"""A load case for the verification: what follows from model, contacts and loads, and what contact points allow.

Conditions on interfaces change some of it (:mod:`mbla.solution.verification.verify_convex`), by the same names.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.solution import Mechanics
from mbla.solution.verification.statics import (
    LoadScale,
    allowed_motion,
    contact_resultants,
    contact_velocities,
    left_to_balance,
    load_scale,
    power,
)
from mbla.solution.verification.strengths import excess, point_strengths

Motion = tuple[FloatArray, FloatArray | None]
"""Velocities of the blocks, (n_blocks, 6), and motions of the interfaces, (n_interfaces, 2, 6), where they have any."""

PROVED_RESIDUAL = 2e-9
"""Unbalanced force and excess over yield, relative to the scale of the block, with which forces still prove a bound."""

PASSED_ON_ROUNDING = 1e-6
"""Share of the forces on a block that its scale is not less than there: thin light blocks pass on forces whose rounding
is more than their weight."""


@dataclass(frozen=True)
class InterfaceTerms:
    """What interfaces add to the residuals of their contact points, power in N m/s.

    dissipated, frictional : power of their motions at most; that of it which is friction
    unexplained, slip      : power that the flow rule leaves unexplained; that of it which is sliding
    """

    dissipated: float = 0.0
    frictional: float = 0.0
    unexplained: float = 0.0
    slip: float = 0.0


@dataclass(frozen=True)
class LoadedModel:
    """Model, contacts and loads; forces are (n_points, 3) N, mechanisms (n_blocks, 6)."""

    model: Model
    contacts: Contacts
    load_case: LoadCase

    @cached_property
    def limits(self) -> YieldLimits:
        """Strengths of the contact points."""
        return point_strengths(self.model, self.contacts)

    @cached_property
    def scale(self) -> LoadScale:
        """Sizes of the loads."""
        return load_scale(self.model, self.contacts, self.load_case, self.limits)

    def velocities(self, mechanism: FloatArray) -> FloatArray:
        """Velocities at the contact points, (n_points, 3)."""
        return contact_velocities(self.model, self.contacts, mechanism)

    def powers(self, mechanism: FloatArray) -> tuple[float, float]:
        """Power of dead and of live load on a mechanism, (n_blocks, 6)."""
        return power(self.load_case.dead_load, mechanism), power(self.load_case.live_load, mechanism)

    def unbalanced_wrenches(self, forces: FloatArray, factor: float) -> FloatArray:
        """What loads and contact forces leave on each block besides what its guides take, (n_blocks, 6) N, N m."""
        loads = self.load_case.dead_load + factor * self.load_case.live_load
        acting = contact_resultants(self.model, self.contacts, forces) + loads
        return left_to_balance(self.model, acting, self.scale.arms)

    def unbalanced_loads(self, forces: FloatArray, factor: float) -> FloatArray:
        """Largest unbalanced component of each block, moments over the lever arm, zero on fixed blocks, (n_blocks,).

        Of guided blocks only what their guides do not carry counts.
        """
        unbalanced = np.abs(self.unbalanced_wrenches(forces, factor))
        unbalanced[:, 3:] /= self.scale.arms[:, None]
        return np.where(self.model.fixed, 0.0, unbalanced.max(axis=1))

    def motion_of(self, mechanics: Mechanics) -> Motion:
        """How blocks and interfaces move."""
        return mechanics.mechanism, None

    def admissible(self, motion: Motion) -> Motion:
        """The nearest motion in which fixed blocks stay where they are, and guided ones on their ways."""
        still = np.where(self.model.fixed[:, None], 0.0, motion[0])
        return allowed_motion(self.model, still, self.scale.arms), motion[1]

    def balance(self, live_power: float, dead_power: float, frictional: float, mechanism: FloatArray) -> float:
        """What shares of the power are relative to, from the powers of loads and of friction in a mechanism."""
        return max(abs(live_power), abs(dead_power), frictional, self.scale.least_factor(mechanism))

    def interface_velocities(self, motions: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        """Velocities that the points have with their interfaces, and those of them by crushing, (n_points, 3)."""
        none = np.zeros((len(self.contacts.points), 3))
        return none, none

    def interface_terms(self, mechanics: Mechanics) -> InterfaceTerms:
        """What the interfaces add to residuals."""
        return InterfaceTerms()

    def off_flow(self, mechanics: Mechanics) -> FloatArray:
        """How far forces of interfaces are from those with which they flow as they do, (n_interfaces,) [force]."""
        return np.zeros(len(self.contacts))

    def interface_excess(self, forces: FloatArray, point_scale: FloatArray) -> float:
        """Largest excess of an interface over its conditions, relative to the scale of its points.

        forces      : (n_points, 3) N, compression positive
        point_scale : (n_points,) N
        """
        return 0.0

    def block_scale(self, forces: FloatArray, factor: float) -> FloatArray:
        """What residuals of each block are relative to, (n_blocks,)."""
        return self.scale.block_scale(self.contacts, forces)

    def forces_prove(self, forces: FloatArray, factor: float) -> bool:
        """Whether forces, (n_points, 3) N, balance the loads within all conditions up to rounding."""
        block_scale = self.scale.rounded_scale(self.contacts, forces, factor, PASSED_ON_ROUNDING)
        allowed = PROVED_RESIDUAL * self.scale.of_lighter(self.contacts, block_scale)
        return bool(
            np.all(self.unbalanced_loads(forces, factor) <= PROVED_RESIDUAL * block_scale)
            and np.all(excess(forces, self.limits) <= allowed)
        )

    def charge(self, forces: FloatArray, factor: float, motion: Motion) -> float:
        """Power of unbalanced forces and of those beyond yield in a mechanism, over its live power.

        forces : (n_points, 3) N, compression positive
        """
        mechanism = motion[0]
        left = self.unbalanced_wrenches(forces, factor)
        unbalanced = float(np.abs(np.einsum("bi,bi->b", left, mechanism)).sum())
        speed = np.sqrt((self.velocities(mechanism) ** 2).sum(axis=1))
        beyond = float((excess(forces, self.limits) * speed).sum())
        return (unbalanced + beyond) / self.powers(mechanism)[1]

    def dissipation(self, motion: Motion, most: float = np.inf) -> tuple[float, float]:
        """Power that joints dissipate at most by associative flow, and Σ δ over the points that cannot crush.

        most : force that no solution comes near: strengths beyond count as that, as those without limit do in what
               rounding of motions is charged with
        """
        limits, (mechanism, motions) = self.limits.at_most(most), motion
        v = self.velocities(mechanism) - self.interface_velocities(motions)[0]
        sliding = np.hypot(v[:, 1], v[:, 2])
        surplus = v[:, 0] - limits.friction * sliding
        short = np.maximum(-surplus, 0.0)
        crushable = np.isfinite(limits.compression)
        crushed = np.where(crushable, limits.compression, 0.0) * short
        dissipated = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0) + crushed
        return float(dissipated.sum()), float(short[~crushable].sum())
