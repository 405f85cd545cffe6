"""The items of `blocks`: one type per kind, and the transform that each of them takes."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Discriminator, Field, Tag

from mbla.deck.names import Name
from mbla.deck.quantities import (
    Angle,
    Count,
    Direction,
    EmbraceAngle,
    Index,
    PlanePoint,
    Point,
    PositiveLength,
    PositiveNumber,
)
from mbla.deck.section import Section, shape


class Rotation(Section):
    """Rotation by an angle about an axis, right-handed."""

    axis: Direction = Field(description="direction of the axis")
    angle: Angle = Field(description="degrees")
    about: Point = Field((0.0, 0.0, 0.0), description="point on the axis")


class Reflection(Section):
    """Mirror image in a plane."""

    normal: Direction = Field(description="normal of the plane")
    point: Point = Field((0.0, 0.0, 0.0), description="point on the plane")


class TransformStep(Section):
    """One step of a transform: exactly one of its keys."""

    translate: Point | None = Field(None, description="displacement")
    rotate: Rotation | None = Field(None, description="rotation about an axis")
    scale: PositiveNumber | None = Field(None, description="factor on all coordinates, about the origin")
    mirror: Reflection | None = Field(None, description="reflection in a plane")


Transform: TypeAlias = Annotated[
    Annotated[TransformStep, Tag("mapping")] | Annotated[list[TransformStep], Tag("list")],
    Discriminator(lambda value: "mapping" if shape(value) == "mapping" else "list"),
]


class Item(Section):
    """What every item of `blocks` has."""

    group: Name | None = Field(None, description="name that selectors use; the item's kind unless given")
    material: Name = Field(description="name of a material")
    transform: Transform = Field(
        default_factory=list, description="a step, or a list of steps applied in order to the item's own geometry"
    )


class BoxItem(Item):
    """One block: a cuboid along the axes."""

    min: Point = Field(description="corner with the least coordinates")
    max: Point = Field(description="corner with the greatest coordinates")


class PolyhedronItem(Item):
    """One block: a closed polyhedron with planar faces, convex or not."""

    vertices: list[Point] = Field(min_length=4, description="corner points")
    faces: list[Annotated[list[Index], Field(min_length=3)]] = Field(
        min_length=4, description="corners of each face in order, as indices of vertices from 0; any orientation"
    )


class Opening(Section):
    """Rectangular opening in the plane of a wall, its bottom and top on bed joints."""

    from_: PlanePoint = Field(alias="from", description="lower corner: distance along the wall, height")
    to: PlanePoint = Field(description="upper corner: distance along the wall, height")


class WallItem(Item):
    """A wall one unit thick: runs along +x from the origin, rises along +z, thickness along +y."""

    unit: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="length along the wall, thickness, height of one unit"
    )
    length: PositiveLength = Field(description="length of the wall; the closing units are cut to fit")
    courses: Count = Field(description="number of courses")
    bond: Literal["running", "stack"] = Field("running", description="running: odd courses shifted by half a unit")
    start: Literal["full", "half"] = Field("full", description="first unit of the bottom course")
    openings: list[Opening] = Field(default_factory=list, description="rectangles left free")


class ArchItem(Item):
    """A circular arch with radial joints and straight-edged voussoirs, in the x-z plane, extruded along +y.

    The left intrados springing is at the origin, the right one at x = span.
    """

    shape: Literal["semicircular", "segmental"] = Field(description="semicircular, or segmental with rise or embrace")
    span: PositiveLength = Field(description="distance between the intrados springings")
    thickness: PositiveLength = Field(description="radial thickness")
    width: PositiveLength = Field(description="extent along y")
    voussoirs: Count = Field(description="number of voussoirs")
    rise: PositiveLength | None = Field(None, description="segmental: height of the intrados crown over the springings")
    embrace: EmbraceAngle | None = Field(None, description="segmental: angle between the springing joints in degrees")
    springers: Literal["none", "ground", "blocks"] = Field(
        "none",
        description="ground: rigid ground under both springing joints; blocks: a fixed block behind each, "
        "in group GROUP_springers; none: the deck's supports hold the arch",
    )
    joint: Name | None = Field(None, description="joint law at a springing on ground; that of contacts unless given")


class MeshItem(Item):
    """Blocks from a geometry file: each object, closed component or volume cell is one block."""

    file: str = Field(
        min_length=1, description="OBJ, PLY, STL, VTU, Gmsh .msh or Abaqus/CalculiX .inp, relative to the deck"
    )
    scale: PositiveNumber = Field(1.0, description="factor from the file's coordinates to the deck's unit of length")


class BlockItem(Section):
    """An item of `blocks`: exactly one key, its kind."""

    box: BoxItem | None = None
    polyhedron: PolyhedronItem | None = None
    wall: WallItem | None = None
    arch: ArchItem | None = None
    mesh: MeshItem | None = None
