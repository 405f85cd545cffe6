"""Keys that users of other programs look for here and that a deck cannot have, with the reason instead of a list."""

from __future__ import annotations

from mbla.deck.tree import KeyPath

REASONS = {
    ("supports", "stiffness"): "elastic supports are not taken: the collapse load of rigid blocks does not depend on "
    "how stiff their supports are; leave it out, or let the support give way with load_cases.NAME.settlement",
}
"""(section, key) of a mapping in that section, at any depth -> why"""


def refusal(path: KeyPath) -> str | None:
    """Why a deck cannot have the key at a path; None where there is no more to say than that it is unknown."""
    return REASONS.get((str(path[0]), str(path[-1]))) if len(path) > 1 else None
