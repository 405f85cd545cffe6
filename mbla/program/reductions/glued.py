"""What glue saves: blocks that are one rigid body have the unknowns of one (:mod:`mbla.contacts.glue`).

It is no reduction that could be switched off. A glued joint has no law that would give its forces another value than
equilibrium leaves open, and no strength that could be reached: without merging there would be unknowns for forces that
nothing determines. Joints with finite strengths high enough give the same load factor, which the tests show.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.contacts.glue import Solids
from mbla.program.reductions.steps import ProgramSize, ReductionStep, StepState


def glued_step(solids: Solids, left: ProgramSize) -> ReductionStep:
    """Blocks that glue makes part of a larger body or holds; contact points inside of these were never set up.

    left : size of the program in which glued blocks are bodies
    """
    label, n_solids = solids.solid_of_block, len(solids.model.blocks)
    held = len(solids.contacts.report.held)
    joined = 0
    saved = held
    if label is not None:
        sizes = np.bincount(label)
        joined = int(sizes[sizes > 1].sum())
        saved += len(label) - n_solids
    unknowns = left.unknowns + 6 * saved
    before = replace(left, unknowns=unknowns, largest=unknowns)
    state = StepState.APPLIED if saved else StepState.NONE
    return ReductionStep("glued", state, joined + held, before, left)
