"""One Newton step and the tangent of the central path, condensed contact by contact to the velocities.

The linear equations of one contact give its change of force as dx = g − C dv::

    normal     dN = (q_y/(N+f_t) − q_d/(f_c−N) − q_N − dv_N) / (y/(N+f_t) + d/(f_c−N) + ρ)
    sliding    (M + ρE) dT = h + γ dN − E dv_T,     M = s I − T wᵀ/l,   E = l I − T Tᵀ/l,   γ = μ (s T/l − w)
               h = q_w − q_s T/l − E q_T

with right-hand sides q named after the slacks (ds is eliminated first, through l > 0). Equilibrium then reads
A C Aᵀ du − f_L dλ = A g − q_1, f_L·du = q_0, and everything else follows by substitution. One factorisation serves the
Newton step at fixed σ and the tangent with d ln σ = 1.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.interior_path.central_path import CentralPath, PathVector, Residuals, along_sigma
from mbla.solution.nonassociative.interior_path.condensed_matrix import Factors, MatrixMap, factorise


@dataclass(frozen=True)
class LinearStep:
    """Newton step at fixed σ, tangent with d ln σ = 1, and the factors both came from."""

    newton: PathVector
    tangent: PathVector
    factors: Factors


@dataclass(frozen=True)
class _Contacts:
    """Linear law of every contact: compliance C, margins, and what gives g from right-hand sides.

    normal : (n_points,) C_NN        follow : (n_points, components − 1) change of T with N
    inverse: (M + ρE)⁻¹ and across: E, (n_points, components − 1, components − 1)
    """

    compliance: FloatArray
    to_opening: FloatArray
    to_crushing: FloatArray
    strength: FloatArray
    normal: FloatArray
    follow: FloatArray
    inverse: FloatArray
    across: FloatArray


def linear_step(path: CentralPath, pattern: MatrixMap, point: PathVector, left: Residuals) -> LinearStep | None:
    """Newton step and tangent at a point with residuals ``left``; None where the matrix is singular."""
    contacts = _linearised(path, point)
    factors = factorise(pattern, contacts.compliance)
    if factors is None:
        return None
    matrix = path.program.equilibrium_matrix
    sides = (_negative(left), along_sigma(path, point))
    given = [_given(path, point, contacts, side) for side in sides]
    right = [
        np.append(matrix @ force.ravel() - side.balance, side.power) for force, side in zip(given, sides, strict=True)
    ]
    answer = factors.solve(np.column_stack(right))
    if not np.isfinite(answer).all():
        return None
    newton, tangent = (
        _substituted(path, point, contacts, side, force, answer[:, i], float(i))
        for i, (side, force) in enumerate(zip(sides, given, strict=True))
    )
    return LinearStep(newton, tangent, factors)


def _linearised(path: CentralPath, point: PathVector) -> _Contacts:
    rho = path.pull * float(np.exp(point.log_sigma))
    to_opening, to_crushing, strength = path.margins(point.forces)
    shear, slip, size = point.forces[:, 1:], point.slip, point.slip_size
    frictional, identity = path.frictional[:, None, None], np.eye(shear.shape[1])
    share = shear / strength[:, None]
    against = np.where(frictional, size[:, None, None] * identity - share[:, :, None] * slip[:, None, :], identity)
    across = np.where(frictional, strength[:, None, None] * identity - share[:, :, None] * shear[:, None, :], 0.0)
    inverse = _inverse(against + rho * across)
    friction = np.where(path.frictional, path.program.limits.friction, 0.0)
    growth = friction[:, None] * (size[:, None] * share - slip)
    follow = np.where(path.frictional[:, None], _times(inverse, growth), 0.0)
    normal = 1.0 / (point.opening / to_opening + point.crushing / to_crushing + rho)
    components = path.program.components
    compliance = np.zeros((len(normal), components, components))
    compliance[:, 0, 0] = normal
    compliance[:, 1:, 0] = follow * normal[:, None]
    compliance[:, 1:, 1:] = inverse @ across
    return _Contacts(compliance, to_opening, to_crushing, strength, normal, follow, inverse, across)


def _given(path: CentralPath, point: PathVector, contacts: _Contacts, side: Residuals) -> FloatArray:
    """g: change of force at each contact while the blocks stand still, (n_points, components)."""
    share = point.forces[:, 1:] / contacts.strength[:, None]
    normal = side.opening / contacts.to_opening - side.crushing / contacts.to_crushing - side.kinematic[:, 0]
    normal = normal * contacts.normal
    driven = side.slip - share * side.slip_size[:, None] - _times(contacts.across, side.kinematic[:, 1:])
    shear = np.where(path.frictional[:, None], _times(contacts.inverse, driven), 0.0)
    return np.column_stack([normal, shear + contacts.follow * normal[:, None]])


def _substituted(
    path: CentralPath,
    point: PathVector,
    contacts: _Contacts,
    side: Residuals,
    given: FloatArray,
    answer: FloatArray,
    log_sigma: float,
) -> PathVector:
    rho, friction = path.pull * float(np.exp(point.log_sigma)), path.program.limits.friction
    motion = path.velocities_of_points(answer[:-1])
    forces = given - _times(contacts.compliance, motion)
    normal, shear = forces[:, 0], forces[:, 1:]
    slip = np.where(path.frictional[:, None], motion[:, 1:] + rho * shear + side.kinematic[:, 1:], 0.0)
    size = side.slip_size - point.slip_size * friction * normal
    size = size - (point.slip * shear).sum(axis=1) - (point.forces[:, 1:] * slip).sum(axis=1)
    return PathVector(
        velocities=answer[:-1],
        load_factor=float(answer[-1]),
        forces=forces,
        opening=(side.opening - point.opening * normal) / contacts.to_opening,
        crushing=np.where(path.crushable, (side.crushing + point.crushing * normal) / contacts.to_crushing, 0.0),
        slip_size=np.where(path.frictional, size / contacts.strength, 0.0),
        slip=slip,
        log_sigma=log_sigma,
    )


def _negative(left: Residuals) -> Residuals:
    return Residuals(
        -left.balance, -left.power, -left.kinematic, -left.opening, -left.crushing, -left.slip_size, -left.slip
    )


def _times(blocks: FloatArray, vectors: FloatArray) -> FloatArray:
    return (blocks @ vectors[:, :, None])[:, :, 0]


def _inverse(blocks: FloatArray) -> FloatArray:
    """Inverses of blocks of one or two rows."""
    if blocks.shape[1] == 1:
        return 1.0 / blocks
    adjugate = np.empty_like(blocks)
    adjugate[:, 0, 0], adjugate[:, 1, 1] = blocks[:, 1, 1], blocks[:, 0, 0]
    adjugate[:, 0, 1], adjugate[:, 1, 0] = -blocks[:, 0, 1], -blocks[:, 1, 0]
    determinant = blocks[:, 0, 0] * blocks[:, 1, 1] - blocks[:, 0, 1] * blocks[:, 1, 0]
    return adjugate / determinant[:, None, None]
