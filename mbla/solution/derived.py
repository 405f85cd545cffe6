"""What of a solution follows from its forces and mechanisms, found again from them: for who does not believe it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids, solids_of
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.program.resultants import assemble_convex
from mbla.solution.glued import MOTIONS, rule_of
from mbla.solution.mechanics import contact_modes
from mbla.solution.solution import Mechanics, Solution
from mbla.solution.verification.statics import contact_velocities

ROUNDING = 1e-9
"""Difference of velocities over the largest that is rounding: those stored are kept then, as modes at thresholds follow
from them."""


def with_derived(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Solution:
    """The solution with velocities and modes of contact points, and resultants, as mechanisms and forces give them."""
    solids = solids_of(model, contacts)
    found: dict[int, Mechanics] = {}
    for part in MOTIONS:
        mechanics: Mechanics | None = getattr(solution, part)
        if mechanics is not None and id(mechanics) not in found:
            still = np.where(model.fixed[:, None], 0.0, mechanics.mechanism)
            moved = contact_velocities(model, contacts, still)
            if _near(moved, mechanics.contact_velocities):
                moved = mechanics.contact_velocities
            mechanics = replace(mechanics, mechanism=still, contact_velocities=moved)
            rule = rule_of(part, solution)
            found[id(getattr(solution, part))] = _with_modes(solids, load_case, mechanics, rule, solution.contact_model)
    parts = {part: found.get(id(getattr(solution, part))) for part in MOTIONS}
    return replace(solution, **parts)  # type: ignore[arg-type]  # names and types are those of the parts


def _near(one: FloatArray, other: FloatArray) -> bool:
    """Whether two arrays differ by no more than rounding of the largest entry."""
    return bool(np.abs(one - other).max(initial=0.0) <= ROUNDING * np.abs(one).max(initial=0.0))


def _with_modes(
    solids: Solids, load_case: LoadCase, mechanics: Mechanics, flow_rule: str, contact_model: str
) -> Mechanics:
    """With modes of the contact points, and resultants of the interfaces where there are any."""
    limits, forces = yield_limits(solids.model, solids.contacts), mechanics.contact_forces
    slope = limits.dilatancy_by(flow_rule)
    if mechanics.interface_motions is None:
        return replace(mechanics, modes=contact_modes(forces, mechanics.contact_velocities, limits, slope))
    from mbla.solution.resultants.solve_convex import modes_of  # late: the law of interfaces is asked for rarely

    convex = assemble_convex(solids.model, solids.contacts, solids.load_case(load_case), contact_model)
    of_solids = replace(mechanics, mechanism=solids.solid_motions(mechanics.mechanism))
    resultants = convex.resultants_of(forces)
    return replace(mechanics, modes=modes_of(convex, of_solids, slope), resultants=resultants)
