"""The exact non-associative joint law as a return map, and Newton's method on it.

From anchor forces x̄ a joint that moves with velocity v goes to::

    a = N̄ − v_N/ρ          N = a within −f_t ... f_c
    τ = T̄ − v_T/ρ          T = τ min(1, (μN + c)/‖τ‖)

where the exact law (opening without force, sliding against friction without dilatancy) holds for the part of the motion
that x = x̄ leaves. Equilibrium A x(v) + f_D + λ f_L = 0 with v = Aᵀu, and f_L·u = 1, is solved for u and λ by semismooth
Newton with the consistent tangent (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X)::

    dx = −C dv:   open C = 0;   stick C = I/ρ;   slip C_NN = 1/ρ, C_TN = μ θ/ρ, C_TT = (l/‖τ‖)(I − θθᵀ)/ρ,  θ = τ/‖τ‖

The tangent is not symmetric: sliding depends on the normal force, the normal force not on sliding.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from mbla.arrays import FloatArray
from mbla.program.program import Program

MOST_STEPS = 30
BACKTRACKS = 10
CONVERGED = 1e-11
"""Unbalanced force, in mean block loads."""

REGULARIZATION = 1e-12
"""Share of the stiffness of all joints sticking that is added everywhere: blocks whose joints all open have none."""


@dataclass(frozen=True)
class LawStep:
    """One step of the exact law: velocities (n_rows,), load factor, forces (n_points, components), unbalanced force."""

    velocities: FloatArray
    load_factor: float
    forces: FloatArray
    residual: float
    factorizations: int


def exact_step(program: Program, anchor: FloatArray, rho: float, velocities: FloatArray, load_factor: float) -> LawStep:
    """Solve one step from forces ``anchor``, (n_points, components), starting from velocities and a load factor.

    The best iterate is returned; whether it is good enough its residual says.
    """
    stiffness = REGULARIZATION * (program.equilibrium_matrix.multiply(program.equilibrium_matrix)).sum(axis=1) / rho
    u, factor = velocities, load_factor
    residual, forces, state = _residual(program, anchor, rho, u, factor)
    best = LawStep(u, factor, forces, float(np.abs(residual).max(initial=0.0)), 0)
    for count in range(1, MOST_STEPS + 1):
        step = _newton_direction(program, rho, state, stiffness, residual)
        if step is None:
            return best
        size, norm = 1.0, float(np.linalg.norm(residual))
        for _ in range(BACKTRACKS):
            trial = _residual(program, anchor, rho, u + size * step[:-1], factor + size * float(step[-1]))
            if np.linalg.norm(trial[0]) < (1.0 - 1e-4 * size) * norm:
                break
            size *= 0.5
        else:
            return LawStep(best.velocities, best.load_factor, best.forces, best.residual, count)
        u, factor = u + size * step[:-1], factor + size * float(step[-1])
        residual, forces, state = trial
        best = LawStep(u, factor, forces, float(np.abs(residual).max(initial=0.0)), count)
        if best.residual <= CONVERGED:
            break
    return best


@dataclass(frozen=True)
class _JointState:
    """Where each joint is on its law: trial forces, norm of the trial shear, shear limit."""

    normal: FloatArray
    shear: FloatArray
    size: FloatArray
    limit: FloatArray
    in_contact: np.typing.NDArray[np.bool_]


def _residual(
    program: Program, anchor: FloatArray, rho: float, u: FloatArray, factor: float
) -> tuple[FloatArray, FloatArray, _JointState]:
    """Unbalanced forces and f_L·u − 1, (n_rows + 1,); the forces; the state of the joints."""
    limits = program.limits
    trial = anchor - (program.equilibrium_matrix.T @ u).reshape(-1, program.components) / rho
    normal = np.clip(trial[:, 0], -limits.tension, limits.compression)
    limit = np.maximum(limits.friction * normal + limits.cohesion, 0.0)
    size = np.linalg.norm(trial[:, 1:], axis=1)
    shorten = np.minimum(1.0, limit / np.maximum(size, 1e-300))
    forces = np.column_stack([normal, trial[:, 1:] * shorten[:, None]])
    balance = program.equilibrium_matrix @ forces.ravel() + program.dead_load + factor * program.live_load
    state = _JointState(normal, trial[:, 1:], size, limit, normal == trial[:, 0])
    return np.append(balance, program.live_load @ u - 1.0), forces, state


def _newton_direction(
    program: Program, rho: float, state: _JointState, stiffness: FloatArray, residual: FloatArray
) -> FloatArray | None:
    tangent = _tangent(program.limits.friction, rho, state)
    matrix, live = program.equilibrium_matrix, program.live_load
    jacobian = -(matrix @ tangent @ matrix.T) - sp.diags_array(stiffness)
    system = sp.block_array([[jacobian, sp.csr_array(live[:, None])], [sp.csr_array(live[None, :]), None]])
    try:
        step = spla.splu(sp.csc_matrix(system)).solve(-residual)
    except RuntimeError:  # exactly singular
        return None
    return step if np.isfinite(step).all() else None


def _tangent(friction: FloatArray, rho: float, state: _JointState) -> sp.csr_array:
    """C of every joint as a block-diagonal matrix, (components n_points, components n_points)."""
    n, size = len(friction), 1 + state.shear.shape[1]
    tangent = np.zeros((n, size, size))
    tangent[:, 0, 0] = state.in_contact / rho
    direction = state.shear / np.maximum(state.size, 1e-300)[:, None]
    slips = state.size > state.limit
    share = np.where(slips, state.limit / np.maximum(state.size, 1e-300), 1.0)
    across = np.eye(size - 1) - np.where(slips, 1.0, 0.0)[:, None, None] * direction[:, :, None] * direction[:, None, :]
    tangent[:, 1:, 1:] = share[:, None, None] * across / rho
    follows = slips & state.in_contact
    tangent[follows, 1:, 0] = friction[follows, None] * direction[follows] / rho
    return sp.csr_array(sp.bsr_array((tangent, np.arange(n), np.arange(n + 1)), shape=(size * n, size * n)))
