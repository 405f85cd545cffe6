"""The kinds of loads as a deck gives them, by their keys.

A kind is one file of ``mbla.model.loads``, which registers it at its foot. A load of the deck has the key of exactly
one kind; others that go with it are in :mod:`mbla.deck.sections.any_load`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

from mbla.deck.kinds.kinds import ChoiceKind, in_order, register


@dataclass(frozen=True, kw_only=True)
class LoadKey(ChoiceKind):
    """A kind of load: what stands at its key, and what goes with it.

    section     : type of what stands at the key, which may be a vector or a name
    description : for schema and reference
    takes       : which of at, pattern, follows and through go with it
    refuses     : why `on` or `factor` does not, after "does not apply to"
    needs_block : it acts on the one block that `on` names
    live_only   : it makes something else of a load case than a sum of loads
    alone       : why no other live load goes with it, empty where others do
    names       : keys of its value that name something of the deck, and what: {"vehicle": "vehicle"}
    is_file     : its value names a file
    """

    section: Any
    description: str
    takes: tuple[str, ...] = ()
    refuses: Mapping[str, str] = field(default_factory=dict)
    needs_block: bool = False
    live_only: bool = False
    alone: str = ""
    names: Mapping[str, str] = field(default_factory=dict)
    is_file: bool = False


NAMED = "loads"
"""key that names loads of section `loads`, which stand in its place"""
LOAD_KEYS: dict[str, LoadKey] = {}
"""by name"""


def register_load(kind: LoadKey) -> None:
    """Make a kind of load known."""
    register(LOAD_KEYS, kind)


def loads_that(holds: Callable[[LoadKey], Any]) -> tuple[str, ...]:
    """Names of the kinds of which something holds, in the order of schema and reference."""
    return tuple(kind.name for kind in in_order(LOAD_KEYS) if holds(kind))


def live_only() -> tuple[str, ...]:
    """Kinds that make something else of a load case than a sum of loads."""
    return loads_that(lambda kind: kind.live_only)


def loads_that_take(key: str) -> tuple[str, ...]:
    """Kinds with which one of at, pattern, follows and through goes."""
    return loads_that(lambda kind: key in kind.takes)
