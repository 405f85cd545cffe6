"""Forces in words: reactions of the supports, forces that lock a structure, how far normal forces can range."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.by_interface import sum_by_interface
from mbla.results.collapse.mechanics import (
    group_reactions,
    guide_reactions,
    interface_resultants,
    load_on_structure,
    support_reactions,
)
from mbla.results.listing.text import MOST_ROWS, counted, number, sentence, table, vector
from mbla.results.outcome import UNIQUE
from mbla.solution.solution import Mechanics


def reaction_lines(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> list[str]:
    """Forces of the supports on the structure, and how they balance the loads on the free blocks."""
    reactions = (
        *support_reactions(model, contacts, mechanics.contact_forces),
        *guide_reactions(model, contacts, load_case, mechanics),
    )
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
    return ["", *table(head, rows), *_more(len(groups), len(rows))]


def _components(wrench: FloatArray, load: FloatArray) -> list[str]:
    """Six numbers; what is below 1e-9 of the load is noise of the last digits."""
    sizes = np.repeat([np.abs(load[:3]).max(), max(np.abs(load[3:]).max(), np.abs(load[:3]).max())], 3)
    return [f"{0.0 if abs(v) < 1e-9 * s else v:.5g}" for v, s in zip(wrench, sizes, strict=True)]


def lock_lines(model: Model, contacts: Contacts, lock: FloatArray) -> list[str]:
    """Forces that balance the live load alone, the largest interfaces first."""
    resultants = interface_resultants(contacts, lock)[:, :3]
    normal = np.einsum("ij,ij->i", resultants, contacts.normals)
    shear = np.linalg.norm(resultants - normal[:, None] * contacts.normals, axis=1)
    sizes = np.linalg.norm(resultants, axis=1)
    loaded = int(np.sum(sizes > 1e-6 * sizes.max(initial=0.0)))
    order = np.argsort(-sizes, kind="stable")[: min(loaded, MOST_ROWS)]
    rows = [[*_interface(model, contacts, int(i)), number(float(normal[i])), number(float(shear[i]))] for i in order]
    force = model.units.force
    says = (
        f"Locked: these forces, within the strength of the joints, balance the live load alone, so that any multiple "
        f"of it is carried; {counted(loaded, 'interface')} take part, the largest:"
    )
    head = ["interface", f"at [{model.units.length}]", f"normal [{force}]", f"shear [{force}]"]
    return ["", *sentence(says), *table(head, rows, left=2), *_more(loaded, len(rows))]


def force_range_lines(model: Model, contacts: Contacts, mechanics: Mechanics, ranges: FloatArray) -> list[str]:
    """How far normal forces can range at the load factor, the widest ranges first."""
    found = sum_by_interface(contacts, mechanics.contact_forces[:, 0])
    widths = ranges[:, 1] - ranges[:, 0]
    order = np.argsort(-widths, kind="stable")[:MOST_ROWS]
    rows = [[*_interface(model, contacts, int(i)), *(_force(float(v)) for v in (*ranges[i], found[i]))] for i in order]
    force = model.units.force
    unique = int(np.sum(np.isfinite(widths) & (widths <= UNIQUE * np.abs(ranges).max(axis=1))))
    says = f"Normal forces that are possible at this load factor; {unique} of {len(contacts)} are unique. The widest:"
    head = ["interface", f"at [{model.units.length}]", f"least [{force}]", "greatest", "found"]
    return ["", *sentence(says), *table(head, rows, left=2), *_more(len(contacts), len(rows))]


def _force(value: float) -> str:
    return "unlimited" if np.isinf(value) else number(value)


def _interface(model: Model, contacts: Contacts, interface: int) -> list[str]:
    a, b = contacts.bodies[interface].tolist()
    size = float(np.abs(model.blocks.vertices).max(initial=0.0))
    return [f"{model.body_name(a)}/{model.body_name(b)}", vector(contacts.centroids[interface], size)]


def _more(total: int, shown: int) -> list[str]:
    return sentence(f"and {total - shown} more; the result files hold them all") if total > shown else []
