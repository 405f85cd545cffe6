"""What is known of a kind of items of `blocks`, and the register of all kinds."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import KW_ONLY, dataclass
from typing import Any

from mbla.deck.kinds import Kind, register
from mbla.deck.positions import BlockPosition
from mbla.deck.text.tree import KeyPath
from mbla.model.blocks.generated import Generator


def one_unit(item: Any) -> tuple[float, str]:
    """Amount of an item that cannot ask for much."""
    return 1.0, ""


def of_the_item(face: int | None) -> KeyPath:
    """Place of a defect that is told at the item as a whole."""
    return ()


@dataclass(frozen=True)
class SideGroup:
    """A group that an item makes beside its own, named after that: ``suffix`` follows the name.

    values : of a key of the item, with which it makes the group
    """

    suffix: str
    key: str
    values: tuple[str, ...]


@dataclass(frozen=True)
class ItemKind(Kind):
    """A kind of items.

    generate  : turns an item into polyhedra in its own coordinates
    amount    : about how many units one copy of an item makes, known before it is made, and the key that matters most;
                where blocks have many facets each of these counts
    positions : that it gives its blocks
    groups    : that it may make beside its own
    materials : key paths below the item that name materials, besides its own; ``#`` stands for every item of a list
    files     : keys that name files; blocks from files have names of their own
    flat_face : what to do where a block is one flat face, by the name of the block and whether there are more; of kinds
                with files
    place     : key path below the item at which a defect of a block is told, by the number of the face that has it
    """

    generate: Generator
    amount: Callable[[Any], tuple[float, str]] = one_unit
    _: KW_ONLY
    positions: tuple[BlockPosition, ...] = ()
    groups: tuple[SideGroup, ...] = ()
    materials: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    flat_face: Callable[[str, bool], str] | None = None
    place: Callable[[int | None], KeyPath] = of_the_item


ITEM_KINDS: dict[str, ItemKind] = {}
"""by name"""


def register_item(kind: ItemKind) -> None:
    """Make a kind of items known."""
    register(ITEM_KINDS, kind)
