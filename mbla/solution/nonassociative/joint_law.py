"""The exact joint law as a return map, and Newton's method on it.

From anchor forces x̄ a joint that moves with velocity v goes, with dilatancy δ = tan ψ (zero without), to::

    a = N̄ − v_N/ρ,   τ = T̄ − v_T/ρ
    stick   N = a,                                   T = τ            where ‖τ‖ ≤ μN + c
    slip    N = (a + δ (‖τ‖ − c)) / (1 + δ μ),       T = (μN + c) θ,  θ = τ/‖τ‖
    and N within −f_t ... f_c in both: open at the one end, crushing at the other

so that the part of the motion that x − x̄ leaves, v + ρ(x − x̄), obeys the law: opening without force, sliding against
friction, v_N = δ ‖v_T‖ while sliding. With δ = μ this is the projection on the cone, with δ = 0 sliding does not lift.
Equilibrium A x(v) + f_D + λ f_L = 0 with v = Aᵀu, and f_L·u = 1, is solved for u and λ by semismooth Newton with the
consistent tangent (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X)::

    dx = −C dv:   stick C = I/ρ;   open and crushing C_NN = 0;
                  slip  C_NN = 1/(1 + δμ)/ρ,  C_NT = δ C_NN θᵀ,  C_T· = μ θ C_N· + (0, (l/‖τ‖)(I − θθᵀ)/ρ)

The tangent is symmetric for δ = μ only: without dilatancy sliding depends on the normal force, not the other way round.
``joint_state`` and ``joint_tangents`` are the law for trial forces (a, τ) of any origin: the springs of ``standing``,
whose joints start free of stress, and points of interfaces with conditions of their own use it too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.yield_conditions import YieldLimits
from mbla.solution.linear_algebra.stiffness import BorderedFactors, Stiffness

BACKTRACKS = 8
CONVERGED = 1e-10
"""Unbalanced force, in mean block loads."""

REGULARIZATION = 1e-12
"""Share of the stiffness of all joints sticking that is added everywhere: blocks whose joints all open have none."""


@dataclass(frozen=True)
class JointState:
    """Where each joint is on its law.

    forces    : (n_points, components)
    direction : (n_points, components − 1) θ of the trial shear
    size      : (n_points,) its norm
    limit     : (n_points,) of shear
    slips, in_contact : (n_points,) whether shear is at its limit, and whether N follows its trial
    """

    forces: FloatArray
    direction: FloatArray
    size: FloatArray
    limit: FloatArray
    slips: BoolArray
    in_contact: BoolArray


def joint_state(limits: YieldLimits, trial: FloatArray, slope: FloatArray | float = 0.0) -> JointState:
    """Return map of every joint.

    trial : (n_points, components) trial forces a, τ
    slope : (n_points,) tangent of the dilatancy angle, or one for all
    """
    size = np.linalg.norm(trial[:, 1:], axis=1)
    direction = trial[:, 1:] / np.maximum(size, 1e-300)[:, None]
    normal = np.clip(trial[:, 0], -limits.tension, limits.compression)
    slips = size > _shear_limit(limits, normal)
    sliding = (trial[:, 0] + slope * (size - limits.cohesion)) / (1.0 + slope * limits.friction)
    sliding = np.where(slips, sliding, trial[:, 0])
    normal = np.clip(sliding, -limits.tension, limits.compression)
    limit = _shear_limit(limits, normal)
    shear = np.where(slips, limit, size)[:, None] * direction
    return JointState(np.column_stack([normal, shear]), direction, size, limit, slips, normal == sliding)


def _shear_limit(limits: YieldLimits, normal: FloatArray) -> FloatArray:
    return np.maximum(limits.friction * normal + limits.cohesion, 0.0)


def joint_tangents(friction: FloatArray, state: JointState, slope: FloatArray | float = 0.0) -> FloatArray:
    """Change of the forces of every joint with its trial forces, (n_points, components, components).

    friction : (n_points,)
    """
    n, size = state.forces.shape
    theta, slips = state.direction, state.slips
    tangents = np.zeros((n, size, size))
    dilates = np.where(slips, slope, 0.0)
    tangents[:, 0, 0] = np.where(state.in_contact, 1.0 / (1.0 + dilates * friction), 0.0)
    tangents[:, 0, 1:] = (tangents[:, 0, 0] * dilates)[:, None] * theta
    share = np.divide(state.limit, state.size, out=np.ones_like(state.size), where=slips)
    across = np.eye(size - 1) - np.where(slips, 1.0, 0.0)[:, None, None] * theta[:, :, None] * theta[:, None, :]
    tangents[:, 1:, 1:] = share[:, None, None] * across
    follows = np.where(slips & (state.limit > 0.0), friction, 0.0)
    tangents[:, 1:, :] += (follows[:, None] * theta)[:, :, None] * tangents[:, None, 0, :]
    return tangents


@dataclass(frozen=True)
class LawStep:
    """One step of the exact law: velocities (n_rows,), load factor, forces (n_points, components), unbalanced force."""

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    residual: float
    factorizations: int


@dataclass(frozen=True)
class LawProblem:
    """A step of the exact law from forces ``anchor``, (n_points, components).

    slope : (n_points,) tangent of the dilatancy angle
    """

    stiffness: Stiffness
    slope: FloatArray
    anchor: FloatArray
    rho: float

    def joints(self, u: FloatArray) -> JointState:
        """The joints at velocities u, (n_rows,)."""
        return joint_state(
            self.stiffness.program.limits, self.anchor - self.stiffness.velocities(u) / self.rho, self.slope
        )

    def factorized(self, state: JointState) -> BorderedFactors | None:
        """Factors of the bordered tangent; None where it is singular."""
        tangents = joint_tangents(self.stiffness.program.limits.friction, state, self.slope) / self.rho
        return self.stiffness.factorized(tangents, REGULARIZATION * self.stiffness.size / self.rho)

    def residual(self, u: FloatArray, factor: float) -> tuple[FloatArray, JointState]:
        """Unbalanced forces and f_L·u − 1, (n_rows + 1,); the state of the joints."""
        program, state = self.stiffness.program, self.joints(u)
        balance = program.equilibrium_matrix @ state.forces.ravel() + program.dead_load + factor * program.live_load
        return np.append(balance, program.live_load @ u - 1.0), state


@np.errstate(over="ignore", invalid="ignore")  # steps that diverge are seen and given up
def exact_step(
    problem: LawProblem, velocities: FloatArray, load_factor: float, most_steps: int, *, balanced: float = CONVERGED
) -> LawStep:
    """Solve one step, starting from velocities, (n_rows,), and a load factor.

    balanced : unbalanced force, in mean block loads, at which it ends; with 0 where rounding lets it fall no further

    The last iterate is returned; whether it is good enough its residual says.
    """
    u, factor, count = velocities, load_factor, 0
    residual, state = problem.residual(u, factor)
    while np.abs(residual).max(initial=0.0) > balanced and count < most_steps:
        solve = problem.factorized(state)
        found = None if solve is None else _line_search(problem, u, factor, solve(-residual), residual)
        count += 1
        if found is None:
            break
        u, factor, residual, state = found
    return LawStep(u, factor, state.forces, float(np.abs(residual).max(initial=0.0)), count)


def _line_search(
    problem: LawProblem, u: FloatArray, factor: float, step: FloatArray, residual: FloatArray
) -> tuple[FloatArray, float, FloatArray, JointState] | None:
    """Halve the step until the residual falls; None where it does not."""
    size, norm = 1.0, float(np.linalg.norm(residual))
    if not np.isfinite(step).all():
        return None
    for _ in range(BACKTRACKS):
        u_new, factor_new = u + size * step[:-1], factor + size * float(step[-1])
        trial, state = problem.residual(u_new, factor_new)
        if np.linalg.norm(trial) < (1.0 - 1e-4 * size) * norm:
            return u_new, factor_new, trial, state
        size *= 0.5
    return None
