"""Selectors: how a deck names blocks."""

from __future__ import annotations

from typing import Annotated, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.names import Name
from mbla.deck.quantities import Index, Point
from mbla.deck.section import Section, shape


class SelectorTerm(Section):
    """Blocks of a group (all, or the one with an index), or blocks whose centroid lies in a box."""

    group: Name | None = Field(None, description="name of a group")
    index: Index | None = Field(None, description="which block of the group, from 0 in order of creation")
    box: tuple[Point, Point] | None = Field(None, description="least and greatest coordinates; centroids inside count")


Term: TypeAlias = Annotated[
    Annotated[Name, Tag("name")] | Annotated[SelectorTerm, Tag("mapping")],
    Discriminator(lambda value: "mapping" if shape(value) == "mapping" else "name"),
]
Selector: TypeAlias = Annotated[
    Annotated[Name, Tag("name")]
    | Annotated[SelectorTerm, Tag("mapping")]
    | Annotated[list[Term], Field(min_length=1), Tag("list")],
    Discriminator(shape),
]
