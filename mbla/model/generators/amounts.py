"""How many blocks an item may ask for: a slip in the units of length asks for far more than anyone can mean."""

from __future__ import annotations

import math

from mbla.deck.items.item import Item, Repetition
from mbla.deck.tree import KeyPath
from mbla.errors import Message
from mbla.model.generators.generator import ItemRefused

MOST = 2_000_000
"""of units, or of facets of their surfaces: some GB of memory"""
FACETS_OF_A_UNIT = 6
"""of most units; an item may have so many times as many facets, in all its copies, as it may have units"""


def copies_of(item: Item) -> int:
    """How often an item is there, itself included."""
    steps = [item.repeat] if isinstance(item.repeat, Repetition) else item.repeat
    return math.prod(step.count for step in steps)


def refuse_too_many(amount: float, key: str | KeyPath, what: str = "units", copies: int = 1) -> None:
    """Refuse an item that makes about so many units; at a key of the item, or a key path below it.

    Before they are made: one of many copies may take GB of memory, too.

    Raises
    ------
    ItemRefused
        for more than can be handled
    """
    _refuse_beyond(MOST, amount * copies, key, what if copies == 1 else f"{what} in {copies:,} copies")


def refuse_too_many_facets(amount: float, key: str | KeyPath, copies: int) -> None:
    """Refuse an item of which each copy has about so many facets.

    Raises
    ------
    ItemRefused
        for more than can be handled
    """
    _refuse_beyond(MOST, amount, key, "facets")
    _refuse_beyond(FACETS_OF_A_UNIT * MOST, amount * copies, key, f"facets in {copies:,} copies")


def _refuse_beyond(most: int, amount: float, key: str | KeyPath, what: str) -> None:
    if amount > most:
        path = (key,) if isinstance(key, str) else key
        about = float(min(amount, 10**300))  # products of whole numbers may be too large for a number
        words = f"makes about {about:.0e} {what}; at most {most:,} can be handled"
        raise ItemRefused([(path, Message("too-many-units", words))])
