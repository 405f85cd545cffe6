"""The central path of the exact joint law: points strictly inside the law that tend to it as σ goes to zero.

Unknowns: velocities u and load factor λ, and at every contact point the force (N, T), the slack y of opening, the
slack d of crushing (only where the compressive strength is finite), the slack w of sliding and its size s::

    A x + f_D + λ f_L = τ r_1                   f_L·u = 1 + τ r_0
    y − d = v_N + ρ (N − N̄) + τ r_N             w = v_T + ρ (T − T̄) + τ r_T            v = Aᵀu
    (N + f_t) y = σ a                           (f_c − N) d = σ a
    l s + T·w = σ b                             l w + s T = 0                           l = μ N + c

with N + f_t, f_c − N, y, d > 0 and (l, T), (s, w) inside the circular cone. The last two lines are the complementarity
of two cones in the Jordan algebra of second-order cones (Alizadeh and Goldfarb 2003, doi:10.1007/s10107-002-0339-5);
that l depends on N while sliding does not act on v_N is what makes the law non-associative and the system unsymmetric.

σ → 0 gives the exact law: opening without force, sliding against friction, no dilatancy. τ = σ/σ_0 lets the path begin
at any point: r_1, r_0, r_N, r_T are what the first point leaves unbalanced. a, b are 1 or a seeded noise about 1, which
parts branches that the symmetry of a structure would let meet. ρ = κ σ K/‖x̄‖² draws the forces towards an anchor x̄,
the gravity state, and vanishes with σ; it chooses among the load factors, which are not unique: without it the path
ends in the middle of the set of solutions, with it on the branch that loading from rest would take.
At points without friction and cohesion T = 0, and their w and s play no part.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.solution.nonassociative.law_state import LawState, law_state


@dataclass(frozen=True)
class PathVector:
    """A point of the path, or a change of one.

    velocities : (n_rows,) u
    forces     : (n_points, components) N, T
    opening    : (n_points,) y
    crushing   : (n_points,) d, zero where the joint cannot crush
    slip_size  : (n_points,) s
    slip       : (n_points, components − 1) w
    log_sigma  : natural logarithm of σ
    """

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    opening: FloatArray
    crushing: FloatArray
    slip_size: FloatArray
    slip: FloatArray
    log_sigma: float

    def plus(self, change: PathVector, size: float = 1.0) -> PathVector:
        """The point moved by ``size`` times a change."""
        return PathVector(
            self.velocities + size * change.velocities,
            self.load_factor + size * change.load_factor,
            self.forces + size * change.forces,
            self.opening + size * change.opening,
            self.crushing + size * change.crushing,
            self.slip_size + size * change.slip_size,
            self.slip + size * change.slip,
            self.log_sigma + size * change.log_sigma,
        )


@dataclass(frozen=True)
class Residuals:
    """What a point leaves of the equations of the path, in their order; also right-hand sides of the same shapes.

    balance     : (n_rows,)              power    : f_L·u = 1
    kinematic   : (n_points, components) of v_N and v_T
    opening, crushing, slip_size : (n_points,)      slip : (n_points, components − 1)
    """

    balance: FloatArray
    power: float
    kinematic: FloatArray
    opening: FloatArray
    crushing: FloatArray
    slip_size: FloatArray
    slip: FloatArray


@dataclass(frozen=True)
class CentralPath:
    """The equations of one path; see the head of the module.

    compatibility : Aᵀ, (components n_points, n_rows)
    crushable, frictional : (n_points,) points with the slack d, and with T
    weights       : (n_points, 2) a, b
    anchor        : (n_points, components) x̄
    pull          : κ K/‖x̄‖²
    start         : r_1, r_0, r_N, r_T at τ = 1, and the log_sigma of it
    """

    program: Program
    compatibility: sp.csr_array
    crushable: BoolArray
    frictional: BoolArray
    weights: FloatArray
    anchor: FloatArray
    pull: float
    start: tuple[FloatArray, float, FloatArray, float]

    def velocities_of_points(self, u: FloatArray) -> FloatArray:
        """Velocities at the contact points, (n_points, components)."""
        return (self.compatibility @ u).reshape(-1, self.program.components)

    def margins(self, forces: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """N + f_t; f_c − N, 1 where unlimited; and l, 1 where there is no friction; all (n_points,)."""
        limits, normal = self.program.limits, forces[:, 0]
        with np.errstate(invalid="ignore"):
            to_crushing = np.where(self.crushable, limits.compression - normal, 1.0)
        strength = np.where(self.frictional, limits.friction * normal + limits.cohesion, 1.0)
        return normal + limits.tension, to_crushing, strength


def central_path(program: Program, noise: float, seed: int, anchor: FloatArray | None, kappa: float) -> CentralPath:
    """A path with the given noise and pull κ towards an anchor; it begins at ``first_point``."""
    limits, shape = program.limits, (program.n_points, program.components)
    anchored = anchor is not None and kappa > 0.0
    pull = kappa * program.n_points / max(float((anchor**2).sum()), 1e-300) if anchored else 0.0  # type: ignore[operator]
    path = CentralPath(
        program=program,
        compatibility=sp.csr_array(program.equilibrium_matrix.T),
        crushable=np.isfinite(limits.compression),
        frictional=(limits.friction > 0.0) | (limits.cohesion > 0.0),
        weights=np.exp(noise * np.random.default_rng(seed).normal(size=(program.n_points, 2))),
        anchor=np.zeros(shape) if anchor is None else anchor,
        pull=pull,
        start=(np.zeros(len(program.dead_load)), 0.0, np.zeros(shape), 0.0),
    )
    first = first_point(path)
    left = residuals(path, first)
    return replace(path, start=(left.balance, left.power, left.kinematic, first.log_sigma))


FIRST_FORCE = 1.0
"""Normal force of the first point at every contact, in mean block loads."""


def first_point(path: CentralPath) -> PathVector:
    """Equal normal forces, no shear, velocities along the live load; σ of the size of force times velocity there."""
    program, limits = path.program, path.program.limits
    u = program.live_load / float(program.live_load @ program.live_load)
    forces = np.zeros((program.n_points, program.components))
    forces[:, 0] = np.where(path.crushable, np.minimum(FIRST_FORCE, 0.5 * (limits.compression - limits.tension)), 1.0)
    to_opening, to_crushing, strength = path.margins(forces)
    speed = float(np.linalg.norm(path.compatibility @ u))
    sigma = float((to_opening**2).mean()) * speed / max(float(np.linalg.norm(to_opening)), 1e-300)
    slack, slip = sigma * path.weights.T
    return PathVector(
        velocities=u,
        load_factor=0.0,
        forces=forces,
        opening=slack / to_opening,
        crushing=np.where(path.crushable, slack / to_crushing, 0.0),
        slip_size=np.where(path.frictional, slip / strength, 1.0),
        slip=np.zeros((program.n_points, program.components - 1)),
        log_sigma=float(np.log(sigma)),
    )


def residuals(path: CentralPath, point: PathVector) -> Residuals:
    """Left side minus right side of every equation."""
    program, sigma = path.program, float(np.exp(point.log_sigma))
    balance, power, kinematic, log_start = path.start
    tau, rho = float(np.exp(point.log_sigma - log_start)), path.pull * sigma
    to_opening, to_crushing, strength = path.margins(point.forces)
    shear, slip, size = point.forces[:, 1:], point.slip, point.slip_size
    motion = np.column_stack([point.opening - point.crushing, slip])
    motion = motion - path.velocities_of_points(point.velocities) - rho * (point.forces - path.anchor) - tau * kinematic
    motion[~path.frictional, 1:] = 0.0
    forces = program.equilibrium_matrix @ point.forces.ravel()
    return Residuals(
        balance=forces + program.dead_load + point.load_factor * program.live_load - tau * balance,
        power=float(program.live_load @ point.velocities) - 1.0 - tau * power,
        kinematic=motion,
        opening=to_opening * point.opening - sigma * path.weights[:, 0],
        crushing=np.where(path.crushable, to_crushing * point.crushing - sigma * path.weights[:, 0], 0.0),
        slip_size=np.where(
            path.frictional, strength * size + (shear * slip).sum(axis=1) - sigma * path.weights[:, 1], 0.0
        ),
        slip=np.where(path.frictional[:, None], strength[:, None] * slip + size[:, None] * shear, 0.0),
    )


def along_sigma(path: CentralPath, point: PathVector) -> Residuals:
    """Right-hand sides of the tangent: what the other unknowns must make up for when ln σ grows by one."""
    sigma = float(np.exp(point.log_sigma))
    balance, power, kinematic, log_start = path.start
    tau = float(np.exp(point.log_sigma - log_start))
    motion = path.pull * sigma * (point.forces - path.anchor) + tau * kinematic
    motion[~path.frictional, 1:] = 0.0
    return Residuals(
        balance=tau * balance,
        power=tau * power,
        kinematic=motion,
        opening=sigma * path.weights[:, 0],
        crushing=np.where(path.crushable, sigma * path.weights[:, 0], 0.0),
        slip_size=np.where(path.frictional, sigma * path.weights[:, 1], 0.0),
        slip=np.zeros_like(point.slip),
    )


def off_path(path: CentralPath, point: PathVector, left: Residuals) -> float:
    """Distance from the path: the largest residual, products over σ, motions over their slacks."""
    sigma = float(np.exp(point.log_sigma))
    products = max(
        float(np.abs(part).max(initial=0.0)) for part in (left.opening, left.crushing, left.slip_size, left.slip)
    )
    normal = np.abs(left.kinematic[:, 0]) / (point.opening + point.crushing)
    sliding = np.abs(left.kinematic[:, 1:]) / point.slip_size[:, None]
    linear = max(float(np.abs(left.balance).max(initial=0.0)), abs(left.power))
    return max(products / sigma, float(normal.max(initial=0.0)), float(sliding.max(initial=0.0)), linear)


def state_of(program: Program, point: PathVector) -> LawState:
    """The state a point stands for; its residual counts unbalanced forces too, in mean block loads."""
    power = float(program.live_load @ point.velocities)
    velocities = point.velocities / power if power != 0.0 else point.velocities
    state = law_state(program, 0.0, point.forces, velocities, point.load_factor)
    return with_balance(program, state)


def with_balance(program: Program, state: LawState) -> LawState:
    """The state with its unbalanced force in the residual."""
    forces = program.equilibrium_matrix @ state.forces.ravel()
    left = forces + program.dead_load + state.load_factor * program.live_load
    return replace(state, residual=max(state.residual, float(np.abs(left).max(initial=0.0))))
