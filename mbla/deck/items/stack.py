"""Item `stack`."""

from __future__ import annotations

from collections.abc import Iterator

from pydantic import Field

from mbla.deck.items.item import Item
from mbla.deck.quantities import Count, Length, PlanePoint, PositiveLength, PositiveNumber
from mbla.deck.section import given, rule
from mbla.deck.suggestions import listed
from mbla.errors import Finding


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
