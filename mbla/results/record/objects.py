"""Objects of the JSON record: quantities as keys with their values, and what each key is.

An object is a group of quantities: one that result file or tables have too, or one of the record alone. The type of a
key is that of its quantity: ``float | None`` is a number or null, ``list[str]`` a list of texts, ``dict[str, int]`` an
object with a key for each that the deck names. What every item of a list or object is, the declaration says; where it
is an object itself, ``inside`` says which.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeVar

from mbla.results.quantities.group import KINDS, Function, Group
from mbla.results.quantities.quantity import Quantity, UnitKind
from mbla.results.record.json_values import as_json

Owner = TypeVar("Owner")


def itself(of: Any) -> Any:
    """The owner that is what there is."""
    return of


TYPES = {"int": "integer", "float": "number", "bool": "boolean", "text": "string"}
LISTS = {"FloatArray": "list[float]", "IntArray": "list[int]"}
ITEMS = {
    "axis": "a coordinate",
    "vector": "a component",
    "sentence": "a sentence",
    "cluster": "a cluster",
    "interface": "number of an interface, from 0",
    "mode": "a mode",
}
"""what is along these dimensions, one by one; along others the same as along with them"""


@dataclass(frozen=True)
class Key:
    """One key.

    path : with full stops between keys; ``[]`` is each item of a list, ``*`` each key that the deck names
    kind : integer, number, string, boolean, object or list, with ``?`` where it may be null
    unit : of its number or numbers
    """

    path: str
    kind: str
    words: str
    unit: UnitKind = "1"


class OnDemand(Mapping[str, Any]):
    """Keys are known, each value is worked out where it is asked for."""

    def __init__(self, makers: Mapping[str, Callable[[], Any]]) -> None:
        self._makers = dict(makers)

    def __getitem__(self, key: str) -> Any:
        """The value; KeyError where there is no such key."""
        return self._makers[key]()

    def __contains__(self, key: object) -> bool:
        return key in self._makers

    def __iter__(self) -> Iterator[str]:
        return iter(self._makers)

    def __len__(self) -> int:
        return len(self._makers)


class Object(Group[Owner]):
    """An object of the record that is no group of the result file and no table.

    quantities : of others that it begins with
    owner      : what its own belong to, of what it tells of
    on_demand  : values are found when they are asked for
    """

    def __init__(
        self, *quantities: Quantity, owner: Callable[[Any], Owner | None] = itself, on_demand: bool = False
    ) -> None:
        super().__init__(owner)
        self.quantities.extend(quantities)
        self.on_demand = on_demand

    def key(self, *items: str, **said: Any) -> Callable[[Function], Function]:
        """Declare the function that follows; ``items``: what each item is, and what each of its items is."""
        return self.quantity(items=items, **said)

    def holds(self, name: str, group: Group[Any], words: str, *items: str) -> None:
        """Declare a group as a key: a list where it has rows, else null where there may be no such thing."""
        of = partial(_owner if group.rows is None else _rows, group)
        kind = "object" if group.owner is itself else "object | None" if group.rows is None else "list[object]"
        self.quantities.append(Quantity(name, "object", words, annotation=kind, items=items, inside=group, of=of))


def _rows(group: Group[Any], base: Any) -> list[Any]:
    return list(group.owner(base) or ())


def _owner(group: Group[Any], base: Any) -> Any:
    return None if group.owner(base) is None else base


def json_of(group: Group[Any], owner: Any) -> Mapping[str, Any]:
    """The object that tells of its owner."""
    if isinstance(group, Object) and group.on_demand:
        return OnDemand({each.name: partial(_value, each, owner) for each in group.quantities})
    values = [(each, _value(each, owner)) for each in group.quantities]
    return {each.name: value for each, value in values if value or not each.missing}


def _value(quantity: Quantity, owner: Any) -> Any:
    found, inside = quantity.of(owner), quantity.inside
    if found is None or inside is None:
        return None if quantity.open and isinstance(found, str) and not found else as_json(found)
    if isinstance(found, dict):
        return {name: json_of(inside, own) for name, own in found.items()}
    return [json_of(inside, own) for own in found] if _is_list(quantity.annotation) else json_of(inside, found)


def _is_list(annotation: str) -> bool:
    return annotation.startswith(("list", "tuple"))


def keys_of(group: Group[Any], path: str = "") -> Iterator[Key]:
    """All keys of an object, ``path`` before each, with those of their items and of the objects in them."""
    for each in group.quantities:
        annotation = each.annotation if not each.open else each.annotation.removesuffix(" | None") + " | None"
        below = "[]" if _is_list(annotation) else ".*" if annotation.startswith("dict") else ""
        if each.inside is not None:
            null = " | None" * annotation.endswith(" | None")
            annotation = {"[]": "list[object]", ".*": "dict[str, object]", "": "object"}[below] + null
        words = each.items or tuple(ITEMS.get(dim, each.words) for dim in each.dims[-1:])
        yield from _keys(path + each.name, annotation, (each.words, *words), each.unit)
        if each.inside is not None:
            yield from keys_of(each.inside, f"{path}{each.name}{below}.")


def _keys(path: str, annotation: str, words: tuple[str, ...], unit: UnitKind) -> Iterator[Key]:
    plain = annotation.removesuffix(" | None")
    null = "?" if plain != annotation else ""
    outer = re.fullmatch(
        r"(list|tuple|dict|Sequence)\[(?:(?<=dict\[)str, )?(.+?)(?:, (?:\.\.\.|\w+))?\]", LISTS.get(plain, plain)
    )
    if outer is None:
        kind = TYPES.get(KINDS.get(plain, ""), "object")
        yield Key(path, kind + null, words[0], unit if kind == "number" else "1")
        return
    is_object = outer[1] == "dict"
    yield Key(path, ("object" if is_object else "list") + null, words[0])
    yield from _keys(path + (".*" if is_object else "[]"), outer[2], words[1:], unit)
