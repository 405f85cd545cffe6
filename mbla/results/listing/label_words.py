"""What selectors can say within a group, in words: members with their numbers of blocks, and ranges of positions."""

from __future__ import annotations

from collections import Counter

from mbla.arrays import IntArray
from mbla.deck.sections.selectors import POSITIONS
from mbla.model.solids.blocks import BlockLabels

MOST_NAMED = 8
"""members that are named one by one"""


def label_words(labels: BlockLabels, blocks: IntArray) -> str:
    """``members key (1 block), ring (8); course 0 .. 5``; empty where the blocks have no labels."""
    words = []
    counts = Counter(labels.members[block] for block in blocks.tolist())
    counts.pop("", None)
    if counts:
        named = [f"{name} ({count})" for name, count in list(counts.items())[:MOST_NAMED]]
        more = f" and {len(counts) - MOST_NAMED} more" if len(counts) > MOST_NAMED else ""
        words.append(f"{'member' if len(counts) == 1 else 'members'} {', '.join(named)}{more}")
    for name in POSITIONS:
        positions = labels.position(name)[blocks]
        positions = positions[positions >= 0]
        if len(positions):
            words.append(f"{name} {positions.min()} .. {positions.max()}")
    return "; ".join(words)
