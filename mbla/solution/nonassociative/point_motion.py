"""What the contact points do in a state of the joint law: who opens, crushes and slides, and in which direction.

The law leaves one of two small at every point: opening velocity or normal force, sliding velocity or reserve of shear.
In numbers neither is zero, so that pairs of ratios are compared, velocities over the largest contact speed and forces
over the largest of their kind::

    opens    v_N / v_max > (N + f_t) / N_max          slides   ‖v_T‖ / v_max > (μN + c − ‖T‖) / (μN + c)_max

Points that just touch, with both below ``touching``, are counted as at rest: the mechanism then leaves their force
free, which is what it says of a velocity that is zero. If it was not zero, forces found with it miss the law and show
that in their residual; a motion that is only noise would go unnoticed.

Sparse mechanisms fit given forces under the joint law without dilatancy, as vertices of a linear program. Forces say
what each contact point may do: open only where N = −f_t, crush only where N = f_c, slide only where the shear is at its
limit, and then against it. The velocities that keep to this form a polyhedron; a random cost that is positive on every
opening and sliding velocity picks a vertex, a mechanism in which few points move::

    min Σ w v_N + Σ w s   s.t.   f_L·u = 1,   v_N = 0 or ≥ 0 or ≤ 0,   v_T = 0, free where there is no strength,
                                 or v_T = −s T/‖T‖ up to a small turn |v_across| ≤ κ s,  s ≥ 0

Forces that are near their limits by a share of the largest may be counted as at them: the mechanism then fits forces
nearby, if there are such.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import BoolArray, FloatArray
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.static import PointMotion
from mbla.solution.cone_solvers.highs_adapter import HighsProgram
from mbla.solution.nonassociative.law_state import LawState
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import Status


def point_motion(program: Program, state: LawState, touching: float, slope: FloatArray | float = 0.0) -> PointMotion:
    """Motion of every point in a state.

    touching : velocity over the largest contact speed below which a point is at rest
    slope    : dilatancy of the flow rule (tangent), (n_points,) or one for all: a sliding point opens with that share
               of its sliding velocity
    """
    limits, forces = program.limits, state.forces
    v = (program.equilibrium_matrix.T @ state.velocities).reshape(-1, program.components)
    speed = max(float(np.linalg.norm(v, axis=1).max(initial=0.0)), 1e-300)
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    surplus = (v[:, 0] - slope * sliding) / speed
    largest = max(float(np.abs(forces[:, 0]).max(initial=0.0)), 1e-300)
    strength = np.maximum(limits.cohesion + limits.friction * forces[:, 0], 0.0)
    strongest = max(float(strength.max(initial=0.0)), 1e-300)
    shear = np.linalg.norm(forces[:, 1:], axis=1)
    reserve = np.maximum(strength - shear, 0.0) / strongest
    opens = surplus > np.maximum((forces[:, 0] + limits.tension) / largest, touching)
    crushable = np.isfinite(limits.compression)
    unused = np.where(crushable, limits.compression - forces[:, 0], np.inf) / largest
    return PointMotion(
        opens=opens,
        crushes=~opens & (-surplus > np.maximum(unused, touching)),
        slides=sliding / speed > np.maximum(reserve, touching),
        shear=_shear_direction(v[:, 1:], sliding / speed, forces[:, 1:], shear / strongest),
    )


def _shear_direction(v: FloatArray, speed: FloatArray, shear: FloatArray, size: FloatArray) -> FloatArray:
    """Direction of the shear from the force or against the velocity, whichever is larger in its kind.

    The error of the power is of the second order in the angle between them. With the direction of the forces that were
    found, those forces stay among the ones compatible with the mechanism.
    """
    of_force = shear / np.maximum(np.linalg.norm(shear, axis=1), 1e-300)[:, None]
    of_velocity = -v / np.maximum(np.linalg.norm(v, axis=1), 1e-300)[:, None]
    return np.asarray(np.where((size > speed)[:, None], of_force, of_velocity))


def motion_of(program: Program, velocities: FloatArray, at_rest: float) -> PointMotion:
    """Motion of every point in a mechanism without dilatancy whose velocities are exact.

    velocities : (n_rows,)  non-dimensional
    at_rest    : velocity over the largest contact speed below which a point is at rest
    """
    v = (program.equilibrium_matrix.T @ velocities).reshape(-1, program.components)
    least = at_rest * float(np.linalg.norm(v, axis=1).max(initial=0.0))
    sliding = np.linalg.norm(v[:, 1:], axis=1)
    return PointMotion(
        opens=v[:, 0] > least,
        crushes=(v[:, 0] < -least) & np.isfinite(program.limits.compression),
        slides=sliding > least,
        shear=-v[:, 1:] / np.maximum(sliding, 1e-300)[:, None],
    )


@dataclass(frozen=True)
class Nearness:
    """How near to its limit a force counts as at it, as a share of the largest, and how far sliding may turn [rad]."""

    force: float
    turn: float


@dataclass(frozen=True)
class _Allowed:
    """What the points may do; a point that is weak has no strength to speak of and slides freely."""

    opens: BoolArray
    crushes: BoolArray
    slides: BoolArray
    weak: BoolArray


def sparse_mechanism(
    program: Program, forces: FloatArray, near: Nearness, weights: FloatArray, speed: float, settings: SolverSettings
) -> FloatArray | None:
    """Velocities, (n_rows,), with live load power 1, that fit the forces; None where the solver finds none.

    forces  : (n_points, components)
    weights : (n_points,) cost of the motion of each point, positive
    speed   : size of contact velocities to expect: the solver's tolerances are absolute
    """
    allowed = _allowed(program, forces, near)
    cone_program = _linear_program(program, forces, allowed, near.turn, weights, speed)
    solution = HighsProgram(cone_program, settings, lambda record: None).solve(0, 0.0)
    if solution.status is not Status.SOLVED:
        return None
    velocities = solution.x[: len(program.dead_load)]
    return np.asarray(velocities / float(program.live_load @ velocities))


def _allowed(program: Program, forces: FloatArray, near: Nearness) -> _Allowed:
    limits = program.limits
    largest = near.force * float(np.abs(forces[:, 0]).max(initial=0.0))
    strength = limits.cohesion + limits.friction * forces[:, 0]
    strongest = near.force * float(strength.max(initial=0.0))
    weak = strength <= strongest
    return _Allowed(
        opens=forces[:, 0] + limits.tension <= largest,
        crushes=limits.compression - forces[:, 0] <= largest,
        slides=~weak & (strength - np.linalg.norm(forces[:, 1:], axis=1) <= strongest),
        weak=weak,
    )


def _linear_program(
    program: Program, forces: FloatArray, allowed: _Allowed, turn: float, weights: FloatArray, speed: float
) -> ConeProgram:
    """Unknowns u and the sliding velocities s; equations, then half-lines ``matrix x ≤ rhs``."""
    c, velocity = program.components, sp.csr_array(program.equilibrium_matrix.T)
    opens, crushes, slides = (np.flatnonzero(part) for part in (allowed.opens, allowed.crushes, allowed.slides))
    pressed = np.flatnonzero(~allowed.opens & ~allowed.crushes)
    stuck = np.flatnonzero(~allowed.slides & ~allowed.weak)
    n_slides = len(slides)
    none, unit = sp.csr_array((n_slides, velocity.shape[1])), sp.eye_array(n_slides, format="csr")
    along, across = _of_sliding(program, velocity, forces, slides)
    equations = [
        _wide(sp.csr_array(program.live_load[None, :]), n_slides),
        _wide(velocity[c * pressed], n_slides),
        *(_wide(velocity[c * stuck + j], n_slides) for j in range(1, c)),
        sp.hstack([along, -unit]),
    ]
    turns = [] if across is None else [sp.hstack([sign * across, -turn * unit]) for sign in (1.0, -1.0)]
    half_lines = [
        _wide(-velocity[c * opens], n_slides),
        _wide(velocity[c * crushes], n_slides),
        sp.hstack([none, -unit]),
        *turns,
    ]
    n_equations = sum(part.shape[0] for part in equations)
    matrix = sp.csc_array(sp.vstack([*equations, *half_lines]))
    cost_of_u = velocity[c * opens].T @ weights[opens] - velocity[c * crushes].T @ weights[crushes]
    rhs = np.zeros(matrix.shape[0])
    rhs[0] = 1.0 / speed
    return ConeProgram(
        cost=np.concatenate([cost_of_u, weights[slides]]),
        matrix=matrix,
        rhs=rhs,
        n_half_lines=matrix.shape[0] - n_equations,
        n_cones=0,
        n_equations=n_equations,
    )


def _of_sliding(
    program: Program, velocity: sp.csr_array, forces: FloatArray, slides: np.typing.NDArray[np.int64]
) -> tuple[sp.csr_array, sp.csr_array | None]:
    """Rows of the sliding velocity against the shear, and of that across it (none in a plane)."""
    c, shear = program.components, forces[slides, 1:]
    direction = -shear / np.maximum(np.linalg.norm(shear, axis=1), 1e-300)[:, None]
    first = velocity[c * slides + 1]
    if c == 2:
        return sp.csr_array(sp.diags_array(direction[:, 0]) @ first), None
    second = velocity[c * slides + 2]
    one, two = sp.diags_array(direction[:, 0]), sp.diags_array(direction[:, 1])
    return sp.csr_array(one @ first + two @ second), sp.csr_array(one @ second - two @ first)


def _wide(rows: sp.csr_array, n_slides: int) -> sp.csr_array:
    """Rows in u as rows in all unknowns."""
    return sp.csr_array(sp.hstack([rows, sp.csr_array((rows.shape[0], n_slides))]))
