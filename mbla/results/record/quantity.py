"""One quantity of a result: its name, type, shape, unit and meaning, the same in every format.

The part of the record that the result file holds, from which everything else follows, is in the rows of ``stored.csv``.
A row has the fields of a :class:`Quantity`; ``rule`` is ``index of DIMENSION``, ``start of DIMENSION`` or ``open``.
Rows of ``ANSWER`` stand for one of each answer, ``WHOSE`` for what that is.
"""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import product
from typing import Literal, TypeAlias

from mbla.deck.units import Units
from mbla.solution.solution import PROVED_STANDING

Kind = Literal["float", "int", "bool", "byte", "text"]
UnitKind: TypeAlias = str
UNITS: dict[UnitKind, str] = {
    "1": "1",
    "time": "s",
    "length": "{length}",
    "area": "{length}2",
    "volume": "{length}3",
    "density": "{mass}/{length}3",
    "mass": "{mass}",
    "degree": "degree",
    "radian": "rad",
    "stress": "{force}/{length}2",
    "bedding": "{force}/{length}3",
    "force": "{force}",
    "moment": "{force} {length}",
    "per_length": "1/{length}",
    "load": "{force}; {force} {length}",
    "velocity": "1/{force}",
    "rotation": "1/({force} {length})",
    "velocities": "1/{force}; 1/({force} {length})",
    "motion": "1; 1/{length}",
    "displacement": "{length}; 1",
    "stiffness": "{force}2",
}
"""kinds of units, in those of a deck"""
HALVES: dict[UnitKind, tuple[UnitKind, UnitKind]] = {
    "load": ("force", "moment"),
    "velocities": ("velocity", "rotation"),
    "motion": ("1", "per_length"),
    "displacement": ("length", "1"),
}
"""units of which the first three components have one, the last three the other"""
COMPONENTS = {
    "axis": ("x", "y", "z"),
    "direction": ("N", "T1", "T2"),
    "component": ("x", "y", "z", "rx", "ry", "rz"),
    "pair": ("a", "b"),
    "end": ("lower", "upper"),
}
"""what is along these dimensions, as columns of tables are named: ``contact_forces_N``"""

NOT_VERIFIED = "not verified: {}"
"""attribute of datasets that ``mbla verify`` takes as the run reported them"""
UNVERIFIED = {
    "versions": "versions and date",
    "times": "times",
    "files": "names of files",
    "words": "reasons and remarks in words",
    "course": "how it was solved: scheme, programs, iterations, steps and ends of paths, sizes, reductions",
    "curve": "of a pushover: errors of its load factors, where it jumps, which blocks fall without the rest, its end",
    "claimed": "that no better answer was found than the status says, without associative flow that it does not fall "
    "before",
    "standing": "that it stands only by self-stress, or that it is doubtful whether it stands",
    "falls": "which block falls first",
}
"""kinds of statements by the words that ``stored.csv`` has for them"""


