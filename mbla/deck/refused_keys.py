"""Keys that a deck cannot have and that users look for all the same, with the reason instead of a list of others."""

from __future__ import annotations

from collections.abc import Mapping

from mbla.deck.tree import KeyPath
from mbla.errors import Message

FOREIGN: Mapping[tuple[str, str], str] = {
    ("supports", "stiffness"): "elastic supports are not taken: the collapse load of rigid blocks does not depend on "
    "how stiff their supports are; leave it out, or let the support give way with load_cases.NAME.settlement",
}
"""Keys of other programs: (section, key of a mapping in that section, at any depth) -> why"""

REPLACED: Mapping[KeyPath, str] = {
    ("contacts", "refine"): "contacts.points.per_edge",
    ("contacts", "inset"): "contacts.points.inset",
}
"""Keys of earlier versions: path of the key -> the key that says the same now"""

GONE: Mapping[KeyPath, str] = {
    ("analysis", "second_opinion"): "the proved bounds say how good the load factor is",
    ("analysis", "form"): "the associative program is solved in velocities",
    ("analysis", "forces"): "contact forces of associative flow are those that prove its load factor from below",
}
"""Keys of earlier versions that nothing replaces -> what holds without them"""

WAS_A_MAPPING: Mapping[KeyPath, str] = {
    ("analysis", "reductions"): "is one switch now: write false in place of the mapping to leave nothing out",
}
"""Keys that were mappings in earlier versions -> what to write now"""


def refusal(path: KeyPath) -> Message | None:
    """Why a deck cannot have the key at a path; None where there is no more to say than that it is unknown."""
    if path in REPLACED:
        return Message("replaced-key", f"is not a key any more: write {REPLACED[path]}")
    if path in GONE:
        return Message("replaced-key", f"is not a key any more: leave it out, {GONE[path]}")
    why = FOREIGN.get((str(path[0]), str(path[-1]))) if len(path) > 1 else None
    return None if why is None else Message("key-of-another-program", why)
