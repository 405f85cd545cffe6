"""Joints in a step of the interior-point method: the law, the unknowns of a joint, their elimination, the way to go.

See :mod:`mbla.solution.nonassociative.interior_step` for the equations.

Then what the products of force left and motion should become in a step.

The products of a joint are N y, (f_c − N) z and the pair p = l s + T·w, q = l w + s T, which is the product of (l, T)
and (s, w) in the algebra of the second-order cone; its eigenvalues are p ± ‖q‖. In the middle N y = (f_c − N) z = σ,
p = σ, q = 0: both eigenvalues are σ too.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.solution.linear_algebra.small_blocks import inverses
from mbla.solution.linear_algebra.stiffness import Stiffness

LEAST_LIMIT = 1e-10
"""Least shear limit of a joint that can have none, in mean block loads: a cone that is a point has no inside."""


@dataclass(frozen=True)
class InteriorLaw:
    """Joint law of a step, (n_points,) each: shear limit l = slope N + offset, tangent of the dilatancy angle."""

    slope: FloatArray
    offset: FloatArray
    dilatancy: FloatArray


def exact_law(program: Program, dilatancy: FloatArray) -> InteriorLaw:
    """The joint law with a dilatancy."""
    return InteriorLaw(program.limits.friction, program.limits.cohesion, dilatancy)


def lagged_law(program: Program, dilatancy: FloatArray, anchor: FloatArray) -> InteriorLaw:
    """Friction beyond the dilatancy taken from the anchor's normal forces: a convex program."""
    limits = program.limits
    offset = np.maximum((limits.friction - dilatancy) * anchor[:, 0] + limits.cohesion, 0.0)
    return InteriorLaw(dilatancy, offset, dilatancy)


@dataclass(frozen=True)
class Iterate:
    """Unknowns; room and crushing only at the points of finite compressive strength.

    velocities (n_rows,), load factor; per point normal force over −f_t, opening, shear, sliding velocity and its bound
    """

    u: FloatArray
    factor: float
    normal: FloatArray
    opening: FloatArray
    shear: FloatArray
    slip: FloatArray
    speed: FloatArray
    crushing: FloatArray


@dataclass(frozen=True)
class StepProblem:
    """The problem: stiffness pattern, law, anchor, step size, points that can crush."""

    stiffness: Stiffness
    law: InteriorLaw
    anchor: FloatArray
    rho: float
    fixed_load: bool
    crushable: IntArray

    @property
    def program(self) -> Program:
        """The program that is solved."""
        return self.stiffness.program

    def limit(self, normal: FloatArray) -> FloatArray:
        """Shear limit l at normal forces over −f_t."""
        full = self.law.slope * (normal - self.program.limits.tension) + self.law.offset
        return np.where(self.law.slope > 0.0, full, np.maximum(full, LEAST_LIMIT))

    def room(self, normal: FloatArray) -> FloatArray:
        """What is left to the compressive strength, at the points that can crush."""
        limits = self.program.limits
        return np.asarray((limits.compression + limits.tension - normal)[self.crushable])


@dataclass(frozen=True)
class Missing:
    """What the linear equations and the products miss."""

    balance: FloatArray
    normal: FloatArray
    shear: FloatArray
    normal_product: FloatArray
    crushing_product: FloatArray
    shear_product: FloatArray
    shear_direction: FloatArray
    speed: float


@dataclass(frozen=True)
class Products:
    """Changes wanted of the products: opening, crushing, sliding, direction of sliding."""

    opening: FloatArray
    crushing: FloatArray
    sliding: FloatArray
    turning: FloatArray

    def plus(self, other: Products) -> Products:
        """The sum of both."""
        return Products(
            self.opening + other.opening,
            self.crushing + other.crushing,
            self.sliding + other.sliding,
            self.turning + other.turning,
        )


def moved(now: Iterate, direction: Iterate, length: float) -> Iterate:
    """The iterate a length along a direction."""
    return Iterate(
        u=now.u + length * direction.u,
        factor=now.factor + length * direction.factor,
        normal=now.normal + length * direction.normal,
        opening=now.opening + length * direction.opening,
        shear=now.shear + length * direction.shear,
        slip=now.slip + length * direction.slip,
        speed=now.speed + length * direction.speed,
        crushing=now.crushing + length * direction.crushing,
    )


def way_to_go(step: StepProblem, now: Iterate, direction: Iterate) -> float:
    """How much of a direction, at most all of it, leaves every joint within its bounds."""
    limit, growth = step.limit(now.normal), step.law.slope * direction.normal
    room = step.room(now.normal)
    lines = (
        (now.normal, direction.normal),
        (now.opening, direction.opening),
        (room, -direction.normal[step.crushable]),
        (now.crushing, direction.crushing),
    )
    reach = 1.0
    for value, change in lines:
        falls = change < 0.0
        reach = min(reach, float((value[falls] / -change[falls]).min(initial=1.0)))
    for radius, change, vector, turn in (
        (limit, growth, now.shear, direction.shear),
        (now.speed, direction.speed, now.slip, direction.slip),
    ):
        reach = min(reach, float(_reach_in_cone(radius, change, vector, turn).min(initial=1.0)))
    return reach


def _reach_in_cone(radius: FloatArray, change: FloatArray, vector: FloatArray, turn: FloatArray) -> FloatArray:
    """First t > 0 at which radius + t change = ‖vector + t turn‖, inf where there is none."""
    square = change**2 - (turn**2).sum(axis=1)
    mixed = radius * change - (vector * turn).sum(axis=1)
    inside = radius**2 - (vector**2).sum(axis=1)
    root = mixed**2 - square * inside
    below = np.sqrt(np.maximum(root, 0.0)) - mixed
    meets = (root >= 0.0) & (below > 0.0)
    return np.where(meets, inside / np.where(meets, below, 1.0), np.inf)


