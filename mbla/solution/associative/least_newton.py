"""Least forces by Newton's method on the multipliers, exact to rounding, from a mechanism and forces nearly least.

Of the forces at collapse those are asked for which, with a small ε, solve ::

    min ½ ε Σ w_k ‖x_k‖² − λ    s.t.   A x + f_D + λ f_L = 0,   x_k within its yield conditions C_k

Its dual has no constraint but f_L·u = 1, and what is best for given u is a projection. With u = u* + ε p about the
mechanism u* found, f_L·p = 0::

    x_k = P_k(−(v*_k/ε + (Aᵀp)_k)/w_k),      A x(p) + f_D + λ f_L = 0

with P the projection on C_k: points that open are without force, points that slide at the edge of friction, by
themselves and without a threshold between what moves and what is at rest. These equations are the derivative of a
convex function and are solved by semismooth Newton (Qi and Sun 1993, doi:10.1007/BF01581275) with a shift of the
diagonal that grows where a step leads uphill and vanishes near the solution. v*/ε is a million times what p adds to it:
the difference of the two parts of a sliding force, −v_N + μ ‖v_T‖, is formed once for v* and by its change for p, or
rounding would leave 1e-7 of a block load unbalanced.
"""

from __future__ import annotations

import time
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.joint_law import JointState, joint_tangents

BALANCED = 1e-10
"""Unbalanced force, in mean block loads, at which the equations count as solved."""

NEARLY = 1e-6
"""Unbalanced force from which on a few steps that bring nothing end the search: the rest is rounding."""

IDLE = 3
"""Those steps."""

FIRST_SHIFT, LEAST_SHIFT, MOST_SHIFT = 1e-4, 1e-11, 1e4
"""Shift of the diagonal, over the stiffness of every row when all joints stick."""

LESS, MORE = 0.1, 100.0
"""Its change after a full step, and after one that led uphill at any length."""

LENGTHS = 6
"""Lengths of one step that are tried."""

UPHILL = 0.5
"""Slope at the end of a step, over that at its beginning, up to which it is taken: the function is convex, and a step
beyond its lowest point on the line by less than that has gone down nearly as far."""


@dataclass(frozen=True)
class LeastProblem:
    """What the equations are made of.

    velocities : (n_rows,) u*, with f_L·u* = 1
    weights    : (n_points,) w
    epsilon    : ε
    """

    stiffness: Stiffness
    velocities: FloatArray
    weights: FloatArray
    epsilon: float

    @property
    def program(self) -> Program:
        """The program whose forces they are."""
        return self.stiffness.program


@dataclass(frozen=True)
class LeastFound:
    """Where Newton's method ended.

    multipliers : (n_rows,) p
    forces      : (n_points, components), within the yield conditions
    unbalanced  : largest unbalanced force, in mean block loads
    steps       : factorisations
    """

    multipliers: FloatArray
    forces: FloatArray
    load_factor: float
    unbalanced: float
    steps: int


@dataclass(frozen=True)
class _Far:
    """Trial forces of the mechanism alone, −v*/(ε w), and what of them needs all its digits.

    forces  : (n_points, components)
    shear   : (n_points,) size of their shear
    surplus : (n_points,) N + μ ‖T‖
    least   : (n_points,) least normal force that the yield conditions allow
    """

    forces: FloatArray
    shear: FloatArray
    surplus: FloatArray
    least: FloatArray


