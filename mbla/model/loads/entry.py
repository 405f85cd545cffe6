"""Single loads of a deck.

Combinations name loads: these stand in for the entries that refer to them, with the product of their factors.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from mbla.deck.load_key import LOAD_KEYS, NAMED
from mbla.deck.sections.any_load import AnyLoad
from mbla.errors import KeyPath


@dataclass(frozen=True)
class Entry:
    """A single load: its kind and value, what it says besides, its place in the deck, and the factor on it."""

    kind: str
    value: Any
    load: AnyLoad
    path: KeyPath
    factor: float

    @staticmethod
    def of(load: AnyLoad, path: KeyPath, factor: float = 1.0) -> Entry:
        """Of a load of the deck, with a factor besides its own."""
        return Entry(load.kind, load.chosen, load, path, factor * load.factor)

    @property
    def adds_up(self) -> bool:
        """It is a part of a sum of loads."""
        return not LOAD_KEYS[self.kind].live_only


def entries_of(loads: Sequence[AnyLoad], path: KeyPath, named: Mapping[str, Sequence[AnyLoad]]) -> Iterator[Entry]:
    """All loads of a list, named ones among them; the deck has no cycle of names."""
    waiting = [Entry.of(load, (*path, number)) for number, load in reversed(list(enumerate(loads)))]
    while waiting:
        entry = waiting.pop()
        if entry.kind != NAMED:
            yield entry
            continue
        name = entry.value
        below = [Entry.of(load, ("loads", name, number), entry.factor) for number, load in enumerate(named[name])]
        waiting += reversed(below)
