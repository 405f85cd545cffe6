"""The least or the greatest value of a force, as one load factor or several (:mod:`mbla.model.objective`).

The load factor counts from a value R0 that the force has in some state that carries the loads: that of the least
contact forces, in the sense of ½ ‖x‖². Near collapse hardly any forces carry the loads, and none may be found; where
joints crush those found may be none. Whether the loads are carried at all is then asked by taking them away step by
step, which proves it where they are not. If they are, R0 lies so high that the end that is sought is below it, and
once that is known from near it, where fewer digits are lost.
"""

from __future__ import annotations

import math
from dataclasses import replace

from mbla.arrays import FloatArray
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.model import LoadCase
from mbla.model.settlement import with_reference
from mbla.solution.solution import WITH_VALUE, Status
from mbla.solution.tilt import Angles, Answer
from mbla.solution.verification.statics import contact_resultants

MARGIN = 1e-9
"""Added to a reaction at rest, over its unit: where statics alone gives it, rounding must not make it too small to
carry the loads."""

NO_REACTION = 1e-11
"""Reaction at rest over its unit that is rounding: it starts from nothing, for what hardly holds anything might not
carry the margin."""

HIGH = 10.0
"""Reaction over its unit, more than any structure is likely to need."""

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


def started(load_case: LoadCase, at_rest: float) -> LoadCase:
    """The load case of a settlement or objective with the reaction from which it starts, from one at rest."""
    settlement = load_case.settlement
    assert settlement is not None  # that is what has a reaction
    nothing = abs(at_rest) <= NO_REACTION * settlement.unit
    return with_reference(load_case, 0.0 if nothing else at_rest + MARGIN * settlement.unit)


def measured_force(bodies: RigidBodies, contact_forces: FloatArray) -> float:
    """The force of an objective in the sense of its end, in the unit of contact forces, (n_points, 3).

    bodies : with its load cell, ties among their contacts
    """
    assert bodies.load_cell is not None  # that is what measures
    measured = contact_resultants(bodies.model, bodies.contacts, contact_forces)[-1]
    always = bodies.tie_prestress_load
    measured = measured if always is None else measured + always[-1]
    return float(bodies.load_cell.direction @ measured)


def ends_of_force(load_case: LoadCase, at_rest: float | None) -> Angles:
    """Load cases to be solved for one end; the last answer has it.

    at_rest : the force, in the sense of the end, in some state that carries the loads; None where none was found
    """
    settlement = load_case.settlement
    assert settlement is not None  # that of the load cell
    if at_rest is not None:
        answer = yield started(load_case, at_rest)
        if answer.solution.status in (*WITH_VALUE, Status.UNBOUNDED, Status.TIME_LIMIT):
            return _in_words(answer)
    relieved = replace(load_case, live_load=-load_case.dead_load, settlement=None, objective=None)
    carried = yield relieved
    if carried.solution.status is Status.NO_EQUILIBRIUM:
        solution = replace(carried.solution, reason=NOT_CARRIED)
        return replace(carried, load_case=with_reference(load_case, math.nan), solution=solution)
    answer = yield with_reference(load_case, HIGH * settlement.unit)
    if not math.isfinite(answer.load_factor):
        return _in_words(answer)
    value = (HIGH - answer.load_factor) * settlement.unit
    return (yield with_reference(load_case, value + max(abs(value), NEAR * settlement.unit)))


def _in_words(answer: Answer) -> Answer:
    """The answer, its reason in the words of forces where they have no limit."""
    if answer.solution.status is not Status.UNBOUNDED:
        return answer
    return replace(answer, solution=replace(answer.solution, reason=NO_LIMIT))
