"""From a point near the end of the path to a state of the exact law.

A point of the path keeps a small force at every open joint and a small slip at every sticking one. Steps of the exact
law (``joint_law``) anchored at its forces close what is left: where the path has come close enough
they converge within a few factorisations, to rounding.
"""

from __future__ import annotations

import numpy as np

from mbla.program.program import Program
from mbla.solution.linear_algebra.stiffness import Stiffness
from mbla.solution.nonassociative.interior_path.central_path import with_balance
from mbla.solution.nonassociative.joint_law import exact_step
from mbla.solution.nonassociative.law_state import LawState, law_state

STEPS = (1e-2, 1e-1, 1.0)
"""ρ ‖x̄‖² of the exact steps, tried in turn: the smaller, the further a step may move."""

MOST_STEPS = 6
MOST_FACTORIZATIONS = 30
EXACT = 1e-12
"""Residual at which nothing is left to gain."""

IMPROVES = 1e-1
"""A step that does not reduce the residual to this share of the one before is the last with its ρ."""


def polished(program: Program, stiffness: Stiffness, state: LawState, sizes: tuple[float, ...]) -> tuple[LawState, int]:
    """The best state that exact steps reach from a state, itself where none is better; and the factorisations.

    sizes : ρ ‖x̄‖² to try in turn
    """
    slope, best, count = np.zeros(program.n_points), state, 0
    for size in sizes:
        current, reached = state, float("inf")
        for _ in range(MOST_STEPS):
            anchor = current.forces
            rho = size / max(float((anchor**2).sum()), 1e-300)
            step = exact_step(
                stiffness, slope, anchor, rho, current.velocities, current.load_factor, MOST_FACTORIZATIONS
            )
            count += step.factorizations
            current = with_balance(program, law_state(program, 0.0, step.forces, step.velocities, step.load_factor))
            if current.residual < best.residual:
                best = current
            if best.residual <= EXACT or current.residual > IMPROVES * reached:
                break
            reached = current.residual
        if best.residual <= EXACT:
            break
    return best, count
