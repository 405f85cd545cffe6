"""A solution for solids restated for the blocks that glue joins in them, and back (see :mod:`mbla.contacts.glue`).

Motions are mapped; forces, contact velocities and modes belong to contact points, which both have in common. Ties are
contact points of the solids only (:mod:`mbla.contacts.tied`).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.contacts.glue import Solids, solids_of
from mbla.contacts.tied import tied
from mbla.model.model import LoadCase, Model
from mbla.program.assemble import yield_limits
from mbla.solution.mechanics import AT_REST, contact_modes
from mbla.solution.of_interfaces import of_interfaces
from mbla.solution.solution import ContactMode, Mechanics, Solution, StandingResult
from mbla.solution.thresholds import STILL
from mbla.solution.verification.statics import contact_velocities

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


def solution_on_blocks(solution: Solution, solids: Solids) -> Solution:
    """The solution for the solids with the motions of all blocks, ties by themselves.

    The block that falls is the first of its solid.
    """
    lengths = solids.model.blocks.sizes
    solution = ties_apart(_with_mechanics(solution, lambda part: _without_rounding(part, solids, lengths)), solids)
    if solids.solid_of_block is None:
        return solution
    standing, size = solution.standing, solution.size
    if standing is not None and standing.block is not None:
        standing = replace(standing, block=int(solids.first_blocks[standing.block]))
    if solids.gauge is not None:
        size = None if size is None else replace(size, free_blocks=size.free_blocks - 1)
    return _with_motions(replace(solution, standing=standing, size=size), solids.block_motions)


def solution_on_solids(solution: Solution, solids: Solids) -> tuple[Solution, float]:
    """The solution with motions of the solids, and how far glued blocks move apart, over the largest motion.

    Ties are among the contacts again. The block that falls stays as it is: it is a name for messages.
    """
    solution = ties_among_contacts(solution, solids)
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


def ties_apart(solution: Solution, solids: Solids) -> Solution:
    """The solution with ties by themselves, from one that has them among its contacts."""
    contacts, ties = solids.contacts, solids.contacts.ties
    if ties is None:
        return solution
    surfaces, points = contacts.n_surfaces, ~contacts.tie_points
    count = len(solids.model.ties)

    def apart(mechanics: Mechanics) -> Mechanics:
        forces, rates = np.full(count, np.nan), np.full(count, np.nan)
        forces[ties.rows] = ties.senses * (mechanics.contact_forces[~points, 0] + ties.offsets)
        rates[ties.rows] = -ties.senses * mechanics.contact_velocities[~points, 0]
        return replace(
            _of_interfaces(mechanics, lambda values: values[:surfaces]),
            contact_forces=mechanics.contact_forces[points],
            contact_velocities=mechanics.contact_velocities[points],
            modes=mechanics.modes[points],
            tie_forces=forces,
            tie_rates=rates,
            **_history_apart(mechanics, points, ties.rows, count),
        )

    motions, ranges = solution.certificate_motions, solution.force_ranges
    return replace(
        _with_mechanics(solution, apart),
        certificate_motions=None if motions is None else motions[:surfaces],
        force_ranges=None if ranges is None else ranges[:surfaces],
    )


def _history_apart(mechanics: Mechanics, points: BoolArray, rows: IntArray, count: int) -> dict[str, Any]:
    """What joints of a path of elastic joints remember, and ties by themselves; nothing of rigid ones."""
    if mechanics.remembered is None or mechanics.stiffness is None:
        return {}
    remembered, stiffness = np.full(count, np.nan), np.full(count, np.nan)
    remembered[rows], stiffness[rows] = mechanics.remembered[~points, 0], mechanics.stiffness[~points, 0]
    own = {"remembered": mechanics.remembered[points], "stiffness": mechanics.stiffness[points]}
    if mechanics.crushed is not None:
        own["crushed"] = mechanics.crushed[: len(mechanics.crushed) - len(rows)]
    return own | {"tie_remembered": remembered, "tie_stiffness": stiffness}


def ties_among_contacts(solution: Solution, solids: Solids) -> Solution:
    """The way back from ``ties_apart``; what it left out of ties is nothing."""
    ties = solids.contacts.ties
    if ties is None:
        return solution
    n = len(ties.rows)

    def among(mechanics: Mechanics) -> Mechanics:
        return with_tie_contacts(mechanics, solids)

    motions, ranges = solution.certificate_motions, solution.force_ranges
    return replace(
        _with_mechanics(solution, among),
        certificate_motions=None if motions is None else _padded(motions, n),
        force_ranges=None if ranges is None else _padded(ranges, n),
    )


def with_tie_contacts(mechanics: Mechanics, solids: Solids) -> Mechanics:
    """Mechanics with ties among the contacts of solids; the same where these have none."""
    ties = solids.contacts.ties
    if ties is None or mechanics.tie_forces is None:
        return mechanics
    n = len(ties.rows)
    forces, speeds = np.zeros((n, 3)), np.zeros((n, 3))
    forces[:, 0] = ties.senses * mechanics.tie_forces[ties.rows] - ties.offsets
    if mechanics.tie_rates is not None:
        speeds[:, 0] = -ties.senses * mechanics.tie_rates[ties.rows]
    resultants = np.zeros((n, 6))
    resultants[:, 0] = forces[:, 0]
    own = mechanics.resultants
    return replace(
        _of_interfaces(mechanics, lambda values: _padded(values, n)),
        resultants=None if own is None else np.vstack([own, resultants]),
        contact_forces=np.vstack([mechanics.contact_forces, forces]),
        contact_velocities=np.vstack([mechanics.contact_velocities, speeds]),
        modes=np.append(mechanics.modes, np.zeros(n, dtype=np.int64)),
        **_history_among(mechanics, ties.rows),
    )


def _history_among(mechanics: Mechanics, rows: IntArray) -> dict[str, Any]:
    """The way back from ``_history_apart``; ties have no shear, whose stiffness does not matter."""
    if mechanics.remembered is None or mechanics.stiffness is None:
        return {}
    if mechanics.tie_remembered is None or mechanics.tie_stiffness is None:
        return {}
    remembered, stiffness = np.zeros((len(rows), 3)), np.zeros((len(rows), 2))
    remembered[:, 0], stiffness[:] = mechanics.tie_remembered[rows], mechanics.tie_stiffness[rows, None]
    crushed = {} if mechanics.crushed is None else {"crushed": _padded(mechanics.crushed, len(rows))}
    return crushed | {
        "remembered": np.vstack([mechanics.remembered, remembered]),
        "stiffness": np.vstack([mechanics.stiffness, stiffness]),
    }


def _padded(values: FloatArray, n: int) -> FloatArray:
    """With n rows of nothing behind."""
    return np.concatenate([values, np.zeros((n, *values.shape[1:]))])


def _of_interfaces(mechanics: Mechanics, changed: Callable[[FloatArray], FloatArray]) -> Mechanics:
    """Mechanics with a change of what has a row for each interface."""
    resultants, motions = mechanics.resultants, mechanics.interface_motions
    return replace(
        mechanics,
        resultants=None if resultants is None else changed(resultants),
        interface_motions=None if motions is None else changed(motions),
    )


def _with_motions(
    solution: Solution,
    mapped: Callable[[FloatArray], FloatArray],
    at_rest: Callable[[FloatArray], FloatArray] | None = None,
) -> Solution:
    """The solution with every motion mapped.

    at_rest : what maps motions in which no live load does work; ``mapped`` unless given
    """
    still = at_rest or mapped
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


# --- What follows from forces and mechanisms, recomputed for verification ---------------------------------------------

ROUNDING = 1e-9
"""Difference of velocities over the largest that is rounding: those stored are kept then, as modes at thresholds follow
from them."""


def with_derived(model: Model, contacts: Contacts, load_case: LoadCase, solution: Solution) -> Solution:
    """The solution with velocities and modes of contact points, and resultants, as mechanisms and forces give them."""
    solids = tied(solids_of(model, contacts, load_case))
    solution = ties_among_contacts(solution, solids)
    found: dict[int, Mechanics] = {}
    for part in MOTIONS:
        mechanics: Mechanics | None = getattr(solution, part)
        if mechanics is not None and id(mechanics) not in found:
            still = np.where(model.fixed[:, None], 0.0, mechanics.mechanism)
            moved = contact_velocities(solids.model, solids.contacts, solids.solid_motions(still))
            if _near(moved, mechanics.contact_velocities):
                moved = mechanics.contact_velocities
            mechanics = replace(mechanics, mechanism=still, contact_velocities=moved)
            rule = rule_of(part, solution)
            contact_model = model_of(part, solution)
            mechanics = _with_modes(solids, mechanics, rule, contact_model)
            found[id(getattr(solution, part))] = _without_rounding(mechanics, solids, model.blocks.sizes)
    parts = {part: found.get(id(getattr(solution, part))) for part in MOTIONS}
    return ties_apart(replace(solution, **parts), solids)  # type: ignore[arg-type]  # names and types are those of the parts


def _without_rounding(mechanics: Mechanics, solids: Solids, lengths: FloatArray) -> Mechanics:
    """The same, with joints at rest where blocks move without them, or with the gauge of an objective, but for
    rounding; and with blocks at rest beside what that moves.

    lengths : (n,) sizes of the blocks, or solids, whose motions are given
    """
    motion, velocities, modes = mechanics.mechanism, mechanics.contact_velocities, mechanics.modes
    speeds = np.abs(motion[:, :3]).max(axis=1) + np.abs(motion[:, 3:]).max(axis=1) * lengths
    gauge = 0.0 if solids.gauge is None else float(np.abs(solids.gauge).max())
    moved = np.abs(velocities).max(axis=1)
    rest = moved <= STILL * max(gauge, float(speeds.max(initial=0.0)))
    if rest.all() or moved.max(initial=0.0) <= AT_REST * gauge:
        rest, modes = np.ones_like(rest), np.full_like(modes, ContactMode.STICK)
    return replace(
        mechanics,
        mechanism=np.where((speeds <= STILL * gauge)[:, None], 0.0, motion),
        contact_velocities=np.where(rest[:, None], 0.0, velocities),
        modes=modes,
    )


def _near(one: FloatArray, other: FloatArray) -> bool:
    """Whether two arrays differ by no more than rounding of the largest entry."""
    return bool(np.abs(one - other).max(initial=0.0) <= ROUNDING * np.abs(one).max(initial=0.0))


def _with_modes(solids: Solids, mechanics: Mechanics, flow_rule: str, contact_model: str) -> Mechanics:
    """With modes of the contact points, and resultants of the interfaces where there are any."""
    limits, forces = yield_limits(solids.model, solids.contacts), mechanics.contact_forces
    slope = limits.dilatancy_by(flow_rule)
    if mechanics.interface_motions is None:
        return replace(mechanics, modes=contact_modes(forces, mechanics.contact_velocities, limits, slope))
    return of_interfaces(solids.model, solids.contacts, contact_model, mechanics, flow_rule)
