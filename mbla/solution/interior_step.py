"""One step of the joint law from anywhere: an interior-point method, where Newton's method on the law itself fails.

The step from anchor forces x̄ that :mod:`mbla.solution.exact_law` states, with the joint law written as products of
what a joint has left and how it moves, all positive until the end, with l = β N + h the limit of shear::

    A x + f_D + λ f_L = 0,   f_L·u = 1,   v = Aᵀu
    y − z = v_N + ρ (N − N̄) − δ s,     (N + f_t) y = σ,   (f_c − N) z = σ
    w     = v_T + ρ (T − T̄),           l s + T·w = σ,     l w + s T = 0,      ‖T‖ < l, ‖w‖ < s

At σ = 0 this is the law: N = −f_t or no opening, ‖T‖ = l or no sliding, T against w, s = ‖w‖. Each iteration is a
Newton step on all of it, with the predictor and corrector of Mehrotra (1992, doi:10.1137/0802028); what belongs to a
joint is eliminated joint by joint, dx = −C dv + g, and one factorisation of A C Aᵀ remains.

Two laws are solved, see ``InteriorLaw``: the exact one, β = μ, h = c, which is not monotone where δ < μ (the method
converges well in practice, and says so where it does not), and the lagged one, β = δ, h = (μ − δ) N̄ + c, a convex
program that has one solution always: max λ − ρ/2 ‖x − x̄‖² within those limits.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.program.program import Program
from mbla.solution.clarabel_adapter import Log
from mbla.solution.solution import IterationRecord
from mbla.solution.stiffness import Stiffness

TOLERANCE = 1e-9
"""Unbalanced force in mean block loads, incompatibility over the largest speed, and products over the power."""

MOST_ITERATIONS = 80
SHARE = 0.95
"""Share of the way to the boundary that a step goes, more near the end."""

SHORT = 0.3
"""After a step shorter than this the next one only recentres: the products have drifted apart."""

STALLED = (10, 0.5)
"""Given up where as many steps together went less than this: the law has no solution in reach from here."""

LEAST_LIMIT = 1e-10
"""Least shear limit of a joint that can have none, in mean block loads: a cone that is a point has no inside."""

REGULARIZATION = 1e-14


@dataclass(frozen=True)
class InteriorLaw:
    """Joint law of a step, (n_points,) each: shear limit l = slope N + offset, tangent of the dilatancy angle."""

    slope: FloatArray
    offset: FloatArray
    dilatancy: FloatArray


@dataclass(frozen=True)
class InteriorResult:
    """What the method reached; ``converged`` where it is the solution to ``TOLERANCE``."""

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    converged: bool
    iterations: int


def exact_law(program: Program, dilatancy: FloatArray) -> InteriorLaw:
    """The joint law with a dilatancy."""
    return InteriorLaw(program.limits.friction, program.limits.cohesion, dilatancy)


def lagged_law(program: Program, dilatancy: FloatArray, anchor: FloatArray) -> InteriorLaw:
    """Friction beyond the dilatancy taken from the anchor's normal forces: a convex program."""
    limits = program.limits
    offset = np.maximum((limits.friction - dilatancy) * anchor[:, 0] + limits.cohesion, 0.0)
    return InteriorLaw(dilatancy, offset, dilatancy)


@dataclass(frozen=True)
class _Iterate:
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
class _Step:
    """The problem: stiffness pattern, law, anchor, step size, points that can crush."""

    stiffness: Stiffness
    law: InteriorLaw
    anchor: FloatArray
    rho: float
    fixed_load: bool
    crushable: IntArray

    @property
    def program(self) -> Program:
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
class _Residuals:
    """What the linear equations and the products miss."""

    balance: FloatArray
    normal: FloatArray
    shear: FloatArray
    normal_product: FloatArray
    crushing_product: FloatArray
    shear_product: FloatArray
    shear_direction: FloatArray
    speed: float


