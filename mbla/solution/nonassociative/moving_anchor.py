"""Flow by the joint law in one interior-point run, whose anchor moves at every iteration.

The equations are those of ``joint_equations``, for any dilatancy. The anchor x̄ of their elastic term ρ (x − x̄) is the
present forces, so that ρ enters the matrix alone: it keeps a step from walking far along forces that are not unique,
and vanishes with the products σ, ρ = κ σ K/‖x_g‖², with K points and the forces x_g under the dead load. No program is
solved on the way, and no friction is taken from a state before.

1. Start: joints on the central path of their law for the forces x_g and a motion along the live load, with products
   σ₀ = 200 S² r, S the root mean square of x_g, r the mean contact speed over S.
2. Centre: Newton's method at fixed σ until the forces balance and no product lies far below the others.
3. Iterate, one factorisation each: predictor, target p (p_ahead/p)³ with the mean product p, corrector. The target
   stays above ``BALANCE`` times p, times the incompatibility of the velocities over the gap: a gap that runs ahead of
   compatibility ends in states that violate the law. κ follows the lengths of the steps.

Walls of up to 30 courses, arches, bridges and most rooms end within the law after 30 to 110 factorisations, one to
three times the time of their associative program. Taller walls, vaults and domes creep at residuals of 1e-3 to 1e-6:
from there the programs of ``alternation`` go on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.joint_equations import (
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
from mbla.solution.nonassociative.law_state import LawState, law_state

FIRST_PRODUCT = 200.0
"""σ₀ over S² r."""

BALANCED, EVEN = 1e-3, 0.05
"""Unbalanced force in mean block loads, and least product over σ, with which a start is centred."""

CENTRING = 40
"""Factorisations of the centring at most; seven to ten are usual."""

RAISE, RAISES, BLOCKED = 3.0, 6, 0.1
"""Factor on σ after a step of the centring shorter than ``BLOCKED``, so many times at most."""

PULL, LEAST_PULL = 0.1, 0.01
"""κ at first and at least."""

STIFFER = ((0.01, 81.0), (0.05, 9.0), (0.2, 3.0), (0.7, 1.0), (0.95, 0.5), (np.inf, 0.25))
"""Factor on κ after a step shorter than the length before it."""

BALANCE = 10.0
"""Without this rule walls end with a gap of 4e-7 at a residual of 2e-4."""

MOST_REDUCTION = 1e-3
"""Least ratio of the next products to the present ones."""

SHARE = 0.95
"""Share of the way to the boundary that a step goes, more near the end."""

SHORT = 0.3
"""After a step shorter than this the next one only recentres: the products have drifted apart."""

CORRECTORS, LONG, BEYOND, GAIN, OUTLYING = 2, 0.9, 0.3, 0.03, 10.0
"""Further correctors (Gondzio 1996, doi:10.1007/BF00249643) at most, only of steps shorter than ``LONG``; how far
beyond its end they look; by how much the step must get longer; factor from the target that counts as outlying."""

SHIFT = 1e-14
"""Share of the stiffness of all joints that is added everywhere: blocks whose joints all open have none."""

SMALL_GAP = 1e-4
"""Products over the power from which a state that fits the law is the end of the run."""

NO_FORCE = 1e-15
"""Forces below this, in mean loads of a block, are none, but rounding: the unit of the program takes their place."""

Watch = Callable[[int, LawState, float, float], None]
"""Called at every iteration with factorisations, state, gap and length of the last step."""

Solve = Callable[[Products], Iterate]


@dataclass(frozen=True)
class MovingResult:
    """State that fits the law best, None where no iteration was made; factorisations that were spent."""

    best: LawState | None
    factorizations: int


def run_with_moving_anchor(
    stiffness: Stiffness, dilatancy: FloatArray, gravity: FloatArray, most: int, enough: float, watch: Watch
) -> MovingResult:
    """Run until a state violates the law by no more than ``enough``, steps end, or after ``most`` factorisations.

    dilatancy : (n_points,) tangents of its angles
    gravity   : (n_points, components)  forces under the dead load, non-dimensional, compression positive
    """
    run = _Run(stiffness, dilatancy, gravity)
    with np.errstate(over="ignore", invalid="ignore", divide="ignore"):  # a run that diverges is seen and given up
        best = run.iterated(run.centred(), most, enough, watch)
    return MovingResult(best, run.factorizations)


@dataclass
class _Run:
    stiffness: Stiffness
    dilatancy: FloatArray
    gravity: FloatArray
    factorizations: int = 0

    @property
    def program(self) -> Program:
        return self.stiffness.program

    @property
    def size(self) -> float:
        """Root mean square of the forces under the dead load, of the program's unit where there are none."""
        size = float(np.sqrt((self.gravity**2).mean()))
        return size if size > NO_FORCE else 1.0

    def linear(self, step: JointEquations, now: Iterate, missing: Missing) -> Solve | None:
        """The factorised equations at an iterate; None where they are singular."""
        joints = Joints.of(step, now)
        if not np.isfinite(joints.tangents).all():
            return None
        shift = SHIFT * float(np.abs(joints.tangents[:, 0, 0]).mean()) * self.stiffness.size
        solve = self.stiffness.factorized(joints.tangents, shift)
        self.factorizations += 1
        return None if solve is None else lambda products: joints.direction(solve, now, missing, products)

    def centred(self) -> Iterate:
        """The start, brought near to the central path."""
        live, every = self.program.live_load, np.ones(self.program.n_points)
        u = live / float(live @ live)
        ratio = float(np.abs(self.stiffness.velocities(u)).mean()) / self.size
        sigma, raised = FIRST_PRODUCT * self.size**2 * ratio, 0
        step = JointEquations.of(self.stiffness, self.dilatancy, self.gravity, ratio)
        now = start_near(step, 0.0, u, sigma * every)
        for _ in range(CENTRING):
            missing = residuals(step, now)
            solve = self.linear(step, now, missing)
            if solve is None:
                break
            target = sigma * every
            direction, length = centred(step, now, wanted(step, missing, target), target, solve)
            if not length > 0.0:
                break
            now = now.plus(direction, length if length >= 1.0 else SHARE * length)
            missing = residuals(step, now)
            if np.abs(missing.balance).max() < BALANCED and _least_product(missing) > EVEN * sigma:
                break
            if length < BLOCKED and raised < RAISES:
                sigma, raised = RAISE * sigma, raised + 1
        return now

    def iterated(self, now: Iterate, most: int, enough: float, watch: Watch) -> LawState | None:
        """The state that fits the law best on the way of the iterations."""
        program, kappa, length = self.program, PULL, 1.0
        best: LawState | None = None
        per_product = 1.0 / (2 * program.n_points + int(np.isfinite(program.limits.compression).sum()))
        while self.factorizations < most:
            step = JointEquations.of(self.stiffness, self.dilatancy, self.gravity, 0.0)
            step = replace(step, anchor=step.forces(now))
            missing = residuals(step, now)
            state = law_state(program, self.dilatancy, step.anchor, now.u, now.factor)
            power = max(abs(now.factor), abs(float(program.dead_load @ now.u)), np.finfo(float).tiny)
            product, gap = per_product * missing.total, missing.total / power
            if best is None or state.residual < best.residual:
                best = state
            watch(self.factorizations, state, gap, length)
            if (gap < SMALL_GAP and best.residual <= enough) or not product > 0.0:
                break
            rho = kappa * product / self.size**2
            moved = self._step(replace(step, rho=rho), now, missing, product, gap, length)
            if moved is None:
                break
            now, length = moved
            kappa = max(kappa * next(factor for limit, factor in STIFFER if length < limit), LEAST_PULL)
        return best

    def _step(
        self, step: JointEquations, now: Iterate, missing: Missing, product: float, gap: float, last: float
    ) -> tuple[Iterate, float] | None:
        """Predictor and corrector; the new iterate and the length of the step, None where there is none."""
        solve = self.linear(step, now, missing)
        if solve is None:
            return None
        target = np.full(self.program.n_points, product)
        products = wanted(step, missing, target)
        if last >= SHORT:
            predictor = solve(wanted(step, missing, 0.0 * target))
            reach = min(1.0, step_to_boundary(step, now, predictor))
            ahead = residuals(step, now.plus(predictor, reach)).total / missing.total
            least = BALANCE * self._incompatibility(step, now, missing) / gap
            target = target * min(1.0, max(float(np.clip(ahead**3, MOST_REDUCTION, 1.0)), least))
            products = wanted(step, missing, target, predictor, reach)
        direction, length = centred(step, now, products, target, solve)
        if not length > 0.0:
            return None
        return now.plus(direction, length if length >= 1.0 else max(SHARE, 1.0 - gap) * length), length

    def _incompatibility(self, step: JointEquations, now: Iterate, missing: Missing) -> float:
        """Largest incompatible velocity over the largest speed, and that which the anchor's forces stand for."""
        speed = float(np.abs(self.stiffness.velocities(now.u)).max(initial=0.0))
        speed += step.rho * float(np.abs(step.anchor).max(initial=0.0))
        off = max(np.abs(missing.normal).max(initial=0.0), np.abs(missing.shear).max(initial=0.0))
        return float(off) / max(speed, np.finfo(float).tiny)


