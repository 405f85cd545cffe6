"""Forces of a case in words: reactions and interfaces, how far they are determined, and the work that they do."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.force_freedom import Enough, ForceFreedom
from mbla.results.collapse.mechanics import (
    Work,
    group_reactions,
    load_on_structure,
    reactions_of,
)
from mbla.results.collapse.soil_pressure import SoilPressure, soil_pressures, water_pressures
from mbla.results.collapse.thrust import thrust_of
from mbla.results.listing.blocks import MOST_ROWS, Block, Paragraph, apart, table_of
from mbla.results.listing.places import counted_of, point_words, soil_words
from mbla.results.listing.text import counted, number, vector
from mbla.results.outcome import result_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Mechanics


def reaction_blocks(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> list[Block]:
    """Forces of the supports on the structure, and how they balance the loads on the free blocks."""
    reactions = reactions_of(model, contacts, load_case, mechanics)
    total = np.sum([reaction.wrench for reaction in reactions], axis=0) if reactions else np.zeros(6)
    load = load_on_structure(model, load_case, mechanics.load_factor)
    named = [(reaction.support, reaction.wrench) for reaction in reactions]
    named += [("sum of reactions", total), ("loads on free blocks", load), ("out of balance", total + load)]
    force, length = model.units.force, model.units.length
    at_collapse = " at collapse" * load_case.question.collapses
    head = ["reaction on the structure", *(f"F{axis}" for axis in "xyz"), *(f"M{axis}" for axis in "xyz")]
    caption = f"Reactions{at_collapse}, forces in {force}, moments about the origin in {force} {length}"
    return table_of(head, [[name, *_components(wrench, load)] for name, wrench in named], caption=caption)


def group_reaction_blocks(model: Model, contacts: Contacts, mechanics: Mechanics) -> list[Block]:
    """Forces of the supports by the group of the blocks that they carry; nothing where they carry one group alone."""
    groups = group_reactions(model, contacts, mechanics.contact_forces)
    if len(groups) < 2:
        return []
    largest = max(float(np.abs(reaction.wrench[:3]).max()) for reaction in groups)
    size = np.full(6, largest or 1.0)
    shown = sorted(groups, key=lambda reaction: -float(np.linalg.norm(reaction.wrench[:3])))[:MOST_ROWS]
    head = ["supports carry", *(f"F{axis} [{model.units.force}]" for axis in "xyz")]
    rows = [[reaction.support, *_components(reaction.wrench, size)[:3]] for reaction in shown]
    return apart(table_of(head, rows, total=len(groups)))


def soil_blocks(model: Model, contacts: Contacts, case: CaseResult) -> list[Block]:
    """What soil of cells and water in it press with on groups of blocks, and where: with the forces that are shown, and
    at rest; nothing without such soil.
    """
    solution, water = case.solution, water_pressures(model, case.load_case)
    states = {} if solution.mechanics is None else {"soil presses": solution.mechanics.contact_forces}
    if solution.standing is not None and solution.standing.forces is not None:
        states["at rest soil presses"] = solution.standing.forces[: len(contacts.points)]
    blocks: list[Block] = []
    for head, forces in states.items():
        table = _soil_table(model, head, [*soil_pressures(model, contacts, forces), *water])
        blocks += apart(table) if blocks else table
    if "at rest soil presses" in states and blocks:
        blocks += apart([Paragraph(AT_REST)])
    return blocks


AT_REST = (
    "At rest: forces that arise under the dead load alone in the assembly without stress, of elastic joints; others "
    "are possible, and no coefficient of earth pressure at rest is assumed. They may lie below active earth pressure."
)


def _soil_table(model: Model, head: str, found: Sequence[SoilPressure]) -> list[Block]:
    """Rows of soil and of water in it, with forces and the centre of pressure."""
    size = np.full(6, max((float(np.abs(each.force).max()) for each in found), default=1.0) or 1.0)
    force, length = model.units.force, model.units.length
    rows = [
        [
            f"{'water in ' * each.water}{soil_words(model, np.array([each.soil]))} on {each.group}",
            *_components(np.append(each.force, np.zeros(3)), size)[:3],
            "-" if np.isnan(each.point).any() else point_words(model, each.point),
        ]
        for each in found[:MOST_ROWS]
    ]
    heads = [head, *(f"F{axis} [{force}]" for axis in "xyz"), f"centre of pressure at [{length}]"]
    return table_of(heads, rows, total=len(found))


def _components(wrench: FloatArray, load: FloatArray) -> list[str]:
    """Six numbers; what is below 1e-9 of the load is noise of the last digits."""
    sizes = np.repeat([np.abs(load[:3]).max(), max(np.abs(load[3:]).max(), np.abs(load[:3]).max())], 3)
    return [f"{0.0 if abs(v) < 1e-9 * s else v:.5g}" for v, s in zip(wrench, sizes, strict=True)]


def lock_blocks(model: Model, contacts: Contacts, lock: FloatArray) -> list[Block]:
    """Forces that balance the live load alone, the largest interfaces first.

    lock : (n_points, 3)  N, T1, T2 [N], compression positive
    """
    thrust = thrust_of(model, contacts, lock)
    normal, shear, sizes = thrust.normal_forces, thrust.shear_forces, np.linalg.norm(thrust.forces, axis=1)
    loaded = int(np.sum(sizes > 1e-6 * sizes.max(initial=0.0)))
    order = np.argsort(-sizes, kind="stable")[: min(loaded, MOST_ROWS)]
    says = (
        f"Locked: these forces, within the strength of the joints, balance the live load alone, so that any multiple "
        f"of it is carried; {counted(loaded, 'interface')} take part, the largest"
    )
    size, rows = float(np.abs(model.blocks.vertices).max(initial=0.0)), []
    for row in order:
        a, b = contacts.bodies[row]
        between = f"{model.body_name(int(a))}/{model.body_name(int(b))}"
        rows.append([between, vector(contacts.centroids[row], size), number(normal[row]), number(shear[row])])
    force = model.units.force
    head = ["interface", f"at [{model.units.length}]", f"normal [{force}]", f"shear [{force}]"]
    return table_of(head, rows, left=2, caption=says, total=loaded)


# --- What of a structure counts for its load factor, and how unique its forces are, in words ------------------------


def enough_blocks(model: Model, case: CaseResult, enough: Enough) -> list[Block]:
    """The reduced model with the same load factor; nothing where every free block moves or the case has no result."""
    resting = np.append(enough.bearing, enough.left_out)
    if result_of(case) is None or not len(resting) or not len(enough.moving):
        return []
    moving = counted_of(model, enough.moving, "moving block")
    if model.soils:
        rest, left_out = counted_of(model, resting, "free block"), counted_of(model, enough.left_out)
        fixing, far = f"what is at rest ({rest})", f"{left_out} touch nothing that moves"
    else:
        fixing = f"the {counted(len(resting), 'stationary free block')}"
        far = f"{len(enough.left_out)} of them touch no moving block"
    says = (
        f"Reduced model: {moving} with {counted(len(enough.interfaces), 'interface')}. Fixing {fixing} leaves the "
        f"load factor unchanged; {far} and can be removed."
    )
    return [Paragraph(says)]


def freedom_blocks(contacts: Contacts, case: CaseResult, freedom: ForceFreedom | str) -> list[Block]:
    """Whether the forces are unique, or why that is not known; what gives the range of one of them."""
    if result_of(case) is None or not len(contacts):
        return []
    if isinstance(freedom, str):
        text = f"The number of unique contact forces was not determined, as {freedom}."
    else:
        text = (
            f"Degree of static indeterminacy at this load factor, in this mechanism: at most {freedom.degree}; the "
            f"resultants of {int(freedom.determined.sum())} of {counted(len(contacts), 'interface')} are unique."
        )
    ask = " For the least and the greatest value of a force: a load case with objective."
    return [Paragraph(text + ask * case.load_case.question.collapses)]


# --- Where the power of a mechanism goes ----------------------------------------------------------------------------


def work_blocks(load_case: LoadCase, work: Work, *, soil: bool = False) -> list[Block]:
    """Shares of the power that the loads put in; nothing where they put in none.

    What is put in is positive, of loads that are lifted negative; what joints dissipate is positive.
    soil : fill holds faces too
    """
    if work.supplied <= 0:
        return []

    def part(name: str, power: float) -> str:
        return f"{name} {round(100 * power / work.supplied, 1) + 0.0:.1f} %"

    normal = float(work.normal.sum())
    joints = {"friction": float(work.friction.sum()), "cohesion": float(work.cohesion.sum())}
    joints |= {"normal forces of joints" if normal > 0 else "dilatancy": normal}
    joints["ties and soil" if soil else "ties"] = work.ties
    shares = [part(name, power) for name, power in joints.items() if name == "friction" or part("", power) != " 0.0 %"]
    live, dead = load_case.question.powers
    loads = f"{part(live, work.live)}, {part(dead, work.dead)}"
    return [Paragraph(f"Energy balance, shares of the work put in: {loads}; dissipated: {', '.join(shares)}.")]
