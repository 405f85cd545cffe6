"""Which keys of the deck's types, and which kinds of things, the decks of a folder give."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from inspect import get_annotations
from typing import Any, get_args

from mbla.deck.content import DeckContent
from mbla.deck.section import Section

Key = tuple[str, str]
"""name of the type that declares a key, key: keys that several kinds of items share are one"""


def all_keys() -> set[Key]:
    """Keys of every section that a deck may have."""
    return {_key(section, name) for section in all_sections() for name in section.model_fields}


def all_sections() -> set[type[Section]]:
    """Types of sections that the deck's type refers to, itself included."""
    found: set[type[Section]] = set()
    waiting: list[Any] = [DeckContent]
    while waiting:
        annotation = waiting.pop()
        waiting += get_args(annotation)
        if isinstance(annotation, type) and issubclass(annotation, Section) and annotation not in found:
            found.add(annotation)
            waiting += [field.annotation for field in annotation.model_fields.values()]
    return found


def keys_in_use(contents: Iterable[Any]) -> set[Key]:
    """Keys that at least one of the decks gives."""
    return {_key(type(section), name) for section in sections_of(contents) for name in section.model_fields_set}


def sections_of(value: Any) -> Iterator[Section]:
    """All sections in a value of a deck, the outer ones first."""
    if isinstance(value, Section):
        yield value
        for name in value.model_fields_set:
            yield from sections_of(getattr(value, name))
    elif isinstance(value, dict):
        yield from sections_of(value.values())
    elif not isinstance(value, str) and isinstance(value, Iterable):
        for each in value:
            yield from sections_of(each)


@cache
def _key(section: type[Section], name: str) -> Key:
    declares = [each for each in section.__mro__ if name in get_annotations(each)]
    return declares[-1].__name__, name