def _least_product(missing: Missing) -> float:
    """Least eigenvalue of the products of all joints."""
    turned = np.linalg.norm(missing.shear_direction, axis=1)
    crushing = missing.crushing_product.min(initial=np.inf)
    return float(min(missing.normal_product.min(), (missing.shear_product - turned).min(), crushing))


def centred(
    step: JointEquations, now: Iterate, products: Products, target: FloatArray, solve: Solve
) -> tuple[Iterate, float]:
    """The direction towards products and the way to go, after correctors that pull outlying products to the middle.

    A corrector looks at the products a little beyond where the step would end, and is kept where the step gets longer.

    target : (n_points,) products aimed at
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


BISECTIONS = 50
"""Down to rounding."""


def start_near(step: JointEquations, load_factor: float, velocities: FloatArray, product: FloatArray) -> Iterate:
    """All joints on the central path of their law for velocities of the blocks, (n_rows,), and given products.

    With trial forces a = x̄ − v/ρ and products σ (without the dilatancy, which Newton's method adds)::

        N − y/ρ = a_N,   N y = σ              N = (a_N + √(a_N² + 4σ/ρ)) / 2
        T − w/ρ = a_T,   l s + T·w = σ,  l w + s T = 0
            T = l ω/s θ,   w = −ω θ,   s = e + √(e² + ω²),   e = σ/2l,   θ = a_T/‖a_T‖,   l ω/s + ω/ρ = ‖a_T‖

    This is the return map of ``joint_law``, rounded off: joints fit their law and the motion, and only the balance of
    forces is missing.

    product : (n_points,) σ
    """
    limits = step.program.limits
    trial = step.anchor - step.stiffness.velocities(velocities) / step.rho
    pressed = trial[:, 0] + limits.tension
    root = np.sqrt(pressed**2 + 4.0 * product / step.rho)
    normal = np.where(pressed > 0.0, 0.5 * (pressed + root), 2.0 * product / step.rho / (root + np.abs(pressed)))
    normal = np.minimum(normal, 0.5 * (limits.compression + limits.tension))
    limit = step.limit(normal)
    sheared = np.linalg.norm(trial[:, 1:], axis=1)
    theta = trial[:, 1:] / np.maximum(sheared, np.finfo(float).tiny)[:, None]
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
        crushing=product[step.crushable] / step.room(normal),
    )


def _sliding(limit: FloatArray, half: FloatArray, sheared: FloatArray, rho: float) -> FloatArray:
    """ω with l ω/s + ω/ρ = ‖a_T‖, which grows with ω."""
    low, high = np.zeros_like(limit), rho * sheared
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        beyond = limit * middle / (half + np.hypot(half, middle)) + middle / rho > sheared
        low, high = np.where(beyond, low, middle), np.where(beyond, middle, high)
    return low
