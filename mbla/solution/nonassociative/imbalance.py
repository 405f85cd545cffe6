"""What forces leave without balance, block by block: of a light block a share of its own load, not of the mean."""

from __future__ import annotations

import numpy as np

from mbla.program.program import Program
from mbla.solution.associative.repair import carried_loads
from mbla.solution.mechanics import lifted
from mbla.solution.nonassociative.law_state import LawState

NOTHING = 1e-11
"""Load of a block, over the mean, that is rounding: a block without weight that carries no other."""


def misfit(program: Program, state: LawState) -> float:
    """Residual of a state with its unbalanced force, the latter block by block."""
    return max(state.residual, imbalance(program, state))


def imbalance(program: Program, state: LawState) -> float:
    """Largest unbalanced force of a block over what it has to balance, at most the mean load of a block.

    Of guided blocks only what does work in the motions that their guides allow counts.
    """
    while program.halved and not program.guided and program.reduction is not None:
        state, program = lifted(program, state), program.reduction.full
    left = np.asarray(
        program.equilibrium_matrix @ state.forces.ravel() + program.dead_load + state.load_factor * program.live_load
    )
    if program.guided and program.reduction is not None:
        left, program = program.reduction.velocities @ left, program.reduction.full
    rows = 3 if program.components == 2 else 6
    carried = carried_loads(program, state.forces).reshape(-1, rows).max(axis=1)
    scale = np.where(carried > NOTHING, np.minimum(carried, 1.0), 1.0)
    return float((np.abs(left).reshape(-1, rows).max(axis=1) / scale).max(initial=0.0))
