"""Strengths that nothing comes near: they are solved as smaller ones, with the same answer.

A capacity of 1e12 N that is meant as no limit is a number of the program beside the weights of blocks, and the solver
has no digits left for these. Strengths of contact points and ties count here as ``REACH`` times the dead load of all
blocks at most. Forces within smaller strengths are within the true ones, so that what they prove holds. A state whose
forces stay away from these limits gives way nowhere else than with the true ones. Where forces come near them, the true
strengths are solved with.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program

REACH = 1e4
"""Strengths that count, over the dead load of all blocks."""

NEAR = 0.1
"""Share of these that forces do not come beyond: friction multiplies what a normal force holds."""


def within_reach(program: Program) -> Program | None:
    """The program with strengths of no more than what counts; None where all of them are, or there is no dead load."""
    limits, most = program.limits, _most(program)
    finite = [np.where(np.isfinite(each), each, 0.0) for each in (limits.cohesion, limits.tension, limits.compression)]
    if not most > 0.0 or max(float(each.max(initial=0.0)) for each in finite) <= most:
        return None
    return replace(program, limits=limits.at_most(most))


def stays_within(program: Program, forces: FloatArray) -> bool:
    """Whether forces, (n_points, components), stay away from the strengths that count."""
    return bool(np.abs(forces).max(initial=0.0) <= NEAR * _most(program))


def _most(program: Program) -> float:
    return REACH * float(np.abs(program.dead_load).sum())
