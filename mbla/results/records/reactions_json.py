"""What supports carry, as an object of the JSON record."""

from __future__ import annotations

from typing import Any

import numpy as np

from mbla.arrays import FloatArray
from mbla.contacts.contacts import Contacts
from mbla.model.model import LoadCase, Model
from mbla.results.collapse.mechanics import guide_reactions, support_reactions
from mbla.results.records.key import Key
from mbla.results.records.numbers import numbers
from mbla.solution.solution import Mechanics


def reactions_json(model: Model, contacts: Contacts, load_case: LoadCase, mechanics: Mechanics) -> dict[str, Any]:
    """Resultants on the structure, moments about the origin: of all supports, and by ground plane and group.

    Guides are among them: what they take is a support too.
    """
    found = [
        *support_reactions(model, contacts, mechanics.contact_forces, by_group=True),
        *guide_reactions(model, contacts, load_case, mechanics, by_group=True),
    ]
    total = np.sum([reaction.wrench for reaction in found], axis=0) if found else np.zeros(6)
    return {
        "total": _wrench_json(total),
        "supports": {reaction.support: _wrench_json(reaction.wrench) for reaction in found},
    }


def _wrench_json(wrench: FloatArray) -> dict[str, Any]:
    wrench = wrench + 0.0  # no -0.0
    return {"force": numbers(wrench[:3]), "moment": numbers(wrench[3:])}


def reaction_keys(place: str) -> tuple[Key, ...]:
    """Description of this object at ``place``."""
    return (
        Key(
            place, "object?", "what the supports exert on the structure at collapse; null where the case has no result"
        ),
        Key(f"{place}.total", "object", "all of them together: unique, as it balances the loads"),
        *_wrench_keys(f"{place}.total"),
        Key(
            f"{place}.supports",
            "object",
            "one by one, which need not be unique: ground planes, fixed blocks and guides by group",
        ),
        Key(f"{place}.supports.*", "object", "of a ground plane, `GROUP (fixed blocks)` or `guides of GROUP`"),
        *_wrench_keys(f"{place}.supports.*"),
    )


def _wrench_keys(owner: str) -> tuple[Key, ...]:
    return (
        Key(f"{owner}.force", "list", "resultant force"),
        Key(f"{owner}.force[]", "number", "a component", "force"),
        Key(f"{owner}.moment", "list", "its moment about the origin"),
        Key(f"{owner}.moment[]", "number", "a component", "moment"),
    )
