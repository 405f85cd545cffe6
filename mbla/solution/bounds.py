"""Forces and velocities repaired so that they prove static and kinematic bounds of the associative load factor.

*Static.* Forces in equilibrium with λ and within the yield conditions prove that collapse needs at least λ. The
solver's forces are inside their cones but balance the loads only to its tolerance. They are corrected in the metric of
the cones' own barrier, so that a force near the border of its cone moves little: the least Δ in

    A Δx + f_L Δλ = −(A x + f_D + λ f_L),    weighted by the barrier's Hessian at x

stays inside all cones if it is short (Dikin's ellipsoid; Nesterov and Nemirovskii 1994, theorem 2.1.1).

*Kinematic.* Velocities compatible with the yield conditions give a load factor at or above the collapse value. The
solver's mechanism is moved, in the same kind of metric, towards contact velocities strictly inside their cones.

Nothing here needs to be believed: what the repaired forces and velocities prove is evaluated by ``verify`` with its own
statics and kinematics.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
import scipy.sparse.linalg as spla

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits, yield_violation

ROUNDS = 6
"""Corrections in a row; each solves one sparse system. Two are usual."""

EQUILIBRIUM_TOLERANCE = 1e-9
"""Residual, relative to the mean load of a block, that counts as equilibrium: where all joints of a sliding plane are
on their cones at once, double precision does not get far below 1e-10."""

OPENINGS = (1e-10, 1e-8)
"""Opening velocities, relative to the largest contact speed, that the mechanism is moved towards; the better one
counts. Confined joints cannot open at all: there the smaller one leaves less to be charged."""

REGULARIZATION = 1e-15
"""On the unit diagonal of the factorised matrix; refinement removes its trace."""

INSIDE = 1e-13
"""Excess over a yield condition, relative to the mean load of a block, that is rounding."""


def repaired_forces(program: Program, forces: FloatArray, load_factor: float) -> tuple[FloatArray, float] | None:
    """Forces near the given ones that balance the loads within the yield conditions, and the load factor they carry.

    forces : (n_points, 3), non-dimensional as ``program``, like the load factor. None where no repair is found.
    """
    x, factor = _pulled_inside(program.limits, forces), load_factor
    for _ in range(ROUNDS):
        step = _static_correction(program, x, factor)
        if step is None:
            return None
        x, factor = x + step[0], factor + step[1]
        residual = np.abs(_residual(program, x, factor)).max(initial=0.0)
        excess = yield_violation(x, program.limits).max(initial=0.0)
        if residual <= EQUILIBRIUM_TOLERANCE and excess <= INSIDE:
            return x, factor
        x = _pulled_inside(program.limits, x)
    return None


def repaired_mechanisms(program: Program, velocities: FloatArray) -> list[FloatArray]:
    """The given velocities, (6 n_free,) non-dimensional, and versions of them moved towards compatibility."""
    moved = [_kinematic_correction(program, velocities, opening) for opening in OPENINGS]
    return [velocities, *(u for u in moved if u is not None)]


def _residual(program: Program, x: FloatArray, factor: float) -> FloatArray:
    return np.asarray(program.equilibrium_matrix @ x.ravel() + program.dead_load + factor * program.live_load)


def _pulled_inside(limits: YieldLimits, x: FloatArray) -> FloatArray:
    """The nearest simple change that puts every force strictly inside: normal force off its ends, shear shortened."""
    inside = x.copy()
    scale = max(float(np.abs(x[:, 0]).max(initial=0.0)), 1e-300)
    margin = 1e-12 * scale
    lower = -np.minimum(
        limits.tension, np.where(limits.friction > 0, limits.cohesion / np.maximum(limits.friction, 1e-300), np.inf)
    )
    upper = limits.compression
    room = np.minimum(margin, 0.25 * (upper - lower))
    inside[:, 0] = np.clip(x[:, 0], lower + room, upper - room)
    capacity = limits.cohesion + limits.friction * inside[:, 0]
    shear = np.hypot(x[:, 1], x[:, 2])
    allowed = np.maximum(capacity * (1 - 1e-10), 0.0)
    factor = np.where(shear > allowed, allowed / np.maximum(shear, 1e-300), 1.0)
    inside[:, 1:] *= factor[:, None]
    return inside


def _barrier_inverse_hessian(limits: YieldLimits, x: FloatArray) -> FloatArray:
    """Inverse Hessian of the barriers of all yield conditions at forces strictly inside, (n_points, 3, 3).

    Cone ‖T‖ ≤ s = c + μN: −log(s² − ‖T‖²); half-lines: −log of their slack. Points without shear strength keep T = 0.
    """
    n = len(x)
    mu, s = limits.friction, limits.cohesion + limits.friction * x[:, 0]
    t = x[:, 1:]
    shearless = (mu == 0) & (limits.cohesion == 0)
    s = np.where(shearless, 1.0, s)
    det = np.maximum(s**2 - (t**2).sum(axis=1), 1e-300)
    gradient = np.column_stack([-mu * s, t]) * (2.0 / det)[:, None]
    hessian = gradient[:, :, None] * gradient[:, None, :]
    hessian[:, 0, 0] -= 2.0 * mu**2 / det
    hessian[:, 1, 1] += 2.0 / det
    hessian[:, 2, 2] += 2.0 / det
    slack = np.maximum(x[:, 0] + limits.tension, 1e-300)
    cut_off = (limits.cohesion > 0) | (mu == 0)
    hessian[:, 0, 0] += np.where(cut_off, slack**-2, 0.0)
    finite = np.isfinite(limits.compression)
    hessian[finite, 0, 0] += np.maximum(limits.compression[finite] - x[finite, 0], 1e-300) ** -2
    # a scaling to unit diagonal keeps the inversion accurate at points whose forces are 1e-12 of the others
    size = 1.0 / np.sqrt(np.maximum(np.einsum("nii->ni", hessian), 1e-300))
    inverse = np.linalg.inv(hessian * size[:, :, None] * size[:, None, :] + 1e-14 * np.eye(3)[None])
    inverse *= size[:, :, None] * size[:, None, :]
    inverse[shearless, 1:, :] = 0.0
    inverse[shearless, :, 1:] = 0.0
    return inverse.reshape(n, 3, 3)


def _block_diagonal(blocks: FloatArray) -> sp.csr_array:
    n = len(blocks)
    return sp.csr_array(sp.bsr_array((blocks, np.arange(n), np.arange(n + 1)), shape=(3 * n, 3 * n)))


def _static_correction(program: Program, x: FloatArray, factor: float) -> tuple[FloatArray, float] | None:
    """Least change of forces and load factor, in the barrier's metric, that restores equilibrium."""
    weights = _block_diagonal(_barrier_inverse_hessian(program.limits, x))
    matrix = program.equilibrium_matrix
    normal = sp.csc_array(matrix @ weights @ matrix.T)
    solve = _bordered_solver(normal, program.live_load, (1e-4 * max(abs(factor), 1e-3)) ** 2)
    if solve is None:
        return None
    delta, delta_factor = np.zeros_like(x), 0.0
    for _ in range(4):  # refinement: the metric spans many decades
        residual = _residual(program, x + delta, factor + delta_factor)
        y = solve(-residual)
        if not np.isfinite(y).all():
            return None
        delta = delta + (weights @ (matrix.T @ y[:-1])).reshape(-1, 3)
        delta_factor += float(y[-1])
    return delta, delta_factor


