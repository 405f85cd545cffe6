"""Item `mesh`: blocks from a geometry file."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Literal

from pydantic import Field

from mbla.deck.quantities import Name, PositiveLength, Switch
from mbla.deck.section import rule
from mbla.deck.sections.geometry_file import GeometryFile, Names
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.item import AnyItem, ItemKind, register_item


class MeshItem(AnyItem, GeometryFile):
    """Blocks from a geometry file: each closed surface or volume cell is one block.

    Objects, groups, layers and element sets of the file are `member` in selectors, under their names with `_` for
    everything but letters, digits, `.` and `-`.

    Many files have their supports among the blocks, as flat faces: `supports` or `flat_faces` take them as rigid ground
    that ends at their outline (see `supports` of the deck, `surface`); the transform and copies of the item move them
    too.
    """

    leave_out: Names | None = Field(
        None, description="objects, groups, layers or sets of the file to leave out, by name; with members: of these"
    )
    supports: Names | None = Field(
        None,
        description="objects, groups or layers of the file that are no blocks but open surfaces, flat or of flat "
        "faces: rigid ground under the faces of blocks that lie on them; of members and leave_out need not be listed",
    )
    flat_faces: Literal["supports", "leave_out"] | None = Field(
        None,
        description="supports: every object of the file that is one flat face is rigid ground; leave_out: it is left "
        "out; default: refused",
    )
    joint: Name | None = Field(None, description="joint law on the file's supports; default: contacts.joint")
    join_cells: Switch = Field(
        False,
        description="volume cells that share faces and belong to one set (ELSET, physical group, or without one the "
        "geometric entity of Gmsh) are one block, instead of one each",
    )
    extrude: PositiveLength | None = Field(
        None, description="thickness of a drawing's outlines, along +y from y = 0; the drawing's x, y become x, z"
    )
    weld: PositiveLength | None = Field(
        None,
        description="distance within which corners of one object are made one; default: "
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


def generate(item: MeshItem, context: ItemContext) -> Generated:
    """Blocks in the order of the file; readers are imported when a deck has a file."""
    from mbla.model.blocks.files.mesh import read_mesh

    return read_mesh(item, context)


def flat_face(member: str, more: bool) -> str:
    """What to do with a flat face, by the name of its object, and whether there are more."""
    if member and not more:
        return f"supports: [{member}] of the mesh makes it rigid ground, leave_out: [{member}] leaves it out"
    return "flat_faces: supports of the mesh makes them rigid ground, flat_faces: leave_out leaves them out"


def place(face: int | None) -> KeyPath:
    """Defects of blocks are told at the file."""
    return ("file",)


register_item(ItemKind("mesh", MeshItem, generate, after="arch", files=("file",), flat_face=flat_face, place=place))
