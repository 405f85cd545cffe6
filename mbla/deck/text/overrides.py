"""``--set key.path=value``: values of the deck replaced before anything is evaluated or checked."""

from __future__ import annotations

from typing import Any

from mbla.deck.content import DeckContent
from mbla.deck.fields import takes_names
from mbla.deck.suggestions import unknown
from mbla.deck.text.reader import read_yaml
from mbla.deck.text.sources import SourceText
from mbla.deck.text.tree import FILE_SHIFT, MappingMarks, Marks, SequenceMarks, Tree, key_text, shorten
from mbla.errors import Fault, KeyPath, Message, Refusal

LABEL = "--set"


class RefusedError(Refusal):
    """The override cannot be applied; the message says why."""


def apply_override(tree: Tree, text: str, number: int) -> list[Fault]:
    """Put one override into the tree; ``number`` counts them from 1, for messages.

    Returns
    -------
    Faults of the override; where there are any, the tree is unchanged.
    """
    file = len(tree.sources)
    source = SourceText(LABEL, text, line=number)
    tree.sources.append(source)
    key, equals, _ = text.partition("=")
    if not equals or not key.strip() or "\n" in text or "\r" in text:
        message = "must be key.path=value, on one line" + ("" if equals else ": there is no =")
        return [Fault(source.place(0), shorten(text), Message("set-refused", message))]
    offset = len(key) + 1
    document = read_yaml(source, file, offset)
    if document.faults:
        return [Fault(fault.place, key.strip(), fault.message, fault.value) for fault in document.faults]
    if key.strip().partition(".")[0] == "include":
        message = "cannot be set: files are included before anything is set"
        return [Fault(source.place(0), key.strip(), Message("set-refused", message))]
    if document.data is None:
        return [Fault(source.place(offset), key.strip(), Message("no-value", "has no value: write one after the ="))]
    try:
        _put(tree, key.strip().split("."), document.data, document.marks, file << FILE_SHIFT)
    except RefusedError as refusal:
        written = shorten(text[offset:])
        return [Fault(source.place(0), key.strip(), refusal.message, written)]
    return []


def _put(tree: Tree, words: list[str], value: Any, value_marks: Marks, mark: int) -> None:
    """Set the value at a path, making the sections on the way that the deck leaves to their defaults."""
    data: Any = tree.data
    marks: Any = tree.marks
    path: KeyPath = ()
    while True:
        key, words = next_key(data, words)
        data_key: str | int = key
        last = not words
        if isinstance(data, list):
            data_key = item_index(data, str(key))
            marks_below = marks.items
        elif isinstance(data, dict):
            marks_below = marks.values
            _check_name(data, path, str(key), value if last else None)
            if key not in data or last:
                marks.keys[key] = mark
            if key not in data and not last:
                data[key] = {}
                marks.values[key] = MappingMarks(mark)
        else:
            raise RefusedError("set-refused", "the deck has a single value there, with nothing below it")
        if last:
            data[data_key] = value
            marks_below[data_key] = value_marks
            return
        data, marks, path = data[data_key], marks_below[data_key], (*path, data_key)
        if not isinstance(marks, (MappingMarks, SequenceMarks)):
            data = None


def next_key(data: Any, words: list[str]) -> tuple[str, list[str]]:
    """First key of a path and the rest; names may hold dots themselves, so the longest that exists is taken."""
    if isinstance(data, dict):
        longest = 1 + max((key.count(".") for key in data), default=0)
        for length in range(min(longest, len(words)), 0, -1):
            if (key := ".".join(words[:length])) in data:
                return key, words[length:]
    return words[0], words[1:]


def item_index(data: list[Any], key: str) -> int:
    """Number of an item of a list; raises RefusedError where there is none."""
    if not key.isascii() or not key.isdecimal():
        raise RefusedError(
            "set-refused", f"{shorten(key) or 'nothing'} is not a number of an item: 0 to {len(data) - 1} are allowed"
        )
    if len(key) > 9 or int(key) >= len(data):
        raise RefusedError("set-refused", f"there is no item {shorten(key)}: 0 to {len(data) - 1} are allowed")
    return int(key)


def _check_name(data: dict[str, Any], path: KeyPath, key: str, value: Any) -> None:
    """Refuse a misspelt name where names are free: it would be added next to the right one and change nothing."""
    if key in data or not takes_names(DeckContent, path):
        return
    if path != ("parameters",) and isinstance(value, dict):
        return
    raise RefusedError("unknown-name", unknown(f"name {shorten(key)} in {key_text(path)}", key, data, "known"))
