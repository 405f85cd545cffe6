"""Load combinations: named loads in place of the entries that refer to them, each with the product of its factors."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from mbla.deck.tree import KeyPath
from mbla.deck.types import Load


@dataclass(frozen=True)
class Entry:
    """A load that is none but itself: its place in the deck, and the factor on it."""

    load: Load
    path: KeyPath
    factor: float


def entries_of(loads: Sequence[Load], path: KeyPath, named: Mapping[str, Sequence[Load]]) -> Iterator[Entry]:
    """All loads of a list, named ones among them; the deck has no cycle of names."""
    waiting = [Entry(load, (*path, number), load.factor) for number, load in reversed(list(enumerate(loads)))]
    while waiting:
        entry = waiting.pop()
        name = entry.load.loads
        if name is None:
            yield entry
            continue
        below = [Entry(load, ("loads", name, i), entry.factor * load.factor) for i, load in enumerate(named[name])]
        waiting += reversed(below)
