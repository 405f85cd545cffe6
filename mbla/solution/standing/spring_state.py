"""State of a stress-free assembly that weak springs hold, by the exact non-associative joint law (``spring_problem``).

Semismooth Newton on the whole law (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X) is tried first. Where it
fails, limits of shear lag behind the normal forces: they are held at l = μN + c of the last iterate. What is left is
the minimum of a convex function, which Newton's method with a line search always finds; limits and minima alternate
until Newton's method on the whole law takes over. More friction takes thrust off a joint, less brings it back: where
limits swing to and fro in this way they move only part of the way to those of the minimum. Where that does not end
either, the assembly moves there in time: dashpots η W act beside the springs, ::

    A x(v) + f − κ W u − η W (u − u_before) = 0

a state on springs κ + η, which is easy where η is large; u_before moves up to u, and η falls from step to step.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.linear_algebra.superlu import factors_on_the_diagonal
from mbla.solution.standing.spring_problem import (
    Joints,
    SpringProblem,
    balanced,
    joint_stiffness,
    joints_at,
    stiffness_at,
)

NEWTON_STEPS = 40

BACKTRACKS = 8

MOST_UPHILL = 2
"""Steps in a row of Newton's method that need not come nearer to balance than any before."""


def newtons_method(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Newton's method on the whole law; whether it converged, and the iterate nearest to balance.

    Steps are shortened until they come nearer to balance. At a kink of the law none may: then the shortened step that
    is left nearest is taken all the same, a few times in a row, for on its other side the way often goes on.
    """
    now = joints_at(problem, kappa, u)
    nearest, least, uphill = u, float(np.linalg.norm(now.unbalanced)), 0
    for _ in range(NEWTON_STEPS):
        if balanced(problem, kappa, u, now):
            return True, u
        step = None if problem.late else newton_step(problem, kappa, now, lagged=False)
        if step is None:
            return False, nearest
        u, now = _backtracked(problem, kappa, u, step, now)
        norm = float(np.linalg.norm(now.unbalanced))
        if norm < least:
            nearest, least, uphill = u, norm, 0
        elif (uphill := uphill + 1) > MOST_UPHILL:
            return False, nearest
    return balanced(problem, kappa, u, now), u


def _backtracked(
    problem: SpringProblem, kappa: float, u: FloatArray, step: FloatArray, now: Joints
) -> tuple[FloatArray, Joints]:
    """The first of ever shorter steps that comes nearer to balance, or else the one that comes nearest."""
    norm = float(np.linalg.norm(now.unbalanced))
    size, best = 1.0, (np.inf, u, now)
    for _ in range(BACKTRACKS):
        trial = joints_at(problem, kappa, u + size * step)
        here = float(np.linalg.norm(trial.unbalanced))
        if here < best[0]:
            best = (here, u + size * step, trial)
        if here < (1.0 - 1e-4 * size) * norm:
            break
        size *= 0.5
    return best[1], best[2]


def newton_step(problem: SpringProblem, kappa: float, joints: Joints, *, lagged: bool) -> FloatArray | None:
    """Newton's step, (n_rows,), None where the tangent is singular."""
    stiffness = None if problem.pattern is None else problem.pattern.next()
    if stiffness is not None:
        tangents, shift = joint_stiffness(problem, joints, lagged), kappa * problem.springs.diagonal()
        solve = stiffness.factorized(tangents, shift, fixed_load=True)
        if solve is None:
            return None
        step = -solve(np.append(joints.unbalanced, 0.0))[:-1]
        return step if np.isfinite(step).all() else None
    matrix = stiffness_at(problem, kappa, joints, lagged)
    factors = factors_on_the_diagonal(matrix, 0.01)
    if factors is None:
        return None
    step = factors.solve(joints.unbalanced)
    step = step + factors.solve(joints.unbalanced - matrix @ step)  # springs are 1e-12 of the joints
    return step if np.isfinite(step).all() else None


LAGS, TRY_EVERY = 9, 3
"""Times that the limits of shear are brought up to date at one κ; Newton's method is tried after every third."""

LEAST_MOVE = 0.1
"""Least share of their way that limits of shear move: it is halved where they turn back, and grows by half where not.
Limits that swing by −q each time come to rest where the share is below 2/(1 + q)."""

CONVEX_STEPS = 30

AHEAD = 0.01
"""Unbalanced force under limits that are held, over that under the joints' own limits, from which on the limits have to
move before anything comes nearer to balance."""

LINE_STEPS = 20

FLAT = 0.5
"""Share of the slope along a search direction that may be left where a line search ends."""


def by_lagged_limits(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Minima under limits of shear that follow the normal forces; whether they led there, and the last minimum.

    u : (n_rows,) displacements to start from
    """
    limit, share, before = joints_at(problem, kappa, u).state.limit, 1.0, np.zeros(len(problem.limits.friction))
    for lag in range(1, LAGS + 1):
        if problem.late:
            break
        u = convex_minimum(problem, kappa, u, limit, AHEAD)
        misfit = joints_at(problem, kappa, u).state.limit - limit
        share = max(0.5 * share, LEAST_MOVE) if misfit @ before < 0.0 else min(1.5 * share, 1.0)
        limit, before = limit + share * misfit, misfit
        if lag % TRY_EVERY == 0:
            found, near = newtons_method(problem, kappa, u)
            if found:
                return True, near
    return False, u


def convex_minimum(
    problem: SpringProblem, kappa: float, u: FloatArray, limit: FloatArray, enough: float = 0.0
) -> FloatArray:
    """Equilibrium under given limits of shear, (n_points,), from u; the unbalanced force is the negative gradient.

    enough : unbalanced force that may be left, over that under the joints' own limits: it is not worth while to find
             the minimum any better than the limits are known
    """
    now = joints_at(problem, kappa, u, limit)
    for _ in range(CONVEX_STEPS):
        if balanced(problem, kappa, u, now) or np.linalg.norm(now.unbalanced) <= enough * _own_norm(problem, kappa, u):
            break
        step = newton_step(problem, kappa, now, lagged=True)
        if step is None:
            break
        descent = float(now.unbalanced @ step)
        if not descent > 0.0:
            break

        def slope_at(size: float, u: FloatArray = u, step: FloatArray = step) -> float:
            return -float(joints_at(problem, kappa, u + size * step, limit).unbalanced @ step)

        u = u + _line_minimum(slope_at, descent) * step
        now = joints_at(problem, kappa, u, limit)
    return u


def _own_norm(problem: SpringProblem, kappa: float, u: FloatArray) -> float:
    """Norm of the unbalanced force under the joints' own limits."""
    return float(np.linalg.norm(joints_at(problem, kappa, u).unbalanced))


def _line_minimum(slope_at: Callable[[float], float], descent: float) -> float:
    """Size of a step at which a convex function, of slope −descent at zero, is nearly flat; 1 wherever that will do."""
    lower, lower_slope, upper, size = 0.0, -descent, np.inf, 1.0
    for _ in range(LINE_STEPS):
        slope = slope_at(size)
        if slope <= FLAT * descent and (upper == np.inf or slope >= -FLAT * descent):
            break
        if slope > 0.0:
            upper, upper_slope = size, slope
        else:
            lower, lower_slope = size, slope
        share = -lower_slope / (upper_slope - lower_slope)
        size = lower + (upper - lower) * min(max(share, 0.1), 0.9)
    return size


DASHPOT_STEPS, MOST_REFUSED = 60, 20
"""Steps in time at one κ, with those that are not found, and the most of these."""

DASHPOT, STRONGER, WEAKER, TRY_DASHPOTS_EVERY = 1.0, 4.0, 0.3, 4
"""η of the first step; what it is multiplied by where no state is found, and where one is; and the steps after which
Newton's method is tried without dashpots. Of nine walls with openings all were settled with these, two to five with
springs alone."""


def by_dashpots(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Steps in time with ever weaker dashpots; whether they led there, and the last state.

    u : (n_rows,) displacements to start from
    """
    eta, steps, refused = DASHPOT, 0, 0
    while steps + refused < DASHPOT_STEPS and refused < MOST_REFUSED and not problem.late:
        held = replace(problem, load=problem.load + eta * (problem.springs @ u), on_the_way=False)
        found, near = newtons_method(held, kappa + eta, u)
        if not found:
            eta, refused = STRONGER * eta, refused + 1
            continue
        u, eta, steps = near, WEAKER * eta, steps + 1
        if eta < kappa or steps % TRY_DASHPOTS_EVERY == 0:
            found, near = newtons_method(problem, kappa, u)
            if found:
                return True, near
    return False, u


def spring_state(problem: SpringProblem, kappa: float, starts: Sequence[FloatArray]) -> FloatArray | None:
    """Displacements, (n_rows,), in equilibrium on springs κ; None where they are not found.

    starts : displacements to start from, of which those nearest to balance are taken
    """
    start = min(starts, key=lambda u: float(np.linalg.norm(joints_at(problem, kappa, u).unbalanced)))
    found, u = newtons_method(problem, kappa, start)
    if not found:
        found, u = by_lagged_limits(problem, kappa, u)
    if not found:
        found, u = by_dashpots(problem, kappa, u)
    return u if found else None
