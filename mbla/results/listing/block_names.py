"""Names of many blocks in few words."""

from __future__ import annotations

import numpy as np

from mbla.arrays import IntArray
from mbla.model.model import Model

MOST_STRETCHES = 2
"""stretches of blocks that are named; the others are counted"""


def block_names(model: Model, blocks: IntArray) -> str:
    """``arch[3..9], facade[2]``: blocks that follow each other in their group as one stretch, the longest first.

    Of many stretches the longest are named and the blocks of the others counted.
    """
    groups, indices, counts = _stretches(model, blocks)
    longest = np.argsort(-counts, kind="stable")[:MOST_STRETCHES]
    words = [_stretch(groups[i], int(indices[i]), int(counts[i])) for i in longest]
    left_out = len(blocks) - int(counts[longest].sum())
    return ", ".join(words) + (f" and {left_out} more" if left_out else "")


def stretches(model: Model, blocks: IntArray) -> int:
    """How many stretches of blocks that follow each other in their group."""
    return len(_stretches(model, blocks)[0])


def _stretches(model: Model, blocks: IntArray) -> tuple[list[str], IntArray, IntArray]:
    """Group, first index and length of every stretch, by group and index."""
    groups, indices = np.array(model.blocks.groups)[blocks], model.blocks.group_indices[blocks]
    order = np.lexsort((indices, groups))
    groups, indices = groups[order], indices[order]
    new = np.ones(len(order), dtype=bool)
    new[1:] = (groups[1:] != groups[:-1]) | (np.diff(indices) != 1)
    start = np.flatnonzero(new)
    counts = np.diff(np.append(start, len(order)))
    return [str(group) for group in groups[start]], indices[start], counts


def _stretch(group: str, first: int, count: int) -> str:
    return f"{group}[{first}]" if count == 1 else f"{group}[{first}..{first + count - 1}]"
