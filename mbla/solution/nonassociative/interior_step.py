"""One step of the joint law from anywhere: an interior-point method, where Newton's method on the law itself fails.

The step from anchor forces x̄ that ``joint_law`` states is solved on the equations of ``joint_equations``. Each
iteration is a Newton step on all of them, with the predictor and corrector of Mehrotra (1992, doi:10.1137/0802028) and
the further correctors of Gondzio (1996, doi:10.1007/BF00249643) where it would be short.

Two laws are solved, see ``InteriorLaw``: the exact one, β = μ, h = c, which is not monotone where δ < μ (the method
converges well in practice, and says so where it does not), and the lagged one, β = δ, h = (μ − δ) N̄ + c, a convex
program that has one solution always: max λ − ρ/2 ‖x − x̄‖² within those limits.

It starts afresh, or near the motion v of the step before: every joint is put on the central path of its law for that
motion. With trial forces a = x̄ − v/ρ and products σ (without the dilatancy, which Newton's method adds)::

    N − y/ρ = a_N,   N y = σ              N = (a_N + √(a_N² + 4σ/ρ)) / 2
    T − w/ρ = a_T,   l s + T·w = σ,  l w + s T = 0
        T = l ω/s θ,   w = −ω θ,   s = e + √(e² + ω²),   e = σ/2l,   θ = a_T/‖a_T‖,   l ω/s + ω/ρ = ‖a_T‖

This is the return map of ``joint_law``, rounded off: joints fit their law and the motion, and only the
balance of forces is missing. The last equation grows with ω and is solved by bisection.

Measured against starts with the velocities of the step before but pressed joints without shear: 291 factorisations in
all steps in place of 417 on a planar wall of 1,012 blocks, 92 in place of 94 on a spatial one of 410. With products ten
times smaller, used for every step, the planar wall took many more and shorter steps; see ``START_SHARE`` in
:mod:`mbla.solution.nonassociative.law_steps` for where they pay.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.joint_equations import (
    InteriorLaw,
    Iterate,
    JointEquations,
    Joints,
    Missing,
    Products,
    outlying,
    residuals,
    step_to_boundary,
    wanted,
)
from mbla.solution.solution import IterationRecord

TOLERANCE = 1e-9
"""Unbalanced force in mean block loads, incompatibility over the largest speed, and products over the power."""

MOST_ITERATIONS = 80
SHARE = 0.95
"""Share of the way to the boundary that a step goes, more near the end."""

SHORT = 0.3
"""After a step shorter than this the next one only recentres: the products have drifted apart."""

STALLED = (10, 0.5)
"""Given up where as many steps together went less than this: the law has no solution in reach from here."""

CORRECTORS, LONG, BEYOND, GAIN, OUTLYING = 2, 0.9, 0.3, 0.03, 10.0
"""Further correctors at most, only of steps shorter than this; how far beyond its end they look; by how much the step
must get longer; factor from the target that counts as outlying. On walls of 1,012 planar and 410 spatial blocks they
saved 22 and 32 % of the factorisations; four of them hardly more, a single one led to more steps."""

REGULARIZATION = 1e-14


@dataclass(frozen=True)
class InteriorResult:
    """What the method reached; ``converged`` where it is the solution to ``TOLERANCE``."""

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    converged: bool
    iterations: int


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
    start_share: float = 1.0,
    deadline: float | None = None,
) -> InteriorResult:
    """Solve one step from forces ``anchor``, (n_points, components); ``log`` gets every iteration.

    velocities : to start near, (n_rows,), those of the step before; the live load's own if None
    start_share : of the usual products that a start near those velocities has
    """
    step = JointEquations.of(stiffness, law, anchor, rho)
    now = (
        fresh_start(step, load_factor) if velocities is None else start_near(step, load_factor, velocities, start_share)
    )
    lengths, started = [1.0], time.perf_counter()
    converged, count = False, 0
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a run that diverges is seen and given up
        for count in range(MOST_ITERATIONS):
            missing = residuals(step, now)
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
    return InteriorResult(now.u, now.factor, step.forces(now), converged, count)


def _errors(step: JointEquations, now: Iterate, missing: Missing) -> tuple[float, float, float]:
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


def _iterate(
    step: JointEquations, now: Iterate, missing: Missing, last: float, gap: float
) -> tuple[Iterate, float] | None:
    """Predictor, corrector, step; the new iterate and the length of the step, None where there is none.

    That is where the system is singular, where nothing of the products is left, and where no way is left: with a load
    that nothing carries the velocities grow without bound until rounding of their products puts joints outside their
    cones. The way back inside is negative, and steps along it end anywhere.
    """
    joints, product = Joints.of(step, now), missing.total / (2 * len(now.normal) + len(step.crushable))
    if not (np.isfinite(joints.tangents).all() and product > 0.0):
        return None
    shift = REGULARIZATION * float(np.abs(joints.tangents[:, 0, 0]).mean()) * step.stiffness.size
    solve = step.stiffness.factorized(joints.tangents, shift)
    if solve is None:
        return None

    predictor = joints.direction(solve, now, missing, wanted(step, missing, 0.0))
    reach = min(1.0, step_to_boundary(step, now, predictor))
    ahead = residuals(step, now.plus(predictor, reach))
    target = product * float(np.clip((ahead.total / missing.total) ** 3, 1e-6, 1.0))
    products = wanted(step, missing, target, predictor, reach)
    if last < SHORT:
        target = product
        products = wanted(step, missing, target)
    direction, length = _centred(
        step, now, products, target, lambda sought: joints.direction(solve, now, missing, sought)
    )
    if not length > 0.0:
        return None
    if length < 1.0:
        length *= max(SHARE, 1.0 - gap)
    return now.plus(direction, length), length


def _centred(
    step: JointEquations, now: Iterate, products: Products, target: float, solve: Callable[[Products], Iterate]
) -> tuple[Iterate, float]:
    """The direction towards products and the way to go, after correctors that pull outlying products to the middle.

    A corrector looks at the products a little beyond where the step would end, and is kept where the step gets longer.
    """
    direction = solve(products)
    length = min(1.0, step_to_boundary(step, now, direction))
    for _ in range(CORRECTORS):
        if length > LONG:
            break
        ahead = now.plus(direction, min(1.0, length + BEYOND))
        products = products.plus(outlying(step, ahead, target / OUTLYING, target * OUTLYING))
        trial = solve(products)
        longer = min(1.0, step_to_boundary(step, now, trial))
        if not longer >= length + GAIN:
            break
        direction, length = trial, longer
    return direction, length


def _record(
    step: JointEquations,
    now: Iterate,
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


BISECTIONS = 50
"""Down to rounding."""


def fresh_start(step: JointEquations, load_factor: float) -> Iterate:
    """All joints on the central path, pressed by the mean size of the anchor's forces, without shear."""
    program, limits, live = step.program, step.program.limits, step.program.live_load
    size = _size(step)
    u = live / (live @ live)
    normal = np.minimum(np.full(program.n_points, size) + limits.tension, _half_of_the_room(step))
    product = _product(step, step.stiffness.velocities(u))
    nothing = np.zeros((program.n_points, program.components - 1))
    return Iterate(
        u=u,
        factor=load_factor,
        normal=normal,
        opening=product / normal,
        shear=nothing,
        slip=nothing,
        speed=product / step.limit(normal),
        crushing=product / step.room(normal),
    )


