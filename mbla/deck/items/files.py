"""Items `mesh` and `table`: blocks from files."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Name, PositiveLength, PositiveNumber, Switch
from mbla.deck.section import Section, rule
from mbla.errors import Finding

Names: TypeAlias = Annotated[list[Annotated[str, Field(min_length=1)]], Field(min_length=1)]

FileUnit: TypeAlias = Literal["m", "mm", "cm", "ft", "in"]


class GeometryFile(Section):
    """A geometry file, and how its coordinates are meant."""

    file: str = Field(
        min_length=1,
        description="OBJ, PLY, STL, VTU, Gmsh .msh, Abaqus/CalculiX .inp, COMPAS .json, or a DXF "
        "drawing with extrude; relative to the deck",
    )
    units: FileUnit | None = Field(
        None,
        description="unit of length of the file, converted to the deck's; that of the header for "
        "DXF, and the deck's own for others unless given",
    )
    scale: PositiveNumber = Field(1.0, description="factor on the file's coordinates, besides the conversion of units")
    up: Literal["z", "y"] | None = Field(
        None,
        description="axis of the file that points upwards; with y the file's x, y, z become x, z, -y of the deck. "
        "z unless given",
    )
    members: Names | None = Field(
        None, description="objects, groups, layers or sets of the file to take, by name; all unless given"
    )


class MeshItem(Item, GeometryFile):
    """Blocks from a geometry file: each closed surface or volume cell is one block.

    Objects, groups, layers and element sets of the file are `member` in selectors, under their names with `_` for
    everything but letters, digits, `.` and `-`.

    Many files have their supports among the blocks, as flat faces: `supports` or `flat_faces` take them as rigid ground
    that ends at their outline (see `supports` of the deck, `surface`); the transform and copies of the item move them
    too.
    """

    leave_out: Names | None = Field(
        None,
        description="objects, groups, layers or sets of the file to leave out, by name; with members: of these",
    )
    supports: Names | None = Field(
        None,
        description="objects, groups or layers of the file that are no blocks but open surfaces, flat or of flat "
        "faces: rigid ground under the faces of blocks that lie on them; of members and leave_out need not be listed",
    )
    flat_faces: Literal["supports", "leave_out"] | None = Field(
        None,
        description="supports: every object of the file that is one flat face is rigid ground; leave_out: it is left "
        "out; refused unless given",
    )
    joint: Name | None = Field(None, description="joint law on the file's supports; that of contacts unless given")
    join_cells: Switch = Field(
        False,
        description="volume cells that share faces and belong to one set (ELSET, physical group, or without one the "
        "geometric entity of Gmsh) are one block, instead of one each",
    )
    extrude: PositiveLength | None = Field(
        None,
        description="thickness of a drawing's outlines, along +y from y = 0; the drawing's x, y become x, z",
    )
    weld: PositiveLength | None = Field(
        None,
        description="distance within which corners of one object are made one; unless given "
        "contacts.tolerance x the shortest edge at a corner, and only where a surface is not closed",
    )


@rule(MeshItem)
def joint_of_supports(item: MeshItem) -> Iterator[Finding]:
    """The joint law of supports needs supports."""
    if item.joint is not None and item.supports is None and item.flat_faces != "supports":
        yield Finding("key-of-another-choice", "applies with supports, or flat_faces: supports, only", "joint")


@rule(MeshItem)
def names_in_one_list(item: MeshItem) -> Iterator[Finding]:
    """A name that is a support is not left out."""
    for number, name in enumerate(item.supports or []):
        if name in (item.leave_out or []):
            yield Finding("duplicate-key", f"{name} is listed under leave_out too", "supports", number)


class TableItem(Item):
    """Blocks from two tables of text (CSV), lengths in the deck's unit.

    The first line of each names the columns. Lines that begin with `#` are comments; semicolons may separate columns,
    numbers then with decimal commas. The names of the blocks are `member` in selectors, as with `mesh`.
    """

    vertices: str = Field(
        min_length=1,
        description="CSV file with the columns block,vertex,x,y,z: one row for each corner of each block; blocks and "
        "vertices go by any names or numbers, those of vertices within their block",
    )
    faces: str = Field(
        min_length=1,
        description="CSV file with the columns block,face,v1,v2,v3,...: one row for each face of each block, its "
        "corners in order by the names of vertices, as many as it has; any orientation",
    )
    leave_out: Names | None = Field(None, description="blocks of the tables to leave out, by name")
