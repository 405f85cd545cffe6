"""States on springs by limits of shear that lag behind the normal forces.

The limits are held at l = μN + c of the last iterate. What is left is the minimum of a convex function, which Newton's
method with a line search always finds; limits and minima alternate until Newton's method on the whole law takes over.
More friction takes thrust off a joint, and less brings it back: where limits swing to and fro in this way they move
only part of the way to those of the minimum.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.standing.spring_newton import newton_step, newtons_method
from mbla.solution.standing.spring_problem import SpringProblem, balanced, joints_at

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
    """Minima under limits of shear that follow the normal forces; whether they led there, and the last minimum."""
    limit, share, before = joints_at(problem, kappa, u, None).limit, 1.0, np.zeros(len(problem.limits.friction))
    for lag in range(1, LAGS + 1):
        if problem.late:
            break
        u = convex_minimum(problem, kappa, u, limit, AHEAD)
        misfit = joints_at(problem, kappa, u, None).limit - limit
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
    return float(np.linalg.norm(joints_at(problem, kappa, u, None).unbalanced))


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
