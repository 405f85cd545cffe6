"""The motion that proves that the dead load is not carried, with nothing in it that does not fall.

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
from scipy.sparse.csgraph import connected_components

from mbla.arrays import BoolArray, FloatArray
from mbla.program.kinematic import ConeProgram, kinematic_form
from mbla.program.program import Program
from mbla.solution.associative.bounds import LOCKED_IN, dissipation, point_dissipation
from mbla.solution.cone_solvers.choice import interior_point_solver
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE
from mbla.solution.standing.weak_spring_continuation import springs_of

FALL_TOLERANCE = 1e-12
"""Of the program: a load that is not carried by 1e-6 of itself shows then, at 1e-10 only one by 1e-4."""

AT_REST = 1e-7
"""Share of the largest velocity below which a block is at rest in the steepest fall."""

CARRIED_SHARE = 1e-7
"""Share of a block's load that would have to be taken off, below which the dead load is carried up to rounding."""


def steepest_fall(program: Program, settings: SolverSettings, log: Log) -> FloatArray | None:
    """The motion in which the dead load gains most, (n_rows,), largest entry 1; None where there is none to be proved.

    Blocks that stand are at rest in it. It is compatible with the yield conditions up to rounding.
    """
    if not np.any(program.dead_load):
        return None
    form = kinematic_form(program, program.limits)
    given = form.cone_program
    sizes = springs_of(program, "dead_load")[0].diagonal()
    quadratic = np.concatenate([sizes, np.zeros(len(given.cost) - len(sizes))])
    without_live_load = ConeProgram(
        cost=given.cost,
        matrix=sp.csc_array(given.matrix[1:]),
        rhs=given.rhs[1:],
        n_half_lines=given.n_half_lines,
        n_cones=given.n_cones,
        n_equations=0,
        quadratic=quadratic,
    )
    exact = replace(settings, tolerance=min(settings.tolerance, FALL_TOLERANCE))
    solution = interior_point_solver(without_live_load, exact, log).solve(1, 0.0)
    velocities = form.velocities(solution.x)
    largest = float(np.abs(velocities).max(initial=0.0))
    if solution.status not in WITH_VALUE or not largest > CARRIED_SHARE:
        return None
    moving = velocities / largest
    candidates = (np.where(np.abs(moving) > AT_REST, moving, 0.0), moving)
    return next((motion for motion in candidates if _proves(program, motion)), None)


def cleaned_certificate(program: Program, velocities: FloatArray, settings: SolverSettings, log: Log) -> FloatArray:
    """A motion that proves what ``velocities``, (n_rows,), prove, without what does not fall.

    The steepest fall where it is found; else the given motion without the connected parts in which the dead load gains
    nothing.
    """
    fall = steepest_fall(program, settings, log)
    return failing_parts(program, velocities) if fall is None else fall


def failing_parts(program: Program, velocities: FloatArray) -> FloatArray:
    """The motion, (n_rows,), with every part at rest whose own dead load does no more work than its joints dissipate.

    Parts are moving blocks connected by contacts; taking one away leaves the velocities at the contacts of the others.
    """
    part_of_row, n_parts = _moving_parts(program, velocities)
    gain = np.zeros(n_parts)
    moving = part_of_row >= 0
    np.add.at(gain, part_of_row[moving], (program.dead_load * velocities)[moving])
    part_of_point, touched = _part_of_point(program, part_of_row)
    np.add.at(gain, part_of_point[touched], -point_dissipation(program, velocities)[0][touched])
    kept = np.where(moving & (gain > 0)[part_of_row], velocities, 0.0)
    return kept if _proves(program, kept) else velocities


def _moving_parts(program: Program, velocities: FloatArray) -> tuple[np.typing.NDArray[np.int64], int]:
    """Part of each row, −1 where it does not move, and the number of parts."""
    touches = sp.coo_array(_touches(program))
    moves = velocities != 0
    n_rows, n_points = touches.shape
    here = moves[touches.row]
    entries = (np.ones(int(here.sum())), (touches.row[here], n_rows + touches.col[here]))
    graph = sp.coo_array(entries, shape=(n_rows + n_points, n_rows + n_points))
    n_parts, label = connected_components(graph, directed=False)
    return np.where(moves, label[:n_rows], -1).astype(np.int64), int(n_parts)


def _part_of_point(
    program: Program, part_of_row: np.typing.NDArray[np.int64]
) -> tuple[np.typing.NDArray[np.int64], BoolArray]:
    """Part whose rows move at each contact point, and whether there is one."""
    touches = sp.coo_array(_touches(program))
    part = np.full(program.n_points, -1, dtype=np.int64)
    here = part_of_row[touches.row] >= 0
    part[touches.col[here]] = part_of_row[touches.row[here]]
    return part, part >= 0


def _touches(program: Program) -> sp.csr_array:
    """Rows that each contact point acts on, (n_rows, n_points)."""
    matrix = program.equilibrium_matrix.tocoo()
    entries = (np.ones(len(matrix.data)), (matrix.row, matrix.col // program.components))
    return sp.csr_array(sp.coo_array(entries, shape=(matrix.shape[0], program.n_points)))


def _proves(program: Program, velocities: FloatArray) -> bool:
    """Whether the dead load does more work than the joints dissipate, closing charged as verification charges it."""
    charge = LOCKED_IN * float(np.abs(program.dead_load).sum())
    return float(program.dead_load @ velocities) > dissipation(program, velocities, charge)
