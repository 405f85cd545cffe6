"""Objects of the JSON record, and how a key of one is declared: a function of what the object tells.

Its name is the key, its docstring the meaning, and what it returns says the type: ``float | None`` is a number or null,
``list[str]`` a list of texts, ``dict[str, int]`` an object with a key for each that the deck names. What every item of
a list or object is, the declaration says; where it is an object itself, ``inside`` says which.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, Generic, TypeVar

from mbla.deck.units import Units
from mbla.results.quantities.group import words_of
from mbla.results.quantities.quantity import Quantity, UnitKind, unit_text
from mbla.results.record.json_values import as_json

Owner = TypeVar("Owner")
Function = TypeVar("Function", bound=Callable[..., Any])
KINDS = {"int": "integer", "float": "number", "bool": "boolean", "str": "string"}


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

    @property
    def item(self) -> tuple[str, str, str]:
        """Path, type with its unit as in a deck in m, N, kg, and meaning."""
        kind = self.kind if self.unit == "1" else f"{self.kind} [{unit_text(self.unit, Units())}]"
        return self.path, kind, self.words


@dataclass(frozen=True)
class Item:
    """What a field of a dataclass is as a key; ``null``: it may be."""

    words: str
    items: str = ""
    unit: UnitKind = "1"
    null: bool = False

    @property
    def of_items(self) -> tuple[str, ...]:
        """What its items are, where it has any."""
        return (self.items,) if self.items else ()


@dataclass(frozen=True)
class _Member:
    """A key with its value; ``annotation``: the type of that; ``missing``: where the value is empty, there is none."""

    annotation: str
    words: str
    of: Callable[[Any], Any]
    items: tuple[str, ...] = ()
    unit: UnitKind = "1"
    inside: Object[Any] | None = None
    missing: bool = False

    def value(self, owner: Any) -> Any:
        found = self.of(owner)
        if found is None or self.inside is None:
            return as_json(found)
        if isinstance(found, dict):
            return {name: self.inside.json(own) for name, own in found.items()}
        return [self.inside.json(own) for own in found] if _is_list(self.annotation) else self.inside.json(found)

    def keys(self, path: str) -> Iterator[Key]:
        """The key, those of its items, and those of the objects in it."""
        below = "[]" if _is_list(self.annotation) else ".*" if self.annotation.startswith("dict") else ""
        annotation = self.annotation
        if self.inside is not None:
            null = " | None" * annotation.endswith(" | None")
            annotation = {"[]": "list[object]", ".*": "dict[str, object]", "": "object"}[below] + null
        yield from _keys(path, annotation, (self.words, *self.items), self.unit)
        if self.inside is not None:
            yield from self.inside.keys(f"{path}{below}.")


def _keys(path: str, annotation: str, words: tuple[str, ...], unit: UnitKind) -> Iterator[Key]:
    null = "?" if annotation.endswith(" | None") else ""
    plain = "list[float]" if annotation.startswith("FloatArray") else annotation.removesuffix(" | None")
    outer = re.fullmatch(r"(list|tuple|dict)\[(?:str, )?(.+?)(?:, (?:\.\.\.|int))?\]", plain)
    if outer is None:
        kind = KINDS.get(plain, "object")
        yield Key(path, kind + null, words[0], unit if kind == "number" else "1")
        return
    is_object = outer[1] == "dict"
    yield Key(path, ("object" if is_object else "list") + null, words[0])
    yield from _keys(path + (".*" if is_object else "[]"), outer[2], words[1:], unit)


def _is_list(annotation: str) -> bool:
    return annotation.startswith(("list", "tuple"))


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


class Object(Generic[Owner]):
    """An object of the record.

    on_demand : values are found when they are asked for
    """

    def __init__(self, *, on_demand: bool = False) -> None:
        self._members: dict[str, _Member] = {}
        self._on_demand = on_demand

    def key(
        self,
        *items: str,
        name: str = "",
        unit: UnitKind = "1",
        inside: Object[Any] | None = None,
        missing: bool = False,
    ) -> Callable[[Function], Function]:
        """Declare the function that follows.

        items   : what each item is, and what each of its items is
        missing : the key, where its value is empty
        """

        def declare(function: Function) -> Function:
            kind, words = function.__annotations__["return"], words_of(function)
            self._members[name or function.__name__] = _Member(kind, words, function, items, unit, inside, missing)
            return function

        return declare

    def fields(self, record: type, **fields: Item) -> None:
        """Declare fields of a dataclass, which the owner is."""
        for name, item in fields.items():
            kind = record.__dataclass_fields__[name].type  # type: ignore[attr-defined]
            kind = KNOWN.get(kind, kind) + " | None" * item.null
            of = partial(lambda attribute, owner: getattr(owner, attribute), name)
            self._members[name] = _Member(kind, item.words, of, item.of_items, item.unit)

    def quantities(self, *quantities: Quantity, null: tuple[str, ...] = ()) -> None:
        """Declare quantities of result files or of tables of rows; ``null``: texts that are null where empty."""
        for each in quantities:
            annotation = {"text": "str"}.get(each.kind, each.kind) + " | None" * (each.open or each.name in null)
            of = partial(_or_null, each.of) if each.name in null else each.of
            if "axis" in each.dims:
                annotation = "FloatArray"
            items = ("a coordinate",) if "axis" in each.dims else ()
            self._members[each.name] = _Member(annotation, each.words, of, items, each.unit)

    def columns(self, quantities: Iterable[Quantity]) -> None:
        """Declare columns of a table as keys: null where there is no value, or an empty text."""
        for each in quantities:
            annotation, of = {"text": "str"}.get(each.kind, each.kind), each.of
            items: tuple[str, ...] = ()
            if each.dims == ("sentence",):
                annotation, items = "list[str]", ("a sentence",)
            elif each.dims:
                annotation, items = f"list[{annotation} | None] | None", (each.words,)
            elif each.kind in ("text", "float"):
                annotation += " | None"
                of = partial(_or_null, each.of) if each.kind == "text" else each.of
            self._members[each.name] = _Member(annotation, each.words, of, items, each.unit)

    def json(self, owner: Owner) -> Mapping[str, Any]:
        """The object that tells of its owner."""
        if self._on_demand:
            return OnDemand({name: partial(member.value, owner) for name, member in self._members.items()})
        values = {name: member.value(owner) for name, member in self._members.items()}
        return {name: value for name, value in values.items() if value or not self._members[name].missing}

    def keys(self, path: str = "") -> Iterator[Key]:
        """All keys of it, ``path`` before each."""
        for name, member in self._members.items():
            yield from member.keys(path + name)


KNOWN = {"IntArray": "list[int]", "tuple[int, int]": "list[int]", "ReductionOutcome": "str", "TieState": "str"}
"""types of fields as those of keys"""


def _or_null(of: Callable[[Any], Any], owner: Any) -> Any:
    return of(owner) or None
