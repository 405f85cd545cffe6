"""Section `contacts`: how contacts are found, and which joint law each has."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from mbla.deck.names import Name
from mbla.deck.quantities import Quantity, Whole
from mbla.deck.section import Section


class ContactOverride(Section):
    """Another joint law between two selections."""

    between: tuple[Name, Name] = Field(description="two groups; may be the same; `ground` stands for ground planes")
    joint: Name = Field(description="name of a joint law")


class ContactsSection(Section):
    """How contacts are found, and their joint law."""

    joint: Name = Field(description="joint law of every contact that no override names")
    tolerance: Annotated[float, Quantity("number", gt=0, le=0.1)] = Field(
        1e-3, description="greatest gap, overlap and sliver width, relative to block size"
    )
    refine: Annotated[int, Whole(ge=1, le=50)] = Field(
        1,
        description="contact points along each edge of an interface, and rings of them inside; 1: its corners alone. "
        "Associative flow can load the corners alone, so that more points lower torsion only without dilatancy",
    )
    inset: Annotated[float, Quantity("number", ge=0, lt=1)] = Field(
        0.0,
        description="share of the way to the centroid that the contact points are moved inwards: lowers torsion (0.459 "
        "is exact for a square), and rocking by the same share",
    )
    overrides: list[ContactOverride] = Field(default_factory=list, description="the last that fits a contact holds")
