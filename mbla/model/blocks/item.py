"""What every item of `blocks` has: a group, a material, a transform, copies; and what springs from its supports."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from mbla.deck.quantities import Name
from mbla.deck.section import Section, rule
from mbla.deck.sections.placement import Repeat, Transform
from mbla.errors import Finding
from mbla.model.blocks.item_kind import SideGroup


class Item(Section):
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


class SpringingItem(Item):
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


SPRINGERS = SideGroup("_springers", "springers", ("blocks",))
"""fixed blocks behind the springings"""
