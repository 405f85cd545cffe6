"""The central path of the exact joint law: points strictly inside the law that tend to it as σ goes to zero.

The equations are those of ``joint_equations`` with products σ a (normal) and σ b (shear)::

    A x + f_D + λ f_L = τ r_1                   f_L·u = 1 + τ r_0
    y − z = v_N + ρ (N − N̄) + τ r_N             w = v_T + ρ (T − T̄) + τ r_T

σ → 0 gives the exact law: opening without force, sliding against friction, no dilatancy. τ = σ/σ_0 lets the path begin
at any point: r_1, r_0, r_N, r_T are what the first point leaves unbalanced. a, b are 1 or a seeded noise about 1, which
parts branches that the symmetry of a structure would let meet. ρ = κ σ K/‖x̄‖² draws the forces towards an anchor x̄,
the gravity state, and vanishes with σ; it chooses among the load factors, which are not unique: without it the path
ends in the middle of the set of solutions, with it on the branch that loading from rest would take.

One factorisation serves the Newton step at fixed σ and the tangent with d ln σ = 1.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import BorderedFactors, Stiffness
from mbla.solution.nonassociative.joint_equations import (
    Iterate,
    JointEquations,
    Joints,
    Missing,
    Products,
    exact_law,
    residuals,
)
from mbla.solution.nonassociative.law_state import LawState, law_state

FIRST_FORCE = 1.0
"""Normal force of the first point at every contact, in mean block loads."""


@dataclass(frozen=True)
class CentralPath:
    """The equations of one path; see the head of the module.

    joints  : with x̄, at ρ = 0
    weights : (n_points, 2) a, b
    pull    : κ K/‖x̄‖²
    start   : what the linear equations miss at τ = 1; None: nothing, at any τ
    log_start : ln σ_0
    """

    joints: JointEquations
    weights: FloatArray
    pull: float
    start: Missing | None = None
    log_start: float = 0.0

    @property
    def program(self) -> Program:
        """The program whose law it is."""
        return self.joints.program

    def at(self, point: Iterate) -> JointEquations:
        """The equations at the σ of a point."""
        return replace(self.joints, rho=self.pull * float(np.exp(point.log_sigma)))


def central_path(stiffness: Stiffness, noise: float, seed: int, anchor: FloatArray | None, kappa: float) -> CentralPath:
    """A path with the given noise and pull κ towards an anchor; it begins at ``first_point``.

    anchor : (n_points, components)  forces, non-dimensional, compression positive; None: no pull
    """
    program = stiffness.program
    shape = (program.n_points, program.components)
    anchored = anchor is not None and kappa > 0.0
    pull = kappa * program.n_points / max(float((anchor**2).sum()), 1e-300) if anchored else 0.0  # type: ignore[operator]
    law = exact_law(program, np.zeros(program.n_points))
    joints = JointEquations.of(stiffness, law, np.zeros(shape) if anchor is None else anchor, 0.0)
    weights = np.exp(noise * np.random.default_rng(seed).normal(size=(program.n_points, 2)))
    path = CentralPath(joints, weights, pull)
    first = first_point(path)
    return replace(path, start=residuals(path.at(first), first), log_start=first.log_sigma)


def first_point(path: CentralPath) -> Iterate:
    """Equal normal forces, no shear, velocities along the live load; σ of the size of force times velocity there."""
    program, joints, limits = path.program, path.joints, path.program.limits
    u = program.live_load / float(program.live_load @ program.live_load)
    normal = np.minimum(FIRST_FORCE, 0.5 * (limits.compression - limits.tension)) + limits.tension
    speed = float(np.linalg.norm(joints.stiffness.velocities(u)))
    sigma = float((normal**2).mean()) * speed / max(float(np.linalg.norm(normal)), 1e-300)
    slack, slip = sigma * path.weights.T
    nothing = np.zeros((program.n_points, program.components - 1))
    return Iterate(
        u=u,
        factor=0.0,
        normal=normal,
        opening=slack / normal,
        shear=nothing,
        slip=nothing,
        speed=slip / joints.limit(normal),
        crushing=slack[joints.crushable] / joints.room(normal),
        log_sigma=float(np.log(sigma)),
    )


def missing_at(path: CentralPath, point: Iterate) -> Missing:
    """What a point leaves of the linear equations of the path, and its products."""
    missing = residuals(path.at(point), point)
    if path.start is None:
        return missing
    tau = float(np.exp(point.log_sigma - path.log_start))
    return replace(
        missing,
        balance=missing.balance - tau * path.start.balance,
        normal=missing.normal - tau * path.start.normal,
        shear=missing.shear - tau * path.start.shear,
    )


def products_wanted(path: CentralPath, point: Iterate, missing: Missing) -> Products:
    """Changes that bring the products to σ a and σ b."""
    normal, shear = float(np.exp(point.log_sigma)) * path.weights.T
    return Products(
        opening=normal - missing.normal_product,
        crushing=normal[path.joints.crushable] - missing.crushing_product,
        sliding=shear - missing.shear_product,
        turning=-missing.shear_direction,
    )


@dataclass(frozen=True)
class LinearStep:
    """Newton step at fixed σ, tangent with d ln σ = 1, and the factors both came from."""

    newton: Iterate
    tangent: Iterate
    factors: BorderedFactors


def linear_step(path: CentralPath, point: Iterate, missing: Missing) -> LinearStep | None:
    """Newton step and tangent at a point that leaves ``missing``; None where the matrix is singular."""
    equations = path.at(point)
    joints = Joints.of(equations, point)
    if not np.isfinite(joints.tangents).all():
        return None
    factors = equations.stiffness.factorized(joints.tangents, None)
    if factors is None:
        return None
    newton = joints.direction(factors, point, missing, products_wanted(path, point, missing))
    tangent = joints.direction(factors, point, *_along_sigma(path, point, missing))
    if not all(np.isfinite(step.u).all() for step in (newton, tangent)):
        return None
    return LinearStep(newton, replace(tangent, log_sigma=1.0), factors)


def _along_sigma(path: CentralPath, point: Iterate, missing: Missing) -> tuple[Missing, Products]:
    """What the other unknowns must make up for when ln σ grows by one."""
    sigma, equations = float(np.exp(point.log_sigma)), path.at(point)
    pulled = equations.rho * (equations.forces(point) - equations.anchor)
    balance, normal, shear = np.zeros_like(missing.balance), pulled[:, 0], pulled[:, 1:]
    if path.start is not None:
        tau = float(np.exp(point.log_sigma - path.log_start))
        balance = -tau * path.start.balance
        normal, shear = normal - tau * path.start.normal, shear - tau * path.start.shear
    growth = sigma * path.weights
    products = Products(
        growth[:, 0], growth[path.joints.crushable, 0], growth[:, 1], np.zeros_like(missing.shear_direction)
    )
    return replace(missing, balance=balance, normal=normal, shear=shear), products


def off_path(path: CentralPath, point: Iterate, missing: Missing) -> float:
    """Distance from the path: the largest residual, products over σ, motions over their slacks."""
    sigma, wanted = float(np.exp(point.log_sigma)), products_wanted(path, point, missing)
    slack = point.opening.copy()
    slack[path.joints.crushable] += point.crushing
    parts = (
        *(part / sigma for part in vars(wanted).values()),
        missing.normal / slack,
        missing.shear / point.speed[:, None],
        missing.balance,
    )
    return max(float(np.abs(part).max(initial=0.0)) for part in parts)


def state_of(path: CentralPath, point: Iterate) -> LawState:
    """The state a point stands for; its residual counts unbalanced forces too, in mean block loads."""
    program = path.program
    power = float(program.live_load @ point.u)
    velocities = point.u / power if power != 0.0 else point.u
    return with_balance(program, law_state(program, 0.0, path.joints.forces(point), velocities, point.factor))


def with_balance(program: Program, state: LawState) -> LawState:
    """The state with its unbalanced force in the residual."""
    forces = program.equilibrium_matrix @ state.forces.ravel()
    left = forces + program.dead_load + state.load_factor * program.live_load
    return replace(state, residual=max(state.residual, float(np.abs(left).max(initial=0.0))))
