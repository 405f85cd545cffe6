"""Forces and velocities repaired so that they prove static and kinematic bounds of the associative load factor.

*Static.* Forces in equilibrium with λ and within the yield conditions prove that collapse needs at least λ. The
solver's forces are inside their cones but balance the loads only to its tolerance. They are corrected in the metric of
the cones' own barrier, so that a force near the border of its cone moves little: the least Δ in

    A Δx + f_L Δλ = −(A x + f_D + λ f_L),    weighted by the barrier's Hessian at x

stays inside all cones if it is short (Dikin's ellipsoid; Nesterov and Nemirovskii 1994, theorem 2.1.1).

*Kinematic.* Velocities compatible with the yield conditions give a load factor at or above the collapse value. The
solver's mechanism is moved, in the same kind of metric, towards contact velocities strictly inside their cones.

Nothing here needs to be believed: what the repaired forces and velocities prove is evaluated by ``verify`` with its own
statics and kinematics. ``certified_gap`` is the solver stage's own reckoning of the same, on the program alone.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.yield_conditions import yield_violation
from mbla.solution.barriers import block_diagonal, force_metric, velocity_hessian
from mbla.solution.law_state import LawState
from mbla.solution.linear_algebra.superlu import factorize

ROUNDS = 6
"""Corrections in a row; each solves one sparse system. Two are usual."""

EQUILIBRIUM_TOLERANCE = 1e-9
"""Residual, relative to the mean load of a block, that counts as equilibrium: where all joints of a sliding plane are
on their cones at once, double precision does not get far below 1e-10."""

BALANCED = 1e-13
"""Residual at which nothing is left to be mended."""

PROGRESS = 0.2
"""Share of the residual or incompatibility that a round may leave and still be followed by another."""

OPENINGS = (1e-13, 1e-11, 1e-9)
"""Opening velocities, relative to the largest contact speed, that the mechanism is moved towards in turn until it is
compatible; the best one counts. Confined joints cannot open at all: there the smallest leaves least to be charged."""

REGULARIZATION = 1e-15
"""On the unit diagonal of the factorised matrix; refinement removes its trace."""

INSIDE = 1e-13
"""Excess over a yield condition, relative to the mean load of a block, that is rounding."""

FORCE_ROUNDING = 16 * np.finfo(float).eps
"""Share of the largest force that is rounding in a yield condition or in equilibrium: joints of a strength of millions
of block loads bear forces of which no more digits are left."""

RUNAWAY = 1e9
"""Growth of the forces that is no repair any more."""

MARGIN = 1e-12
"""Share of the largest normal force, or of what a light block has to balance, by which forces are put inside."""

STEEP = 10.0
"""Friction up to which the metric follows the cone: beyond it shear could move so much more freely than normal force
that nothing is left of the latter in double precision."""

CHARGED = 2.0
"""Normal force, over the largest of the solution, with which rounding in a mechanism's compatibility is charged."""

LOCKED_IN = 1e4
"""Normal force, over the whole dead load, that would have to be locked in to hold a structure that a motion with
rounding says to fall."""

WORK_ROUNDING = 1e-13
"""Work of the dead load, over the sum of its parts, that may be rounding."""

ZERO_FACTOR = 1e-3
"""Load factors below this share of dead over live load are taken for that share in relative measures."""


@dataclass(frozen=True)
class CertifiedGap:
    """What the repaired forces and velocities of a state prove about the associative factor of a program.

    static, kinematic : bounds, NaN where none could be proved
    gap               : their distance over the load factor, or over a thousandth of dead over live load if that is more
    forces, load_factor: the repaired forces, (n_points, components), and what they carry; as given where not repaired
    velocities        : (n_rows,) of the least kinematic bound
    """

    static: float
    kinematic: float
    gap: float
    forces: FloatArray
    load_factor: float
    velocities: FloatArray


def certified_gap(program: Program, state: LawState) -> CertifiedGap:
    """Bounds of the associative load factor that a state proves; no solver is asked."""
    repaired = repaired_forces(program, state.forces, state.load_factor)
    forces, factor = (state.forces, state.load_factor) if repaired is None else repaired
    charge = CHARGED * float(np.abs(state.forces[:, 0]).max(initial=0.0))
    mechanisms = repaired_mechanisms(program, state.velocities)
    values = [kinematic_value(program, u, charge) for u in mechanisms]
    best = int(np.argmin(np.nan_to_num(values, nan=np.inf)))
    static, kinematic = (np.nan if repaired is None else factor), values[best]
    if not static >= 0.0 and not program.dead_load.any():  # no forces balance no load
        forces, factor, static = np.zeros_like(forces), 0.0, 0.0
    least = ZERO_FACTOR * factor_size(program)
    gap = abs(kinematic - static) / max(abs(kinematic), least, 1e-300)
    return CertifiedGap(static, kinematic, gap, forces, factor, mechanisms[best])


