"""Groups of quantities, and how a quantity is declared: a function, or a field or property of a dataclass.

A group is what a renderer takes together: a group of the result file, a table, an object of the JSON record. It says
what its quantities belong to, the owner, and each is a function of that: its name is the name, its docstring what it
is, and what it returns says its type::

    @POINTS.quantity("table contacts", unit="force", dims="point axis")
    def global_forces(scene: Scene) -> FloatArray | None:
        "Contact force on body b in the axes of the deck."

Where the owner is a dataclass whose fields or properties are the quantities, these are named with what they are; what
is none of it is refused when the module is imported, and so is a type that files and tables cannot hold.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence, Sized
from copy import copy
from dataclasses import dataclass
from operator import attrgetter
from typing import Any, Generic, Self, TypeVar

from mbla.arrays import FloatArray
from mbla.results.quantities.quantity import UNVERIFIED, Kind, Quantity, UnitKind

Owner = TypeVar("Owner")
Function = TypeVar("Function", bound=Callable[..., Any])

DECLARED: list[Quantity] = []
"""every quantity of the result file and of tables, in the order of declaration"""
KINDS: dict[str, Kind] = {
    **dict.fromkeys(("float", "FloatArray", "list[float]", "tuple[float, float]", "list[float | None]"), "float"),
    **dict.fromkeys(("int", "IntArray", "list[int]"), "int"),
    **dict.fromkeys(("bool", "BoolArray", "list[bool]"), "bool"),
    "ByteArray": "byte",
    **dict.fromkeys(("str", "list[str]", "tuple[str, ...]", "Sequence[str]", "Values", "Message"), "text"),
    **dict.fromkeys(
        (
            "Literal['notice', 'warning']",
            "Status",
            "Standing",
            "Side",
            "ReductionOutcome",
            "TieState",
            "CurveEnd",
            "HistoryEnd",
        ),
        "text",
    ),
}
"""kinds of quantities by the types of their values; those of the JSON record may have others"""


@dataclass(frozen=True)
class Field:
    """What a field or property of a dataclass is as a quantity; see :class:`Quantity`.

    dims      : without that of the rows where the owner is a list
    rule      : ``open``, ``index of DIMENSION`` or ``start of DIMENSION``
    part, unverified, files : None: as the group says; ``{}`` in a part stands for that of the group
    attribute : the field, where the quantity has another name
    by        : what is told of its value, where that is not all of it: ``count``, ``total``
    items, inside, missing : in the JSON record, see :class:`Quantity`
    """

    words: str
    dims: str = ""
    unit: UnitKind = "1"
    rule: str = ""
    part: str | None = None
    unverified: str | None = None
    proved: tuple[str, ...] = ()
    files: str | None = None
    attribute: str = ""
    by: Callable[[Any], Any] | None = None
    names: Callable[[Any], Sequence[str]] | None = None
    items: tuple[str, ...] = ()
    inside: Group[Any] | None = None
    missing: bool = False


class Group(Generic[Owner]):
    """Quantities of one owner.

    owner : from what a renderer has: results or a scene; None where there is no such thing
    claim : the same for the result file, where that holds what was claimed and not only what is a result
    file  : group of the result file; empty: they are in none
    table : whose columns they are
    rows  : dimension of the rows, where the owner is a list and each quantity one of an item; None where it is no list
    asked : they belong to a load case whether it is solved or not
    part, unverified, files : of quantities that do not say it themselves
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
        files: str = "",
    ) -> None:
        self.owner, self.claim = owner, claim or owner
        self.file, self.table, self.rows, self.asked = file, table, rows, asked
        self.part, self.unverified, self.files = part, unverified, files
        self.row: Callable[[Any], Any] | None = None
        self.quantities: list[Quantity] = []

    def of(self, owner: Callable[[Any], Any]) -> Self:
        """What declares quantities of another owner, which this one's leads to, among those of this group."""
        other = copy(self)
        if self.rows is None:
            other.owner, other.claim = _of_one(self.owner, owner), _of_one(self.claim, owner)
        else:
            other.row = owner
        return other

    def quantity(
        self, files: str | None = None, *, like: Quantity | None = None, name: str = "", **said: Any
    ) -> Callable[[Function], Function]:
        """Declare the function that follows; ``like``: it is what another one is; ``said``: see :class:`Field`.

        Its words are its docstring, where they are not given.
        """

        def declare(function: Function) -> Function:
            what: dict[str, Any] = {"words": words_of(function), "files": files}
            if like is not None:
                what |= {"words": like.words, "unit": like.unit, "dims": " ".join(like.dims)}
            self._add(name or function.__name__, function.__annotations__["return"], Field(**what | said), function)
            return function

        return declare

    def fields(self, record: type, **fields: Field) -> dict[str, Quantity]:
        """Declare fields and properties of a dataclass, which the owner or each of its items is."""
        return {name: self._field(record, name, own) for name, own in fields.items()}

    def _field(self, record: type, name: str, said: Field) -> Quantity:
        attribute, by = said.attribute or name, said.by
        known = record.__dataclass_fields__.get(attribute)  # type: ignore[attr-defined]
        if by is not None:
            return self._add(name, by.__annotations__["return"], said, lambda of: by(getattr(of, attribute)))
        kind = vars(record)[attribute].fget.__annotations__["return"] if known is None else known.type
        return self._add(name, kind, said, attrgetter(attribute), record=record, attribute=attribute)

    def _add(self, name: str, annotation: str, said: Field, of: Callable[[Any], Any], **more: Any) -> Quantity:
        rule, _, dimension = said.rule.partition(" of ")
        one = self.rows is None
        of = of if self.row is None else _of_one(self.row, of)
        unverified = self.unverified if said.unverified is None else said.unverified
        files = self.files if said.files is None else said.files
        quantity = Quantity(
            name,
            KINDS.get(annotation.removesuffix(" | None"), "object"),
            said.words,
            said.unit,
            dims=(*([self.rows] if self.rows else []), *said.dims.split()),
            group=self.file,
            asked=self.asked,
            index_of=dimension if rule == "index" else "",
            start_of=dimension if rule == "start" else "",
            open=rule == "open",
            part=self.part if said.part is None else said.part.format(self.part),
            unverified=UNVERIFIED[unverified] if unverified else "",
            proved=said.proved,
            table=self.table if files else "",
            files=tuple(files.split()),
            names=said.names,
            of=_of_one(self.owner, of) if one else of,
            stored=_of_one(self.claim, of) if one else _of_each(self.claim, of),
            annotation=annotation,
            items=said.items,
            inside=said.inside,
            missing=said.missing,
            **more,
        )
        self.quantities.append(quantity)
        if quantity.group or quantity.table:
            if quantity.kind == "object":
                raise TypeError(f"{name}: {annotation} is no type of what files and tables hold")
            DECLARED.append(quantity)
        return quantity


def count(items: Sized) -> int:
    """How many there are."""
    return len(items)


def total(values: FloatArray) -> float:
    """All of them together."""
    return float(values.sum())


def words_of(function: Callable[..., Any]) -> str:
    """A docstring as words: without the full stop, and without the capital letter but of what has several."""
    words = " ".join(str(function.__doc__).split()).removesuffix(".")
    return words if words[1:2].isupper() else words[:1].lower() + words[1:]


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
