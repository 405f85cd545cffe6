"""Selectors: how a deck names blocks."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, TypeAlias

from pydantic import ConfigDict, Field

from mbla.deck.kinds.kinds import in_order
from mbla.deck.kinds.positions import COPY, SHARED
from mbla.deck.quantities import Box, Index, Name, Position
from mbla.deck.section import ByShape, Section, given, rule, with_keys
from mbla.deck.sections.blocks import ITEM_KINDS
from mbla.deck.suggestions import listed
from mbla.errors import Finding

GIVEN = tuple(dict.fromkeys((*SHARED, *(each for kind in in_order(ITEM_KINDS) for each in kind.positions), COPY)))
"""positions that items give their blocks"""
POSITIONS = tuple(position.name for position in GIVEN)
"""their names, each a key of selectors"""
OUTER_FIRST = tuple(position.name for position in sorted(GIVEN, key=lambda position: position.depth))
"""the names, those of parts before those of what is in them"""
GROUND = "ground"
"""name that stands for ground planes in `contacts.overrides`, for what does not move in `ties`"""
ONE_OF = ("group", "box")
"""keys of a selector of which it has at least one"""
PositionRange: TypeAlias = Annotated[Position | tuple[Position, Position], ByShape("name")]


@with_keys(
    {
        "copy_" if each is COPY else each.name: (
            PositionRange | None,
            Field(None, alias="copy" if each is COPY else None, description=each.words),
        )
        for each in GIVEN
    }
)
class SelectorTerm(Section):
    """Blocks of a group, or blocks whose centroid lies in a box; every further key narrows the choice.

    A position is a number, or [first, last]; negative ones count from the last of the group, -1, or of each of the
    parts that are chosen besides: {span: [0, 1], voussoir: -1} are the last voussoirs of both spans.
    """

    model_config = ConfigDict(json_schema_extra={"anyOf": [{"required": [key]} for key in ONE_OF]})

    group: Name | None = Field(None, description="name of a group")
    box: Box | None = Field(None, description="least and greatest coordinates; centroids inside count")
    index: Index | None = Field(None, description="which block of the group, from 0 in order of creation")
    member: Name | None = Field(None, description="part of a composite item, `lintel` for example")

    def position(self, name: str) -> int | tuple[int, int] | None:
        """What is asked of a position, by its name."""
        asked: int | tuple[int, int] | None = getattr(self, "copy_" if name == COPY.name else name)
        return asked


Term: TypeAlias = Annotated[Name | SelectorTerm, ByShape("name")]
Selector: TypeAlias = Annotated[Name | SelectorTerm | Annotated[list[Term], Field(min_length=1)], ByShape("name")]


@rule(SelectorTerm)
def selector_term(term: SelectorTerm) -> Iterator[Finding]:
    """A group or a box; an index counts within a group; a range ascends."""
    if not given(term, ONE_OF):
        yield Finding("missing-key", f"needs one of {listed(ONE_OF)}")
    if term.index is not None and term.group is None and term.box is not None:
        yield Finding("key-of-another-choice", "applies with group only", "index")
    for name in POSITIONS:
        value = term.position(name)
        if isinstance(value, tuple) and value[0] > value[1] and (value[0] < 0) == (value[1] < 0):
            yield Finding("out-of-bounds", f"must be >= {value[0]}, the first of the range", name, 1)
