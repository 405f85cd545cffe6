"""Files of geometry that a deck names, and how their coordinates are meant."""

from __future__ import annotations

from typing import Annotated, Literal, TypeAlias

from pydantic import Field

from mbla.deck.quantities import PositiveNumber
from mbla.deck.section import Section

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
        description="unit of length of the file, converted to the deck's; default: the unit in "
        "the header of a DXF file, the deck's own for others",
    )
    scale: PositiveNumber = Field(1.0, description="factor on the file's coordinates, besides the conversion of units")
    up: Literal["z", "y"] | None = Field(
        None,
        description="axis of the file that points upwards; with y the file's x, y, z become x, z, -y of the deck; "
        "default: z",
    )
    members: Names | None = Field(
        None, description="objects, groups, layers or sets of the file to take, by name; default: all"
    )
