"""The state that flow without normality starts from: contact forces under the dead load alone.

They are those that arise from the stress-free assembly (``standing``), where it stands. Where it does
not, or that is doubtful, they are the least that carry the dead load, in the sense of ½ ‖x‖². The least forces may hold
a thrust between walls that nothing has brought about: a bar lying on the ground between two walls and pushed along
them, friction 0.5, then moves at 0.786 instead of 0.5.
"""

from __future__ import annotations

import time

import numpy as np

from mbla.arrays import FloatArray
from mbla.program.program import Program
from mbla.program.static import gravity_form
from mbla.solution.cone_solvers.choice import interior_point_solver
from mbla.solution.cone_solvers.cone_solution import ConeSolution, Log
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import ProgramRecord, Status
from mbla.solution.standing.standing import assess_dead_load
from mbla.solution.standing.weak_spring_continuation import Weakening


def gravity_forces(
    program: Program,
    settings: SolverSettings,
    log: Log,
    records: list[ProgramRecord],
    known: Weakening | None = None,
) -> FloatArray | ConeSolution:
    """Forces under the dead load, (n_points, components), or the solver's verdict where there are none.

    records : gets a line
    known   : ``stress_free_state`` of the program where it was found before
    """
    started, number = time.perf_counter(), len(records) + 1
    stress_free = assess_dead_load(program, settings, known=known).forces
    if stress_free is not None:
        seconds = time.perf_counter() - started
        records.append(ProgramRecord(number, "gravity", Status.SOLVED, np.nan, np.nan, 0, seconds))
        return stress_free
    return least_forces(program, settings, log, records)


def least_forces(
    program: Program, settings: SolverSettings, log: Log, records: list[ProgramRecord]
) -> FloatArray | ConeSolution:
    """The least forces that carry the dead load, (n_points, components), or the solver's verdict; a line of records."""
    form, number = gravity_form(program), len(records) + 1
    solution = interior_point_solver(form.cone_program, settings, log).solve(number, 0.0)
    records.append(solution.record(number, "gravity", np.nan))
    return form.forces(solution.x) if solution.status in (Status.SOLVED, Status.APPROXIMATE) else solution
