"""Residuals of forces and mechanism under a flow rule, relative to loads, speeds and power.

With s = ‖v_T‖ and ψ the dilatancy angle that the flow rule claims, the complementarity residual is the share of the
power balance, hence of the load factor, that the rule leaves unexplained::

    Σ |(N + f_t)(v_N − s tan ψ)₊| + Σ |(f_c − N)(s tan ψ − v_N)₊| + Σ |(μN + c) s + T·v_T|
    over   max(|λ|, |f_D·u|, Σ (μN + c) s, least factor)

where the second sum is |N (s tan ψ − v_N)₊| at points that cannot crush, and the least factor
(``load_scale``) gives structures whose load factor is zero a scale. The third sum by itself is the
slip residual: sliding that is not against the friction, or not with all of it.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.program.yield_conditions.limits import YieldLimits
from mbla.solution.solution import Mechanics
from mbla.solution.verification.case import LoadedModel
from mbla.solution.verification.statics import largest_on_interface, off_guides
from mbla.solution.verification.strengths import excess

AT_REST = 1e-9
"""contact speed over the speed of blocks up to which a joint does not move: the accuracy of the cone programs"""


@dataclass(frozen=True)
class Residuals:
    """Relative residuals of one pair of forces and mechanism.

    equilibrium     : largest unbalanced force, or moment over the lever arm, over the mean load of a block; over what
                      the block itself has to balance where that is less
    yielding        : largest excess of a force over its yield conditions, over the same of the lighter block
    tension         : the part of it that is tension beyond the tensile strength
    penetration     : largest closing velocity over the largest contact speed, that of a cut that opens among them,
                      where the joint cannot crush, 0 where no joint moves with the blocks; or the largest velocity of a
                      block against its guide, over the largest of any, if that is more
    complementarity : see the module's text
    slip            : the part of it that is sliding not against friction
    live_power      : of the live load on the mechanism, should be 1
    power_balance   : difference of external and dissipated power, over what complementarity is relative to
    """

    equilibrium: float
    yielding: float
    tension: float
    penetration: float
    complementarity: float
    slip: float
    live_power: float
    power_balance: float

    @property
    def largest(self) -> float:
        """The largest of all, NaN where one is."""
        off = abs(self.live_power - 1.0)
        parts = (self.equilibrium, self.yielding, self.penetration, self.complementarity, self.power_balance, off)
        return float(np.max(parts))  # tension and slip are parts of others


NO_FORCE = 2.0
"""Force over the largest on an interface of a state that it does not come near: strengths beyond count as that in
powers, where the rounding of motions would count as much as they do."""


def residuals_of(case: LoadedModel, mechanics: Mechanics, dilatancy: FloatArray) -> Residuals:
    """Residuals under a flow rule with the given dilatancy (tangent), (n_points,)."""
    limits, scale, contacts, free = case.limits, case.scale, case.contacts, case.model.free
    x, factor, (u, motions) = mechanics.contact_forces, mechanics.load_factor, case.motion_of(mechanics)
    moved, (by_interfaces, by_crushing) = case.velocities(u), case.interface_velocities(motions)
    v, interfaces = moved - by_interfaces, case.interface_terms(mechanics)
    sliding = np.hypot(v[:, 1], v[:, 2])
    speed = float(np.linalg.norm(moved, axis=1).max(initial=load_cell_speed(contacts, u)))
    closing = np.where(np.isinf(limits.compression), np.maximum(by_crushing[:, 0] - moved[:, 0], 0.0), 0.0)
    dead_power, live_power = case.powers(u)
    counted = limits.at_most(NO_FORCE * largest_on_interface(contacts, x))
    strength = counted.friction * x[:, 0] + counted.cohesion
    flow = flow_power(counted, dilatancy, x, v, sliding, strength)
    frictional = float(np.abs(strength * sliding).sum()) + interfaces.frictional
    balance = case.balance(factor * live_power, dead_power, frictional, u)
    lost = dead_power + factor * live_power - flow.dissipated - interfaces.dissipated
    block_scale = case.block_scale(x, factor)
    point_scale = scale.of_lighter(contacts, block_scale)
    of_points = float((excess(x, limits) / point_scale).max(initial=0.0))
    tension = np.maximum(-x[:, 0] - limits.tension, 0.0)
    return Residuals(
        equilibrium=float((case.unbalanced_loads(x, factor)[free] / block_scale[free]).max(initial=0.0)),
        yielding=max(of_points, case.interface_excess(x, point_scale)),
        tension=float((tension / point_scale).max(initial=0.0)),
        penetration=max(penetration_of(closing, speed, u, scale.arms), off_guides(case.model, u, scale.arms)),
        complementarity=share_of(flow.normal + flow.slip + interfaces.unexplained, balance),
        slip=share_of(flow.slip + interfaces.slip, balance),
        live_power=live_power,
        power_balance=share_of(abs(lost), balance),
    )


def load_cell_speed(contacts: Contacts, mechanism: FloatArray) -> float:
    """Speed at which the load cell of an objective, the last block, opens its cut; 0 without one.

    Joints of the cut move by that much less: blocks that follow it leave them at rest but for rounding.
    """
    return 0.0 if contacts.cut is None else float(np.linalg.norm(mechanism[-1, :3]))


def penetration_of(closing: FloatArray, speed: float, mechanism: FloatArray, arms: FloatArray) -> float:
    """Largest closing velocity over the largest contact speed; 0 where the blocks move and no joint does.

    Blocks that only guides hold have no joint, and blocks on parallel rails may move side by side. Where nothing moves
    at all it is NaN.

    closing   : (n_points,)
    speed     : largest contact speed
    mechanism : (n_blocks, 6)
    arms      : (n_blocks,)
    """
    blocks = float((np.linalg.norm(mechanism[:, :3], axis=1) + arms * np.linalg.norm(mechanism[:, 3:], axis=1)).max())
    if blocks > 0 and speed <= AT_REST * blocks:
        return 0.0
    return share_of(float(closing.max(initial=0.0)), speed)


def share_of(part: float, total: float) -> float:
    """A part over the total, NaN where there is none."""
    return part / total if total > 0 else np.nan


@dataclass(frozen=True)
class FlowPower:
    """Power that the flow rule leaves unexplained, across and along the joints, and what the joints dissipate."""

    normal: float
    slip: float
    dissipated: float


def flow_power(
    limits: YieldLimits,
    dilatancy: FloatArray,
    x: FloatArray,
    v: FloatArray,
    sliding: FloatArray,
    strength: FloatArray,
) -> FlowPower:
    """Power of points with forces x and velocities v, sliding speeds and shear strengths, (n_points,)."""
    surplus = v[:, 0] - dilatancy * sliding
    crushable = np.isfinite(limits.compression)
    capacity = np.where(crushable, limits.compression, 0.0)
    opening = np.maximum(surplus, 0.0)
    crushing = np.where(crushable, np.maximum(-surplus, 0.0), 0.0)
    normal = np.abs((x[:, 0] + limits.tension) * opening) + np.abs((capacity - x[:, 0]) * crushing)
    normal += np.where(crushable, 0.0, np.abs(x[:, 0] * np.minimum(surplus, 0.0)))
    slip = np.abs(strength * sliding + x[:, 1] * v[:, 1] + x[:, 2] * v[:, 2])
    dissipated = (strength - dilatancy * x[:, 0]) * sliding + limits.tension * opening + capacity * crushing
    return FlowPower(float(normal.sum()), float(slip.sum()), float(dissipated.sum()))
