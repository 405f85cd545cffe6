"""How many blocks an item may ask for: a slip in the units of length asks for far more than anyone can mean."""

from __future__ import annotations

import math
from dataclasses import dataclass

from mbla.deck.items.item import Item, Repetition

MOST = 2_000_000
"""units, or facets of round blocks, that all items together may make: some GB of memory"""


@dataclass(frozen=True)
class Amount:
    """About how much one copy of an item makes, known before it is made.

    units : of usual size; where blocks have many facets each of these counts
    key   : of the item, that has most to do with it; empty for the item itself
    """

    units: float
    key: str = ""


def copies_of(item: Item) -> int:
    """How often an item is there, itself included."""
    steps = [item.repeat] if isinstance(item.repeat, Repetition) else item.repeat
    return math.prod(step.count for step in steps)


def too_many(units: float) -> str:
    """What is said after an item, or all of them, that makes more than can be handled."""
    return f"about {min(units, 1e300):.0e} units; at most {MOST:,} can be handled"
