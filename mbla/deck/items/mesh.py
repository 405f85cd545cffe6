"""Item `mesh`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import PositiveNumber


class MeshItem(Item):
    """Blocks from a geometry file: each object, closed component or volume cell is one block."""

    file: str = Field(
        min_length=1, description="OBJ, PLY, STL, VTU, Gmsh .msh or Abaqus/CalculiX .inp, relative to the deck"
    )
    scale: PositiveNumber = Field(1.0, description="factor from the file's coordinates to the deck's unit of length")
