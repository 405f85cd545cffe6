"""Key paths of parameters in a deck: whether there is such a key, its unit, its value."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from types import UnionType
from typing import Annotated, Any, Union, get_args, get_origin

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from mbla.deck.content import DeckContent
from mbla.deck.fields import allowed_keys, annotations_at, branches, sections_at, takes_names
from mbla.deck.quantities import RealNumber
from mbla.deck.suggestions import listed, unknown
from mbla.deck.text.overrides import RefusedError, item_index, next_key
from mbla.deck.text.tree import Tree, key_text, shorten
from mbla.deck.units import Units
from mbla.errors import Fault, KeyPath, Message

FIXED = {
    "include": "files are included before anything is set",
    "mbla": "it is the version of the format",
    "units": "figures that are compared have one unit",
    "title": "it does not change the answer",
    "find": "it does not change the answer",
    "output": "it does not change the answer",
    "expected": "it does not change the answer",
}
"""Sections of the deck that hold no parameter, and why"""


def path_of_key(data: Mapping[str, Any], key: str) -> KeyPath:
    """Path of the value that a key path of a parameter names in a deck; sections may be left to their defaults.

    data : the deck as read

    Raises RefusedError with what is wrong with it.
    """
    words = key.strip().split(".")
    if words[0] in FIXED:
        raise RefusedError("sweep-key", f"{words[0]} holds no parameter: {FIXED[words[0]]}")
    path: KeyPath = ()
    below: Any = data
    while words:
        word, words = next_key(below, words)
        step = _step(below, path, word)
        if isinstance(below, dict):
            below = below.get(step)
        else:
            below = below[step] if isinstance(below, list) and isinstance(step, int) else None
        path = (*path, step)
    by_name = takes_names(DeckContent, path)
    keys = allowed_keys(DeckContent, path) if sections_at(DeckContent, path) else ()
    if by_name or (keys and not _takes_plain_values(path)):
        names = listed(keys or below or ["a name"])
        raise RefusedError("sweep-key", f"{key_text(path)} is a section of the deck: name one of its keys, {names}")
    return path


def _step(data: Any, path: KeyPath, word: str) -> str | int:
    """The next key or number of an item below a path."""
    if isinstance(data, list):
        return item_index(data, word)
    below = isinstance(data, dict | None)
    names = list(data or ()) if below and takes_names(DeckContent, path) else allowed_keys(DeckContent, path)
    if below and word in {*(data or ()), *names}:
        return word
    if not below or not names:
        raise RefusedError("sweep-key", f"the deck has nothing below {key_text(path)}")
    where = f"key {shorten(word)} in {key_text(path)}" if path else f"section {shorten(word)}"
    raise RefusedError("sweep-key", unknown(where, word, names))


def _takes_plain_values(path: KeyPath) -> bool:
    """Whether a value that may be a section may be a number, text or list as well."""
    return any(
        not (isinstance(each, type) and issubclass(each, BaseModel))
        for annotation in annotations_at(DeckContent, path)
        for each in branches(annotation)
    )


ASKED = ("analysis", "strengthen")
"""sections that say what is asked, not what the structure and its loads are"""


def number_at(content: DeckContent, path: KeyPath) -> float | None:
    """Real number of the structure or its loads at a path, in the deck's units; None for what is none.

    Such as a count, a choice or a section, and what only says what is asked.
    """
    value = value_at(content, path) if path[0] not in ASKED and dimensions_at(path) else None
    return None if isinstance(value, bool) or not isinstance(value, (int, float)) else float(value)


def dimensions_at(path: KeyPath) -> set[str]:
    """Dimensions that a value at a path may have; none where no real number stands."""
    return {each.dimension for annotation in annotations_at(DeckContent, path) for each in _quantities(annotation)}


def parameter_faults(tree: Tree, content: DeckContent | None) -> Iterator[Fault]:
    """What is wrong with the key paths that a deck itself has for parameters.

    content : None where the deck has other faults: only keys that it has not are found then
    """
    for place, key in _asked(tree.data):
        try:
            path = path_of_key(tree.data, key)
        except RefusedError as refusal:
            yield tree.fault(place, Message("parameter-key", refusal.message.words))
            continue
        if content is not None and number_at(content, path) is None:
            words = f"{key_text(path)} is no real number of the structure or its loads that the deck gives"
            yield tree.fault(place, Message("parameter-key", words))


def _asked(data: Mapping[str, Any]) -> Iterator[tuple[KeyPath, str]]:
    """Where a deck has key paths of parameters, and these, as far as they are text."""
    analysis, find = (each if isinstance(each := data.get(name), dict) else {} for name in ("analysis", "find"))
    slopes = analysis.get("sensitivity")
    for row, key in enumerate(slopes if isinstance(slopes, list) else []):
        if isinstance(key, str):
            yield ("analysis", "sensitivity", row), key
    if isinstance(key := find.get("parameter"), str):
        yield ("find", "parameter"), key


def unit_of(paths: Sequence[KeyPath], units: Units) -> str:
    """The deck's unit of the values at some paths; empty for plain numbers, for text, where several are possible."""
    found = set()
    for path in paths:
        at = dimensions_at(path)
        found.add(units.unit(at.pop()) if len(at) == 1 else "")
    return found.pop() if len(found) == 1 else ""


def _quantities(annotation: Any) -> Iterator[RealNumber]:
    """Quantities of an annotation and of the items of a list."""
    if get_origin(annotation) is Annotated:
        below, *metadata = get_args(annotation)
        for item in metadata:
            if isinstance(item, RealNumber):
                yield item
            elif isinstance(item, FieldInfo):
                yield from (each for each in item.metadata if isinstance(each, RealNumber))
        yield from _quantities(below)
    elif get_origin(annotation) in (Union, UnionType, list, tuple):
        for each in get_args(annotation):
            yield from _quantities(each)


def value_at(content: DeckContent, path: KeyPath) -> Any:
    """Checked value at a path, in the deck's units; None where there is none."""
    value: Any = content.model_dump(by_alias=True)
    with suppress(KeyError, IndexError, TypeError):
        for key in path:
            value = value[key]
        return value
    return None


def vector_at(content: DeckContent, path: KeyPath) -> tuple[float, float, float] | None:
    """Vector of three numbers at a path; None where there is something else."""
    value = value_at(content, path)
    if not isinstance(value, tuple) or len(value) != 3 or not all(isinstance(each, (int, float)) for each in value):
        return None
    x, y, z = (float(each) for each in value)
    return x, y, z
