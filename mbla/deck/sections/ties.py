"""Section `ties`: what is neither block nor joint and holds blocks together or apart: ties, rings, struts, strips."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.quantities import (
    Length,
    Name,
    NonNegativeNumber,
    Point,
    PositiveArea,
    PositiveForce,
    PositiveLength,
    PositiveStress,
)
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.deck.sections.placement import Repeat
from mbla.deck.sections.selectors import Selector
from mbla.errors import Finding

FORMS = ("through", "ring", "strip")
"""what lays out a tie"""


BreaksAt: TypeAlias = Annotated[
    Annotated[Literal["never"], Tag("name")] | Annotated[NonNegativeNumber, Tag("number")],
    Discriminator(lambda value: "name" if value == "never" else "number"),
]


class Plate(Section):
    """A round anchor plate on a wall: the wall limits the force, by punching or by the cone that is torn out."""

    diameter: PositiveLength = Field(description="of the plate")
    wall: PositiveLength = Field(description="thickness of the wall that it bears on")
    shear_strength: PositiveStress | None = Field(None, description="shear strength of the wall, for punching")
    tensile_strength: PositiveStress | None = Field(
        None, description="tensile strength of the wall, for the cone that is torn out"
    )


class Ring(Section):
    """A closed tie round the plan of some blocks, at one height or several."""

    around: Selector = Field(description="the blocks that it goes round: along the convex outline of their plan there")
    z: Annotated[list[Length], Field(min_length=1)] = Field(description="its height; a ring at each of several")


@exactly_one_of(*FORMS)
class TieSection(Section):
    """A tie, strut, ring or strip, or several alike, without weight: a force along a line, within limits."""

    name: Name | None = Field(None, description="name of the tie in results; default: its form and number")
    through: Annotated[list[Point], Field(min_length=2, max_length=1000)] | None = Field(
        None, description="where it begins, the points that it passes, where it ends; first point again: closed"
    )
    ring: Ring | None = Field(None, description="a closed tie round a building or a tower")
    strip: Annotated[list[Point], Field(min_length=2, max_length=1000)] | None = Field(
        None,
        description="FRP or FRCM glued to faces along this line: where it crosses from block to block it carries "
        "tension along the line, at every joint up to its capacity",
    )
    on: Annotated[list[Selector], Field(min_length=2, max_length=1000)] | None = Field(
        None,
        description="for each point of through: the block to which it is fixed, or `ground` for a fixed point "
        "outside of the model; default: the block at the point",
    )
    acts: Literal["tension", "compression", "both"] = Field(
        "tension", description="tension: a tie; compression: a strut; both: a bar"
    )
    points: Literal["passes", "fixed"] = Field(
        "passes",
        description="between the ends. passes: the tie slides at its points without friction and has one force; "
        "fixed: it is fixed at its points and has a force in each stretch",
    )
    capacity: PositiveForce | None = Field(None, description="greatest force")
    area: PositiveArea | None = Field(None, description="cross-section, with strength")
    diameter: PositiveLength | None = Field(None, description="diameter of a round bar, in place of area")
    strength: PositiveStress | None = Field(
        None, description="stress at which the tie yields; times the area its capacity"
    )
    anchorage: PositiveForce | None = Field(None, description="greatest force of the anchors, where that is less")
    plate: Plate | None = Field(None, description="anchor plate, where the wall behind it limits the force")
    prestress: PositiveForce | None = Field(
        None,
        description="force of the tie when it is installed: it counts for standing; a load factor does not depend "
        "on it",
    )
    breaks_at: BreaksAt | None = Field(
        None,
        description="in a pushover and in a time history: elongation over length (of a strut shortening) at which the "
        "tie breaks; 0: brittle, as soon as it yields; `never`: it yields without end. Default: never, of strips 0, as "
        "glue lets go by a slip of tenths of a millimetre (CNR-DT 200 R1/2013)",
    )
    repeat: Repeat = Field(default_factory=list, description="copies, as of items")


def blocks_of_points(item: Any) -> Iterator[Finding]:
    """Blocks by points go with points, one for each."""
    if item.on is None:
        return
    if item.through is None:
        yield Finding("key-of-another-choice", "applies to through only", "on")
    elif len(item.on) != len(item.through):
        words = f"must name a block for each of the {len(item.through)} points, it names {len(item.on)}"
        yield Finding("tie-misfit", words, "on")


@rule(TieSection)
def tie(item: TieSection) -> Iterator[Finding]:
    """A capacity, one cross-section, and keys that apply."""
    if item.capacity is None and item.strength is None and item.anchorage is None and item.plate is None:
        yield Finding("missing-key", "needs capacity, or area or diameter with strength")
    others = given(item, ("strength", "anchorage", "plate"))
    if item.capacity is not None and others:
        words = "only one may be given of capacity and of what it follows from: strength, anchorage, plate"
        yield Finding("one-of-several", words, others[0])
    sections = given(item, ("area", "diameter"))
    if len(sections) > 1:
        yield Finding("one-of-several", "only one of area and diameter may be given", sections[1])
    if item.strength is not None and not sections:
        yield Finding("missing-key", "needs area or diameter in addition to strength")
    if sections and item.strength is None:
        yield Finding("key-of-another-choice", "applies with strength only", sections[0])
    yield from blocks_of_points(item)
    if item.strip is not None and isinstance(item.breaks_at, float) and item.breaks_at > 0.0:
        words = "must be 0, or never, for a strip, which has no length across a joint"
        yield Finding("tie-misfit", words, "breaks_at")
    if item.points == "fixed" and item.strip is not None:
        yield Finding("key-of-another-choice", "does not apply to a strip, which is glued all along", "points")
    if item.acts != "tension":
        for key in given(item, ("ring", "strip", "prestress")):
            yield Finding("key-of-another-choice", "applies with acts: tension only", key)
        if item.through is not None and len(item.through) > 2 and item.points == "passes":
            yield Finding("key-of-another-choice", "what takes compression goes straight: use points: fixed", "acts")


@rule(Plate)
def plate(item: Plate) -> Iterator[Finding]:
    """A strength of the wall."""
    if not given(item, ("shear_strength", "tensile_strength")):
        yield Finding("missing-key", "needs one of shear_strength or tensile_strength")