def start_near(step: JointEquations, load_factor: float, velocities: FloatArray, share: float = 1.0) -> Iterate:
    """All joints on the central path of their law for velocities of the blocks, (n_rows,).

    share : of the usual products; the less, the nearer
    """
    v = step.stiffness.velocities(velocities)
    product, trial = share * _product(step, v), step.anchor - v / step.rho
    pressed = trial[:, 0] + step.program.limits.tension
    root = np.sqrt(pressed**2 + 4.0 * product / step.rho)
    normal = np.where(pressed > 0.0, 0.5 * (pressed + root), 2.0 * product / step.rho / (root + np.abs(pressed)))
    normal = np.minimum(normal, _half_of_the_room(step))
    limit = step.limit(normal)
    sheared = np.linalg.norm(trial[:, 1:], axis=1)
    theta = trial[:, 1:] / np.maximum(sheared, 1e-300)[:, None]
    half = 0.5 * product / limit
    sliding = _sliding(limit, half, sheared, step.rho)
    speed = half + np.hypot(half, sliding)
    return Iterate(
        u=velocities,
        factor=load_factor,
        normal=normal,
        opening=product / normal,
        shear=(limit * sliding / speed)[:, None] * theta,
        slip=-sliding[:, None] * theta,
        speed=speed,
        crushing=product / step.room(normal),
    )


def _sliding(limit: FloatArray, half: FloatArray, sheared: FloatArray, rho: float) -> FloatArray:
    """ω with l ω/s + ω/ρ = ‖a_T‖."""
    low, high = np.zeros_like(limit), rho * sheared
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = limit * middle / (half + np.hypot(half, middle)) + middle / rho > sheared
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return low


def _size(step: JointEquations) -> float:
    """Root mean square of the anchor's forces."""
    return float(np.sqrt((step.anchor**2).mean())) or 1.0


def _product(step: JointEquations, velocities: FloatArray) -> float:
    """Σ of a start: the mean force times the mean speed of joints that move and give by as much."""
    size = _size(step)
    return size * (float(np.abs(velocities).mean()) + step.rho * size)


def _half_of_the_room(step: JointEquations) -> FloatArray:
    limits = step.program.limits
    return 0.5 * (limits.compression + limits.tension)
