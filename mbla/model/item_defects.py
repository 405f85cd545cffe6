"""Defects of blocks as faults of the deck, at the items or faces that give the blocks."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence

from mbla.arrays import IntArray
from mbla.deck.deck import Deck
from mbla.deck.tree import KeyPath
from mbla.errors import Fault, Message
from mbla.model.blocks import Blocks
from mbla.model.collect_items import kind_of
from mbla.model.defects import Defect

FROM_FILES = ("mesh", "table")
"""kinds of items whose blocks have names of their own"""
MOST_FAULTS_PER_ITEM = 10
"""defects of blocks of one item that are told one by one; a mesh in the wrong format has one in every block"""


def defects_in_words(deck: Deck, defects: Sequence[Defect], item_of_block: IntArray, blocks: Blocks) -> list[Fault]:
    """A fault for each defect; many of one item are counted only.

    item_of_block : (n_blocks,) item of the deck that each block comes from
    """
    faults = []
    told: Counter[int] = Counter()
    for defect in defects:
        number = int(item_of_block[defect.block])
        told[number] += 1
        if told[number] <= MOST_FAULTS_PER_ITEM:
            path = _path(deck, defect.face, number)
            faults.append(
                deck.fault_at(
                    path, defect.message.around(before=f"block {_called(deck, blocks, defect.block, number)}: ")
                )
            )
    for number, count in told.items():
        if count > MOST_FAULTS_PER_ITEM:
            message = f"{count - MOST_FAULTS_PER_ITEM} more blocks of this item are refused"
            faults.append(deck.fault_at(_path(deck, None, number), Message("more-faults", message)))
    return faults


def _called(deck: Deck, blocks: Blocks, block: int, number: int) -> str:
    """Name of a block; with that which its file gives it, where it comes from one: ``vault[17] (key_stone)``."""
    member = blocks.labels.members[block] if kind_of(deck.content.blocks[number])[0] in FROM_FILES else ""
    return f"{blocks.name(block)}{f' ({member})' if member else ''}"


def _path(deck: Deck, face: int | None, number: int) -> KeyPath:
    """The face of a block that the deck spells out, the file of a mesh, or the item."""
    kind, _ = kind_of(deck.content.blocks[number])
    if kind == "polyhedron" and face is not None:
        return ("blocks", number, kind, "faces", face)
    return ("blocks", number, kind, "file") if kind == "mesh" else ("blocks", number, kind)
