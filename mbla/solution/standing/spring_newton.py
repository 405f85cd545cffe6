"""Semismooth Newton for a stress-free assembly that weak springs hold (:mod:`mbla.solution.standing.spring_problem`).

The method is that of Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X.
"""

from __future__ import annotations

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
    now = joints_at(problem, kappa, u, None)
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
        trial = joints_at(problem, kappa, u + size * step, None)
        here = float(np.linalg.norm(trial.unbalanced))
        if here < best[0]:
            best = (here, u + size * step, trial)
        if here < (1.0 - 1e-4 * size) * norm:
            break
        size *= 0.5
    return best[1], best[2]


def newton_step(problem: SpringProblem, kappa: float, joints: Joints, *, lagged: bool) -> FloatArray | None:
    """Newton's step, None where the tangent is singular."""
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
