"""Groups of quantities, and how a quantity is declared: a function, or the field of a dataclass.

A group is what a renderer takes together: a group of the result file, a table, an object of the JSON record. It says
what its quantities belong to, the owner, and each is a function of that: its name is the name, its docstring what it
is, and what it returns says its type::

    @POINTS.quantity("table contacts", unit="force", dims="point axis")
    def global_forces(scene: Scene) -> FloatArray | None:
        "Contact force on body b in the axes of the deck."

Where the owner is a dataclass whose fields are the quantities, these are named with what they are; what is no field of
it is refused when the module is imported.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import Any, Generic, TypeVar

from mbla.results.quantities.quantity import UNVERIFIED, Kind, Quantity, UnitKind

Owner = TypeVar("Owner")
Function = TypeVar("Function", bound=Callable[..., Any])

DECLARED: list[Quantity] = []
"""every quantity of the result file and of tables, in the order of declaration"""
KINDS: dict[str, Kind] = {
    "float": "float",
    "FloatArray": "float",
    "list[float]": "float",
    "tuple[float, float]": "float",
    "int": "int",
    "IntArray": "int",
    "list[int]": "int",
    "bool": "bool",
    "BoolArray": "bool",
    "list[bool]": "bool",
    "ByteArray": "byte",
}
"""types of quantities by those of their values; others are texts"""


@dataclass(frozen=True)
class Field:
    """What a field of a dataclass is as a quantity; see :class:`Quantity`.

    dims      : without that of the rows where the owner is a list
    rule      : ``open``, ``index of DIMENSION`` or ``start of DIMENSION``
    part, unverified, table : None: as the group says; ``{}`` in a part stands for that of the group
    attribute : the field, where the quantity has another name
    """

    words: str
    dims: str = ""
    unit: UnitKind = "1"
    rule: str = ""
    part: str | None = None
    unverified: str | None = None
    proved: tuple[str, ...] = ()
    files: str = ""
    table: str | None = None
    attribute: str = ""
    names: Callable[[Any], Sequence[str]] | None = None


class Group(Generic[Owner]):
    """Quantities of one owner.

    owner : from what a renderer has: results or a scene; None where there is no such thing
    claim : the same for the result file, where that holds what was claimed and not only what is a result
    file  : group of the result file; empty: they are in none
    table : whose columns they are
    rows  : dimension of the rows, where the owner is a list and each quantity one of an item; None where it is no list
    asked : they belong to a load case whether it is solved or not
    part, unverified : of quantities that do not say it themselves
    """

    def __init__(
        self,
        owner: Callable[[Any], Owner | None],
        *,
        claim: Callable[[Any], Owner | None] | None = None,
        file: str = "",
        table: str = "",
        rows: str | None = None,
        asked: bool = False,
        part: str = "",
        unverified: str = "",
    ) -> None:
        self.owner, self.claim = owner, claim or owner
        self.file, self.table, self.rows, self.asked = file, table, rows, asked
        self.part, self.unverified = part, unverified
        self.quantities: list[Quantity] = []

    def quantity(
        self, files: str = "", *, like: Quantity | None = None, name: str = "", kind: Kind | None = None, **said: Any
    ) -> Callable[[Function], Function]:
        """Declare the function that follows; ``like``: it is what another one is; ``said``: see :class:`Field`.

        Its words are its docstring, where they are not given.
        """

        def declare(function: Function) -> Function:
            own = Field(**{"words": words_of(function), "files": files} | said)
            found = self._described(name or function.__name__, kind or _kind(function.__annotations__["return"]), own)
            if like is not None:
                found = replace(found, kind=like.kind, words=like.words, unit=like.unit, dims=like.dims)
            self._add(found, function)
            return function

        return declare

    def fields(self, record: type, **fields: Field) -> dict[str, Quantity]:
        """Declare fields of a dataclass, which the owner or each of its items is."""
        known = record.__dataclass_fields__  # type: ignore[attr-defined]
        found = {}
        for name, own in fields.items():
            attribute = own.attribute or name
            described = self._described(name, _kind(known[attribute].type), own)
            found[name] = self._add(replace(described, record=record, attribute=attribute), _getter(attribute))
        return found

    def _described(self, name: str, kind: Kind, said: Field) -> Quantity:
        rule, _, dimension = said.rule.partition(" of ")
        return Quantity(
            name=name,
            kind=kind,
            words=said.words,
            unit=said.unit,
            dims=(*([self.rows] if self.rows else []), *said.dims.split()),
            group=self.file,
            asked=self.asked,
            index_of=dimension if rule == "index" else "",
            start_of=dimension if rule == "start" else "",
            open=rule == "open",
            part=self.part if said.part is None else said.part.format(self.part),
            unverified=(UNVERIFIED | {"": ""})[self.unverified if said.unverified is None else said.unverified],
            proved=said.proved,
            table=(self.table if said.table is None else said.table) if said.files else "",
            files=tuple(said.files.split()),
            names=said.names,
        )

    def _add(self, described: Quantity, of: Callable[[Any], Any]) -> Quantity:
        if self.rows is None:
            value, stored = _of_one(self.owner, of), _of_one(self.claim, of)
        else:
            value, stored = of, _of_each(self.claim, of)
        quantity = replace(described, of=value, stored=stored)
        self.quantities.append(quantity)
        DECLARED.append(quantity)
        return quantity


def words_of(function: Callable[..., Any]) -> str:
    """A docstring as words: without the full stop, and without the capital letter but of what has several."""
    words = " ".join(str(function.__doc__).split()).removesuffix(".")
    return words if words[1:2].isupper() else words[:1].lower() + words[1:]


def _kind(annotation: str) -> Kind:
    return KINDS.get(annotation.removesuffix(" | None"), "text")


def _getter(attribute: str) -> Callable[[Any], Any]:
    return lambda owner: getattr(owner, attribute)


def _of_one(owner: Callable[[Any], Any], of: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def value(base: Any) -> Any:
        found = owner(base)
        return None if found is None else of(found)

    return value


def _of_each(owner: Callable[[Any], Any], of: Callable[[Any], Any]) -> Callable[[Any], Any]:
    def values(base: Any) -> Any:
        found = owner(base)
        return None if found is None else [of(row) for row in found]

    return values
