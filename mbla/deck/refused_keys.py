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

GONE = (("analysis", "reductions", "merged"), ("analysis", "reductions", "repeated"))
"""Keys of earlier versions that nothing replaces: decks give the same without them"""


def refusal(path: KeyPath) -> Message | None:
    """Why a deck cannot have the key at a path; None where there is no more to say than that it is unknown."""
    if path in REPLACED:
        return Message("replaced-key", f"is not a key any more: write {REPLACED[path]}")
    if path in GONE:
        return Message("replaced-key", "is not a key any more: leave it out, nothing else changes")
    why = FOREIGN.get((str(path[0]), str(path[-1]))) if len(path) > 1 else None
    return None if why is None else Message("key-of-another-program", why)
