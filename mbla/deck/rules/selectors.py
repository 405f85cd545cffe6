"""Rules on selectors."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import least_below_greatest
from mbla.deck.section import Finding, rule
from mbla.deck.selectors import POSITIONS
from mbla.errors import Message


@rule(types.SelectorTerm)
def selector_term(term: types.SelectorTerm) -> Iterator[Finding]:
    """An index counts within a group; a range ascends; a box has an extent."""
    if term.index is not None and term.group is None and term.box is not None:
        yield ("index",), Message("key-of-another-choice", "applies with group only")
    for name in POSITIONS:
        value = term.position(name)
        if isinstance(value, tuple) and value[0] > value[1] and (value[0] < 0) == (value[1] < 0):
            yield (name, 1), Message("out-of-bounds", f"must be >= {value[0]}, the first of the range")
    if term.box is not None:
        for (key, axis), message in least_below_greatest(*term.box, "box", "xyz"):
            yield (key, 1, axis), message
