"""Rules on columns, stacks and trilithons."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import given
from mbla.deck.section import Finding, rule
from mbla.deck.suggestions import listed
from mbla.errors import Message


@rule(types.ColumnItem)
def column_heights(column: types.ColumnItem) -> Iterator[Finding]:
    """Heights of the drums one by one, or equal ones."""
    pair = ("height", "drums")
    found = given(column, pair)
    if column.drum_heights is not None:
        for key in found:
            yield (key,), Message("one-of-several", "is what drum_heights says already: leave one of them out")
    elif len(found) < 2:
        yield (), Message("missing-key", "needs height and drums, or drum_heights")


@rule(types.ColumnItem)
def column_profile(column: types.ColumnItem) -> Iterator[Finding]:
    """An entasis shows at joints between the ends only."""
    count = column.drums if column.drum_heights is None else len(column.drum_heights)
    if column.entasis > 0 and count == 1:
        yield (
            ("entasis",),
            Message(
                "key-of-another-choice",
                "has no effect on a single drum: it is the swelling of the joints between drums",
            ),
        )


@rule(types.StackItem)
def stack_shifts(stack: types.StackItem) -> Iterator[Finding]:
    """One way of saying how blocks are shifted, and blocks that rest on each other."""
    keys = ("shift", "offsets", "overhang")
    found = given(stack, keys)
    if len(found) > 1:
        yield (
            (found[1],),
            Message("one-of-several", f"only one of {listed(keys)} may be given, here are {listed(found, 'and')}"),
        )
    elif found and stack.count == 1:
        yield (found[0],), Message("key-of-another-choice", "has no effect on a single block")
    else:
        yield from _shift_sizes(stack)


def _shift_sizes(stack: types.StackItem) -> Iterator[Finding]:
    length, depth, _ = stack.block
    beyond = "the block would not rest on the one below"
    for axis, limit in enumerate((length, depth)):
        if stack.shift is not None and abs(stack.shift[axis]) >= limit:
            yield ("shift", axis), Message("out-of-bounds", f"must be less than {limit:g} in size: {beyond}")
    if stack.offsets is not None and len(stack.offsets) != stack.count - 1:
        yield (
            ("offsets",),
            Message("out-of-bounds", f"must be {stack.count - 1} numbers, count - 1; here are {len(stack.offsets)}"),
        )
    for number, offset in enumerate(stack.offsets or ()):
        if abs(offset) >= length:
            yield ("offsets", number), Message("out-of-bounds", f"must be less than {length:g} in size: {beyond}")
    if stack.overhang is not None and stack.overhang >= 2:
        yield ("overhang",), Message("out-of-bounds", f"must be < 2: {beyond}")


@rule(types.TrilithonItem)
def trilithon_lintel(trilithon: types.TrilithonItem) -> Iterator[Finding]:
    """The lintel rests on both uprights."""
    if trilithon.lintel[0] <= trilithon.opening:
        yield (
            ("lintel", 0),
            Message(
                "out-of-bounds", f"must be > {trilithon.opening:g}, the opening: the lintel rests on both uprights"
            ),
        )
