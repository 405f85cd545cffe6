"""Keys and choices that decks of earlier versions had, and of other programs: what to write instead."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from mbla.errors import Message

KEYS: Mapping[str, str] = {
    "contacts.refine": "write contacts.points.per_edge",
    "contacts.inset": "write contacts.points.inset",
    "analysis.second_opinion": "leave it out, the proved bounds say how good the load factor is",
    "analysis.form": "leave it out, the associative program is solved in velocities",
    "analysis.path": "leave it out, the load path is followed where a peak is looked for, and listed",
    "analysis.forces": "leave it out, contact forces of associative flow are those that prove its load factor",
    "analysis.proximal": "leave it out, the default scheme has no parameters but analysis.search",
    "analysis.interior": "leave it out, the default scheme has no parameters but analysis.search",
    "analysis.lowest": "leave it out, analysis.search says how far lower load factors are looked for",
    "supports.stiffness": "leave it out, the collapse load of rigid blocks does not depend on how stiff their supports "
    "are; load_cases.NAME.settlement lets a support give way",
}
"""Section and key, at whatever depth below the section -> what to do"""

SCHEMES: Mapping[str, str] = {
    "path": "use auto; where a peak is looked for the load path is followed and listed",
    "proximal": "use auto, which ends lower",
    "interior": "use auto, which ends lower",
    "lowest": "use auto, which looks for lower load factors; analysis.search says how far",
}
"""Choice of analysis.scheme -> what to write"""


def gone_key(path: tuple[str | int, ...]) -> Message | None:
    """Why a deck cannot have the key at a path; None where there is no more to say than that it is unknown."""
    words = KEYS.get(f"{path[0]}.{path[-1]}") if len(path) > 1 else None
    return Message("replaced-key", f"is no key here: {words}") if words else None


def gone_value(path: tuple[str | int, ...], value: Any) -> Message | None:
    """Why a deck cannot have a value of earlier versions at a path; None where it is not one."""
    if path == ("analysis", "reductions") and isinstance(value, dict):
        return Message("replaced-key", "is one switch: write false in place of the mapping to leave nothing out")
    words = SCHEMES.get(value) if path == ("analysis", "scheme") and isinstance(value, str) else None
    return Message("replaced-key", f"is no scheme any more: {words}") if words else None