def interior_step(
    stiffness: Stiffness,
    law: InteriorLaw,
    anchor: FloatArray,
    rho: float,
    load_factor: float,
    log: Log,
    number: int,
    *,
    velocities: FloatArray | None = None,
    fixed_load: bool = False,
    deadline: float | None = None,
) -> InteriorResult:
    """Solve one step from forces ``anchor``, (n_points, components); ``log`` gets every iteration.

    velocities : to start from, (n_rows,), those of the step before; the live load's own if None
    fixed_load : the load factor stays ``load_factor``, and f_L·u is free
    """
    crushable = np.flatnonzero(np.isfinite(stiffness.program.limits.compression))
    step = _Step(stiffness, law, anchor, rho, fixed_load, crushable)
    now, lengths, started = _start(step, load_factor, velocities), [1.0], time.perf_counter()
    converged, count = False, 0
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a run that diverges is seen and given up
        for count in range(MOST_ITERATIONS):
            missing = _residuals(step, now)
            errors = _errors(step, now, missing)
            log(_record(step, now, number, count, errors, lengths[-1], started))
            converged = max(errors) <= TOLERANCE
            late = deadline is not None and time.monotonic() > deadline
            if converged or late or not np.isfinite(errors).all() or sum(lengths[-STALLED[0] :]) < STALLED[1]:
                break
            moved = _iterate(step, now, missing, lengths[-1], errors[0])
            if moved is None:
                break
            now, length = moved
            lengths = [*([1.0] * STALLED[0] if count == 0 else lengths), length]
    forces = np.column_stack([now.normal - stiffness.program.limits.tension, now.shear])
    return InteriorResult(now.u, now.factor, forces, converged, count)


def _start(step: _Step, load_factor: float, velocities: FloatArray | None) -> _Iterate:
    """All joints on the central path, pressed at least by the mean size of the anchor's forces, without shear."""
    program, limits, live = step.program, step.program.limits, step.program.live_load
    size = float(np.sqrt((step.anchor**2).mean())) or 1.0
    u, normal = velocities, np.maximum(step.anchor[:, 0], size) + limits.tension
    if u is None:
        u = np.zeros_like(live) if step.fixed_load else live / (live @ live)
        normal = np.full(program.n_points, size) + limits.tension
    half = 0.5 * (limits.compression + limits.tension)
    normal = np.minimum(normal, half)
    product = size * (float(np.abs(step.stiffness.velocities(u)).mean()) + step.rho * size)
    nothing = np.zeros((program.n_points, program.components - 1))
    return _Iterate(
        u=u,
        factor=load_factor,
        normal=normal,
        opening=product / normal,
        shear=nothing,
        slip=nothing,
        speed=product / step.limit(normal),
        crushing=product / step.room(normal),
    )


def _residuals(step: _Step, now: _Iterate) -> _Residuals:
    program = step.program
    forces = np.column_stack([now.normal - program.limits.tension, now.shear])
    v = step.stiffness.velocities(now.u)
    balance = program.equilibrium_matrix @ forces.ravel() + program.dead_load + now.factor * program.live_load
    elastic = step.rho * (forces - step.anchor)
    limit = step.limit(now.normal)
    normal = v[:, 0] + elastic[:, 0] - step.law.dilatancy * now.speed - now.opening
    normal[step.crushable] += now.crushing
    return _Residuals(
        balance=np.append(balance, 0.0 if step.fixed_load else program.live_load @ now.u - 1.0),
        normal=normal,
        shear=v[:, 1:] + elastic[:, 1:] - now.slip,
        normal_product=now.normal * now.opening,
        crushing_product=step.room(now.normal) * now.crushing,
        shear_product=limit * now.speed + (now.shear * now.slip).sum(axis=1),
        shear_direction=limit[:, None] * now.slip + now.speed[:, None] * now.shear,
        speed=float(np.abs(v).max(initial=0.0)) + step.rho * float(np.abs(forces).max(initial=0.0)),
    )


def _errors(step: _Step, now: _Iterate, missing: _Residuals) -> tuple[float, float, float]:
    """Gap relative to the power, unbalanced force, incompatibility relative to the speed."""
    gap = float(missing.normal_product.sum() + missing.crushing_product.sum() + np.abs(missing.shear_product).sum())
    program = step.program
    power = max(
        abs(now.factor * float(program.live_load @ now.u)),
        abs(float(program.dead_load @ now.u)),
        step.rho * float((now.normal**2).sum() + (now.shear**2).sum()),
        1e-300,
    )
    incompatible = max(np.abs(missing.normal).max(initial=0.0), np.abs(missing.shear).max(initial=0.0))
    return gap / power, float(np.abs(missing.balance).max()), float(incompatible) / missing.speed


