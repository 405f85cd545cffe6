"""The least or the greatest value of a force, as one load factor or several (:mod:`mbla.model.objective`).

The load factor counts from a value R0 that the force has in some state that carries the loads: that of the least
contact forces, in the sense of ½ ‖x‖². Near collapse hardly any forces carry the loads, and the program may find
none; where joints crush, its forces may be invalid. Then the loads are taken away step by step, which proves whether
they are carried. If they are, R0 is first set far above the force, and a second program with R0 near the force that the
first one found loses fewer digits.
"""

from __future__ import annotations

import math
from dataclasses import replace

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.model import LoadCase
from mbla.model.settlement import with_reference
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.solution.sequence.settlement import HIGH, forces_at_rest, started
from mbla.solution.sequence.solved_case import AnalysisSequence, SolvedCase
from mbla.solution.settings import SolverSettings
from mbla.solution.solution import WITH_VALUE, Status
from mbla.solution.verification.statics import contact_resultants

NEAR = 1e-3
"""Distance over the unit of forces from which an end is found again that is near zero."""

NOT_CARRIED = (
    "these loads are not carried: a mechanism exists in which they do more work than the joints dissipate, so that no "
    "forces balance them"
)

NO_LIMIT = (
    "no mechanism exists in which the cut opens that way: forces of any size in it balance each other within the "
    "friction of the joints"
)


def measured_force(bodies: RigidBodies, contact_forces: FloatArray) -> float:
    """The force of an objective in the sense of its end, in the unit of contact forces, (n_points, 3).

    bodies : with its load cell, ties among their contacts
    """
    assert bodies.load_cell is not None  # that is what measures
    measured = contact_resultants(bodies.model, bodies.contacts, contact_forces)[-1]
    always = bodies.tie_prestress_load
    measured = measured if always is None else measured + always[-1]
    return float(bodies.load_cell.direction @ measured)


def end_of_force(assembly: Assembly, load_case: LoadCase, settings: SolverSettings) -> AnalysisSequence:
    """One end of the range of a force, from the least forces that carry the loads."""
    unit = load_case.question.scale
    total = forces_at_rest(assembly, load_case, settings)
    if total is not None:
        answer = yield started(load_case, measured_force(assembly.of(load_case), total))
        if answer.solution.status in (*WITH_VALUE, Status.UNBOUNDED, Status.TIME_LIMIT):
            return _in_words(answer)
    relieved = replace(load_case, live_load=-load_case.dead_load, question=LOAD_FACTOR)
    carried = yield relieved
    if carried.solution.status is Status.NO_EQUILIBRIUM:
        solution = replace(carried.solution, reason=NOT_CARRIED)
        return replace(carried, load_case=with_reference(load_case, math.nan), solution=solution)
    answer = yield with_reference(load_case, HIGH * unit)
    if not math.isfinite(answer.load_factor):
        return _in_words(answer)
    value = (HIGH - answer.load_factor) * unit
    return (yield with_reference(load_case, value + max(abs(value), NEAR * unit)))


def _in_words(answer: SolvedCase) -> SolvedCase:
    """The answer, its reason in the words of forces where they have no limit."""
    if answer.solution.status is not Status.UNBOUNDED:
        return answer
    return replace(answer, solution=replace(answer.solution, reason=NO_LIMIT))
