"""Items `box`, `polyhedron`, `stack` and `trilithon`."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import (
    Count,
    Index,
    Length,
    PlanePoint,
    Point,
    PositiveLength,
    PositiveNumber,
    corners_in_order,
)
from mbla.deck.section import given, rule
from mbla.deck.suggestions import listed
from mbla.errors import Finding


class BoxItem(Item):
    """One block: a cuboid along the axes."""

    min: Point = Field(description="corner with the least coordinates")
    max: Point = Field(description="corner with the greatest coordinates")


@rule(BoxItem)
def box_extent(box: BoxItem) -> Iterator[Finding]:
    """Corners in order, none equal."""
    yield from corners_in_order(box.min, box.max, "max")


class PolyhedronItem(Item):
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


class StackItem(Item):
    """Equal cuboids one on the other along +z, the lowest with its least corner at the origin. Labels: `drum`."""

    block: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(description="extents of a block along x, y, z")
    count: Count = Field(description="number of blocks")
    shift: PlanePoint | None = Field(None, description="displacement along x and y of each block from the one below")
    offsets: list[Length] | None = Field(
        None, description="displacement along x of each block from the one below, count - 1 of them from the bottom"
    )
    overhang: PositiveNumber | None = Field(
        None,
        description="harmonic overhang towards +x: the k-th block from the top is shifted by overhang times "
        "length/(2k) over the one below; 1 is the most that stands",
    )


@rule(StackItem)
def stack_shifts(stack: StackItem) -> Iterator[Finding]:
    """One way of saying how blocks are shifted, and blocks that rest on each other."""
    keys = ("shift", "offsets", "overhang")
    found = given(stack, keys)
    if len(found) > 1:
        yield Finding(
            "one-of-several", f"only one of {listed(keys)} may be given, here are {listed(found, 'and')}", found[1]
        )
    elif found and stack.count == 1:
        yield Finding("key-of-another-choice", "has no effect on a single block", found[0])
    else:
        yield from _shift_sizes(stack)


def _shift_sizes(stack: StackItem) -> Iterator[Finding]:
    length, depth, _ = stack.block
    beyond = "the block would not rest on the one below"
    for axis, limit in enumerate((length, depth)):
        if stack.shift is not None and abs(stack.shift[axis]) >= limit:
            yield Finding("out-of-bounds", f"must be less than {limit:g} in size: {beyond}", "shift", axis)
    if stack.offsets is not None and len(stack.offsets) != stack.count - 1:
        yield Finding(
            "out-of-bounds", f"must be {stack.count - 1} numbers, count - 1; here are {len(stack.offsets)}", "offsets"
        )
    for number, offset in enumerate(stack.offsets or ()):
        if abs(offset) >= length:
            yield Finding("out-of-bounds", f"must be less than {length:g} in size: {beyond}", "offsets", number)
    if stack.overhang is not None and stack.overhang >= 2:
        yield Finding("out-of-bounds", f"must be < 2: {beyond}", "overhang")


class TrilithonItem(Item):
    """Two uprights along x and a lintel on them, centred; the left upright has its least corner at the origin.

    Members `upright` and `lintel`; labels of the uprights: `unit` 0 and 1.
    """

    upright: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="extents of an upright along x, y, z"
    )
    opening: PositiveLength = Field(description="clear distance between the uprights")
    lintel: tuple[PositiveLength, PositiveLength, PositiveLength] = Field(
        description="extents of the lintel along x, y, z; longer than the opening"
    )


@rule(TrilithonItem)
def trilithon_lintel(trilithon: TrilithonItem) -> Iterator[Finding]:
    """The lintel rests on both uprights."""
    if trilithon.lintel[0] <= trilithon.opening:
        words = f"must be > {trilithon.opening:g}, the opening: the lintel rests on both uprights"
        yield Finding("out-of-bounds", words, "lintel", 0)
