"""How many blocks an item may ask for: a slip in the units of length asks for far more than anyone can mean."""

from __future__ import annotations

from mbla.deck.tree import KeyPath
from mbla.errors import Message
from mbla.model.generators.generator import ItemRefused

MOST = 2_000_000
"""of units, or of facets of their surfaces: some GB of memory"""


def refuse_too_many(amount: float, key: str | KeyPath, what: str = "units") -> None:
    """Refuse an item that makes about so many units; at a key of the item, or a key path below it.

    Raises
    ------
    ItemRefused
        for more than can be handled
    """
    if amount > MOST:
        path = (key,) if isinstance(key, str) else key
        about = float(min(amount, 10**300))  # products of whole numbers may be too large for a number
        words = f"makes about {about:.0e} {what}; at most {MOST:,} can be handled"
        raise ItemRefused([(path, Message("too-many-units", words))])
