"""State of a stress-free assembly that weak springs hold, by the exact non-associative joint law.

Newton's method on the whole law (``spring_newton``) is tried first. Where it fails, limits of shear
are held and follow (``lagged_limits``); where that does not end either, the assembly moves there in
time (:mod:`mbla.solution.standing.dashpots`).
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.nonassociative.lagged_limits import by_lagged_limits
from mbla.solution.standing.dashpots import by_dashpots
from mbla.solution.standing.spring_newton import newtons_method
from mbla.solution.standing.spring_problem import SpringProblem, joints_at


def spring_state(problem: SpringProblem, kappa: float, starts: Sequence[FloatArray]) -> FloatArray | None:
    """Displacements, (n_rows,), in equilibrium on springs κ; None where they are not found.

    starts : displacements to start from, of which those nearest to balance are taken
    """
    start = min(starts, key=lambda u: float(np.linalg.norm(joints_at(problem, kappa, u, None).unbalanced)))
    found, u = newtons_method(problem, kappa, start)
    if not found:
        found, u = by_lagged_limits(problem, kappa, u)
    if not found:
        found, u = by_dashpots(problem, kappa, u)
    return u if found else None
