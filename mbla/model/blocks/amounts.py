"""How many blocks items may ask for: an error in the units of length asks for far more than is meant."""

from __future__ import annotations

import math
from collections.abc import Sequence

from mbla.deck.sections.placement import Repetition

MOST = 2_000_000
"""units, or facets of round blocks, that all items together may make: some GB of memory"""


def copies_of(repeat: Sequence[Repetition] | Repetition) -> int:
    """How often something is there that is repeated, itself included."""
    steps = [repeat] if isinstance(repeat, Repetition) else repeat
    return math.prod(step.count for step in steps)


def too_many(units: float) -> str:
    """Message on an item, or all of them, that makes more than can be handled."""
    return f"about {min(units, 1e300):.0e} units; at most {MOST:,} can be handled"
