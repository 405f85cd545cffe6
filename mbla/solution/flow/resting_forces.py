"""Forces of what does not move under given loads: any that carry them within the laws of points and interfaces."""

from __future__ import annotations

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.stiffness_shares import shares_of
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.flow.gravity_step import gravity_step
from mbla.solution.flow.settings import RATIOS
from mbla.solution.law.elastic_joints import ElasticJoints
from mbla.solution.law.interfaces import Interfaces
from mbla.solution.settings import SolverSettings
from mbla.solution.standing.standing import least_forces


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
