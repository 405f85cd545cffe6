"""What every item of `blocks` has (a group, a material, a transform, copies), and what is known of its kind.

A kind registers at the foot of its own file.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal, TypeAlias

from pydantic import Field

from mbla.deck.kinds.kinds import ChoiceKind, register
from mbla.deck.kinds.positions import BlockPosition
from mbla.deck.quantities import Name
from mbla.deck.section import Section, rule
from mbla.deck.sections.placement import Repeat, Transform
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.generated import Generator


class AnyItem(Section):
    """What every item of `blocks` has."""

    group: Name | None = Field(None, description="name for selectors; default: the item's kind")
    material: Name = Field(description="name of a material")
    transform: Transform = Field(
        default_factory=list, description="a step, or a list of steps applied in order to the item's own geometry"
    )
    repeat: Repeat = Field(
        default_factory=list,
        description="copies, made after the transform, all in the same group; of a list each step repeats what the "
        "steps before it have made",
    )


class SpringingItem(AnyItem):
    """What springs from its supports: arches, domes and vaults."""

    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under the springing joints; blocks: fixed blocks behind them, in group "
        "GROUP_springers; none: the deck's supports hold the structure",
    )
    joint: Name | None = Field(None, description="joint law at springings on ground; default: contacts.joint")


@rule(SpringingItem)
def joint_of_ground(item: SpringingItem) -> Iterator[Finding]:
    """The joint law of a ground needs a ground."""
    if item.joint is not None and item.springers != "ground":
        yield Finding("key-of-another-choice", "applies with springers: ground only", "joint")


@dataclass(frozen=True)
class SideGroup:
    """A group that an item makes beside its own, named after that: ``suffix`` follows the name.

    values : of a key of the item, with which it makes the group
    """

    suffix: str
    key: str
    values: tuple[str, ...]


SPRINGERS = SideGroup("_springers", "springers", ("blocks",))
"""fixed blocks behind the springings"""


Amount: TypeAlias = Callable[[Any], tuple[float, str]]
"""About how many units one copy of an item makes, known before it is made, and the key that matters most; where blocks
have many facets each of these counts."""


@dataclass(frozen=True)
class ItemKind(ChoiceKind):
    """A kind of items.

    generate  : turns an item into polyhedra in its own coordinates
    amount    : how much an item asks for; default: one, as of what cannot ask for much
    positions : that it gives its blocks
    groups    : that it may make beside its own
    materials : key paths below the item that name materials, besides its own; ``#`` stands for every item of a list
    files     : keys that name files; blocks from files have names of their own
    flat_face : what to do where a block is one flat face, by the name of the block and whether there are more; of kinds
                with files
    place     : key path below the item at which a defect of a block is told, by the number of the face that has it;
                default: at the item as a whole
    """

    generate: Generator
    amount: Amount = lambda _: (1.0, "")
    _: KW_ONLY
    positions: tuple[BlockPosition, ...] = ()
    groups: tuple[SideGroup, ...] = ()
    materials: tuple[str, ...] = ()
    files: tuple[str, ...] = ()
    flat_face: Callable[[str, bool], str] | None = None
    place: Callable[[int | None], KeyPath] = lambda _: ()


ITEM_KINDS: dict[str, ItemKind] = {}
"""by name"""


def register_item(kind: ItemKind) -> None:
    """Make a kind of items known."""
    register(ITEM_KINDS, kind)
