"""Sections `supports` and `symmetry`: what holds the structure, and the planes that mirror it."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.quantities import Direction, Length, Name, Point, PositiveNumber, Switch
from mbla.deck.section import Section, exactly_one_of, given, rule
from mbla.deck.sections.geometry_file import FileUnit, Names
from mbla.deck.sections.selectors import Selector
from mbla.errors import Finding


class Plane(Section):
    """A plane at right angles to an axis, or by a point and its normal."""

    x: Length | None = Field(None, description="the plane at this x")
    y: Length | None = Field(None, description="the plane at this y")
    z: Length | None = Field(None, description="the plane at this z")
    point: Point | None = Field(None, description="a point on the plane")
    normal: Direction | None = Field(None, description="normal of the plane; of ground it points to the structure")


@exactly_one_of("x", "y", "z", "point")
class GroundPlane(Plane):
    """A plane: exactly one of x, y, z (the structure lies on the side of greater x, y or z), or a point and a normal
    towards the structure.
    """


@exactly_one_of("x", "y", "z", "point")
class SymmetryPlane(Plane):
    """A plane of symmetry: exactly one of x, y, z (normal along that axis), or a point and a normal.

    Blocks, supports, guides, settlements and forces of the deck appear on both sides, each image in the group of its
    original; results are those of the whole structure. A block with a face on the plane meets its image there, with the
    joint law that contacts gives for the two. Several planes act one after the other: each mirrors the structure that
    the planes before it have made, and chooses its halves from that.
    """

    halves: Selector | None = Field(
        None, description="blocks that are cut in two by the plane: half and image are one block"
    )


@rule(Plane)
def plane_normal(plane: Plane) -> Iterator[Finding]:
    """A normal goes with a point."""
    if plane.point is not None and plane.normal is None:
        yield Finding("missing-key", "needs a normal in addition to its point")
    if plane.normal is not None and plane.point is None:
        yield Finding("key-of-another-choice", "applies with point only", "normal")


@exactly_one_of("polygon", "file")
class Surface(Section):
    """Rigid ground that ends at an outline, inclined as it may be: a polygon, or the flat faces of a file.

    The surface carries the part of each block face that lies on it, from the side of the block, or from both sides.
    Blocks may reach past the outline below the plane of the surface. Every flat face of a file, or several faces that
    lie in one plane and share edges, is a surface. Flat faces among the blocks of a `mesh` are taken by its keys
    `supports` and `flat_faces`.
    """

    polygon: Annotated[list[Point], Field(min_length=3)] | None = Field(
        None, description="corners in order, either way round, in one plane within contacts.tolerance x its size"
    )
    file: str | None = Field(
        None, min_length=1, description="geometry file of open surfaces, as of a mesh; relative to the deck"
    )
    units: FileUnit | None = Field(None, description="unit of length of the file, as of a mesh")
    scale: PositiveNumber | None = Field(None, description="factor on the file's coordinates; default: 1")
    up: Literal["z", "y"] | None = Field(None, description="axis of the file that points upwards, as of a mesh")
    members: Names | None = Field(
        None, description="objects, groups or layers of the file to take, by name; default: all"
    )


@rule(Surface)
def keys_of_a_file(surface: Surface) -> Iterator[Finding]:
    """How a file is read says nothing about a polygon."""
    if surface.file is None and surface.polygon is not None:
        for key in given(surface, ("units", "scale", "up", "members")):
            yield Finding("key-of-another-choice", "applies with file only", key)


class Turn(Section):
    """A rotation about a line."""

    axis: Direction = Field(description="direction of the line; the rotation is right-handed about it")
    about: Point = Field(description="a point on the line")


Component = Literal["x", "y", "z", "rx", "ry", "rz"]
"""Displacement along an axis, or rotation about it."""


class Support(Section):
    """Rigid ground under every face on a plane or a bounded surface, fixed blocks, or guided blocks with given
    admissible motions.
    """

    ground: GroundPlane | None = Field(None, description="rigid ground on an unbounded plane")
    surface: Surface | None = Field(None, description="rigid ground within an outline")
    joint: Name | None = Field(None, description="joint law on the ground or surface; default: that of contacts")
    blocks: Selector | None = Field(
        None,
        description="blocks that are fixed, or held as `fixed`, `slide` and `turn` say; with ground or surface: "
        "the only blocks that it carries",
    )
    fixed: Annotated[list[Component], Field(min_length=1)] | None = Field(
        None,
        description="displacements, and rotations about the centroid, that are held; default: all six. The support "
        "takes any force, in both senses and without friction",
    )
    slide: Direction | None = Field(None, description="the blocks may slide along this direction, both ways")
    turn: Turn | None = Field(
        None, description="the blocks may turn about this line, both ways; with slide: they may do both"
    )
    together: Switch | None = Field(
        None,
        description="true: the blocks move as one rigid body, with fixed: about their common centroid; default: "
        "each by itself",
    )


@rule(Support)
def support(item: Support) -> Iterator[Finding]:
    """Ground, fixed blocks, or guided blocks."""
    kinds = given(item, ("ground", "surface"))
    if not kinds and item.blocks is None:
        yield Finding("missing-key", "needs one of ground, surface or blocks")
    elif item.joint is not None and not kinds:
        words = "applies with ground or surface only: blocks that do not move have the joints of their contacts"
        yield Finding("key-of-another-choice", words, "joint")
    ways = given(item, ("fixed", "slide", "turn"))
    if len(kinds) > 1:
        yield Finding("one-of-several", "only one of ground or surface may be given", "surface")
    if kinds:
        for key in (*ways, *given(item, ("together",))):
            words = f"does not apply to {kinds[0]}, which does not move: say it of blocks in an item of their own"
            yield Finding("key-of-another-choice", words, key)
        return
    if item.fixed is not None and len(ways) > 1:
        words = "only one of fixed, and slide or turn, may be given: what may slide or turn is held otherwise"
        yield Finding("one-of-several", words, ways[1])
    if item.together and not ways:
        words = "applies with fixed, slide or turn only: blocks that do not move do so together anyway"
        yield Finding("key-of-another-choice", words, "together")


@rule(Support)
def guide(item: Support) -> Iterator[Finding]:
    """Admissible motions have a direction."""
    fixed = item.fixed or []
    for number, component in enumerate(fixed):
        if component in fixed[:number]:
            yield Finding("duplicate-key", f"{component} is listed already", "fixed", number)
