"""Forces and mechanisms repaired so that they prove bounds of the associative load factor.

*Static:* forces in equilibrium with λ and within the yield conditions prove that collapse needs at least λ. The
solver's forces are inside their cones but balance the loads only to its tolerance. They are corrected in the metric of
the cones' own barrier, so that a force near the border of its cone moves little: the least Δ in

    A Δx + f_L Δλ = −(A x + f_D + λ f_L),    weighted by the barrier's Hessian at x

stays inside all cones if it is short (Dikin's ellipsoid; Nesterov and Nemirovskii 1994, theorem 2.1.1).

*Kinematic:* velocities compatible with the yield conditions give a load factor at or above the collapse value. The
solver's mechanism is moved, in the metric of the cones' own barrier, towards contact velocities strictly inside them.

The barrier of a cone ‖T‖ ≤ s is −log(s² − ‖T‖²), that of a half-line −log of its slack. Forces and velocities have two
or three components.

Conditions on interfaces are further cones: their slacks s stand beside the forces, in balance in the rows of their
unknowns ψ, and cones @ ψ beside the contact velocities (:mod:`mbla.program.conditions`).
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.process.stopwatch import stage
from mbla.program.program import Program
from mbla.program.yield_conditions import YieldLimits, yield_violation
from mbla.solution.associative.condition_cones import ConditionCones
from mbla.solution.linear_algebra.block_products import block_diagonal, inverses
from mbla.solution.linear_algebra.bordered_system import PROGRESS, ROUNDS, bordered_solver

TINY = 1e-100
"""Stands for zero slack: its square and the square of its inverse are within the range of numbers."""


@np.errstate(over="ignore", invalid="ignore")
def force_metric(limits: YieldLimits, x: FloatArray) -> sp.csr_array:
    """Inverse Hessian of the barriers of all yield conditions at forces strictly inside, block-diagonal.

    Points without shear strength keep T = 0. Not finite where squares of forces are beyond the range of numbers.

    x : (n_points, components)  non-dimensional, compression positive; the matrix has a row for each of its numbers
    """
    mu, s = limits.friction, limits.cohesion + limits.friction * x[:, 0]
    t = x[:, 1:]
    shearless = (mu == 0) & (limits.cohesion == 0)
    s = np.where(shearless, 1.0, s)
    det = np.maximum(s**2 - (t**2).sum(axis=1), TINY)
    hessian = _cone_hessian(np.column_stack([-mu * s, t]), det)
    hessian[:, 0, 0] -= 2.0 * mu**2 / det
    hessian[:, range(1, x.shape[1]), range(1, x.shape[1])] += (2.0 / det)[:, None]
    slack = np.maximum(x[:, 0] + limits.tension, TINY)
    cut_off = (limits.cohesion > 0) | (mu == 0)
    hessian[:, 0, 0] += np.where(cut_off, slack**-2, 0.0)
    finite = np.isfinite(limits.compression)
    hessian[finite, 0, 0] += np.maximum(limits.compression[finite] - x[finite, 0], TINY) ** -2
    inverse = _inverse(hessian)
    inverse[shearless, 1:, :] = 0.0
    inverse[shearless, :, 1:] = 0.0
    return block_diagonal(inverse)


@np.errstate(over="ignore", invalid="ignore")
def velocity_hessian(friction: FloatArray, v: FloatArray) -> FloatArray:
    """Hessian of −log(v_N² − μ² ‖v_T‖²) at velocities strictly inside; −log v_N² where μ = 0.

    Not finite where squares of velocities are beyond the range of numbers.

    friction : (n,); v : (n, components)  opening positive; the Hessians are (n, components, components)
    """
    squared = friction**2
    det = np.maximum(v[:, 0] ** 2 - squared * (v[:, 1:] ** 2).sum(axis=1), TINY)
    hessian = _cone_hessian(np.column_stack([-v[:, 0], squared[:, None] * v[:, 1:]]), det)
    hessian[:, 0, 0] -= 2.0 / det
    hessian[:, range(1, v.shape[1]), range(1, v.shape[1])] += (2.0 * squared / det)[:, None]
    return hessian


def _cone_hessian(gradient: FloatArray, det: FloatArray) -> FloatArray:
    gradient = gradient * (2.0 / det)[:, None]
    return np.asarray(gradient[:, :, None] * gradient[:, None, :])


def _inverse(hessian: FloatArray) -> FloatArray:
    """Inverse of each block; scaled to unit diagonal, so that points with forces 1e-12 of the others keep accuracy."""
    size = 1.0 / np.sqrt(np.maximum(np.einsum("nii->ni", hessian), TINY))
    unit = hessian * size[:, :, None] * size[:, None, :] + 1e-14 * np.eye(hessian.shape[1])[None]
    return np.asarray(inverses(unit) * size[:, :, None] * size[:, None, :])


EQUILIBRIUM_TOLERANCE = 1e-9
"""Residual, relative to the mean load of a block, that counts as equilibrium: where all joints of a sliding plane are
on their cones at once, double precision does not get far below 1e-10."""

BALANCED = 1e-13
"""Residual at which no repair is needed."""

INSIDE = 1e-13
"""Excess over a yield condition, relative to the mean load of a block, that is rounding."""

FORCE_ROUNDING = 16 * np.finfo(float).eps
"""Share of the largest force that is rounding in a yield condition or in equilibrium: joints of a strength of millions
of block loads bear forces of which no more digits are left."""

RUNAWAY = 1e9
"""Growth of the forces that is no repair any more."""

MARGIN = 1e-12
"""Share of the largest normal force, or of what a light block has to balance, by which forces are put inside."""

NO_FORCE = 1e-18
"""Share of the largest force below which a normal force counts as zero next to a shear."""

STEEP = 10.0
"""Friction up to which the metric follows the cone: beyond it shear could move so much more freely than normal force
that nothing is left of the latter in double precision."""


@stage("repair")
def repaired_forces(
    program: Program,
    forces: FloatArray,
    load_factor: float,
    slacks: FloatArray | None = None,
    inside: float = INSIDE,
) -> tuple[FloatArray, float] | None:
    """Forces near the given ones that balance the loads within all conditions, and the load factor they carry.

    forces : (n_points, components), non-dimensional as ``program``, like the load factor. None where no repair is found
    slacks : (n_slacks,) of the conditions on interfaces, where the program has such: without them there is none
    inside : excess over a yield condition that is allowed
    """
    if slacks is None and program.conditions is not None:
        return None
    further = ConditionCones.of(program)
    x, s, factor, best, least = forces, further.none if slacks is None else slacks, load_factor, None, np.inf
    for _ in range(ROUNDS + 1):
        off = float(np.abs(further.unbalanced(x, s, factor)).max(initial=0.0))
        excess = max(float(yield_violation(x, program.limits).max(initial=0.0)), further.lack(s).max(initial=0.0))
        rounding = FORCE_ROUNDING * max(float(np.abs(x).max(initial=0.0)), float(np.abs(s).max(initial=0.0)))
        if excess <= max(inside, rounding) and off <= min(least, max(EQUILIBRIUM_TOLERANCE, rounding)):
            enough = off <= max(BALANCED, rounding) or off > PROGRESS * least
            best, least = (x, factor), off
            if enough:
                break
        x, s = _pulled_inside(program, x), further.pulled_inside(s)
        step = _static_correction(program, further, x, s, factor)
        if step is None:
            break
        x, s, factor = x + step[0], s + step[1], factor + step[2]
        if np.abs(x).max(initial=0.0) > RUNAWAY * (1.0 + np.abs(forces).max(initial=0.0)):
            break
    return best


def carried_loads(program: Program, x: FloatArray) -> FloatArray:
    """Size of what each row of equilibrium has to balance: contact forces, counted without sign, and dead load."""
    sizes = np.repeat(np.linalg.norm(x, axis=1), program.components)
    return np.asarray(abs(program.equilibrium_matrix) @ sizes + np.abs(program.dead_load))


def least_carried(program: Program, x: FloatArray) -> FloatArray:
    """What the lighter of the blocks at each contact point has to balance, as a force there, (n_points,)."""
    matrix = program.equilibrium_matrix.tocoo()
    share = carried_loads(program, x)[matrix.row] / np.maximum(np.abs(matrix.data), 1e-300)
    least = np.full(program.n_points, np.inf)
    np.minimum.at(least, matrix.col // program.components, share)
    return least


def _pulled_inside(program: Program, x: FloatArray) -> FloatArray:
    """The nearest simple change that puts every force strictly inside: normal force off its ends, shear shortened.

    By little relative to what the lighter block has to balance: much of its load may be little relative to the others'.
    """
    inside, limits = x.copy(), program.limits
    largest = np.minimum(max(float(np.abs(x[:, 0]).max(initial=0.0)), 1e-288), least_carried(program, x))
    frictional = limits.friction > 0
    apex = np.divide(limits.cohesion, limits.friction, out=np.full_like(limits.cohesion, np.inf), where=frictional)
    lower, upper = -np.minimum(limits.tension, apex), limits.compression
    room = np.minimum(MARGIN * largest, 0.25 * (upper - lower))
    inside[:, 0] = np.clip(x[:, 0], lower + room, upper - room)
    shear = np.linalg.norm(x[:, 1:], axis=1)
    allowed = np.maximum((limits.cohesion + limits.friction * inside[:, 0]) * (1 - 1e-10), 0.0)
    factor = np.divide(allowed, shear, out=np.ones_like(shear), where=shear > allowed)
    inside[:, 1:] *= factor[:, None]
    return inside


def _static_correction(
    program: Program, further: ConditionCones, x: FloatArray, s: FloatArray, factor: float
) -> tuple[FloatArray, FloatArray, float] | None:
    """Least change of forces, slacks and load factor, in the barrier's metric, that restores equilibrium."""
    limits = program.limits
    least = NO_FORCE * max(float(np.abs(x).max(initial=0.0)), 1e-280)  # a steeper cone has none: no digits are left
    needed = 2.0 * np.linalg.norm(x[:, 1:], axis=1) / np.maximum(x[:, 0], least)
    weights = force_metric(replace(limits, friction=np.minimum(limits.friction, np.maximum(STEEP, needed))), x)
    of_slacks = further.inverse_hessian(s)
    matrix, held = further.moving.equilibrium_matrix, further.held
    normal = further.with_slacks(matrix @ weights @ matrix.T, of_slacks)
    free = 1e-4 * max(abs(factor), 1e-3)
    solve = bordered_solver(normal, further.moving.live_load, free * free)  # not **, which raises beyond numbers
    if solve is None:
        return None
    delta, of_s, delta_factor = np.zeros_like(x), np.zeros_like(s), 0.0
    for _ in range(4):  # refinement: the metric spans many decades
        y = solve(-further.unbalanced(x + delta, s + of_s, factor + delta_factor))
        if not np.isfinite(y).all():
            return None
        delta = delta + (weights @ (matrix.T @ y[:-1])).reshape(x.shape)
        of_s = of_s + of_slacks @ (held.T @ y[:-1])
        delta_factor += float(y[-1])
    return delta, of_s, delta_factor


