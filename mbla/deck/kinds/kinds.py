"""Kinds of things of which a mapping of the deck is exactly one, such as an item of `blocks`.

A kind registers at the foot of its own file; the type of the mapping, with its schema, is made of those registered.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any, TypeVar

from mbla.deck.section import Section, with_keys


@dataclass(frozen=True)
class ChoiceKind:
    """A kind of thing.

    name    : key of the deck that it goes by
    section : type of what stands at the key, with its rules
    after   : kind behind which it stands in schema and reference; those without one stand in the order of their names
    """

    name: str
    section: type[Section]
    after: str = field(default="", kw_only=True)


K = TypeVar("K", bound=ChoiceKind)
C = TypeVar("C", bound="Choice")


class Choice(Section):
    """A mapping with exactly one key, the kind of what stands there."""

    @property
    def kind(self) -> str:
        """Its key."""
        return next(name for name in type(self).model_fields if getattr(self, name) is not None)

    @property
    def chosen(self) -> Any:
        """What stands there."""
        return getattr(self, self.kind)


def register(kinds: dict[str, K], kind: K) -> None:
    """Add a kind to those of its sort.

    Raises ValueError where its name is taken.
    """
    if kind.name in kinds:
        raise ValueError(f"{kind.name} is registered already")
    kinds[kind.name] = kind


def in_order(kinds: Mapping[str, K]) -> list[K]:
    """The kinds in the order of schema and reference.

    Raises ValueError where a kind stands behind one that is not registered, or behind itself.
    """
    behind: dict[str, list[K]] = {}
    for name in sorted(kinds):
        behind.setdefault(kinds[name].after, []).append(kinds[name])
    found, waiting = [], behind.get("", [])[::-1]
    while waiting:
        found.append(waiting.pop())
        waiting += behind.get(found[-1].name, [])[::-1]
    if len(found) < len(kinds):
        raise ValueError(f"no order of {', '.join(sorted(set(kinds) - {kind.name for kind in found}))}")
    return found


def keys_of(kinds: Mapping[str, ChoiceKind]) -> Callable[[type[C]], type[C]]:
    """A section with a key for each of some kinds."""
    return with_keys({kind.name: (kind.section | None, None) for kind in in_order(kinds)})
