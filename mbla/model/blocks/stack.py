"""Item `stack`.

Harmonic overhang of a stack: with blocks of length l, the k-th from the top is shifted over the one below by s l/(2 k);
at s = 1 the blocks above each joint have their centre of gravity exactly over its edge.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from pydantic import Field

from mbla.arrays import FloatArray
from mbla.deck.kinds.positions import DRUM
from mbla.deck.quantities import Count, Length, PlanePoint, PositiveLength, PositiveNumber
from mbla.deck.section import given, rule
from mbla.deck.suggestions import listed
from mbla.errors import Finding
from mbla.model.blocks.generated import Generated, ItemContext, ItemPart
from mbla.model.blocks.item import AnyItem, ItemKind, register_item
from mbla.model.solids.polyhedra import cuboids


class StackItem(AnyItem):
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


def generate(item: StackItem, context: ItemContext) -> Generated:
    """Blocks from the bottom."""
    shifts = np.concatenate([np.zeros((1, 2)), np.cumsum(_shifts(item), axis=0)])
    heights = item.block[2] * np.arange(item.count + 1)
    least = np.column_stack([shifts, heights[:-1]])
    greatest = np.column_stack([shifts + item.block[:2], heights[1:]])
    return Generated((ItemPart(cuboids(least, greatest), labels={"drum": np.arange(item.count)}),))


def _shifts(item: StackItem) -> FloatArray:
    """Displacement along x and y of each block but the lowest from the one below, (count - 1, 2)."""
    shifts = np.zeros((item.count - 1, 2))
    if item.shift is not None:
        shifts[:] = item.shift
    elif item.offsets is not None:
        shifts[:, 0] = item.offsets
    elif item.overhang is not None:
        shifts[:, 0] = item.overhang * item.block[0] / (2.0 * np.arange(item.count - 1, 0, -1))
    return shifts


def amount(item: StackItem) -> tuple[float, str]:
    """Its blocks."""
    return item.count, "count"


register_item(ItemKind("stack", StackItem, generate, amount, after="column", positions=(DRUM,)))
