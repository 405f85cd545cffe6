"""Forces of what does not move under given loads: any that carry them within the laws of points and interfaces."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray
from mbla.program.program import Program
from mbla.program.reductions.restrict import ChosenPart
from mbla.program.stiffness_shares import shares_of
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.flow.gravity_step import gravity_step
from mbla.solution.flow.settings import RATIOS
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.interfaces import Interfaces
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.standing import least_forces

UNBALANCED = 0.01
"""Unbalanced force of a block, over the largest of all blocks, from which joints do not carry its loads."""


def resting_forces(program: Program, interfaces: Interfaces, settings: SolverSettings, log: Log) -> FloatArray | None:
    """Forces that carry the dead load of a program, (n_points, components); None where none were found.

    The least of all; where interfaces have a law of their own those of elastic joints without stress.
    """
    rows = interfaces.rows_of(program)
    if rows:
        at_rest = gravity_step(ElasticJoints.of(program, shares_of(program), RATIOS[0], interfaces=rows))
        return at_rest.state.forces if at_rest.carried else None
    carried = least_forces(program, settings, log)
    return None if isinstance(carried, ConeSolution) else carried


def rows_not_carried(part: ChosenPart, interfaces: Interfaces) -> BoolArray | None:
    """Rows of the blocks of a part that elastic joints do not carry, in the whole, (n_rows of the whole,).

    None where they carry all, or where that was not decided.
    """
    program = part.program
    joints = ElasticJoints.of(program, shares_of(program), RATIOS[0], interfaces=interfaces.rows_of(program))
    at_rest = gravity_step(joints)
    if not at_rest.settled or at_rest.carried:
        return None
    of_block = np.abs(joints.unbalanced(at_rest.state)[: len(program.dead_load)])
    of_block = of_block.reshape(-1, 3 if program.components == 2 else 6).max(axis=1)
    unbalanced = np.repeat(of_block > UNBALANCED * of_block.max(), len(program.dead_load) // len(of_block))
    return np.asarray(part.lifted(unbalanced) > 0.0)
