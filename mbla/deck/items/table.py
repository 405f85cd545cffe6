"""Item `table`."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.items.item import Item


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
