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
    "analysis.peak": "leave it out, the load factor is the greatest on the path of elastic joints",
    "analysis.range": "leave it out, the load factor is the greatest on the path of elastic joints; analysis.search "
    "says how far to look for lower ones",
    "analysis.forces": "leave it out, contact forces of associative flow are those that prove its load factor",
    "analysis.proximal": "leave it out, the path of elastic joints has no parameters but those of analysis.path",
    "analysis.interior": "leave it out, the path of elastic joints has no parameters but those of analysis.path",
    "analysis.lowest": "leave it out, analysis.search says how far to search for lower load factors",
    "analysis.friction_cone": "leave it out, the cone is circular: programs with polyhedra took 3 to 26 times as "
    "long, and bracketed a load factor that the cone gives with proved bounds",
    "analysis.sides": "leave it out, the friction cone is circular",
    "expected.lower": "write least_load_factor",
    "supports.stiffness": "leave it out, the collapse load of rigid blocks does not depend on how stiff their supports "
    "are; load_cases.NAME.settlement lets a support give way",
}
"""Section and key, at whatever depth below the section -> what to do"""

CHOICES: Mapping[tuple[str, str], str] = {
    ("scheme", "path"): "use auto, which follows the path of elastic joints",
    ("scheme", "elastic"): "use auto, which follows the path of elastic joints",
    ("scheme", "proximal"): "use auto",
    ("scheme", "interior"): "use auto",
    ("scheme", "lowest"): "use auto; analysis.search says how far to look for lower load factors",
    ("solver", "highs"): "use auto, whose load factor lies between proved bounds and takes less time",
}
"""Key of the analysis section and choice of it -> what to write"""


def gone_key(path: tuple[str | int, ...]) -> Message | None:
    """Why a deck cannot have the key at a path; None where there is no more to say than that it is unknown."""
    words = KEYS.get(f"{path[0]}.{path[-1]}") if len(path) > 1 else None
    return Message("replaced-key", f"is no key here: {words}") if words else None


def gone_value(path: tuple[str | int, ...], value: Any) -> Message | None:
    """Why a deck cannot have a value of earlier versions at a path; None where it is not one."""
    if path == ("analysis", "reductions") and isinstance(value, dict):
        return Message("replaced-key", "is one switch: write false in place of the mapping to leave nothing out")
    key = path[-1] if len(path) == 2 and path[0] == "analysis" else ""
    words = CHOICES.get((str(key), value)) if isinstance(value, str) else None
    return Message("replaced-key", f"is no {key} any more: {words}") if words else None
