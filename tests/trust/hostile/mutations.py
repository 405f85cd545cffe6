"""Changes of files: of the tree that a YAML or JSON text is, of the words and numbers of other texts, and of bytes."""

from __future__ import annotations

import copy
import json
import re
from collections.abc import Sequence
from functools import lru_cache
from typing import Any, Protocol, TypeVar

import yaml

T = TypeVar("T")

_LOADER: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

VALUES: Sequence[Any] = [
    *yaml.safe_load(
        """
        [null, true, 0, 1, -1, 2, 0.5, 90, 180, 1.0e-300, 1.0e-9, 1.0e+9, 1.0e+300, -1.0e+300, 2147483648,
         9007199254740993, "", " ", stone, dry, ground, "=1/0", "=9**9**9", "=n*1e9", "=mu", "=-1", 10 kN, 1e9 km,
         1 m^9, stone.obj, ../stone.obj, /dev/zero, [], {}, [0, 0, 0], [1, 0, 0], [0, 0, 1.0e-12],
         [1.0e+200, -1.0e+200, 1.0e+200], [[0, 0, 0], [1, 1, 1]], {group: wall, index: -1}, {ground: {z: 0}},
         {count: 100000, translate: [0, 0, 0]}, {translate: [0, 0, 1.0e-9]}, {scale: 1.0e-9},
         {rotate: {axis: [0, 0, 1], angle: 45}}]
        """
    ),
    *(10**30, 10**400, "\u202e\u0000", "x" * 5000),
]
"""what is put in the place of something else"""
WORDS = (b"0", b"-1", b"1", b"2", b"nan", b"inf", b"1e308", b"1e-308", b"99999999999", b"4294967295", b"x", b"", b"1 1")
BYTES = [bytes([value]) for value in (0, 9, 10, 13, 27, 255)]
BYTES += [b"\xef\xbb\xbf", b"\xe2\x80\xa8", b"{", b"}", b"[", b"]", b"#", b'"', b"'", b"&a ", b"*a", b"!!x ", b"<<: "]
BYTES += [b": ", b"- ", b"? ", b"|\n", b"---\n", b"...\n", b"%YAML 1.1\n"]
"""what is inserted"""


class Choice(Protocol):
    """Chooses one of several; a generator of random numbers, or hypothesis."""

    def __call__(self, options: Sequence[T], /) -> T: ...


def changed(kind: str, content: bytes, choose: Choice) -> bytes:
    """A file with one change."""
    if kind in ("deck", "sweep", "json", "gltf") and choose(range(4)):
        return changed_tree(kind, content, choose)
    return changed_words(content, choose) if choose(range(2)) else changed_bytes(content, choose)


def changed_tree(kind: str, content: bytes, choose: Choice) -> bytes:
    """A YAML or JSON text with one value of its tree changed, as JSON; its bytes changed where it is none."""
    tree = copy.deepcopy(_parsed(content, kind in ("json", "gltf")))
    places = _places(tree)
    if not places:
        return changed_bytes(content, choose)
    holder, key = _at(tree, choose(places))
    _change(holder, key, [_value(tree, place) for place in places], choose)
    return json.dumps(tree).encode()  # which is YAML, too


@lru_cache(maxsize=2000)
def _parsed(content: bytes, is_json: bool) -> Any:
    """Tree of a text; None where it has none that JSON can say."""
    try:
        tree = json.loads(content) if is_json else yaml.load(content, _LOADER)
        json.dumps(tree)
    except (ValueError, TypeError, yaml.YAMLError, RecursionError):
        return None
    return tree


def _change(holder: Any, key: Any, others: Sequence[Any], choose: Choice) -> None:
    """One change of an entry of a mapping or list."""
    how = choose(("value", "value", "other", "leave out", "repeat", "rename", "number", "number", "wrap"))
    value = holder[key]
    if how == "number" and isinstance(value, (int, float)) and not isinstance(value, bool):
        holder[key] = choose((-value, 0, 2 * value, value + 1, value * 10**6, _float(value) / 2, _float(value) * 1e-6))
    elif how == "other":
        holder[key] = copy.deepcopy(choose(others))
    elif how == "leave out":
        del holder[key]
    elif how == "repeat" and isinstance(holder, list):
        holder.insert(key, copy.deepcopy(value))
    elif how == "rename" and isinstance(holder, dict):
        holder[choose((f"{key}s", str(key).upper(), "material", "repeat", "transform", "on", "../x", "x" * 300))] = (
            value
        )
    elif how == "wrap":
        holder[key] = [value]
    else:
        holder[key] = copy.deepcopy(choose(VALUES))


def _float(value: float) -> float:
    """A number in double precision, the largest one for what has none."""
    return float(min(max(value, -1e308), 1e308))


def _places(value: Any, path: tuple[Any, ...] = ()) -> list[tuple[Any, ...]]:
    """Paths of everything below a value."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    found = []
    for key, below in list(entries):
        found += [(*path, key), *_places(below, (*path, key))]
    return found


def _at(tree: Any, path: tuple[Any, ...]) -> tuple[Any, Any]:
    for key in path[:-1]:
        tree = tree[key]
    return tree, path[-1]


def _value(tree: Any, path: tuple[Any, ...]) -> Any:
    holder, key = _at(tree, path)
    return holder[key]


def changed_words(content: bytes, choose: Choice) -> bytes:
    """A text with one word or line replaced, left out or repeated."""
    pattern = rb"[^\n]+\n?" if choose(range(3)) == 0 else rb"[^\s,\[\]{}:<>\"]+"
    spans = [match.span() for match in re.finditer(pattern, content)]
    if not spans:
        return changed_bytes(content, choose)
    begin, end = choose(spans)
    other = choose(spans)
    new = choose((*WORDS, content[slice(*other)], content[begin:end] * 2))
    return content[:begin] + new + content[end:]


def changed_bytes(content: bytes, choose: Choice) -> bytes:
    """A file with some bytes inserted, overwritten, left out or cut off."""
    at = choose(range(len(content) + 1))
    how = choose(("insert", "overwrite", "leave out", "cut", "flip"))
    if how == "cut":
        return content[:at]
    if how == "leave out":
        return content[:at] + content[at + choose((1, 2, 4, 50)) :]
    if how == "flip" and at < len(content):
        return content[:at] + bytes([content[at] ^ (1 << choose(range(8)))]) + content[at + 1 :]
    new = choose(BYTES)
    return content[:at] + new + content[at + (len(new) if how == "overwrite" else 0) :]
