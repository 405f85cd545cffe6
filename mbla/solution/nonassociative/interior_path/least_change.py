"""The change of a point of the path that lowers its products at least cost while equilibrium and compatibility hold.

With weights that rise with a product above its target σ, a change z of one contact costs::

    ½ Σ weight (relative change of the product − what is wanted)² + ½ δ ‖z‖²

Wanted: σ − p over p for a product above its target, ln(σ/p), at most a factor e, for one below; none of the vector
l w + s T. ‖z‖ is the local norm of the cones (second derivative of −ln of their determinant; Nesterov and Todd 1997,
doi:10.1287/moor.22.1.1): relative changes, of the distance to the boundary too. The changes of s and of the slack of
crushing concern one contact alone and are eliminated first. Then min Σ ½ zᵀH z + G·z over z = (dx, dq) of every contact
with q = (y − z, w), A dx + dλ f_L = −r_1, dq = Aᵀdu − r_q and f_L·du = −r_0, multipliers p of equilibrium and θ of the
live power, X = H_xx⁻¹, W = X H_xq and S = H_qq − H_qx W::

    A S Aᵀ du − A Wᵀ Aᵀ p + θ f_L = −A (G_q − Wᵀ G_x − S r_q)
   −A W Aᵀ du − A X Aᵀ p + dλ f_L = −r_1 + A (X G_x − W r_q)
    f_L·p = 0,   f_L·du = −r_0,   dx = −X (G_x + Aᵀ p) − W dq

The matrix is quasi-definite, so that every pivot order works (Vanderbei 1995, doi:10.1137/0805005). It stays regular
where the Newton matrix of the path is singular.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.block_products import block_diagonal, inverses
from mbla.solution.linear_algebra.superlu import factorize
from mbla.solution.nonassociative.joint_equations import Iterate, JointEquations, Missing

HEAVIEST = 100.0
"""Ratio of product to target beyond which its weight no longer grows."""

NEAREST = 1e-14
"""Least relative distance from the boundary of a cone that is told from rounding."""

REFINEMENTS = 2

INVERSE = 1e-13
"""Addition to the scaled diagonal of H_xx before it is inverted: rounding."""


def least_change(
    joints: JointEquations, point: Iterate, missing: Missing, target: float, damping: float
) -> Iterate | None:
    """The change of least cost towards products equal to ``target``, with damping δ; None where that is singular."""
    program, c = joints.program, joints.program.components
    matrix, n = program.equilibrium_matrix, len(program.live_load)
    hessian, gradient = _local_cost(joints, point, missing, target, damping)
    hessian, gradient, crushing_row, crushing_offset = _eliminated(hessian, gradient, 2 * c + 1)
    hessian, gradient, speed_row, speed_offset = _eliminated(hessian, gradient, 2 * c)
    hxx, hxq, hqq = hessian[:, :c, :c], hessian[:, :c, c:], hessian[:, c:, c:]
    gx, gq = gradient[:, :c], gradient[:, c:]
    inverse = _inverse(hxx)
    through = inverse @ hxq
    stiff = hqq - hxq.transpose(0, 2, 1) @ through
    known = np.column_stack([missing.normal, missing.shear])
    right = np.concatenate(
        [
            -(matrix @ (gq - _times(through.transpose(0, 2, 1), gx) + _times(stiff, known)).ravel()),
            -missing.balance[:-1] + matrix @ (_times(inverse, gx) + _times(through, known)).ravel(),
            [0.0, -missing.balance[-1]],
        ]
    )
    answer = _solved(joints, (stiff, -through, -inverse), right)
    if answer is None:
        return None
    slacks = joints.stiffness.velocities(answer[:n]) + known
    forces = -_times(inverse, gx + joints.stiffness.velocities(answer[n : 2 * n])) - _times(through, slacks)
    motion = np.concatenate([forces, slacks], axis=1)
    speed = -((speed_row * motion).sum(axis=1) + speed_offset)
    with_speed = np.column_stack([motion, speed])
    crushing = -((crushing_row * with_speed).sum(axis=1) + crushing_offset)[joints.crushable]
    opening = slacks[:, 0].copy()
    opening[joints.crushable] += crushing
    return Iterate(
        answer[:n], float(answer[2 * n]), forces[:, 0], opening, forces[:, 1:], slacks[:, 1:], speed, crushing
    )


def _solved(joints: JointEquations, blocks: tuple[FloatArray, ...], right: FloatArray) -> FloatArray | None:
    """Assemble, scale, factorise, solve and refine; unknowns du, p, dλ, θ.

    blocks : S, −W and −X of every contact
    """
    a, live = joints.program.equilibrium_matrix, sp.csr_array(joints.program.live_load[:, None])
    s, w, x = (a @ block_diagonal(block) @ joints.stiffness.compatibility for block in blocks)
    system = sp.csc_array(
        sp.block_array(
            [[s, w.T, None, live], [w, x, live, None], [None, live.T, None, None], [live.T, None, None, None]]
        )
    )
    if not np.isfinite(system.data).all():
        return None
    n = a.shape[0]
    size = np.sqrt(np.maximum(np.abs(system.diagonal()), 1e-300))
    for border, start in ((2 * n, n), (2 * n + 1, 0)):
        size[border] = max(float(np.abs(joints.program.live_load / size[start : start + n]).max()), 1e-300)
    scale = sp.diags_array(1.0 / size)
    scaled = sp.csc_array(scale @ system @ scale)
    solve = factorize(scaled, symmetric=True)
    if solve is None:
        return None
    answer = solve(right / size)
    for _ in range(REFINEMENTS):
        answer += solve(right / size - scaled @ answer)
    return answer / size if np.isfinite(answer).all() else None


def _local_cost(
    joints: JointEquations, point: Iterate, missing: Missing, target: float, damping: float
) -> tuple[FloatArray, FloatArray]:
    """H, (n_points, 2 c + 2, 2 c + 2), and G, (n_points, 2 c + 2), over (dx, dq, ds, dz)."""
    c, n, here = joints.program.components, joints.program.n_points, joints.crushable
    hessian, gradient = np.zeros((n, 2 * c + 2, 2 * c + 2)), np.zeros((n, 2 * c + 2))
    speed, crush = 2 * c, 2 * c + 1
    hessian[:, crush, crush] = 1.0
    row = np.zeros((n, 2 * c + 2))
    row[:, 0], row[:, c] = 1.0 / point.normal, 1.0 / point.opening
    row[here, crush] = 1.0 / point.opening[here]
    _add_product(hessian, gradient, row, missing.normal_product, target)
    hessian[:, 0, 0] += damping / point.normal**2
    slack = row.copy()
    slack[:, 0] = 0.0
    hessian += damping * slack[:, :, None] * slack[:, None, :]
    if len(here):
        room, some, slope = joints.room(point.normal), hessian[here], gradient[here]
        row = np.zeros((len(here), 2 * c + 2))
        row[:, 0], row[:, crush] = -1.0 / room, 1.0 / point.crushing
        some[:, crush, crush] -= 1.0
        _add_product(some, slope, row, missing.crushing_product, target)
        some[:, 0, 0] += damping / room**2
        some[:, crush, crush] += damping / point.crushing**2
        hessian[here], gradient[here] = some, slope
    limit, friction = joints.limit(point.normal), joints.law.slope
    product, vector = missing.shear_product, missing.shear_direction
    rows = np.zeros((n, c, 2 * c + 2))
    rows[:, 0, 0], rows[:, 0, 1:c], rows[:, 0, c + 1 : speed] = friction * point.speed, point.slip, point.shear
    rows[:, 0, speed] = limit
    rows[:, 1:, 0], rows[:, 1:, speed] = friction[:, None] * point.slip, point.shear
    diagonal = np.arange(c - 1)
    rows[:, 1 + diagonal, 1 + diagonal] = point.speed[:, None]
    rows[:, 1 + diagonal, c + 1 + diagonal] = limit[:, None]
    extent = np.maximum(product, np.linalg.norm(vector, axis=1))
    rows[:, 0] *= (_weight(product, target) / product)[:, None]
    rows[:, 1:] *= (_weight(extent, target) / extent)[:, None, None]
    left = np.column_stack(
        [_weight(product, target) * _wanted(product, target), vector * (_weight(extent, target) / extent)[:, None]]
    )
    hessian += rows.transpose(0, 2, 1) @ rows
    gradient += np.einsum("kij,ki->kj", rows, left)
    of_force = _local_norm(limit, point.shear)
    of_force[:, 0, :] *= friction[:, None]
    of_force[:, :, 0] *= friction[:, None]
    hessian[:, :c, :c] += damping * of_force
    places = np.concatenate([[speed], np.arange(c + 1, speed)])
    hessian[:, places[:, None], places[None, :]] += damping * _local_norm(point.speed, point.slip)
    return hessian, gradient


def _wanted(product: FloatArray, target: float) -> FloatArray:
    """Relative change of a product that is too much, with the sign of a residual."""
    above = 1.0 - target / product
    return np.where(product > target, above, np.clip(np.log(product / target), -1.0, 0.0))


def _weight(product: FloatArray, target: float) -> FloatArray:
    return np.clip(product / target, 1.0, HEAVIEST)


def _add_product(
    hessian: FloatArray, gradient: FloatArray, row: FloatArray, product: FloatArray, target: float
) -> None:
    weight = _weight(product, target) ** 2
    hessian += weight[:, None, None] * row[:, :, None] * row[:, None, :]
    gradient += (weight * _wanted(product, target))[:, None] * row


def _local_norm(size: FloatArray, part: FloatArray) -> FloatArray:
    """Second derivative of −½ ln(size² − ‖part‖²), (n, components, components)."""
    length = np.linalg.norm(part, axis=1)
    determinant = np.maximum(size - length, NEAREST * size) * (size + length)
    mirrored = np.column_stack([size, -part]) / determinant[:, None]
    signature = np.diag(np.append(1.0, -np.ones(part.shape[1])))
    return np.asarray(2.0 * mirrored[:, :, None] * mirrored[:, None, :] - signature / determinant[:, None, None])


def _eliminated(
    hessian: FloatArray, gradient: FloatArray, last: int
) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """The cost without its last variable, at place ``last``, and row and offset that give it back."""
    pivot = hessian[:, last, last]
    row, offset = hessian[:, last, :last] / pivot[:, None], gradient[:, last] / pivot
    reduced = hessian[:, :last, :last] - row[:, :, None] * hessian[:, last, None, :last]
    return reduced, gradient[:, :last] - row * gradient[:, last, None], row, offset


def _inverse(blocks: FloatArray) -> FloatArray:
    """Inverses of positive blocks, scaled by their diagonals."""
    scale = 1.0 / np.sqrt(np.einsum("kii->ki", blocks))
    both = scale[:, :, None] * scale[:, None, :]
    return np.asarray(inverses(blocks * both + INVERSE * np.eye(blocks.shape[1])) * both)


def _times(blocks: FloatArray, vectors: FloatArray) -> FloatArray:
    return np.asarray((blocks @ vectors[:, :, None])[:, :, 0])