@dataclass(frozen=True)
class Joints:
    """Every joint linearised: inverse @ (…) gives its forces, dx = −tangents dv + g."""

    step: StepProblem
    limit: FloatArray
    cone: FloatArray
    inverse: FloatArray
    tangents: FloatArray

    @staticmethod
    def of(step: StepProblem, now: Iterate) -> Joints:
        """Eliminate openings and sliding velocities: H dx = −G dv + q, C = H⁻¹ G."""
        law, rho, c = step.law, step.rho, step.program.components
        limit = step.limit(now.normal)
        over = 1.0 / limit
        cone = limit[:, None, None] * np.eye(c - 1) - (over[:, None] * now.shear)[:, :, None] * now.shear[:, None, :]
        h = np.zeros((len(limit), c, c))
        g = np.zeros_like(h)
        h[:, 0, 0] = rho + now.opening / now.normal + law.dilatancy * law.slope * now.speed * over
        h[step.crushable, 0, 0] += now.crushing / step.room(now.normal)
        h[:, 0, 1:] = (law.dilatancy * over)[:, None] * (rho * now.shear + now.slip)
        h[:, 1:, 0] = law.slope[:, None] * (now.slip - (now.speed * over)[:, None] * now.shear)
        h[:, 1:, 1:] = rho * cone + now.speed[:, None, None] * np.eye(c - 1)
        h[:, 1:, 1:] -= (over[:, None] * now.shear)[:, :, None] * now.slip[:, None, :]
        g[:, 0, 0] = 1.0
        g[:, 0, 1:] = (law.dilatancy * over)[:, None] * now.shear
        g[:, 1:, 1:] = cone
        inverse = inverses(h)
        return Joints(step, limit, cone, inverse, np.matmul(inverse, g))

    def direction(
        self,
        solve: Callable[[FloatArray], FloatArray],
        now: Iterate,
        missing: Missing,
        products: Products,
    ) -> Iterate:
        """Direction that changes the products as told and makes up for what else is missing."""
        step, law, program = self.step, self.step.law, self.step.program
        opening, crushing, sliding, turning = products.opening, products.crushing, products.sliding, products.turning
        over = 1.0 / self.limit
        normal = opening / now.normal - missing.normal
        normal[step.crushable] -= crushing / step.room(now.normal)
        normal += law.dilatancy * over * (sliding - (now.shear * missing.shear).sum(axis=1))
        shear = turning - (over * sliding)[:, None] * now.shear - np.einsum("pij,pj->pi", self.cone, missing.shear)
        free = np.einsum("pij,pj->pi", self.inverse, np.column_stack([normal, shear]))
        rhs = -missing.balance
        rhs[:-1] -= program.equilibrium_matrix @ free.ravel()
        answer = solve(rhs)
        dv = step.stiffness.velocities(answer[:-1])
        dx = free - np.einsum("pij,pj->pi", self.tangents, dv)
        slip = dv[:, 1:] + step.rho * dx[:, 1:] + missing.shear
        speed = sliding - now.speed * law.slope * dx[:, 0]
        speed = over * (speed - (now.shear * slip).sum(axis=1) - (now.slip * dx[:, 1:]).sum(axis=1))
        return Iterate(
            u=answer[:-1],
            factor=float(answer[-1]),
            normal=dx[:, 0],
            opening=(opening - now.opening * dx[:, 0]) / now.normal,
            shear=dx[:, 1:],
            slip=slip,
            speed=speed,
            crushing=(crushing + now.crushing * dx[step.crushable, 0]) / step.room(now.normal),
        )


def wanted(
    step: StepProblem, missing: Missing, target: float, predictor: Iterate | None = None, second: float = 0.0
) -> Products:
    """Changes to products ``target``, less the second-order terms of a predictor weighted by ``second``."""
    plain = Products(
        opening=target - missing.normal_product,
        crushing=target - missing.crushing_product,
        sliding=target - missing.shear_product,
        turning=-missing.shear_direction,
    )
    if predictor is None or second == 0.0:
        return plain
    growth = step.law.slope * predictor.normal
    return plain.plus(
        Products(
            opening=-second * predictor.normal * predictor.opening,
            crushing=second * predictor.normal[step.crushable] * predictor.crushing,
            sliding=-second * (growth * predictor.speed + (predictor.shear * predictor.slip).sum(axis=1)),
            turning=-second * (growth[:, None] * predictor.slip + predictor.speed[:, None] * predictor.shear),
        )
    )


def outlying(step: StepProblem, ahead: Iterate, least: float, most: float) -> Products:
    """Changes that bring products back within limits, by no more than ``most`` downwards.

    Far too large products are better left alone than fought with (Gondzio 1996).
    """

    def back(product: FloatArray) -> FloatArray:
        return np.maximum(np.clip(product, least, most) - product, -most)

    limit = step.limit(ahead.normal)
    head = limit * ahead.speed + (ahead.shear * ahead.slip).sum(axis=1)
    tail = limit[:, None] * ahead.slip + ahead.speed[:, None] * ahead.shear
    size = np.linalg.norm(tail, axis=1)
    larger, smaller = back(head + size), back(head - size)
    way = tail / np.maximum(size, 1e-300)[:, None]
    return Products(
        opening=back(ahead.normal * ahead.opening),
        crushing=back(step.room(ahead.normal) * ahead.crushing),
        sliding=0.5 * (larger + smaller),
        turning=(0.5 * (larger - smaller))[:, None] * way,
    )
