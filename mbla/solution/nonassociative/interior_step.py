"""One step of the joint law from anywhere: an interior-point method, where Newton's method on the law itself fails.

The step from anchor forces x̄ that ``joint_law`` states, with the joint law written as products of
what a joint has left and how it moves, all positive until the end, with l = β N + h the limit of shear::

    A x + f_D + λ f_L = 0,   f_L·u = 1,   v = Aᵀu
    y − z = v_N + ρ (N − N̄) − δ s,     (N + f_t) y = σ,   (f_c − N) z = σ
    w     = v_T + ρ (T − T̄),           l s + T·w = σ,     l w + s T = 0,      ‖T‖ < l, ‖w‖ < s

At σ = 0 this is the law: N = −f_t or no opening, ‖T‖ = l or no sliding, T against w, s = ‖w‖. Each iteration is a
Newton step on all of it, with the predictor and corrector of Mehrotra (1992, doi:10.1137/0802028) and the further
correctors of Gondzio (1996, doi:10.1007/BF00249643) where it would be short; what belongs to a joint is eliminated
joint by joint, dx = −C dv + g, and one factorisation of A C Aᵀ remains.

Two laws are solved, see ``InteriorLaw``: the exact one, β = μ, h = c, which is not monotone where δ < μ (the method
converges well in practice, and says so where it does not), and the lagged one, β = δ, h = (μ − δ) N̄ + c, a convex
program that has one solution always: max λ − ρ/2 ‖x − x̄‖² within those limits.
"""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.interior_joints import (
    InteriorLaw,
    Iterate,
    Joints,
    Missing,
    Products,
    StepProblem,
    moved,
    outlying,
    wanted,
    way_to_go,
)
from mbla.solution.nonassociative.interior_start import fresh_start, start_near
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
    fixed_load: bool = False,
    deadline: float | None = None,
) -> InteriorResult:
    """Solve one step from forces ``anchor``, (n_points, components); ``log`` gets every iteration.

    velocities : to start near, (n_rows,), those of the step before; the live load's own if None
    start_share : of the usual products that a start near those velocities has
    fixed_load : the load factor stays ``load_factor``, and f_L·u is free
    """
    crushable = np.flatnonzero(np.isfinite(stiffness.program.limits.compression))
    step = StepProblem(stiffness, law, anchor, rho, fixed_load, crushable)
    now = (
        fresh_start(step, load_factor) if velocities is None else start_near(step, load_factor, velocities, start_share)
    )
    lengths, started = [1.0], time.perf_counter()
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


def _residuals(step: StepProblem, now: Iterate) -> Missing:
    program = step.program
    forces = np.column_stack([now.normal - program.limits.tension, now.shear])
    v = step.stiffness.velocities(now.u)
    balance = program.equilibrium_matrix @ forces.ravel() + program.dead_load + now.factor * program.live_load
    elastic = step.rho * (forces - step.anchor)
    limit = step.limit(now.normal)
    normal = v[:, 0] + elastic[:, 0] - step.law.dilatancy * now.speed - now.opening
    normal[step.crushable] += now.crushing
    return Missing(
        balance=np.append(balance, 0.0 if step.fixed_load else program.live_load @ now.u - 1.0),
        normal=normal,
        shear=v[:, 1:] + elastic[:, 1:] - now.slip,
        normal_product=now.normal * now.opening,
        crushing_product=step.room(now.normal) * now.crushing,
        shear_product=limit * now.speed + (now.shear * now.slip).sum(axis=1),
        shear_direction=limit[:, None] * now.slip + now.speed[:, None] * now.shear,
        speed=float(np.abs(v).max(initial=0.0)) + step.rho * float(np.abs(forces).max(initial=0.0)),
    )


def _errors(step: StepProblem, now: Iterate, missing: Missing) -> tuple[float, float, float]:
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
    step: StepProblem, now: Iterate, missing: Missing, last: float, gap: float
) -> tuple[Iterate, float] | None:
    """Predictor, corrector, step; the new iterate and the length of the step, None where there is none.

    That is where the system is singular, and where no way is left: with a load that nothing carries the velocities grow
    without bound until rounding of their products puts joints outside their cones. The way back inside is negative, and
    steps along it end anywhere.
    """
    joints = Joints.of(step, now)
    if not np.isfinite(joints.tangents).all():
        return None
    shift = REGULARIZATION * float(np.abs(joints.tangents[:, 0, 0]).mean()) * step.stiffness.size
    solve = step.stiffness.factorized(joints.tangents, shift, fixed_load=step.fixed_load)
    if solve is None:
        return None
    n_products = 2 * len(now.normal) + len(step.crushable)
    product = (missing.normal_product.sum() + missing.shear_product.sum() + missing.crushing_product.sum()) / n_products

    predictor = joints.direction(solve, now, missing, wanted(step, missing, 0.0))
    reach = way_to_go(step, now, predictor)
    ahead = _residuals(step, moved(now, predictor, reach))
    left = (ahead.normal_product.sum() + ahead.shear_product.sum() + ahead.crushing_product.sum()) / n_products
    target = product * float(np.clip((left / product) ** 3, 1e-6, 1.0))
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
    return moved(now, direction, length), length


def _centred(
    step: StepProblem, now: Iterate, products: Products, target: float, solve: Callable[[Products], Iterate]
) -> tuple[Iterate, float]:
    """The direction towards products and the way to go, after correctors that pull outlying products to the middle.

    A corrector looks at the products a little beyond where the step would end, and is kept where the step gets longer.
    """
    direction = solve(products)
    length = way_to_go(step, now, direction)
    for _ in range(CORRECTORS):
        if length > LONG:
            break
        ahead = moved(now, direction, min(1.0, length + BEYOND))
        products = products.plus(outlying(step, ahead, target / OUTLYING, target * OUTLYING))
        trial = solve(products)
        longer = way_to_go(step, now, trial)
        if not longer >= length + GAIN:
            break
        direction, length = trial, longer
    return direction, length


def _record(
    step: StepProblem,
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