def _iterate(step: _Step, now: _Iterate, missing: _Residuals, last: float, gap: float) -> tuple[_Iterate, float] | None:
    """Predictor, corrector, step; the new iterate and the length of the step, None where the system is singular."""
    joints = _Joints.of(step, now)
    shift = REGULARIZATION * float(np.abs(joints.tangents[:, 0, 0]).mean()) * step.stiffness.size
    solve = step.stiffness.factorized(joints.tangents, shift, fixed_load=step.fixed_load)
    if solve is None:
        return None
    n_products = 2 * len(now.normal) + len(step.crushable)
    product = (missing.normal_product.sum() + missing.shear_product.sum() + missing.crushing_product.sum()) / n_products

    predictor = joints.direction(solve, now, missing, 0.0, None, 0.0)
    reach = _reach(step, now, predictor)
    ahead = _residuals(step, _moved(now, predictor, reach))
    left = (ahead.normal_product.sum() + ahead.shear_product.sum() + ahead.crushing_product.sum()) / n_products
    target = product * float(np.clip((left / product) ** 3, 1e-6, 1.0))
    second = reach
    if last < SHORT:
        target, second = product, 0.0
    step_taken = joints.direction(solve, now, missing, target, predictor, second)
    length = _reach(step, now, step_taken)
    if length < 1.0:
        length *= max(SHARE, 1.0 - gap)
    return _moved(now, step_taken, length), length


def _moved(now: _Iterate, direction: _Iterate, length: float) -> _Iterate:
    return _Iterate(
        u=now.u + length * direction.u,
        factor=now.factor + length * direction.factor,
        normal=now.normal + length * direction.normal,
        opening=now.opening + length * direction.opening,
        shear=now.shear + length * direction.shear,
        slip=now.slip + length * direction.slip,
        speed=now.speed + length * direction.speed,
        crushing=now.crushing + length * direction.crushing,
    )


def _reach(step: _Step, now: _Iterate, direction: _Iterate) -> float:
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
class _Joints:
    """Every joint linearised: inverse @ (…) gives its forces, dx = −tangents dv + g."""

    step: _Step
    limit: FloatArray
    cone: FloatArray
    inverse: FloatArray
    tangents: FloatArray

    @staticmethod
    def of(step: _Step, now: _Iterate) -> _Joints:
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
        inverse: FloatArray = np.asarray(np.linalg.inv(h), dtype=np.float64)
        return _Joints(step, limit, cone, inverse, np.matmul(inverse, g))

    def direction(
        self,
        solve: Callable[[FloatArray], FloatArray],
        now: _Iterate,
        missing: _Residuals,
        target: float,
        predictor: _Iterate | None,
        second: float,
    ) -> _Iterate:
        """Direction towards products ``target``, with the second-order terms of a predictor weighted by ``second``."""
        step, law, program = self.step, self.step.law, self.step.program
        products = _wanted(step, missing, target, predictor, second)
        opening, crushing, sliding, turning = products
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
        return _Iterate(
            u=answer[:-1],
            factor=float(answer[-1]),
            normal=dx[:, 0],
            opening=(opening - now.opening * dx[:, 0]) / now.normal,
            shear=dx[:, 1:],
            slip=slip,
            speed=speed,
            crushing=(crushing + now.crushing * dx[step.crushable, 0]) / step.room(now.normal),
        )


def _wanted(
    step: _Step, missing: _Residuals, target: float, predictor: _Iterate | None, second: float
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Changes wanted of the products: opening, crushing, sliding, direction of sliding."""
    opening = target - missing.normal_product
    crushing = target - missing.crushing_product
    sliding = target - missing.shear_product
    turning = -missing.shear_direction
    if predictor is not None and second > 0.0:
        growth = step.law.slope * predictor.normal
        opening = opening - second * predictor.normal * predictor.opening
        crushing = crushing + second * predictor.normal[step.crushable] * predictor.crushing
        sliding = sliding - second * (growth * predictor.speed + (predictor.shear * predictor.slip).sum(axis=1))
        turning = turning - second * (growth[:, None] * predictor.slip + predictor.speed[:, None] * predictor.shear)
    return opening, crushing, sliding, turning


def _record(
    step: _Step,
    now: _Iterate,
    number: int,
    count: int,
    errors: tuple[float, float, float],
    length: float,
    started: float,
) -> IterationRecord:
    gap, balance, incompatible = errors
    return IterationRecord(
        program=number,
        iteration=count,
        load_factor=step.program.scaling.load_factor(now.factor),
        gap=gap,
        primal_residual=balance,
        dual_residual=incompatible,
        step=length,
        seconds=time.perf_counter() - started,
    )
