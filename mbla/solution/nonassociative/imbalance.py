"""What forces leave without balance, block by block: of a light block a share of its own load, not of the mean."""

from __future__ import annotations

import numpy as np

from mbla.program.program import Program
from mbla.solution.associative.repair import carried_loads
from mbla.solution.mechanics import lifted
from mbla.solution.nonassociative.law_state import LawState

NOTHING = 1e-6
"""What a block without weight carries, over the mean load, that is rounding."""


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
    while (program.guided or program.halved) and program.reduction is not None:
        left = np.asarray(program.reduction.velocities @ left)
        state, program = lifted(program, state), program.reduction.full
    rows = 3 if program.components == 2 else 6
    carried = carried_loads(program, state.forces).reshape(-1, rows).max(axis=1)
    weightless = ~program.dead_load.reshape(-1, rows).any(axis=1) & (carried < NOTHING)
    scale = np.clip(np.where(weightless, 1.0, carried), np.finfo(float).tiny, 1.0)
    return float((np.abs(left).reshape(-1, rows).max(axis=1) / scale).max(initial=0.0))
