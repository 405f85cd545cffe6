"""The text of a deck from its content: what :mod:`mbla.deck.text.reader` reads back to the same values.

What fits on a line is written in brackets, else each key and each item has a line; items that are short share lines.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from mbla.deck.text.tree import plain_scalar

WIDTH = 120
_WORD = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_./^-]*")
"""text that needs no quotes, unless it reads as a number or another value"""


def deck_text(data: dict[str, Any]) -> str:
    """Lines of a mapping: of mappings, lists, texts, numbers, true and false."""
    return "".join(f"{line}\n" for line in _lines(data, 0))


def _lines(value: dict[str, Any] | list[Any], indent: int) -> Iterator[str]:
    entries = value.items() if isinstance(value, dict) else ((None, item) for item in value)
    for key, below in entries:
        head = " " * indent + ("-" if key is None else f"{_flow(key)}:")
        text = _flow(below)
        if len(head) + len(text) < WIDTH or not isinstance(below, (dict, list)) or not below:
            yield f"{head} {text}"
        elif isinstance(below, list) and max(len(_flow(item)) for item in below) < WIDTH // 3:
            yield f"{head} ["
            yield from _filled([_flow(item) for item in below], " " * (indent + 2))
            yield " " * (indent + 2) + "]"
        else:
            lines = _lines(below, indent + 2)
            yield head if key is not None else f"{head} {next(lines).lstrip()}"
            yield from lines


def _filled(items: list[str], margin: str) -> Iterator[str]:
    """As many items on each line as there is room for."""
    line = ""
    for item in items:
        if line and len(margin) + len(line) + len(item) + 2 > WIDTH:
            yield f"{margin}{line}"
            line = ""
        line += f"{' ' if line else ''}{item},"
    yield f"{margin}{line}"


def _flow(value: Any) -> str:
    """A value on one line."""
    if isinstance(value, dict):
        return "{" + ", ".join(f"{_flow(key)}: {_flow(below)}" for key, below in value.items()) + "}"
    if isinstance(value, list):
        return "[" + ", ".join(map(_flow, value)) + "]"
    if isinstance(value, str) and _WORD.fullmatch(value) and plain_scalar(value) == value:
        return value
    return json.dumps(value, ensure_ascii=False)
