"""What forces leave without balance, block by block: of a light block a share of its own load, not of the mean."""

from __future__ import annotations

import numpy as np

from mbla.program.program import Program
from mbla.solution.nonassociative.collapse_state import CollapseState
from mbla.solution.proof.static_repair import carried_loads

NOTHING = 1e-6
"""What a block without weight carries, over the mean load, that is rounding."""


def imbalance(program: Program, state: CollapseState) -> float:
    """Largest unbalanced force of a block over what it has to balance, at most the mean load of a block.

    Of guided blocks only what does work in the motions that their guides allow counts.
    """
    forces, load = state.forces, program.dead_load + state.load_factor * program.live_load
    left = np.asarray(program.equilibrium_matrix @ forces.ravel() + load)
    if program.of_blocks is not None:
        lift = program.of_blocks
        program, forces, left = lift.full, lift.contact_forces(forces), lift.motion(left)
    rows = 3 if program.components == 2 else 6
    carried = carried_loads(program, forces).reshape(-1, rows).max(axis=1)
    weightless = ~program.dead_load.reshape(-1, rows).any(axis=1) & (carried < NOTHING)
    scale = np.clip(np.where(weightless, 1.0, carried), np.finfo(float).tiny, 1.0)
    return float((np.abs(left).reshape(-1, rows).max(axis=1) / scale).max(initial=0.0))