OPENINGS = (1e-13, 1e-11, 1e-9)
"""Opening velocities, relative to the largest contact speed, that the mechanism is moved towards in turn until it is
compatible; the best one counts. Confined joints cannot open at all: there the smallest leaves least to be charged."""


def repaired_mechanisms(program: Program, velocities: FloatArray) -> Iterator[FloatArray]:
    """The given velocities, and versions of them moved towards compatibility.

    Each is found when it is asked for.

    velocities : (n_rows + n_unknowns,) of the blocks, then unknowns of the conditions on interfaces; non-dimensional
    """
    yield velocities
    further = ConditionCones.of(program)
    for opening in OPENINGS:
        u, lack = velocities, np.inf
        for _ in range(ROUNDS):
            moved = _kinematic_correction(further, u, opening)
            if moved is None:
                break
            yield moved
            u, before, lack = moved, lack, incompatibility(further, moved)
            if lack == 0.0:
                return
            if lack > PROGRESS * before:
                break


def incompatibility(further: ConditionCones, velocities: FloatArray) -> float:
    """Sum of μ s − v_N over points that cannot crush, where that is positive, and of what conditions lack.

    velocities : (n_rows + n_unknowns,)  non-dimensional
    """
    program = further.moving
    v = program.contact_velocities(velocities)
    lack = np.maximum(program.limits.friction * np.linalg.norm(v[:, 1:], axis=1) - v[:, 0], 0.0)
    of_conditions = further.lack(further.held.T @ velocities)
    return float(lack[np.isinf(program.limits.compression)].sum() + of_conditions.sum())


