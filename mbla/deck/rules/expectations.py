"""Rules on expectations."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import given
from mbla.deck.section import Finding, rule


@rule(types.Expectation)
def expectation(item: types.Expectation) -> Iterator[Finding]:
    """Something must be expected."""
    if not given(item, ("load_factor", "associative_load_factor", "reaction", "lower", "status")):
        yield (), "needs at least one of load_factor, associative_load_factor, reaction, lower or status"