def factor_size(program: Program) -> float:
    """Size of load factors: dead load over live load; the strength of the joints for want of it, 1 for want of that."""
    strength = float((program.limits.cohesion + program.limits.tension).sum())
    sizes = (float(np.linalg.norm(program.dead_load)), strength, 1.0)
    return next(size for size in sizes if size > 0.0) / float(np.linalg.norm(program.live_load))


def falling_motion(program: Program, velocities: FloatArray) -> FloatArray | None:
    """Velocities near the given ones, (n_rows,), proving that the dead load alone is not carried; None where none do.

    They are compatible, what rounding leaves is charged as if the whole dead load were locked in many times over, and
    the dead load does more work in them than the joints dissipate. They are scaled to a largest entry of 1: a solver's
    certificate of infeasibility may have any size, whose square need not be a number.
    """
    largest = float(np.abs(velocities).max(initial=0.0))
    if not 0.0 < largest < np.inf:
        return None
    velocities = velocities / largest
    charge = LOCKED_IN * float(np.abs(program.dead_load).sum())
    for u in repaired_mechanisms(program, velocities):
        work = float(program.dead_load @ u) - dissipation(program, u, charge)
        if work > WORK_ROUNDING * float(np.abs(program.dead_load) @ np.abs(u)):
            return u
    return None


def kinematic_value(program: Program, velocities: FloatArray, charge: float) -> float:
    """Load factor that velocities, (n_rows,), prove to be at or above the collapse value, NaN where none.

    charge : normal force with which what is left of incompatibility is charged
    """
    live_power = float(program.live_load @ velocities)
    if not live_power > 0.0:
        return float("nan")
    return float((dissipation(program, velocities, charge) - program.dead_load @ velocities) / live_power)


def dissipation(program: Program, velocities: FloatArray, charge: float) -> float:
    """Power of the joints by associative flow; incompatibility where they cannot crush costs ``charge`` as force."""
    limits = program.limits
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, program.components)
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    surplus = v[:, 0] - limits.friction * sliding
    resistance = np.where(np.isinf(limits.compression), charge, limits.compression)
    opening = limits.cohesion * sliding + limits.tension * np.maximum(surplus, 0.0)
    return float((opening + resistance * np.maximum(-surplus, 0.0)).sum())


def repaired_forces(
    program: Program, forces: FloatArray, load_factor: float, inside: float = INSIDE
) -> tuple[FloatArray, float] | None:
    """Forces near the given ones that balance the loads within the yield conditions, and the load factor they carry.

    forces : (n_points, components), non-dimensional as ``program``, like the load factor. None where no repair is found
    inside : excess over a yield condition that is allowed
    """
    x, factor, best, least = forces, load_factor, None, np.inf
    for _ in range(ROUNDS + 1):
        off = float(np.abs(_unbalanced(program, x, factor)).max(initial=0.0))
        excess = float(yield_violation(x, program.limits).max(initial=0.0))
        rounding = FORCE_ROUNDING * float(np.abs(x).max(initial=0.0))
        if excess <= max(inside, rounding) and off <= min(least, max(EQUILIBRIUM_TOLERANCE, rounding)):
            enough = off <= max(BALANCED, rounding) or off > PROGRESS * least
            best, least = (x, factor), off
            if enough:
                break
        x = _pulled_inside(program, x)
        step = _static_correction(program, x, factor)
        if step is None:
            break
        x, factor = x + step[0], factor + step[1]
        if np.abs(x).max(initial=0.0) > RUNAWAY * (1.0 + np.abs(forces).max(initial=0.0)):
            break
    return best


def repaired_mechanisms(program: Program, velocities: FloatArray) -> list[FloatArray]:
    """The given velocities, (n_rows,) non-dimensional, and versions of them moved towards compatibility."""
    found = [velocities]
    for opening in OPENINGS:
        u, lack = velocities, np.inf
        for _ in range(ROUNDS):
            moved = _kinematic_correction(program, u, opening)
            if moved is None:
                break
            found.append(moved)
            u, before, lack = moved, lack, incompatibility(program, moved)
            if lack == 0.0:
                return found
            if lack > PROGRESS * before:
                break
    return found


def incompatibility(program: Program, velocities: FloatArray) -> float:
    """Sum of μ s − v_N over points that cannot crush, where that is positive."""
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, program.components)
    lack = np.maximum(program.limits.friction * np.linalg.norm(v[:, 1:], axis=1) - v[:, 0], 0.0)
    return float(lack[np.isinf(program.limits.compression)].sum())


def _unbalanced(program: Program, x: FloatArray, factor: float) -> FloatArray:
    return np.asarray(program.equilibrium_matrix @ x.ravel() + program.dead_load + factor * program.live_load)


def carried_loads(program: Program, x: FloatArray) -> FloatArray:
    """Size of what each row of equilibrium has to balance: contact forces, counted without sign, and dead load."""
    sizes = np.repeat(np.linalg.norm(x, axis=1), program.components)
    return np.asarray(abs(program.equilibrium_matrix) @ sizes + np.abs(program.dead_load))