@dataclass(frozen=True)
class Quantity:
    """A quantity.

    words    : its meaning
    dims     : names of its dimensions; none for a single value
    place    : what it belongs to: the group of the result file; ``*`` stands for the name of a load case
    index_of : for indices: the dimension they count (``body`` for blocks and then grounds)
    start_of : for offsets of ragged arrays: the dimension they divide
    open     : non-finite values are allowed: nan for "nothing to say", inf for "unlimited"
    part     : quantities of one part are all there or all missing; empty: always there
    unverified : kind of statement, where the run alone can make it and ``mbla verify`` does not verify it
    proved   : texts that are verified all the same, as others prove them
    """

    name: str
    kind: Kind
    words: str
    unit: UnitKind = "1"
    dims: tuple[str, ...] = ()
    place: str = ""
    index_of: str = ""
    start_of: str = ""
    open: bool = False
    part: str = ""
    unverified: str = ""
    proved: tuple[str, ...] = ()

    @property
    def path(self) -> str:
        """Place and name: the dataset of the result file."""
        return f"{self.place}/{self.name}"

    def unproved(self, value: object) -> str:
        """``unverified`` of a value, empty where that is verified."""
        return "" if isinstance(value, str) and value in self.proved else self.unverified

    def components(self) -> Iterator[tuple[tuple[int, ...], str, UnitKind]]:
        """Place, name and unit of each of the columns of one item: ``contact_forces_N`` and so on."""
        along = [COMPONENTS[dim] for dim in self.dims if dim in COMPONENTS]
        for place in product(*(range(len(names)) for names in along)):
            parts = (names[row] for names, row in zip(along, place, strict=True))
            halves = HALVES.get(self.unit, (self.unit, self.unit)) if along else (self.unit,)
            yield place, "_".join([self.name, *parts]), halves[place[-1] // 3] if place else self.unit


def real(name: str, words: str, unit: UnitKind = "1", dims: str = "") -> Quantity:
    """Floating-point numbers that do."""
    return Quantity(name, "float", words, unit, tuple(dims.split()))


def integer(name: str, words: str, dims: str = "") -> Quantity:
    """Integers that do."""
    return Quantity(name, "int", words, dims=tuple(dims.split()))


def flag(name: str, words: str, dims: str = "") -> Quantity:
    """Truth that does, 0 or 1."""
    return Quantity(name, "bool", words, dims=tuple(dims.split()))


def unit_text(kind: UnitKind, units: Units) -> str:
    """The unit in those of a deck."""
    return UNITS[kind].format(length=units.length, force=units.force, mass=units.mass)


ANSWERS = {
    "mechanics": ("", "by the deck's flow rule"),
    "associative": ("/associative", "by the associative flow rule, where that is not the deck's"),
    "least": ("/least", "the least of the states of rigid joints that a search found"),
    "torsion": ("/torsion", "on the path of elastic joints with torsion of uniform pressure"),
    "level": ("/level", "of the level table with the load across, by the associative flow rule"),
}
"""answers of a solution: group below the load case, and whose forces and velocities they are"""
PROVED = {"cases/*/standing/verdict": tuple(verdict.value for verdict in PROVED_STANDING)}
"""texts that are verified although others of their quantity are not"""


@cache
def rows_of(name: str) -> tuple[dict[str, str], ...]:
    """Rows of a table of the record by the names of its columns."""
    text = files("mbla.results.record").joinpath(name).read_text(encoding="utf-8")
    return tuple(csv.DictReader(text.splitlines()))


def _stored() -> Iterator[Quantity]:
    rows = list(rows_of("stored.csv"))
    own = [row for row in rows if "ANSWER" in row["place"]]
    first = rows.index(own[0])
    for row in (row for row in rows[:first] if row not in own):
        yield quantity_of(row)
    for answer, (group, whose) in ANSWERS.items():
        for row in own:
            part, words = row["part"].replace("ANSWER", answer), row["words"].replace("WHOSE", whose)
            yield quantity_of(row | {"place": f"cases/*{group}", "part": part, "words": words})
    for row in (row for row in rows[first:] if row not in own):
        yield quantity_of(row)


def quantity_of(row: dict[str, str]) -> Quantity:
    """A quantity from a row of a table of the record."""
    kind, _, dimension = row.get("rule", "").partition(" of ")
    return Quantity(
        name=row["name"],
        kind=row["kind"],  # type: ignore[arg-type]
        words=row["words"],
        unit=row["unit"] or "1",
        dims=tuple(row["dims"].split()),
        place=row["place"],
        index_of=dimension if kind == "index" else "",
        start_of=dimension if kind == "start" else "",
        open=kind == "open",
        part=row.get("part", ""),
        unverified=UNVERIFIED.get(row.get("unverified", ""), ""),
        proved=PROVED.get(f"{row['place']}/{row['name']}", ()),
    )


STORED: tuple[Quantity, ...] = tuple(_stored())
"""in the order of writing"""
STORED_BY_PATH: dict[str, Quantity] = {each.path: each for each in STORED}


def stored(kind: type, place: str) -> tuple[str, ...]:
    """Fields of a dataclass that the result file holds at a place, by the name that both have."""
    names = kind.__dataclass_fields__  # type: ignore[attr-defined]
    return tuple(name for name in names if f"{place}/{name}" in STORED_BY_PATH)
