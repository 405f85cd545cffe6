"""Forces of a case in words: reactions and interfaces, how far they are determined, and the work that they do."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.force_freedom import Enough, ForceFreedom
from mbla.results.collapse.interface_modes import sum_by_interface
from mbla.results.collapse.mechanics import (
    Work,
    group_reactions,
    load_on_structure,
    reactions_of,
)
from mbla.results.collapse.thrust import thrust_of
from mbla.results.listing.text import MOST_ROWS, counted, long_table, number, sentence, table, vector
from mbla.results.outcome import UNIQUE, result_of
from mbla.results.results import CaseResult
from mbla.solution.solution import Mechanics


def reaction_lines(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> list[str]:
    """Forces of the supports on the structure, and how they balance the loads on the free blocks."""
    reactions = reactions_of(model, contacts, load_case, mechanics)
    total = np.sum([reaction.wrench for reaction in reactions], axis=0) if reactions else np.zeros(6)
    load = load_on_structure(model, load_case, mechanics.load_factor)
    named = [(reaction.support, reaction.wrench) for reaction in reactions]
    named += [("sum of reactions", total), ("loads on free blocks", load), ("out of balance", total + load)]
    force, length = model.units.force, model.units.length
    head = ["reaction on the structure", *(f"F{axis}" for axis in "xyz"), *(f"M{axis}" for axis in "xyz")]
    return [
        "",
        *sentence(f"Reactions at collapse, forces in {force}, moments about the origin in {force} {length}:"),
        *table(head, [[name, *_components(wrench, load)] for name, wrench in named]),
    ]


def group_reaction_lines(model: Model, contacts: Contacts, mechanics: Mechanics) -> list[str]:
    """Forces of the supports by the group of the blocks that they carry; nothing where they carry one group alone."""
    groups = group_reactions(model, contacts, mechanics.contact_forces)
    if len(groups) < 2:
        return []
    largest = max(float(np.abs(reaction.wrench[:3]).max()) for reaction in groups)
    size = np.full(6, largest or 1.0)
    shown = sorted(groups, key=lambda reaction: -float(np.linalg.norm(reaction.wrench[:3])))[:MOST_ROWS]
    head = ["supports carry", *(f"F{axis} [{model.units.force}]" for axis in "xyz")]
    rows = [[reaction.support, *_components(reaction.wrench, size)[:3]] for reaction in shown]
    return long_table(head, rows, len(groups))


def _components(wrench: FloatArray, load: FloatArray) -> list[str]:
    """Six numbers; what is below 1e-9 of the load is noise of the last digits."""
    sizes = np.repeat([np.abs(load[:3]).max(), max(np.abs(load[3:]).max(), np.abs(load[:3]).max())], 3)
    return [f"{0.0 if abs(v) < 1e-9 * s else v:.5g}" for v, s in zip(wrench, sizes, strict=True)]


def lock_lines(model: Model, contacts: Contacts, lock: FloatArray) -> list[str]:
    """Forces that balance the live load alone, the largest interfaces first.

    lock : (n_points, 3)  N, T1, T2 [N], compression positive
    """
    thrust = thrust_of(model, contacts, lock)
    normal, shear, sizes = thrust.normal_forces, thrust.shear_forces, np.linalg.norm(thrust.forces, axis=1)
    loaded = int(np.sum(sizes > 1e-6 * sizes.max(initial=0.0)))
    order = np.argsort(-sizes, kind="stable")[: min(loaded, MOST_ROWS)]
    rows = [[*_interface(model, contacts, int(i)), number(float(normal[i])), number(float(shear[i]))] for i in order]
    force = model.units.force
    says = (
        f"Locked: these forces, within the strength of the joints, balance the live load alone, so that any multiple "
        f"of it is carried; {counted(loaded, 'interface')} take part, the largest:"
    )
    head = ["interface", f"at [{model.units.length}]", f"normal [{force}]", f"shear [{force}]"]
    return ["", *sentence(says), *long_table(head, rows, loaded, left=2)[1:]]


def force_range_lines(model: Model, contacts: Contacts, mechanics: Mechanics, ranges: FloatArray) -> list[str]:
    """How far normal forces can range at the load factor, the widest ranges first.

    ranges : (n_interfaces, 2) least and greatest [N], compression positive; inf where unlimited, nan where not found
    """
    found = sum_by_interface(contacts, mechanics.contact_forces[:, 0])
    widths = ranges[:, 1] - ranges[:, 0]
    order = np.argsort(-widths, kind="stable")[:MOST_ROWS]
    rows = [[*_interface(model, contacts, int(i)), *(_force(float(v)) for v in (*ranges[i], found[i]))] for i in order]
    force = model.units.force
    unique = int(np.sum(np.isfinite(widths) & (widths <= UNIQUE * np.abs(ranges).max(axis=1))))
    says = f"Normal forces that are possible at this load factor; {unique} of {len(contacts)} are unique. The widest:"
    head = ["interface", f"at [{model.units.length}]", f"least [{force}]", "greatest", "found"]
    return ["", *sentence(says), *long_table(head, rows, len(contacts), left=2)[1:]]


def _force(value: float) -> str:
    return "unlimited" if np.isinf(value) else number(value)


def _interface(model: Model, contacts: Contacts, interface: int) -> list[str]:
    a, b = contacts.bodies[interface].tolist()
    size = float(np.abs(model.blocks.vertices).max(initial=0.0))
    return [f"{model.body_name(a)}/{model.body_name(b)}", vector(contacts.centroids[interface], size)]


# --- What of a structure counts for its load factor, and how unique its forces are, in words ------------------------


def enough_lines(case: CaseResult, enough: Enough) -> list[str]:
    """Which blocks can be left out; nothing where every free block moves or the case has no result."""
    resting = len(enough.bearing) + len(enough.left_out)
    if result_of(case) is None or not resting or not len(enough.moving):
        return []
    return sentence(
        f"Relevant to this result: {counted(len(enough.moving), 'moving block')} and "
        f"{counted(len(enough.interfaces), 'interface')} on them. With the {counted(resting, 'stationary free block')} "
        f"fixed ({len(enough.left_out)} touch no moving block and can be removed) it has the same load factor."
    )


def freedom_lines(contacts: Contacts, case: CaseResult, freedom: ForceFreedom | str) -> list[str]:
    """Whether the forces are unique, or why that is not known; the option that gives their ranges if not taken."""
    if result_of(case) is None or not len(contacts):
        return []
    if isinstance(freedom, str):
        told = f"How far the contact forces are unique was not determined, as {freedom}."
    else:
        told = (
            f"Degree of static indeterminacy at this load factor, in this mechanism: at most {freedom.degree}; the "
            f"resultants of {int(freedom.determined.sum())} of {counted(len(contacts), 'interface')} are unique."
        )
    can_ask = case.solution.force_ranges is None and case.solution.contact_model == "concave"
    return sentence(told + " For ranges of forces: analysis.force_ranges: true." * can_ask)


# --- Where the power of a mechanism goes ----------------------------------------------------------------------------


def work_lines(load_case: LoadCase, work: Work) -> list[str]:
    """Shares of the power that the loads put in; nothing where they put in none."""
    if work.given <= 0:
        return []
    settles = load_case.settlement is not None  # whose dead load holds the reaction at rest
    against = "the reaction at rest less the work of the weights" if settles else "work against the dead load"
    normal = float(work.normal.sum())
    sinks = (
        (against, max(-work.dead, 0.0), work.dead <= 0),
        ("work against the live load", max(-work.live, 0.0), False),
        ("friction", float(work.friction.sum()), True),
        ("cohesion", float(work.cohesion.sum()), False),
        ("normal forces of the joints", max(normal, 0.0), False),
        ("dilatancy of the sliding joints", min(normal, 0.0), False),
    )
    shares = [(name, power_share(power, work), always) for name, power, always in sinks]
    balance = ", ".join(f"{share} % {name}" for name, share, always in shares if always or float(share) != 0.0)
    return sentence(f"Energy balance, {_source(load_case, work)}: {balance}.")


def _source(load_case: LoadCase, work: Work) -> str:
    """What does the work."""
    if load_case.settlement is not None and work.dead <= 0:
        return "of the work of the reaction that the support loses"
    if work.dead <= 0:
        return "of the work of the live load"
    if work.live <= 0:
        return "of the work of the dead load, which drives the mechanism"
    live, dead = power_share(work.live, work), power_share(work.dead, work)
    return f"of the work of the live load ({live} %) and the dead load ({dead} %)"


def power_share(power: float, work: Work) -> str:
    """Percentage of the power that is put in, ``-`` where none is."""
    return f"{round(100 * power / work.given, 1) + 0.0:.1f}" if work.given > 0 else "-"
