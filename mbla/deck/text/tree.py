"""Deck content as plain dicts, lists and scalars, with the place of every key and value in a parallel tree of marks.

A mark is one integer: number of the source text in the upper bits, offset of the first character in the lower ones.
Marks stay integers because a deck has hundreds of thousands of values and only faults need their places.

Plain scalars are read by the core schema of YAML 1.2 (https://yaml.org/spec/1.2.2/#103-core-schema). Unlike YAML 1.1:
``1e3`` is a number, ``017`` is seventeen, ``no``, ``on``, dates and ``12:30:45`` are text.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from mbla.deck.text.sources import SourceText
from mbla.errors import Fault, KeyPath, Message, Place, ValueRefused, printable

FILE_SHIFT = 32
OFFSET_MASK = (1 << FILE_SHIFT) - 1
_LONGEST_VALUE = 60
_PLAIN_WORD = re.compile(r"[^\s,\]}]+")


class MappingMarks:
    """Marks of a mapping: its own first character, its keys, and its values."""

    __slots__ = ("keys", "own", "values")

    def __init__(self, own: int) -> None:
        self.own = own
        self.keys: dict[str, int] = {}
        self.values: dict[str, Marks] = {}


class SequenceMarks:
    """Marks of a list: its own first character, and its items."""

    __slots__ = ("items", "own")

    def __init__(self, own: int) -> None:
        self.own = own
        self.items: list[Marks] = []


Marks: TypeAlias = int | MappingMarks | SequenceMarks


def own_mark(marks: Marks) -> int:
    """Mark of a value itself, whatever it holds."""
    return marks if isinstance(marks, int) else marks.own


@dataclass(frozen=True)
class Tree:
    """Content of a deck, its marks, and the texts that the marks point into."""

    data: dict[str, Any]
    marks: MappingMarks
    sources: list[SourceText]

    def place_of(self, mark: int) -> Place:
        """Place of a mark."""
        return self.source_of(mark).place(mark & OFFSET_MASK)

    def source_of(self, mark: int) -> SourceText:
        """Text that a mark points into."""
        return self.sources[mark >> FILE_SHIFT]

    def marks_along(self, path: KeyPath) -> list[int]:
        """Marks from the root to the value at a path, as far as the path exists."""
        found: list[int] = [self.marks.own]
        marks: Marks = self.marks
        for key in path:
            below = _step(marks, key)
            if below is None:
                break
            marks = below
            found.append(own_mark(marks))
        return found

    def value_mark(self, path: KeyPath) -> int:
        """Mark of the value at a path, or of the nearest mapping or list around it."""
        return self.marks_along(path)[-1]

    def fault(self, path: KeyPath, message: Message, at_key: bool = False) -> Fault:
        """Fault of the value at a path, or of its key; what does not exist is reported where its mapping begins."""
        place, written = self._reported(path, at_key)
        return Fault(place, key_text(path), message, written)

    def place_at(self, path: KeyPath) -> Place:
        """Where a fault of the value at a path would be reported."""
        return self._reported(path, at_key=False)[0]

    def _reported(self, path: KeyPath, at_key: bool) -> tuple[Place, str | None]:
        """Place of a fault, and the value there as written."""
        marks: Marks = self.marks
        data: Any = self.data
        place = self.marks.own
        for depth, key in enumerate(path):
            below = _step(marks, key)
            if below is None:
                return self.place_of(place), None
            data = data[key]
            # A mapping is announced by its key; its first character is already its first content.
            last_key = depth == len(path) - 1 and at_key
            by_key = isinstance(marks, MappingMarks) and (last_key or isinstance(below, MappingMarks))
            place = marks.keys[str(key)] if by_key and isinstance(marks, MappingMarks) else own_mark(below)
            marks = below
        return self.place_of(place), self._written(own_mark(marks), data) if path else None

    def _written(self, mark: int, value: Any) -> str | None:
        """A value as the deck has it, shortened; None for mappings and for lists over several lines."""
        text = self.source_of(mark).text
        offset = mark & OFFSET_MASK
        if isinstance(value, dict):
            return None
        if isinstance(value, list):
            return _flow_sequence(text[offset : offset + 500])
        first = text[offset : offset + 1]
        if isinstance(value, str):
            return shorten(f"{first}{value}{first}" if first in ("'", '"') else value)
        match = _PLAIN_WORD.match(text, offset)
        return shorten(match.group()) if match else None


def _step(marks: Marks, key: str | int) -> Marks | None:
    if isinstance(marks, MappingMarks):
        return marks.values.get(key) if isinstance(key, str) else None
    if isinstance(marks, SequenceMarks) and isinstance(key, int) and 0 <= key < len(marks.items):
        return marks.items[key]
    return None


def _flow_sequence(text: str) -> str | None:
    """The bracketed list at the start of a text, without line breaks; None where there is none, or it is long."""
    depth = 0
    for position, character in enumerate(text):
        depth += (character == "[") - (character == "]")
        if depth == 0:
            return shorten(text[: position + 1]) if position else None
    return shorten(text)


def shorten(text: str) -> str:
    """A text on one line, cut where it would fill the screen, with nothing in it that a terminal acts on."""
    line = printable(" ".join(text[: 4 * _LONGEST_VALUE].split()))
    return line if len(line) <= _LONGEST_VALUE and len(text) <= 4 * _LONGEST_VALUE else line[: _LONGEST_VALUE - 1] + "…"


def key_text(path: Sequence[str | int]) -> str:
    """``blocks[3].wall.length``."""
    text = ""
    for key in path:
        text += f"[{key}]" if isinstance(key, int) else f".{shorten(key)}" if text else shorten(key)
    return text


Scalar: TypeAlias = str | int | float | bool | None
_NUMBER = re.compile(
    r"(?P<int>[-+]?[0-9]+)|(?P<float>[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?)"
    r"|(?P<octal>0o[0-7]+)|(?P<hex>0x[0-9a-fA-F]+)|(?P<nonfinite>[-+]?\.(?:inf|Inf|INF)|\.(?:nan|NaN|NAN))"
)
_NUMBER_START = frozenset("+-.0123456789")
_WORDS: dict[str, Scalar] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
}
_EXACT = 2**53
"""Up to here every integer is a float too; beyond, the deck's numbers are floats."""


def plain_scalar(text: str) -> Scalar:
    """Value of an unquoted scalar.

    Raises ValueRefused for infinity, not-a-number, and numbers too large for double precision.
    """
    if text[:1] not in _NUMBER_START or (match := _NUMBER.fullmatch(text)) is None:
        return _WORDS.get(text, text)
    kind = match.lastgroup
    if kind == "float":
        return _finite(float(text))
    if kind == "nonfinite":
        raise ValueRefused("not-a-number", "must be a finite number")
    if kind == "int" and len(text) <= 15:
        return int(text)
    base = {"int": 10, "octal": 8, "hex": 16}[kind or "int"]
    if len(text) > 400:  # int() itself refuses more than 4300 digits; nothing finite has as many as 400
        raise ValueRefused("not-a-number", "is too large for a number")
    number = int(text, base if base == 10 else 0)
    if abs(number) <= _EXACT:
        return number
    try:
        return _finite(float(number))
    except OverflowError:
        raise ValueRefused("not-a-number", "is too large for a number") from None


def _finite(number: float) -> float:
    if abs(number) == float("inf"):
        raise ValueRefused("not-a-number", "is too large for a number")
    return number
