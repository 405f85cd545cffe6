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

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Objective
from mbla.model.settlement import with_reference
from mbla.solution.solution import WITH_VALUE, Status
from mbla.solution.tilt import Angles, Answer

MARGIN = 1e-9
"""Added to a reaction at rest, over its unit: where statics alone gives it, rounding must not make it too small to
carry the loads."""

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


def force_through(contacts: Contacts, objective: Objective, contact_forces: FloatArray) -> float:
    """The force through the cut of an objective along its direction, in the unit of the forces, (n_points, 3)."""
    signs = objective.crossed(contacts.bodies)[contacts.interface_of_point]
    return float(signs @ np.einsum("pj,pjx,x->p", contact_forces, contacts.frames, objective.direction))


def ends_of_force(contacts: Contacts, load_case: LoadCase, at_rest: FloatArray | None) -> Angles:
    """Load cases to be solved for one end; the last answer has it.

    at_rest : (n_points, 3) contact forces that carry the loads; None where none were found
    """
    settlement, objective = load_case.settlement, load_case.objective
    assert settlement is not None  # that is why it is asked
    assert objective is not None
    if at_rest is not None:
        value = settlement.sense * force_through(contacts, objective, at_rest)
        answer = yield with_reference(load_case, value + MARGIN * settlement.unit)
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