@stage("repair")
def _kinematic_correction(further: ConditionCones, u: FloatArray, opening: float) -> FloatArray | None:
    """Least change, in the barrier's metric, towards velocities that open by ``opening`` of the largest speed."""
    program = further.moving
    mu, matrix, held = program.limits.friction, program.equilibrium_matrix, further.held
    v = program.contact_velocities(u)
    speed = max(float(np.abs(v).max(initial=0.0)), 1e-9 * float(np.abs(u).max(initial=0.0)), 1e-150)
    target = v.copy()
    target[:, 0] = np.maximum(v[:, 0], mu * np.linalg.norm(v[:, 1:], axis=1) + opening * speed)
    wanted = further.inside_by(held.T @ u, opening)
    weights = velocity_hessian(mu, target)
    # joints that can crush need not open: they only keep the velocity from straying
    weak = 1.0 / (speed * speed)  # not **, which raises beyond numbers
    weights[np.isfinite(program.limits.compression)] = weak * np.eye(program.components)
    metric, of_conditions = block_diagonal(weights), further.hessian(wanted)
    normal = further.with_slacks(matrix @ metric @ matrix.T, of_conditions)
    solve = bordered_solver(normal, program.live_load, np.inf)
    if solve is None:
        return None
    delta = np.zeros_like(u)
    for _ in range(3):
        misfit = matrix @ (metric @ (target.ravel() - matrix.T @ (u + delta)))
        misfit += held @ (of_conditions @ (wanted - held.T @ (u + delta)))
        delta = delta + solve(misfit)[:-1]
    return u + delta if np.isfinite(delta).all() else None
