"""Items `mesh` and `table`: blocks from files."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import PositiveLength, PositiveNumber, Switch


class MeshItem(Item):
    """Blocks from a geometry file: each closed surface or volume cell is one block.

    Objects, groups, layers and element sets of the file are `member` in selectors, under their names with `_` for
    everything but letters, digits, `.` and `-`.
    """

    file: str = Field(
        min_length=1,
        description="OBJ, PLY, STL, VTU, Gmsh .msh, Abaqus/CalculiX .inp, COMPAS .json, or a DXF "
        "drawing with extrude; relative to the deck",
    )
    units: Literal["m", "mm", "cm", "ft", "in"] | None = Field(
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
    members: Annotated[list[str], Field(min_length=1)] | None = Field(
        None, description="objects, groups, layers or sets of the file to take, by name; all unless given"
    )
    join_cells: Switch = Field(
        False,
        description="volume cells that share faces and belong to one set (ELSET, physical group) are one block, "
        "instead of one each",
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
