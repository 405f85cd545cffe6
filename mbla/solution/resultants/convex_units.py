"""Units of the convex contact model: of the forces at collapse, and of the unknowns so that light blocks are not lost.

*Forces.* A joint with a strength of thousands of block loads may carry all of it at collapse. Its conditions are then
differences of numbers of that size, and nothing of them is left in the unit of the mean load: the largest load of a
block at collapse takes its place.

*Unknowns.* As ``in_own_units`` of ``associative_form``: the solver's tolerance is one for all
equations, and the quadratic term of the stabilised form one for all velocities, which where only light blocks fall are
large. The velocity of a block is counted in units of 1 over what it carries; what conditions and multipliers add to the
motion of an interface or a point in units of 1 over what the lighter of its blocks carries.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.program.kinematic import ConeProgram, KinematicForm
from mbla.program.resultants import ConvexProgram
from mbla.solution.associative.associative_form import LIGHT, LIGHTEST
from mbla.solution.associative.repair import carried_loads

LOST = 1e-6
"""Unbalanced force of a row, over what it carries, from which the program deserves units of its own."""

LINKS = 4
"""Steps along the cones of a condition from an unknown that moves its interface to one that does not: one is usual."""


HEAVY = 100.0
"""Load of a block at collapse, in mean dead loads, up to which the mean dead load is the unit of force."""


def unit_at_collapse(convex: ConvexProgram, load_factor: float) -> float:
    """Unit of force, in that of the program, where the collapse is at a load factor."""
    program = convex.points
    largest = float(np.abs(program.dead_load + load_factor * program.live_load).max(initial=0.0))
    return largest if largest > HEAVY else 1.0


def units_of_unknowns(form: KinematicForm, convex: ConvexProgram, forces: FloatArray) -> FloatArray:
    """What each unknown of the form is to be multiplied by, (n_unknowns,), at most 1.

    forces : (n_points, 3) of a solution, which need not be sharp
    """
    rows = np.clip(carried_loads(convex.points, forces), LIGHTEST, 1.0)
    points = _least_along(convex.points.equilibrium_matrix, rows)
    n_interfaces = convex.n_interfaces
    interfaces = np.ones(n_interfaces)
    np.minimum.at(interfaces, convex.interface_of_point, points.reshape(-1, 3).min(axis=1))
    of_conditions = []
    for condition in convex.conditions:
        unit = _least_along(condition.motion, np.repeat(interfaces, 6), none=np.inf)
        for _ in range(LINKS):
            linked = _least_along(condition.cones, _least_along(sp.csr_array(condition.cones.T), unit, none=np.inf))
            unit = np.where(np.isinf(unit), linked, unit)
        of_conditions.append(np.minimum(unit, 1.0))
    of_points = points.reshape(-1, 3).min(axis=1)
    chosen = np.concatenate([form.rows.frictional, form.rows.crushing])
    return np.concatenate([rows, *of_conditions, of_points[chosen]])


def loses_light_blocks(convex: ConvexProgram, forces: FloatArray, load_factor: float) -> bool:
    """Whether a solution leaves lightly loaded blocks out of balance that deserve units of their own.

    forces : (n_points, 3)  non-dimensional, compression positive
    """
    program, carried = convex.points, carried_loads(convex.points, forces)
    loads = program.dead_load + load_factor * program.live_load
    unbalanced = np.abs(program.equilibrium_matrix @ forces.ravel() + loads)
    return bool(np.any((carried < LIGHT) & (unbalanced > LOST * carried)))


def in_units(program: ConeProgram, units: FloatArray) -> ConeProgram:
    """The same in unknowns multiplied by their units; the quadratic term, which is none of the structure's, stays.

    units : (n_unknowns,)
    """
    matrix = sp.csc_array(program.matrix @ sp.diags_array(1.0 / units))
    matrix.sort_indices()
    return replace(program, cost=program.cost / units, matrix=matrix)


def _least_along(matrix: sp.csr_array, of_rows: FloatArray, none: float = 1.0) -> FloatArray:
    """The least value of the rows in which each column has an entry, (n_columns,)."""
    entries = matrix.tocoo()
    least = np.full(entries.shape[1], np.inf)
    np.minimum.at(least, entries.col, of_rows[entries.row])
    return np.where(np.isinf(least), none, least)