def least_by_newton(
    problem: LeastProblem, multipliers: FloatArray, load_factor: float, most_steps: int, deadline: float | None = None
) -> LeastFound:
    """Solve the equations from multipliers p, (n_rows,), and a load factor.

    deadline : of ``time.monotonic``

    The last iterate is returned; whether it is good enough ``unbalanced`` says.
    """
    program, stiffness, far = problem.program, problem.stiffness, _far(problem)
    live = program.live_load
    diagonal = stiffness.size / float(problem.weights.mean())
    p = multipliers - live * (live @ multipliers) / (live @ live)
    state, balance = _at(problem, far, p)
    shift, steps, idle, best = FIRST_SHIFT, 0, 0, np.inf
    while True:
        unbalanced = balance + load_factor * live
        size = float(np.abs(unbalanced).max(initial=0.0))
        idle = 0 if size < 0.5 * best else idle + 1
        best = min(best, size)
        late = deadline is not None and time.monotonic() > deadline
        if size <= BALANCED or steps >= most_steps or shift > MOST_SHIFT or late or (best < NEARLY and idle > IDLE):
            return LeastFound(p, state.forces, load_factor, size, steps)
        tangents = joint_tangents(program, program.limits.friction, 1.0, state) / problem.weights[:, None, None]
        solve = stiffness.factorized(tangents, shift * diagonal)
        steps += 1
        step = None if solve is None else solve(-np.append(unbalanced, 0.0))
        taken = None if step is None else _along(problem, far, p, step, balance, unbalanced)
        if step is None or taken is None:
            shift = MORE * shift
            continue
        length, p, state, balance = taken
        load_factor += float(step[-1])
        shift = max(shift * (LESS if length == 1.0 else 1.0 if length > 0.2 else 4.0), LEAST_SHIFT)


def _along(
    problem: LeastProblem,
    far: _Far,
    p: FloatArray,
    step: FloatArray,
    balance: FloatArray,
    unbalanced: FloatArray,
) -> tuple[float, FloatArray, JointState, FloatArray] | None:
    """The length of a step, and what is there; None where it leads uphill at any length."""
    if not np.isfinite(step).all():
        return None
    live, way, change = problem.program.live_load, step[:-1], float(step[-1])
    before, norm = abs(float(balance @ way)), float(np.linalg.norm(unbalanced))
    predicted = unbalanced - balance + change * live
    length = 1.0
    for _ in range(LENGTHS):
        state, there = _at(problem, far, p + length * way)
        slope = -float(there @ way)
        if slope <= UPHILL * before or np.linalg.norm(there + predicted) <= UPHILL * norm:
            return length, p + length * way, state, there
        length *= max(before / (before + slope), 0.1)
    return None


def _far(problem: LeastProblem) -> _Far:
    limits = problem.program.limits
    forces = -problem.stiffness.velocities(problem.velocities) / (problem.epsilon * problem.weights)[:, None]
    shear = np.linalg.norm(forces[:, 1:], axis=1)
    apex = np.where(limits.friction > 0.0, limits.cohesion / np.maximum(limits.friction, 1e-300), np.inf)
    return _Far(forces, shear, forces[:, 0] + limits.friction * shear, -np.minimum(limits.tension, apex))


def _at(problem: LeastProblem, far: _Far, p: FloatArray) -> tuple[JointState, FloatArray]:
    """Projected forces at multipliers p, and A x + f_D."""
    program = problem.program
    limits, friction = program.limits, program.limits.friction
    near = -problem.stiffness.velocities(p) / problem.weights[:, None]
    trial = far.forces + near
    size = np.linalg.norm(trial[:, 1:], axis=1)
    direction = trial[:, 1:] / np.maximum(size, 1e-300)[:, None]
    longer = ((far.forces[:, 1:] + trial[:, 1:]) * near[:, 1:]).sum(axis=1) / np.maximum(size + far.shear, 1e-300)
    normal = np.clip(trial[:, 0], far.least, limits.compression)
    slips = size > np.maximum(friction * normal + limits.cohesion, 0.0)
    sliding = far.surplus + near[:, 0] + friction * (longer - limits.cohesion)
    sliding = np.where(slips, sliding / (1.0 + friction**2), trial[:, 0])
    normal = np.clip(sliding, far.least, limits.compression)
    limit = np.maximum(friction * normal + limits.cohesion, 0.0)
    shear = np.where(slips, limit, size)[:, None] * direction
    state = JointState(np.column_stack([normal, shear]), direction, size, limit, slips, normal == sliding)
    return state, program.equilibrium_matrix @ state.forces.ravel() + program.dead_load
