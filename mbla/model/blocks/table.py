"""Item `table`: blocks from tables of their vertices and faces."""

from __future__ import annotations

from pydantic import Field

from mbla.deck.sections.geometry_file import Names
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.item import AnyItem, ItemKind, register_item


class TableItem(AnyItem):
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


def generate(item: TableItem, context: ItemContext) -> Generated:
    """Blocks in the order in which the table of vertices names them first."""
    from mbla.model.blocks.files.table import read_blocks

    return read_blocks(item, context)


def flat_face(member: str, more: bool) -> str:
    """What to do with a flat face, by the name of its block, and whether there are more."""
    return f"leave_out: [{member}{', ...' if more else ''}], and a surface in supports where it is ground"


register_item(ItemKind("table", TableItem, generate, after="mesh", files=("vertices", "faces"), flat_face=flat_face))
