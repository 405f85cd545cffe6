"""A solution of what the solver sees restated for the blocks and ties of the deck, and back.

Motions are mapped; forces, contact velocities and modes belong to contact points, which both have in common, but for
ties, which are contact points of the rigid bodies only (:mod:`mbla.assembly.lift`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.assembly.lift import (
    motions_of_blocks,
    motions_of_bodies,
    of_all_ties,
    parting,
    with_tie_rows,
    without_tie_rows,
)
from mbla.assembly.rigid_bodies import RigidBodies
from mbla.solution.full_model.contact_modes import AT_REST
from mbla.solution.solution import ContactMode, Mechanics, Solution, StandingResult
from mbla.solution.thresholds import STILL

MOTIONS = ("mechanics", "associative", "least", "torsion", "level")
"""parts of a solution that hold a mechanism"""


BY_NORMALITY = ("associative", "level")
"""parts of a solution that flow by the associative rule whatever that of the analysis"""


def rule_of(part: str, solution: Solution) -> str:
    """Flow rule of a part of a solution."""
    return "associative" if part in BY_NORMALITY else solution.flow_rule


def model_of(part: str, solution: Solution) -> str:
    """Contact model of a part of a solution."""
    return "convex" if part == "torsion" else solution.contact_model


OF_CONTACTS: tuple[str, ...] = ("contact_forces", "contact_velocities", "modes", "resultants", "interface_motions")
"""what mechanics have a row of for each interface or contact point"""
HISTORY = ("remembered", "stiffness", "crushed")
"""the same of a path of elastic joints"""


def solution_on_blocks(solution: Solution, bodies: RigidBodies) -> Solution:
    """The solution for rigid bodies with the motions of all blocks, ties by themselves.

    The block that falls is the first of its body.
    """
    lengths = bodies.model.blocks.sizes
    solution = ties_apart(_with_mechanics(solution, lambda part: without_rounding(part, bodies, lengths)), bodies)
    if bodies.body_of_block is None:
        return solution
    standing, size = solution.standing, solution.size
    if standing is not None and standing.block is not None:
        standing = replace(standing, block=int(bodies.first_blocks[standing.block]))
    if bodies.load_cell is not None and size is not None:
        size = replace(size, free_blocks=size.free_blocks - 1)

    def lifted(motions: FloatArray) -> FloatArray:
        return motions_of_blocks(bodies, motions)

    return _with_motions(replace(solution, standing=standing, size=size), lifted, lifted)


def solution_on_bodies(solution: Solution, bodies: RigidBodies) -> tuple[Solution, float]:
    """The solution with motions of the bodies, and how far glued blocks move apart, over the largest motion.

    Ties are among the contacts again. The block that falls stays as it is: it is a name for messages.
    """
    solution = ties_among_contacts(solution, bodies)
    if bodies.body_of_block is None:
        return solution, 0.0
    apart = [0.0]

    def joined(motions: FloatArray, *, cell_moves: bool = True) -> FloatArray:
        apart.append(parting(bodies, motions))
        return motions_of_bodies(bodies, motions, cell_moves=cell_moves)

    return _with_motions(solution, joined, lambda motions: joined(motions, cell_moves=False)), max(apart)


def ties_apart(solution: Solution, bodies: RigidBodies) -> Solution:
    """The solution with ties by themselves, from one that has them among its contacts."""
    ties = bodies.contacts.ties
    if ties is None:
        return solution
    n, count = len(ties.rows), len(bodies.model.ties)

    def apart(mechanics: Mechanics) -> Mechanics:
        of_ties = {
            "tie_forces": ties.senses * (mechanics.contact_forces[-n:, 0] + ties.offsets),
            "tie_rates": -ties.senses * mechanics.contact_velocities[-n:, 0],
        }
        if mechanics.remembered is not None and mechanics.stiffness is not None:
            of_ties["tie_remembered"] = mechanics.remembered[-n:, 0]
            of_ties["tie_stiffness"] = mechanics.stiffness[-n:, 0]
        changed: dict[str, Any] = {name: of_all_ties(ties, count, values) for name, values in of_ties.items()}
        for name, values in _rows(mechanics, OF_CONTACTS + HISTORY).items():
            changed[name] = without_tie_rows(ties, values)
        return replace(mechanics, **changed)

    solution = _with_mechanics(solution, apart)
    return _with_interfaces(solution, lambda values: without_tie_rows(ties, values))


def ties_among_contacts(solution: Solution, bodies: RigidBodies) -> Solution:
    """The way back from ``ties_apart``; what it left out of ties is nothing."""
    ties = bodies.contacts.ties
    if ties is None:
        return solution
    solution = _with_mechanics(solution, lambda mechanics: _with_tie_contacts(mechanics, bodies))
    return _with_interfaces(solution, lambda values: with_tie_rows(ties, values))


def _with_tie_contacts(mechanics: Mechanics, bodies: RigidBodies) -> Mechanics:
    """Mechanics with ties among the contacts of bodies; the same where these have none.

    Ties have no shear, whose stiffness does not matter.
    """
    ties = bodies.contacts.ties
    if ties is None or mechanics.tie_forces is None:
        return mechanics
    forces = (ties.senses * mechanics.tie_forces[ties.rows] - ties.offsets)[:, None]
    of_ties, names = {"contact_forces": forces, "resultants": forces}, OF_CONTACTS
    if mechanics.tie_rates is not None:
        of_ties["contact_velocities"] = (-ties.senses * mechanics.tie_rates[ties.rows])[:, None]
    if mechanics.tie_remembered is not None and mechanics.tie_stiffness is not None:
        of_ties["remembered"] = mechanics.tie_remembered[ties.rows, None]
        of_ties["stiffness"] = np.repeat(mechanics.tie_stiffness[ties.rows, None], 2, axis=1)
        names += HISTORY
    rows = _rows(mechanics, names)
    return replace(
        mechanics,
        **{name: with_tie_rows(ties, values, of_ties.get(name)) for name, values in rows.items()},  # type: ignore[arg-type]  # names and types are those of the fields
    )


def _rows(mechanics: Mechanics, names: tuple[str, ...]) -> dict[str, FloatArray]:
    """Those of some names that mechanics have."""
    return {name: values for name in names if (values := getattr(mechanics, name)) is not None}


def _with_interfaces(solution: Solution, changed: Callable[[FloatArray], FloatArray]) -> Solution:
    """The solution with a change of what it has of each interface besides its mechanics."""
    motions = solution.certificate_motions
    return replace(solution, certificate_motions=None if motions is None else changed(motions))


def without_rounding(mechanics: Mechanics, bodies: RigidBodies, lengths: FloatArray) -> Mechanics:
    """The same, with joints at rest where blocks move without them, or with the load cell of an objective, but
    for rounding; and with blocks at rest beside what that moves.

    lengths : (n,) sizes of the blocks, or bodies, whose motions are given
    """
    motion, velocities, modes = mechanics.mechanism, mechanics.contact_velocities, mechanics.modes
    speeds = np.abs(motion[:, :3]).max(axis=1) + np.abs(motion[:, 3:]).max(axis=1) * lengths
    cell = 0.0 if bodies.load_cell is None else float(np.abs(bodies.load_cell.motion).max())
    moved = np.abs(velocities).max(axis=1)
    rest = moved <= STILL * max(cell, float(speeds.max(initial=0.0)))
    if rest.all() or moved.max(initial=0.0) <= AT_REST * cell:
        rest, modes = np.ones_like(rest), np.full_like(modes, ContactMode.STICK)
    return replace(
        mechanics,
        mechanism=np.where((speeds <= STILL * cell)[:, None], 0.0, motion),
        contact_velocities=np.where(rest[:, None], 0.0, velocities),
        modes=modes,
    )


def _with_motions(
    solution: Solution,
    mapped: Callable[[FloatArray], FloatArray],
    still: Callable[[FloatArray], FloatArray],
) -> Solution:
    """The solution with every motion mapped, by ``still`` those in which no live load does work."""
    moved = _with_mechanics(solution, lambda part: replace(part, mechanism=mapped(part.mechanism)))
    return replace(
        moved,
        certificate=None if solution.certificate is None else still(solution.certificate),
        standing=_standing(solution.standing, still),
    )


def _with_mechanics(solution: Solution, changed: Callable[[Mechanics], Mechanics]) -> Solution:
    """The solution with all its mechanics changed; what was one object stays one."""
    known: dict[int, Mechanics] = {}

    def of(mechanics: Mechanics) -> Mechanics:
        if id(mechanics) not in known:
            known[id(mechanics)] = changed(mechanics)
        return known[id(mechanics)]

    parts: dict[str, Any] = {name: of(part) for name in MOTIONS if (part := getattr(solution, name)) is not None}
    return replace(solution, **parts)


def _standing(standing: StandingResult | None, mapped: Callable[[FloatArray], FloatArray]) -> StandingResult | None:
    if standing is None or standing.settlement is None:
        return standing
    return replace(standing, settlement=mapped(standing.settlement))
