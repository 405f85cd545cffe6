"""Item `mesh`."""

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
        description="OBJ, PLY, STL, VTU, Gmsh .msh, Abaqus/CalculiX .inp, glTF (.gltf, .glb), COMPAS .json, or a DXF "
        "drawing with extrude; relative to the deck",
    )
    units: Literal["m", "mm", "cm", "ft", "in"] | None = Field(
        None,
        description="unit of length of the file, converted to the deck's; metres for glTF, that of the header for "
        "DXF, and the deck's own for others unless given",
    )
    scale: PositiveNumber = Field(1.0, description="factor on the file's coordinates, besides the conversion of units")
    up: Literal["z", "y"] | None = Field(
        None,
        description="axis of the file that points upwards; with y the file's x, y, z become x, z, -y of the deck. "
        "y for glTF, z for others unless given",
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
