"""A solution for solids restated for the blocks that glue joins in them, and back (see :mod:`mbla.contacts.glue`).

Motions are mapped; forces, contact velocities and modes belong to contact points, which both have in common.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids, solids_of
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.solution.mechanics import contact_modes
from mbla.solution.solution import Mechanics, Solution, StandingResult
from mbla.solution.verification.statics import contact_velocities

MOTIONS = ("mechanics", "associative", "lower", "upper", "peak", "level")
"""parts of a solution that hold a mechanism"""


BY_NORMALITY = ("associative", "level")
"""parts of a solution that flow by the associative rule whatever that of the analysis"""


def rule_of(part: str, solution: Solution) -> str:
    """Flow rule of a part of a solution."""
    return "associative" if part in BY_NORMALITY else solution.flow_rule


def solution_on_blocks(solution: Solution, solids: Solids) -> Solution:
    """The solution for the solids with the motions of all blocks; the block that falls is the first of its solid."""
    if solids.solid_of_block is None:
        return solution
    standing, size = solution.standing, solution.size
    if standing is not None and standing.block is not None:
        standing = replace(standing, block=int(solids.first_blocks[standing.block]))
    if solids.gauge is not None and size is not None:
        size = replace(size, free_blocks=size.free_blocks - 1)
    return _with_motions(replace(solution, standing=standing, size=size), solids.block_motions)


def solution_on_solids(solution: Solution, solids: Solids) -> tuple[Solution, float]:
    """The solution with motions of the solids, and how far glued blocks move apart, over the largest motion.

    The block that falls stays as it is: it is a name for messages.
    """
    if solids.solid_of_block is None:
        return solution, 0.0
    apart = [0.0]

    def checked(motions: FloatArray, *, opens: bool = True) -> FloatArray:
        of_solids = solids.solid_motions(motions, opens=opens)
        lengths = np.repeat([1.0, float(solids.model.blocks.sizes.max(initial=0.0)) or 1.0], 3)
        difference = np.abs((solids.block_motions(of_solids) - motions) * lengths).max(initial=0.0)
        size = np.abs(motions * lengths).max(initial=0.0)
        if difference > 0.0:
            apart.append(float(difference / size))
        return of_solids

    return _with_motions(solution, checked, partial(checked, opens=False)), max(apart)


def _with_motions(
    solution: Solution,
    mapped: Callable[[FloatArray], FloatArray],
    at_rest: Callable[[FloatArray], FloatArray] | None = None,
) -> Solution:
    """The solution with every motion mapped; what was one object stays one.

    at_rest : what maps motions in which no live load does work; ``mapped`` unless given
    """
    still = at_rest or mapped
    known: dict[int, Mechanics] = {}

    def of(mechanics: Mechanics) -> Mechanics:
        if id(mechanics) not in known:
            known[id(mechanics)] = replace(mechanics, mechanism=mapped(mechanics.mechanism))
        return known[id(mechanics)]

    parts: dict[str, Any] = {name: of(part) for name in MOTIONS if (part := getattr(solution, name)) is not None}
    return replace(
        solution,
        **parts,
        certificate=None if solution.certificate is None else still(solution.certificate),
        standing=_standing(solution.standing, still),
    )


def _standing(standing: StandingResult | None, mapped: Callable[[FloatArray], FloatArray]) -> StandingResult | None:
    if standing is None or standing.settlement is None:
        return standing
    return replace(standing, settlement=mapped(standing.settlement))


# --- What follows from forces and mechanisms, recomputed for verification ---------------------------------------------

ROUNDING = 1e-9
"""Difference of velocities over the largest that is rounding: those stored are kept then, as modes at thresholds follow
from them."""


def with_derived(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Solution:
    """The solution with velocities and modes of contact points, and resultants, as mechanisms and forces give them."""
    solids = solids_of(model, contacts, load_case)
    found: dict[int, Mechanics] = {}
    for part in MOTIONS:
        mechanics: Mechanics | None = getattr(solution, part)
        if mechanics is not None and id(mechanics) not in found:
            still = np.where(model.fixed[:, None], 0.0, mechanics.mechanism)
            moved, speed = contact_velocities(model, contacts, still), 0.0
            if solids.gauge is not None:  # where all that moves moves with it what is left of it is rounding
                moved = contact_velocities(solids.model, solids.contacts, solids.solid_motions(still))
                speed = float(np.abs(solids.gauge).max())
            if _near(moved, mechanics.contact_velocities, speed):
                moved = mechanics.contact_velocities
            mechanics = replace(mechanics, mechanism=still, contact_velocities=moved)
            rule = rule_of(part, solution)
            found[id(getattr(solution, part))] = _with_modes(solids, load_case, mechanics, rule, solution.contact_model)
    parts = {part: found.get(id(getattr(solution, part))) for part in MOTIONS}
    return replace(solution, **parts)  # type: ignore[arg-type]  # names and types are those of the parts


def _near(one: FloatArray, other: FloatArray, size: float) -> bool:
    """Whether two arrays differ by no more than rounding of the largest entry, or of that size."""
    return bool(np.abs(one - other).max(initial=0.0) <= ROUNDING * np.abs(one).max(initial=size))


def _with_modes(
    solids: Solids, load_case: LoadCase, mechanics: Mechanics, flow_rule: str, contact_model: str
) -> Mechanics:
    """With modes of the contact points, and resultants of the interfaces where there are any."""
    limits, forces = yield_limits(solids.model, solids.contacts), mechanics.contact_forces
    slope = limits.dilatancy_by(flow_rule)
    if mechanics.interface_motions is None:
        return replace(mechanics, modes=contact_modes(forces, mechanics.contact_velocities, limits, slope))
    from mbla.program.resultants import assemble_convex
    from mbla.solution.resultants.solve_convex import modes_of  # late: the law of interfaces is asked for rarely

    convex = assemble_convex(solids.model, solids.contacts, solids.load_case(load_case), contact_model)
    of_solids = replace(mechanics, mechanism=solids.solid_motions(mechanics.mechanism))
    resultants = convex.resultants_of(forces)
    return replace(mechanics, modes=modes_of(convex, of_solids, slope), resultants=resultants)
