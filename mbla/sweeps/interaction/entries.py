"""Live loads of a deck that was read as the deck would write them again, for a setting that puts them back changed."""

from __future__ import annotations

import os
from typing import Any

from mbla.deck import Deck
from mbla.deck.sections.load_cases import LoadCaseSection
from mbla.deck.sections.loads import Load
from mbla.deck.tree import KeyPath
from mbla.errors import UsageError
from mbla.model.loads.load_kind import Entry, entries_of

NO_SUM = {
    "travel": "travels: a load case for each of its positions",
    "tilt": "tilts: its answer is an angle",
}
"""kinds of loads that make something else of a load case than a sum of loads, and what"""


def section_of(deck: Deck, case: str, what: str) -> LoadCaseSection:
    """A load case whose live loads are a sum of loads; UsageError for any other, where ``what`` cannot be asked."""
    cases = deck.content.load_cases
    if case not in cases:
        raise UsageError("unknown-load-case", f"no load case {case} in the deck; it has {', '.join(cases)}")
    section = cases[case]
    if section.settlement is not None:
        raise UsageError(
            "interact-load", f"load case {case}: a support gives way, there is no live load; {what} needs one"
        )
    for entry in live_entries(deck, case):
        for kind, words in NO_SUM.items():
            if getattr(entry.load, kind) is not None:
                raise UsageError(
                    "interact-load", f"load case {case}: its live load {words}; {what} takes other kinds of load"
                )
    return section


def live_entries(deck: Deck, case: str) -> list[Entry]:
    """The live loads of a case, those that named loads stand for among them, with the products of their factors."""
    path: KeyPath = ("load_cases", case, "live")
    return list(entries_of(deck.content.load_cases[case].live or [], path, deck.content.loads))


def written(deck: Deck, entry: Entry, factor: float, **changes: Any) -> dict[str, Any]:
    """A load as a deck writes it, in the deck's units, with another factor and other values.

    A table is named relative to the main file of the deck, from where a setting looks for it.
    """
    text: dict[str, Any] = dumped(entry.load)
    if entry.load.table is not None:
        table = deck.resolve_file((*entry.path, "table"), entry.load.table)
        text["table"] = os.path.relpath(table.resolve(), deck.folder.resolve())
    return text | {"factor": factor} | changes


def dumped(load: Load) -> dict[str, Any]:
    """What the deck gives of a load, expressions evaluated."""
    text: dict[str, Any] = load.model_dump(mode="json", by_alias=True, exclude_unset=True, exclude_none=True)
    return text
