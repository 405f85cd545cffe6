"""Rules on expectations."""

from __future__ import annotations

from collections.abc import Iterator

from mbla.deck import types
from mbla.deck.rules.common import given
from mbla.deck.section import Finding, rule
from mbla.errors import Message

FIGURES = ("load_factor", "angle", "position", "associative_load_factor", "reaction", "lower", "status")


@rule(types.Expectation)
def expectation(item: types.Expectation) -> Iterator[Finding]:
    """Something must be expected."""
    if not given(item, FIGURES):
        yield (), Message("missing-key", f"needs at least one of {', '.join(FIGURES[:-1])} or {FIGURES[-1]}")


@rule(types.DeckContent)
def expectations_of_kinds(deck: types.DeckContent) -> Iterator[Finding]:
    """An angle belongs to a tilt, a worst position to a load that travels."""
    for name, item in deck.expected.items():
        case = deck.load_cases.get(name)
        for key, kind in (("angle", "tilt"), ("position", "travel")):
            live = [] if case is None or getattr(item, key) is None else (case.live or [])
            if live and not any(getattr(load, kind) is not None for load in live):
                yield (
                    ("expected", name, key),
                    Message("key-of-another-choice", f"applies to load cases with {kind} only"),
                )
