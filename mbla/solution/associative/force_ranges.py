"""How far the total normal force of each interface can range at the load factor of associative flow.

The forces that carry the load factor are those that fit the mechanism, whichever of its mechanisms was found
(complementary slackness; :mod:`mbla.program.static`). Over them the sum of the normal forces of an interface
has a least and a greatest value: two programs for each interface, linear ones in a plane, that differ in their cost
alone. A range without an end means that the interface can carry any normal force: what it carries is not determined by
the loads.

A part at rest carries its loads at the given load factor by any forces within the yield conditions.

The program must not be reduced by mirror symmetry, which shows symmetric forces alone, nor by leaving out contact
points, whose interface would have none.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Message
from mbla.program.kinematic import ConeProgram
from mbla.program.program import Program
from mbla.program.static import PointMotion, StaticForm, fixed_mechanism_form
from mbla.solution.cone_solvers.choice import cone_solver
from mbla.solution.cone_solvers.cone_solution import Log
from mbla.solution.nonassociative.law_state import LawState, point_motion
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, ProgramRecord, Status
from mbla.solution.thresholds import ZERO_FACTOR

TOUCHING = 1e-6
"""Velocity, over the largest contact speed, above which a point counts as moving."""

ALL = 0.95
"""Share of the points that move from which on the mechanism alone is not trusted with the forces: rounding in the
directions of sliding leaves hardly any."""

FORCE_SET_TOLERANCE, FORCE_SET_REGULARIZATION = 1e-8, 1e-8
"""Of the cone solver: the set of forces has hardly an interior."""

FALL = 2e-8
"""Share of the load factor (at least of dead over live load) by which that of the forces may be lower."""

WITHIN = 1e-5
"""Share of the largest normal force, or dead load of a block, by which a range may miss the forces found."""


@dataclass(frozen=True)
class ForceRanges:
    """Least and greatest total normal force of each interface.

    ranges : (n_interfaces, 2) in units of the program's forces; inf without an end; NaN where the program has no points
             of the interface, or where the solver gave no answer
    remark : how many were not found; None where all were
    """

    ranges: FloatArray
    programs: tuple[ProgramRecord, ...]
    remark: Message | None = None


def force_ranges(
    program: Program,
    state: LawState,
    interface_of_point: IntArray,
    settings: SolverSettings,
    log: Log,
    *,
    first: int = 1,
) -> ForceRanges:
    """Ranges over the forces that fit an associative state, or a state at rest.

    interface_of_point : (n_points of the full model,)
    first              : number of the first program in the sequence of the load case
    """
    sums = normal_sums(program, interface_of_point)
    form = fixed_mechanism_form(program, _trusted_motion(program, state))
    settings = replace(settings, tolerance=FORCE_SET_TOLERANCE, regularization=FORCE_SET_REGULARIZATION)
    solver = cone_solver(_with_factor(form, state), settings, log, has_inside=False)
    ranges = np.full((sums.shape[0], 2), np.nan)
    records: list[ProgramRecord] = []
    present = np.flatnonzero(np.diff(sums.indptr))
    largest = max(float(np.abs(part).max(initial=0.0)) for part in (state.forces[:, 0], program.dead_load))
    for interface in present:
        row = sums[[interface]]
        cost = np.append((row @ form.expand).toarray().ravel(), 0.0)
        found = float((row @ state.forces.ravel())[0])
        for end, sign in enumerate((1.0, -1.0)):
            solver.update(cost=sign * cost)
            solution = solver.solve(first + len(records), 0.0)
            value = np.nan
            if solution.status is Status.NO_EQUILIBRIUM:  # of a program in velocities: here it has no least value
                value = -sign * np.inf
            elif solution.status in WITH_VALUE:
                value = sign * solution.objective + float((row @ form.offset)[0])
            room = WITHIN * max(largest, abs(found))
            ranges[interface, end] = value if sign * (value - found) <= room else np.nan
            what = "least" if sign > 0 else "greatest"
            records.append(solution.record(first + len(records), f"{what} normal force", np.nan))
            if solution.status is Status.TIME_LIMIT:
                return ForceRanges(ranges, tuple(records), _words(ranges[present]))
    return ForceRanges(ranges, tuple(records), _words(ranges[present]))


def normal_sums(program: Program, interface_of_point: IntArray) -> sp.csr_array:
    """Rows that add up the normal forces of each interface of the model, (n_interfaces, components n_points)."""
    full, forces = program.full, program.lift.forces
    places = full.components * np.arange(full.n_points)
    shape = (int(interface_of_point.max(initial=-1)) + 1, full.components * full.n_points)
    sums = sp.csr_array((np.ones(len(places)), (interface_of_point, places)), shape=shape)
    return sp.csr_array(sums @ forces)


def _trusted_motion(program: Program, state: LawState) -> PointMotion:
    """What the points do in an associative state; nothing, so that the yield conditions alone bound, where all move."""
    motion = point_motion(program, state, TOUCHING, program.limits.friction)
    moves = motion.opens | motion.slides | motion.crushes
    if len(moves) == 0 or float(np.mean(moves)) < ALL:
        return motion
    none = np.zeros(program.n_points, dtype=bool)
    return PointMotion(none, none, none, np.zeros((program.n_points, program.components - 1)))


def _with_factor(form: StaticForm, state: LawState) -> ConeProgram:
    """The load factor bounded from below where a mechanism bounds it from above, given where nothing moves."""
    data, program = form.cone_program, form.program
    row = sp.csr_array(([1.0], ([0], [data.matrix.shape[1] - 1])), shape=(1, data.matrix.shape[1]))
    if not np.any(state.velocities):
        return replace(
            data,
            matrix=sp.csc_array(sp.vstack([row, data.matrix])),
            rhs=np.append(state.load_factor, data.rhs),
            n_equations=data.n_equations + 1,
        )
    dead, live = (float(np.linalg.norm(load)) for load in (program.dead_load, program.live_load))
    least = state.load_factor - FALL * max(abs(state.load_factor), ZERO_FACTOR * dead / live)
    matrix, equations = sp.csr_array(data.matrix), data.n_equations
    return replace(
        data,
        matrix=sp.csc_array(sp.vstack([matrix[:equations], -row, matrix[equations:]])),
        rhs=np.concatenate([data.rhs[:equations], [-least], data.rhs[equations:]]),
        n_half_lines=data.n_half_lines + 1,
    )


def _words(ranges: FloatArray) -> Message | None:
    missing = int(np.isnan(ranges).any(axis=1).sum())
    words = f"the range of the normal force was not found for {missing} interfaces"
    return Message("force-range-not-found", words) if missing else None
