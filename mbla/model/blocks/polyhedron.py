"""Item `polyhedron`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from mbla.deck.quantities import Index, Point
from mbla.deck.section import rule
from mbla.errors import Finding, KeyPath
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart
from mbla.model.blocks.item import AnyItem, ItemKind, register_item
from mbla.model.solids.polyhedra import polyhedra_from_lists


class PolyhedronItem(AnyItem):
    """One block: a closed polyhedron with planar faces, convex or not."""

    vertices: list[Point] = Field(min_length=4, description="corner points")
    faces: list[Annotated[list[Index], Field(min_length=3)]] = Field(
        min_length=4, description="corners of each face in order, as indices of vertices from 0; any orientation"
    )


@rule(PolyhedronItem)
def polyhedron_faces(polyhedron: PolyhedronItem) -> Iterator[Finding]:
    """Faces use vertices that exist, each once."""
    n_vertices = len(polyhedron.vertices)
    for number, face in enumerate(polyhedron.faces):
        if max(face) >= n_vertices:
            position = next(i for i, corner in enumerate(face) if corner >= n_vertices)
            words = f"must be <= {n_vertices - 1}: there are {n_vertices} vertices, from 0"
            yield Finding("out-of-bounds", words, "faces", number, position)
        elif len(set(face)) < len(face):
            position = next(i for i, corner in enumerate(face) if corner in face[:i])
            yield Finding("duplicate-key", "is a corner of this face already", "faces", number, position)


def generate(item: PolyhedronItem, context: ItemContext) -> Generated:
    """The polyhedron as listed; faces in any orientation."""
    return Generated((ItemPart(polyhedra_from_lists([item.vertices], [item.faces])),))


def place(face: int | None) -> KeyPath:
    """A defect of a face is told where the deck spells it out."""
    return () if face is None else ("faces", face)


register_item(ItemKind("polyhedron", PolyhedronItem, generate, after="box", place=place))