def _bordered_solver(
    normal: sp.csc_array, live: FloatArray, weight: float
) -> Callable[[FloatArray], FloatArray] | None:
    """Solver of [[N, f], [fᵀ, −1/weight]] (y, t) = (rhs, 0); weight inf makes f·y = 0 a constraint.

    N is scaled to unit diagonal first; its one tiny eigenvalue is the collapse mechanism, which the border controls.
    """
    diagonal = normal.diagonal()
    largest = float(diagonal.max(initial=0.0))
    if not 0.0 < largest < np.inf:
        return None
    scale = 1.0 / np.sqrt(np.maximum(diagonal, 1e-16 * largest))
    scaling = sp.diags_array(scale)
    scaled = scaling @ normal @ scaling + REGULARIZATION * sp.eye_array(len(scale))
    border = scale * live
    size = float(np.linalg.norm(border))
    corner = -1.0 / (weight * size**2) if np.isfinite(weight) else 0.0
    column = sp.csc_array((border / size)[:, None])
    system = sp.csc_matrix(sp.block_array([[scaled, column], [column.T, sp.csc_array([[corner]])]]))
    try:
        factors = spla.splu(system, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    except RuntimeError:  # exactly singular
        return None

    def solve(rhs: FloatArray) -> FloatArray:
        solution = factors.solve(np.append(scale * rhs, 0.0))
        return np.append(scale * solution[:-1], solution[-1] / size)

    return solve


def _kinematic_correction(program: Program, u: FloatArray, opening: float) -> FloatArray | None:
    """Least change, in the barrier's metric, towards velocities that open by ``opening`` of the largest speed."""
    mu = program.limits.friction
    v = (program.equilibrium_matrix.T @ u).reshape(-1, 3)
    target = v.copy()
    sliding = np.hypot(v[:, 1], v[:, 2])
    least = opening * float(np.abs(v).max(initial=0.0))
    target[:, 0] = np.maximum(v[:, 0], mu * sliding + least)
    weights = _velocity_barrier_hessian(mu, target)
    # joints that can crush need not open: they only keep the velocity from straying
    speed = max(float(np.abs(v).max(initial=0.0)), 1e-9 * float(np.abs(u).max(initial=0.0)), 1e-150)
    weights[np.isfinite(program.limits.compression)] = np.eye(3) / speed**2
    metric = _block_diagonal(weights)
    matrix = program.equilibrium_matrix
    solve = _bordered_solver(sp.csc_array(matrix @ metric @ matrix.T), program.live_load, np.inf)
    if solve is None:
        return None
    delta = np.zeros_like(u)
    for _ in range(3):
        misfit = target.ravel() - matrix.T @ (u + delta)
        delta = delta + solve(matrix @ (metric @ misfit))[:-1]
    return u + delta if np.isfinite(delta).all() else None


def _velocity_barrier_hessian(mu: FloatArray, v: FloatArray) -> FloatArray:
    """Hessian of −log(v_N² − μ² ‖v_T‖²) at velocities strictly inside, (n_points, 3, 3); −log v_N where μ = 0."""
    det = np.maximum(v[:, 0] ** 2 - mu**2 * (v[:, 1] ** 2 + v[:, 2] ** 2), 1e-300)
    gradient = np.column_stack([-v[:, 0], (mu**2)[:, None] * v[:, 1:]]) * (2.0 / det)[:, None]
    hessian = gradient[:, :, None] * gradient[:, None, :]
    hessian[:, 0, 0] -= 2.0 / det
    hessian[:, 1, 1] += 2.0 * mu**2 / det
    hessian[:, 2, 2] += 2.0 * mu**2 / det
    return np.asarray(hessian)
