"""State of a stress-free assembly that weak springs hold, by the exact non-associative joint law (``spring_problem``).

Semismooth Newton on the full law (Alart and Curnier 1991, doi:10.1016/0045-7825(91)90022-X) is tried first. Where it
fails the assembly moves there in time: dashpots η W act parallel to the springs, ::

    A x(v) + f − κ W u − η W (u − u_before) = 0

a state on springs κ + η, which is easy where η is large; u_before moves up to u, and η falls from step to step.
"""

from __future__ import annotations

from collections.abc import Sequence
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


@np.errstate(over="ignore", invalid="ignore")  # steps that diverge are seen and given up
def newtons_method(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Newton's method on the full law; whether it converged, and the iterate nearest to balance.

    Steps are shortened until they come nearer to balance. At a kink of the law none may: then the shortened step that
    is left nearest is taken all the same, a few times in a row, for beyond the kink it often converges.
    """
    now = joints_at(problem, kappa, u)
    nearest, least, uphill = u, float(np.linalg.norm(now.unbalanced)), 0
    for _ in range(NEWTON_STEPS):
        if balanced(problem, kappa, u, now):
            return True, u
        step = None if problem.late else newton_step(problem, kappa, now)
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


def newton_step(problem: SpringProblem, kappa: float, joints: Joints) -> FloatArray | None:
    """Newton's step, (n_rows,), None where the tangent is singular."""
    stiffness = None if problem.pattern is None else problem.pattern.next()
    if stiffness is not None:
        tangents, shift = joint_stiffness(problem, joints), kappa * problem.springs.diagonal()
        solve = stiffness.factorized(tangents, shift, fixed_load=True)
        if solve is None:
            return None
        step = -solve(np.append(joints.unbalanced, 0.0))[:-1]
        return step if np.isfinite(step).all() else None
    matrix = stiffness_at(problem, kappa, joints)
    factors = factors_on_the_diagonal(matrix, 0.01)
    if factors is None:
        return None
    step = factors.solve(joints.unbalanced)
    step = step + factors.solve(joints.unbalanced - matrix @ step)  # springs are 1e-12 of the joints
    return step if np.isfinite(step).all() else None


DASHPOT_STEPS, MOST_REFUSED = 60, 20
"""Steps in time at one κ, with those that are not found, and the most of these."""

DASHPOT, STRONGER, WEAKER, TRY_DASHPOTS_EVERY = 1.0, 4.0, 0.3, 4
"""η of the first step; what it is multiplied by where no state is found, and where one is; and the steps after which
Newton's method is tried without dashpots. Of nine walls with openings all were settled with these."""


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
        found, u = by_dashpots(problem, kappa, u)
    return u if found else None
