"""How many blocks an item may ask for: a slip in the units of length asks for far more than anyone can mean."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from mbla.deck.items.item import Item, Repetition
from mbla.deck.text.tree import KeyPath
from mbla.errors import Finding, Message
from mbla.model.generators.generator import ItemRefused

MOST = 2_000_000
"""of units, or of facets of their surfaces: some GB of memory"""
FACETS_OF_A_UNIT = 6
"""of most units; an item may have so many times as many facets, in all its copies, as it may have units"""

MOST_PAIRS, PAIRS_OF_A_BLOCK = 300_000, 30
"""of blocks that are looked at: so many, or so many times the number of blocks; those that share no volume have some
ten"""
MOST_COPIES = 10**15
"""that are told apart: far beyond all that can be handled, and a number that products with others stay finite of"""


def copies_of(item: Item) -> int:
    """How often an item is there, itself included; ``MOST_COPIES`` stand for more."""
    steps = [item.repeat] if isinstance(item.repeat, Repetition) else item.repeat
    return min(math.prod(step.count for step in steps), MOST_COPIES)


@dataclass(frozen=True)
class Amount:
    """About how much one copy of an item makes, known before it is made.

    number : of units, or of facets of their surfaces
    key    : of the item, or a key path below it, that has most to do with it
    """

    number: float
    key: str | KeyPath = ()
    what: Literal["units", "facets"] = "units"

    def of_copies(self, item: Item) -> float:
        """In units, of an item with all its copies."""
        return self.number * copies_of(item) / (FACETS_OF_A_UNIT if self.what == "facets" else 1)


def refuse_too_many(amount: Amount, item: Item) -> None:
    """Refuse an item that makes more than can be handled, before any of it is made.

    Raises
    ------
    ItemRefused
        at the key of the amount
    """
    copies = copies_of(item)
    words = amount.what if copies == 1 else f"{amount.what} in {copies:,} copies"
    if amount.what == "facets":
        refuse_beyond(MOST, amount.number, amount.key, amount.what)
    most = MOST if amount.what == "units" else FACETS_OF_A_UNIT * MOST
    refuse_beyond(most, amount.number * copies, amount.key, words)


def most_pairs(blocks: int) -> int:
    """Pairs that so many blocks may have that come near each other."""
    return max(MOST_PAIRS, PAIRS_OF_A_BLOCK * blocks)


def too_many_together(about: float) -> Message | None:
    """What is said of items that make about so many units together; None where that can be handled."""
    if about <= MOST:
        return None
    words = f"the items make about {about:.0e} units together; at most {MOST:,} can be handled"
    return Message("too-many-units", words)


def refuse_beyond(most: int, amount: float, key: str | KeyPath, what: str) -> None:
    """Refuse an item that makes more of something than can be handled, at a key of it.

    Raises
    ------
    ItemRefused
        at that key
    """
    if amount > most:
        words = f"makes about {min(amount, 1e300):.0e} {what}; at most {most:,} can be handled"
        raise ItemRefused(Finding("too-many-units", words, *((key,) if isinstance(key, str) else key)))
