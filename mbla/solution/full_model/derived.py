"""What follows from forces and mechanisms of a solution, found again: velocities, modes, resultants."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.assembly import Assembly
from mbla.assembly.lift import motions_of_bodies
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.model.model import LoadCase
from mbla.program.assemble import yield_limits
from mbla.solution.full_model.contact_modes import contact_modes
from mbla.solution.full_model.lifted import (
    MOTIONS,
    model_of,
    rule_of,
    ties_among_contacts,
    ties_apart,
    without_rounding,
)
from mbla.solution.full_model.of_interfaces import of_interfaces
from mbla.solution.solution import Mechanics, Solution
from mbla.solution.verification.statics import contact_velocities

ROUNDING = 1e-9
"""Difference of velocities over the largest that is rounding: those stored are kept then, as modes at thresholds follow
from them."""


def with_derived(assembly: Assembly, load_case: LoadCase, solution: Solution) -> Solution:
    """The solution with velocities and modes of contact points, and resultants, as mechanisms and forces give them."""
    bodies, model = assembly.of(load_case), assembly.model.of_case(load_case)
    solution = ties_among_contacts(solution, bodies)
    found: dict[int, Mechanics] = {}
    for part in MOTIONS:
        mechanics: Mechanics | None = getattr(solution, part)
        if mechanics is not None and id(mechanics) not in found:
            still = np.where(model.fixed[:, None], 0.0, mechanics.mechanism)
            moved = contact_velocities(bodies.model, bodies.contacts, motions_of_bodies(bodies, still))
            if _near(moved, mechanics.contact_velocities):
                moved = mechanics.contact_velocities
            mechanics = replace(mechanics, mechanism=still, contact_velocities=moved)
            rule = rule_of(part, solution)
            contact_model = model_of(part, solution)
            mechanics = _with_modes(bodies, mechanics, rule, contact_model)
            found[id(getattr(solution, part))] = without_rounding(mechanics, bodies, model.blocks.sizes)
    parts = {part: found.get(id(getattr(solution, part))) for part in MOTIONS}
    return ties_apart(replace(solution, **parts), bodies)  # type: ignore[arg-type]  # names and types are those of the parts


def _near(one: FloatArray, other: FloatArray) -> bool:
    """Whether two arrays differ by no more than rounding of the largest entry."""
    return bool(np.abs(one - other).max(initial=0.0) <= ROUNDING * np.abs(one).max(initial=0.0))


def _with_modes(bodies: RigidBodies, mechanics: Mechanics, flow_rule: str, contact_model: str) -> Mechanics:
    """With modes of the contact points, and resultants of the interfaces where there are any."""
    limits, forces = yield_limits(bodies.model, bodies.contacts), mechanics.contact_forces
    slope = limits.dilatancy_by(flow_rule)
    if mechanics.interface_motions is None:
        return replace(mechanics, modes=contact_modes(forces, mechanics.contact_velocities, limits, slope))
    return of_interfaces(bodies.model, bodies.contacts, contact_model, mechanics, flow_rule)
