"""The motion that proves that the dead load is not carried, in which only moves what falls.

A cone program without equilibrium ends on some motion in which the dead load does more work than the joints dissipate.
Any multiple of it, and anything that costs less than it gains, may be mixed in: a wall from which one lintel falls
moves as a whole. The motion that gains most over its own size::

    min  ½ uᵀW u − f_D·u + dissipation(v)   s.t.   v = Aᵀu compatible with the yield conditions

has none of that: W u is the least load, over the sizes of the blocks' loads, that would have to be taken off for the
rest to be carried, so that what stands is at rest. It always has a solution, zero where the dead load is carried.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import kinematic_form
from mbla.program.program import Program
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.proof.bounds import dissipation
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE
from mbla.solution.thresholds import LOCKED_IN

FALL_TOLERANCE = 1e-12
"""Of the program: a load that is not carried by 1e-6 of itself shows then, at 1e-10 only one by 1e-4."""

AT_REST = 1e-7
"""Share of the largest velocity below which a block is at rest in the steepest fall."""

CARRIED_SHARE = 1e-7
"""Share of a block's load that would have to be taken off, below which the dead load is carried up to rounding."""


def steepest_fall(program: Program, settings: SolverSettings, log: Log) -> FloatArray | None:
    """The motion in which the dead load gains most, largest entry 1; None where nothing falls.

    (n_rows,) of the blocks, unknowns of conditions on interfaces behind.

    Blocks that stand are at rest in it. It is compatible with the yield conditions up to rounding.
    """
    if not np.any(program.dead_load):
        return None
    form = kinematic_form(program, program.limits)
    given = form.cone_program
    sizes = _sizes_of_loads(program).diagonal()
    quadratic = np.concatenate([sizes, np.zeros(len(given.cost) - len(sizes))])
    without_live_load = replace(
        given, matrix=sp.csc_array(given.matrix[1:]), rhs=given.rhs[1:], n_equations=0, quadratic=quadratic, n_local=0
    )
    exact = replace(settings, tolerance=min(settings.tolerance, FALL_TOLERANCE))
    solution = cone_solver(without_live_load, exact, log).solve(1, 0.0)
    blocks = np.arange(len(program.dead_load))
    velocities = form.all_velocities(solution.x)
    largest = float(np.abs(velocities[blocks]).max(initial=0.0))
    if solution.status not in WITH_VALUE or not largest > CARRIED_SHARE:
        return None
    moving = velocities / largest
    still = moving.copy()
    still[blocks] = np.where(np.abs(moving[blocks]) > AT_REST, moving[blocks], 0.0)
    candidates = (still, moving)
    return next((motion for motion in candidates if _proves(program, motion)), None)


def _sizes_of_loads(program: Program) -> sp.csr_array:
    """W by the size of each block's dead load, the mean of the others' where it has none, (n_rows, n_rows)."""
    way_back = program.lift.velocities
    sizes = np.linalg.norm(program.full.dead_load.reshape(-1, 6), axis=1)
    sizes = np.where(sizes > 0, sizes, sizes[sizes > 0].mean())
    springs = way_back.T @ sp.diags_array(np.repeat(sizes, 6)) @ way_back
    squares = way_back.power(2)
    own = float(squares.sum(axis=0).max(initial=0.0)) or 1.0  # in the unit of force of a part, as if it were alone
    mine = squares.sum(axis=1).reshape(-1, 6).any(axis=1)
    own *= float(sizes[mine].mean()) if mine.any() else 1.0
    return sp.csr_array(springs / own)


def _proves(program: Program, velocities: FloatArray) -> bool:
    """Whether the dead load does more work than the joints dissipate, closing charged as verification charges it."""
    charge = LOCKED_IN * float(np.abs(program.dead_load).sum())
    return float(program.dead_load @ velocities[: len(program.dead_load)]) > dissipation(program, velocities, charge)
