"""Labels of blocks within their group: the member of a composite item, and counted positions such as the course.

A generator knows where each unit lies; selectors ask for it (``{group: facade, course: 3}``), and results say it.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.selectors import POSITIONS

NONE = -1
"""position of a block that has none of that name"""


@dataclass(frozen=True)
class BlockLabels:
    """Labels of n blocks.

    members   : name of the part of a composite item that a block belongs to, such as "lintel"; empty where none
    positions : (n, len(POSITIONS)) from 0; -1 where the generator gives none of that name
    """

    members: tuple[str, ...]
    positions: IntArray

    def position(self, name: str) -> IntArray:
        """(n,) of the positions of that name."""
        column: IntArray = self.positions[:, POSITIONS.index(name)]
        return column


def no_labels(count: int) -> BlockLabels:
    """Labels of blocks that have none."""
    return BlockLabels(("",) * count, np.full((count, len(POSITIONS)), NONE, dtype=np.int64))


def labels_of(count: int, member: str | Sequence[str], positions: Mapping[str, IntArray], copy: int) -> BlockLabels:
    """Labels of the blocks of one part of an item.

    member    : of all blocks, or of each
    positions : (count,) by name
    copy      : number of the repetition; -1 where the item is not repeated
    """
    labels = no_labels(count)
    for name, values in positions.items():
        labels.positions[:, POSITIONS.index(name)] = values
    labels.positions[:, POSITIONS.index("copy")] = copy
    members = (member,) * count if isinstance(member, str) else tuple(member)
    if len(members) != count:
        raise ValueError(f"{len(members)} members for {count} blocks")
    return BlockLabels(members, labels.positions)


def join_labels(parts: Sequence[BlockLabels]) -> BlockLabels:
    """Labels of the blocks of several parts, in order."""
    return BlockLabels(
        tuple(member for part in parts for member in part.members),
        np.concatenate([part.positions for part in parts]),
    )
