"""Selections of `contacts.overrides`: blocks as everywhere, and ``ground`` for ground planes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np

from mbla.arrays import BoolArray
from mbla.deck.references import GROUND
from mbla.deck.tree import KeyPath
from mbla.deck.types import ContactOverride, Selector, SelectorTerm
from mbla.errors import Fault
from mbla.model.selectors import Roster, select_blocks


def check_overrides(overrides: Sequence[ContactOverride], roster: Roster, faults: list[Fault]) -> None:
    """Add to ``faults`` the selectors of overrides that mean no block."""
    for number, override in enumerate(overrides):
        for side, selector in enumerate(override.between or ()):
            for below, term in _blocks_in(selector):
                select_blocks(term, ("contacts", "overrides", number, "between", side, *below), roster, faults)


def bodies_selected(selector: Selector, roster: Roster, n_grounds: int) -> BoolArray:
    """Bodies that a side of an override means, (n_blocks + n_grounds,)."""
    n_blocks = len(roster.blocks)
    chosen = np.zeros(n_blocks + n_grounds, dtype=bool)
    for below, term in _blocks_in(selector):
        blocks = select_blocks(term, below, roster, [])
        assert blocks is not None  # ``check_overrides`` found blocks for every one
        chosen[blocks] = True
    terms = selector if isinstance(selector, list) else [selector]
    chosen[n_blocks:] = GROUND in terms
    return chosen


def selector_words(selector: Selector) -> str:
    """A selector as a message names it: ``base``, ``{group: base, index: 2}``, ``base or ground``."""
    if isinstance(selector, list):
        return " or ".join(selector_words(term) for term in selector)
    if isinstance(selector, str):
        return selector
    keys = selector.model_dump(exclude_none=True, by_alias=True)
    return "{" + ", ".join(f"{key}: {_plain(value)}" for key, value in keys.items()) + "}"


def _plain(value: object) -> str:
    if isinstance(value, (tuple, list)):
        return "[" + ", ".join(_plain(item) for item in value) + "]"
    return f"{value:g}" if isinstance(value, float) else str(value)


def _blocks_in(selector: Selector) -> Iterator[tuple[KeyPath, str | SelectorTerm]]:
    """The terms of a selector that mean blocks, with their place below it.

    A group that happens to be called "ground" is not meant: the word stands for ground planes.
    """
    if isinstance(selector, list):
        yield from (((number,), term) for number, term in enumerate(selector) if term != GROUND)
    elif selector != GROUND:
        yield (), selector
