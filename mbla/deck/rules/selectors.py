"""Rules on selectors."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import least_below_greatest
from mbla.deck.section import Finding, rule


@rule(types.SelectorTerm)
def selector_term(term: types.SelectorTerm) -> Iterator[Finding]:
    """An index counts within a group; a box has an extent."""
    if term.box is not None and term.index is not None:
        yield ("index",), "applies with group only"
    if term.box is not None:
        for (key, axis), message in least_below_greatest(*term.box, "box", "xyz"):
            yield (key, 1, axis), message
