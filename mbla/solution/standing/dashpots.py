"""States on springs by motion in time: dashpots η W act beside the springs, ::

    A x(v) + f − κ W u − η W (u − u_before) = 0

a state on springs κ + η, which is easy where η is large; u_before moves up to u, and η falls from step to step.
"""

from __future__ import annotations

from dataclasses import replace

from mbla.arrays import FloatArray
from mbla.solution.standing.spring_newton import newtons_method
from mbla.solution.standing.spring_problem import SpringProblem

DASHPOT_STEPS, MOST_REFUSED = 60, 20
"""Steps in time at one κ, with those that are not found, and the most of these."""

DASHPOT, STRONGER, WEAKER, TRY_DASHPOTS_EVERY = 1.0, 4.0, 0.3, 4
"""η of the first step; what it is multiplied by where no state is found, and where one is; and the steps after which
Newton's method is tried without dashpots. Of nine walls with openings all were settled with these, two to five with
springs alone."""


def by_dashpots(problem: SpringProblem, kappa: float, u: FloatArray) -> tuple[bool, FloatArray]:
    """Steps in time with ever weaker dashpots; whether they led there, and the last state."""
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