def _least_carried(program: Program, x: FloatArray) -> FloatArray:
    """What the lighter of the blocks at each contact point has to balance, as a force there, (n_points,)."""
    matrix = program.equilibrium_matrix.tocoo()
    share = carried_loads(program, x)[matrix.row] / np.maximum(np.abs(matrix.data), 1e-300)
    least = np.full(program.n_points, np.inf)
    np.minimum.at(least, matrix.col // program.components, share)
    return least


def _pulled_inside(program: Program, x: FloatArray) -> FloatArray:
    """The nearest simple change that puts every force strictly inside: normal force off its ends, shear shortened.

    By little beside what the lighter block there has to balance: much of its load may be little beside the others'.
    """
    inside, limits = x.copy(), program.limits
    largest = np.minimum(max(float(np.abs(x[:, 0]).max(initial=0.0)), 1e-288), _least_carried(program, x))
    apex = np.where(limits.friction > 0, limits.cohesion / np.maximum(limits.friction, 1e-300), np.inf)
    lower, upper = -np.minimum(limits.tension, apex), limits.compression
    room = np.minimum(MARGIN * largest, 0.25 * (upper - lower))
    inside[:, 0] = np.clip(x[:, 0], lower + room, upper - room)
    shear = np.linalg.norm(x[:, 1:], axis=1)
    allowed = np.maximum((limits.cohesion + limits.friction * inside[:, 0]) * (1 - 1e-10), 0.0)
    factor = np.divide(allowed, shear, out=np.ones_like(shear), where=shear > allowed)
    inside[:, 1:] *= factor[:, None]
    return inside


def _static_correction(program: Program, x: FloatArray, factor: float) -> tuple[FloatArray, float] | None:
    """Least change of forces and load factor, in the barrier's metric, that restores equilibrium."""
    limits = program.limits
    needed = 2.0 * np.linalg.norm(x[:, 1:], axis=1) / np.maximum(x[:, 0], 1e-300)
    weights = force_metric(replace(limits, friction=np.minimum(limits.friction, np.maximum(STEEP, needed))), x)
    matrix = program.equilibrium_matrix
    normal = sp.csc_array(matrix @ weights @ matrix.T)
    solve = bordered_solver(normal, program.live_load, (1e-4 * max(abs(factor), 1e-3)) ** 2)
    if solve is None:
        return None
    delta, delta_factor = np.zeros_like(x), 0.0
    for _ in range(4):  # refinement: the metric spans many decades
        y = solve(-_unbalanced(program, x + delta, factor + delta_factor))
        if not np.isfinite(y).all():
            return None
        delta = delta + (weights @ (matrix.T @ y[:-1])).reshape(x.shape)
        delta_factor += float(y[-1])
    return delta, delta_factor


def bordered_solver(normal: sp.csc_array, live: FloatArray, weight: float) -> Callable[[FloatArray], FloatArray] | None:
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
    corner = -1.0 / (weight * size**2) if size > 0.0 and np.isfinite(weight) else 0.0
    if not size > 0.0:  # no live load: the border says nothing
        size, corner = 1.0, -1.0
    column = sp.csc_array((border / size)[:, None])
    solve_scaled = factorize(sp.block_array([[scaled, column], [column.T, sp.csc_array([[corner]])]]), symmetric=True)
    if solve_scaled is None:
        return None

    def solve(rhs: FloatArray) -> FloatArray:
        solution = solve_scaled(np.append(scale * rhs, 0.0))
        return np.append(scale * solution[:-1], solution[-1] / size)

    return solve


def _kinematic_correction(program: Program, u: FloatArray, opening: float) -> FloatArray | None:
    """Least change, in the barrier's metric, towards velocities that open by ``opening`` of the largest speed."""
    mu, matrix = program.limits.friction, program.equilibrium_matrix
    v = (matrix.T @ u).reshape(-1, program.components)
    speed = max(float(np.abs(v).max(initial=0.0)), 1e-9 * float(np.abs(u).max(initial=0.0)), 1e-150)
    target = v.copy()
    target[:, 0] = np.maximum(v[:, 0], mu * np.linalg.norm(v[:, 1:], axis=1) + opening * speed)
    weights = velocity_hessian(mu, target)
    # joints that can crush need not open: they only keep the velocity from straying
    weights[np.isfinite(program.limits.compression)] = np.eye(program.components) / speed**2
    metric = block_diagonal(weights)
    solve = bordered_solver(sp.csc_array(matrix @ metric @ matrix.T), program.live_load, np.inf)
    if solve is None:
        return None
    delta = np.zeros_like(u)
    for _ in range(3):
        misfit = target.ravel() - matrix.T @ (u + delta)
        delta = delta + solve(matrix @ (metric @ misfit))[:-1]
    return u + delta if np.isfinite(delta).all() else None
