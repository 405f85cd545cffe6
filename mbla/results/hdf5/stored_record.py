"""A record of any kind as arrays and back: what a run must know to go on from where it was stopped.

A record is a dataclass whose fields are numbers, texts, enumerations, arrays, records, and tuples, lists and
dictionaries of these. All its arrays are laid one after the other, by their kind; a tree in JSON says where each is,
and what the rest of the record is. What is no part of a record by the types of its fields is refused when it is read::

    float, int, bool, str, None      as JSON has them; floats that are not finite as texts
    array                            [kind, begin, *shape]
    tuple, list                      [items]
    record, dictionary               {field or key: value}
"""

from __future__ import annotations

import json
import math
import types
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass
from enum import Enum
from typing import Any, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

Record = TypeVar("Record")
KINDS: dict[str, type[np.generic]] = {"f": np.float64, "i": np.int64, "b": np.bool_}
"""of arrays, by the letter that numpy has for them"""


@dataclass(frozen=True)
class StoredRecord:
    """A record as it stands in a file.

    tree   : JSON
    arrays : by kind, all numbers one after the other
    """

    tree: str
    arrays: Mapping[str, np.ndarray]


def stored(record: Any) -> StoredRecord:
    """A record as arrays; raises TypeError where something in it is of another kind."""
    parts: dict[str, list[np.ndarray]] = {kind: [np.zeros(0, dtype=own)] for kind, own in KINDS.items()}
    counts = dict.fromkeys(KINDS, 0)

    def of_array(values: np.ndarray) -> list[Any]:
        kind = values.dtype.kind
        if kind not in KINDS:
            raise TypeError(f"an array of {values.dtype} cannot be stored")
        begin, counts[kind] = counts[kind], counts[kind] + values.size
        parts[kind].append(values.astype(KINDS[kind]).ravel())
        return [kind, begin, *values.shape]

    tree = json.dumps(_tree(record, of_array), separators=(",", ":"))
    return StoredRecord(tree, {kind: np.concatenate(own) for kind, own in parts.items()})


def _tree(value: Any, of_array: Callable[[np.ndarray], list[Any]]) -> Any:
    match value:
        case Enum():
            return value.value
        case float():
            return float(value) if math.isfinite(value) else repr(float(value))
        case None | bool() | int() | str():
            return value
        case np.generic():
            return _tree(value.item(), of_array)
        case np.ndarray():
            return of_array(value)
        case tuple() | list():
            return [_tree(each, of_array) for each in value]
        case dict():
            return {key: _tree(each, of_array) for key, each in value.items()}
    if not is_dataclass(value):
        raise TypeError(f"{type(value).__name__} cannot be stored")
    return {field.name: _tree(getattr(value, field.name), of_array) for field in fields(value) if field.init}


def restored(kind: type[Record], found: StoredRecord) -> Record:
    """The record of a kind; raises ValueError, TypeError or KeyError where that is not what was stored."""
    value: Record = _value(kind, json.loads(found.tree), found.arrays)
    return value


def _value(kind: Any, tree: Any, arrays: Mapping[str, np.ndarray]) -> Any:
    """What a tree is by the type of its place."""
    origin, inner = get_origin(kind), get_args(kind)
    if origin in (Union, types.UnionType):
        if tree is None:
            return None
        (kind,) = (each for each in inner if each is not type(None))
        return _value(kind, tree, arrays)
    if origin is np.ndarray or kind is np.ndarray:
        return _array(tree, arrays)
    if origin in (tuple, list):
        return _items(origin, inner, tree, arrays)
    if origin in (dict, Mapping):
        return {key: _value(inner[1], each, arrays) for key, each in tree.items()}
    if is_dataclass(kind) and isinstance(kind, type):
        hints = get_type_hints(kind)
        return kind(**{name: _value(hints[name], each, arrays) for name, each in tree.items()})
    if isinstance(kind, type) and issubclass(kind, Enum):
        return kind(tree)
    if kind is float:
        return float(tree)
    if kind in (int, bool, str) and type(tree) is kind:
        return tree
    raise TypeError(f"{tree!r} is not of {kind}")


def _items(origin: type, inner: tuple[Any, ...], tree: list[Any], arrays: Mapping[str, np.ndarray]) -> Any:
    """A tuple or a list: of one kind, or of a kind for each."""
    if origin is list or inner[-1] is Ellipsis:
        return origin(_value(inner[0], each, arrays) for each in tree)
    return tuple(_value(own, each, arrays) for own, each in zip(inner, tree, strict=True))


def _array(tree: list[Any], arrays: Mapping[str, np.ndarray]) -> np.ndarray:
    kind, begin, *shape = tree
    count = math.prod(shape)
    values = arrays[kind][begin : begin + count]
    if len(values) != count:
        raise ValueError("an array ends before its last value")
    return np.asarray(values.reshape(shape).astype(KINDS[kind]))
