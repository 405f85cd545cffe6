"""Joints strictly inside their law: unknowns, equations, their elimination joint by joint, the way to the boundary.

``moving_anchor`` solves these equations. The law, with dilatancy δ, is written as products of what a joint has left and
how it moves, all positive, with l = μ N + c the limit of shear and anchor forces x̄::

    A x + f_D + λ f_L = 0,   f_L·u = 1,   v = Aᵀu
    y − z = v_N + ρ (N − N̄) − δ s,     (N + f_t) y = σ,   (f_c − N) z = σ
    w     = v_T + ρ (T − T̄),           l s + T·w = σ,     l w + s T = 0,      ‖T‖ < l, ‖w‖ < s

At σ = 0 this is the law: N = −f_t or no opening, ‖T‖ = l or no sliding, T against w, s = ‖w‖. A Newton step on all of
it eliminates what belongs to a joint, dx = −C dv + g, so that one factorisation of A C Aᵀ remains.

The products of a joint are N y, (f_c − N) z and the pair p = l s + T·w, q = l w + s T, which is the product of (l, T)
and (s, w) in the algebra of the second-order cone (Alizadeh and Goldfarb 2003, doi:10.1007/s10107-002-0339-5); its
eigenvalues are p ± ‖q‖. In the middle N y = (f_c − N) z = σ, p = σ, q = 0: both eigenvalues are σ too. That l depends
on N while sliding does not act on v_N is what makes the law non-associative and the system unsymmetric.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.solution.cone_solvers.cone_vectors import cones_to_boundary, lines_to_boundary
from mbla.solution.linear_algebra.block_products import inverses
from mbla.solution.linear_algebra.stiffness import Stiffness

LEAST_LIMIT = 1e-10
"""Least shear limit of a joint that can have none, in mean block loads: a cone that is a point has no inside."""


@dataclass(frozen=True)
class Iterate:
    """Unknowns, or a change of them.

    u, factor : velocities, (n_rows,), and load factor
    normal    : (n_points,) N + f_t
    opening   : (n_points,) y
    shear     : (n_points, components − 1) T
    slip      : (n_points, components − 1) w
    speed     : (n_points,) s
    crushing  : (n_crushable,) z
    """

    u: FloatArray
    factor: float
    normal: FloatArray
    opening: FloatArray
    shear: FloatArray
    slip: FloatArray
    speed: FloatArray
    crushing: FloatArray

    def plus(self, change: Iterate, length: float = 1.0) -> Iterate:
        """The iterate a length along a direction."""
        return Iterate(*(a + length * b for a, b in zip(vars(self).values(), vars(change).values(), strict=True)))


@dataclass(frozen=True)
class JointEquations:
    """The equations of one program.

    dilatancy : (n_points,) tangent of its angle
    anchor    : (n_points, components) x̄
    crushable : numbers of the points of finite compressive strength
    """

    stiffness: Stiffness
    dilatancy: FloatArray
    anchor: FloatArray
    rho: float
    crushable: IntArray

    @staticmethod
    def of(stiffness: Stiffness, dilatancy: FloatArray, anchor: FloatArray, rho: float) -> JointEquations:
        """Of a program; the forces x̄ of the anchor are (n_points, components)."""
        crushable = np.flatnonzero(np.isfinite(stiffness.program.limits.compression))
        return JointEquations(stiffness, dilatancy, anchor, rho, crushable)

    @property
    def program(self) -> Program:
        """The program that is solved."""
        return self.stiffness.program

    def limit(self, normal: FloatArray) -> FloatArray:
        """Shear limit l at normal forces over −f_t, N + f_t; both are (n_points,)."""
        limits = self.program.limits
        full = limits.friction * (normal - limits.tension) + limits.cohesion
        return np.where(limits.friction > 0.0, full, np.maximum(full, LEAST_LIMIT))

    def forces(self, now: Iterate) -> FloatArray:
        """Contact forces, (n_points, components)."""
        return np.column_stack([now.normal - self.program.limits.tension, now.shear])

    def room(self, normal: FloatArray) -> FloatArray:
        """What is left to the compressive strength at the points that can crush, (n_crushable,).

        normal : (n_points,) N + f_t
        """
        limits = self.program.limits
        return np.asarray((limits.compression + limits.tension - normal)[self.crushable])


@dataclass(frozen=True)
class Missing:
    """What the linear equations and the products miss.

    balance           : (n_rows + 1,) unbalanced forces and f_L·u − 1
    normal, shear     : (n_points,), (n_points, components − 1) incompatible velocities
    normal_product    : (n_points,) (N + f_t) y            crushing_product : (n_crushable,) (f_c − N) z
    shear_product     : (n_points,) p                      shear_direction  : (n_points, components − 1) q
    speed             : what incompatible velocities are relative to
    """

    balance: FloatArray
    normal: FloatArray
    shear: FloatArray
    normal_product: FloatArray
    crushing_product: FloatArray
    shear_product: FloatArray
    shear_direction: FloatArray
    speed: float

    @property
    def total(self) -> float:
        """Sum of the products."""
        return float(self.normal_product.sum() + self.shear_product.sum() + self.crushing_product.sum())


def residuals(step: JointEquations, now: Iterate) -> Missing:
    """What an iterate leaves of the equations, all products counted as missing."""
    program, forces = step.program, step.forces(now)
    v = program.from_touch(step.stiffness.velocities(now.u))
    balance = program.equilibrium_matrix @ forces.ravel() + program.dead_load + now.factor * program.live_load
    elastic = step.rho * (forces - step.anchor)
    limit = step.limit(now.normal)
    normal = v[:, 0] + elastic[:, 0] - step.dilatancy * now.speed - now.opening
    normal[step.crushable] += now.crushing
    return Missing(
        balance=np.append(balance, program.live_load @ now.u - 1.0),
        normal=normal,
        shear=v[:, 1:] + elastic[:, 1:] - now.slip,
        normal_product=now.normal * now.opening,
        crushing_product=step.room(now.normal) * now.crushing,
        shear_product=limit * now.speed + (now.shear * now.slip).sum(axis=1),
        shear_direction=limit[:, None] * now.slip + now.speed[:, None] * now.shear,
        speed=float(np.abs(v).max(initial=0.0)) + step.rho * float(np.abs(forces).max(initial=0.0)),
    )


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


def step_to_boundary(step: JointEquations, now: Iterate, direction: Iterate) -> float:
    """How much of a direction leaves every joint within its bounds; infinite where none binds."""
    lines = (
        (now.normal, direction.normal),
        (now.opening, direction.opening),
        (step.room(now.normal), -direction.normal[step.crushable]),
        (now.crushing, direction.crushing),
    )
    cones = (
        (step.limit(now.normal), now.shear, step.program.limits.friction * direction.normal, direction.shear),
        (now.speed, now.slip, direction.speed, direction.slip),
    )
    reach = [float(lines_to_boundary(value, change).min(initial=np.inf)) for value, change in lines]
    for radius, vector, growth, turn in cones:
        length = np.linalg.norm(vector, axis=1)
        within = (radius - length) * (radius + length)
        mixed = radius * growth - (vector * turn).sum(axis=1)
        reach.append(float(cones_to_boundary(within, mixed, growth**2 - (turn**2).sum(axis=1)).min(initial=np.inf)))
    return min(reach)


@dataclass(frozen=True)
class Joints:
    """Every joint linearised: inverse @ (…) gives its forces, dx = −tangents dv + g."""

    step: JointEquations
    limit: FloatArray
    cone: FloatArray
    inverse: FloatArray
    tangents: FloatArray

    @staticmethod
    def of(step: JointEquations, now: Iterate) -> Joints:
        """Eliminate openings and sliding velocities: H dx = −G dv + q, C = H⁻¹ G."""
        rho, c = step.rho, step.program.components
        limit = step.limit(now.normal)
        over = 1.0 / limit
        cone = limit[:, None, None] * np.eye(c - 1) - (over[:, None] * now.shear)[:, :, None] * now.shear[:, None, :]
        h = np.zeros((len(limit), c, c))
        g = np.zeros_like(h)
        h[:, 0, 0] = rho + now.opening / now.normal + step.dilatancy * step.program.limits.friction * now.speed * over
        h[step.crushable, 0, 0] += now.crushing / step.room(now.normal)
        h[:, 0, 1:] = (step.dilatancy * over)[:, None] * (rho * now.shear + now.slip)
        h[:, 1:, 0] = step.program.limits.friction[:, None] * (now.slip - (now.speed * over)[:, None] * now.shear)
        h[:, 1:, 1:] = rho * cone + now.speed[:, None, None] * np.eye(c - 1)
        h[:, 1:, 1:] -= (over[:, None] * now.shear)[:, :, None] * now.slip[:, None, :]
        g[:, 0, 0] = 1.0
        g[:, 0, 1:] = (step.dilatancy * over)[:, None] * now.shear
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
        """Direction that changes the products as told and makes up for what else is missing.

        solve : from a right-hand side, (n_rows + 1,), to velocities and load factor, (n_rows + 1,)
        """
        step, program = self.step, self.step.program
        opening, crushing, sliding, turning = products.opening, products.crushing, products.sliding, products.turning
        over = 1.0 / self.limit
        normal = opening / now.normal - missing.normal
        normal[step.crushable] -= crushing / step.room(now.normal)
        normal += step.dilatancy * over * (sliding - (now.shear * missing.shear).sum(axis=1))
        shear = turning - (over * sliding)[:, None] * now.shear - np.einsum("pij,pj->pi", self.cone, missing.shear)
        free = np.einsum("pij,pj->pi", self.inverse, np.column_stack([normal, shear]))
        rhs = -missing.balance
        rhs[:-1] -= program.equilibrium_matrix @ free.ravel()
        answer = solve(rhs)
        dv = step.stiffness.velocities(answer[:-1])
        dx = free - np.einsum("pij,pj->pi", self.tangents, dv)
        slip = dv[:, 1:] + step.rho * dx[:, 1:] + missing.shear
        speed = sliding - now.speed * step.program.limits.friction * dx[:, 0]
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
    step: JointEquations,
    missing: Missing,
    target: FloatArray,
    predictor: Iterate | None = None,
    second: float = 0.0,
) -> Products:
    """Changes to products ``target``, (n_points,), less the second-order terms of a predictor times ``second``."""
    plain = Products(
        opening=target - missing.normal_product,
        crushing=target[step.crushable] - missing.crushing_product,
        sliding=target - missing.shear_product,
        turning=-missing.shear_direction,
    )
    if predictor is None or second == 0.0:
        return plain
    growth = step.program.limits.friction * predictor.normal
    return plain.plus(
        Products(
            opening=-second * predictor.normal * predictor.opening,
            crushing=second * predictor.normal[step.crushable] * predictor.crushing,
            sliding=-second * (growth * predictor.speed + (predictor.shear * predictor.slip).sum(axis=1)),
            turning=-second * (growth[:, None] * predictor.slip + predictor.speed[:, None] * predictor.shear),
        )
    )


def outlying(step: JointEquations, ahead: Iterate, least: FloatArray, most: FloatArray) -> Products:
    """Changes that bring products back within limits, (n_points,), by no more than ``most`` downwards.

    Far too large products are better left alone than fought with (Gondzio 1996).
    """

    def back(product: FloatArray, at: IntArray | slice = slice(None)) -> FloatArray:
        return np.maximum(np.clip(product, least[at], most[at]) - product, -most[at])

    limit = step.limit(ahead.normal)
    head = limit * ahead.speed + (ahead.shear * ahead.slip).sum(axis=1)
    tail = limit[:, None] * ahead.slip + ahead.speed[:, None] * ahead.shear
    size = np.linalg.norm(tail, axis=1)
    larger, smaller = back(head + size), back(head - size)
    way = tail / np.maximum(size, 1e-300)[:, None]
    return Products(
        opening=back(ahead.normal * ahead.opening),
        crushing=back(step.room(ahead.normal) * ahead.crushing, step.crushable),
        sliding=0.5 * (larger + smaller),
        turning=(0.5 * (larger - smaller))[:, None] * way,
    )
