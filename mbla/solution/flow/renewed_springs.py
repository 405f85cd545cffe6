"""Springs that are renewed: where a structure rests whose blocks weak springs alone do not bring to rest.

Springs that are weak enough to carry nothing leave the system of equations of many sliding joints as good as singular,
as in soil of cells; stronger ones carry a share of the load. Springs that let go and take hold again where the blocks
have come to, with less stiffness each time, do neither::

    A x + f_D − ε S (u − ū) = 0,   ū the displacements that the springs before came to (Rockafellar 1976,
                                   doi:10.1137/0314056)

What they carry vanishes where the structure comes to rest, and stays where it goes on.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.solution.law.elastic_joints import StepState
from mbla.solution.law.joint_equations import JointStep

SOFTER, FIRMER, GENTLER = 0.3, 10.0, 0.5
"""Factor on the stiffness of springs from one renewal to the next; on that of springs with which the step was not
solved; and power of the first factor from there on."""

LESS, STILL = 0.5, 8
"""Share of what springs carry that a renewal leaves at most where they come nearer to nothing; renewals in a row that
do not before it is given up."""

MOST = 600
"""Factorisations from which on no springs are renewed."""

LIGHT = 1e-6
"""Share of the dead load of a block that springs carry of it at most where it stands, a third of what a verification
allows: cells of soil may have a thousandth of the mean load."""

Solve = Callable[[JointStep, StepState], tuple[StepState, bool, int]]
"""the state of a step from one nearby, whether it solves it, factorisations"""
Rest = Callable[[JointStep, StepState], tuple[StepState | None, int]]
"""the state at rest by a solved one, None where springs carry a share; factorisations"""


@dataclass(frozen=True)
class Renewed:
    """Where it has come to rest: step and state; None where it has not; factorisations."""

    step: JointStep
    state: StepState | None
    spent: int


def renewed_springs(step: JointStep, state: StepState, solve: Solve, rest: Rest) -> Renewed:
    """The state at rest by springs that are renewed.

    step, state : with the first springs, which hold the blocks where they were
    """
    factor, still, least, spent = SOFTER, 0, np.inf, 0
    while still < STILL and spent < MOST:
        softer = replace(step, held=factor * step.held, holds_at=state.u)
        there, solved, more = solve(softer, state)
        spent += more
        if not solved:
            step, factor, still = replace(step, held=FIRMER * step.held), factor**GENTLER, still + 1
            continue
        step, state = softer, there
        found, more = rest(step, state)
        spent += more
        if found is not None:
            return Renewed(step, found, spent)
        carried = _carried(step, state.u)
        still = 0 if carried < LESS * least else still + 1
        least = min(least, carried)
    return Renewed(step, None, spent)


def are_light(step: JointStep, state: StepState) -> bool:
    """Whether springs carry next to nothing of any block, over its own dead load; of guided blocks in their motions."""
    program = step.joints.program
    springs = np.asarray(step.held * (state.u - step.holds_at))[: len(program.dead_load)]
    if program.of_blocks is not None:
        lift = program.of_blocks
        program, springs = lift.full, lift.motion(springs)
    rows = 3 if program.components == 2 else 6
    own = np.abs(program.dead_load).reshape(-1, rows).max(axis=1)
    carried = np.abs(springs).reshape(-1, rows).max(axis=1)
    return bool((carried <= LIGHT * own)[own > 0.0].all())


def _carried(step: JointStep, u: FloatArray) -> float:
    """The greatest force of a spring."""
    return float(np.abs(step.held * (u - step.holds_at)).max(initial=0.0))
