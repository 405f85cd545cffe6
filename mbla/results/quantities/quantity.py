"""A quantity that a result holds or reports: name, type, unit, dimensions, meaning, and where it is written."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from itertools import product
from typing import Any, Literal, TypeAlias

from mbla.deck.units import Units

Kind = Literal["float", "int", "bool", "byte", "text", "object"]
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
    "frequency": "1/s",
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
    "spring": "{force}/{length}",
    "speed": "{length}/s",
    "acceleration": "{length}/s2",
    "spin": "rad/s",
    "speeds": "{length}/s; rad/s",
    "impulse": "{force} s",
    "angular_impulse": "{force} {length} s",
    "momentum": "{force} s; {force} {length} s",
}
"""kinds of units, in those of a deck"""
HALVES: dict[UnitKind, tuple[UnitKind, UnitKind]] = {
    "load": ("force", "moment"),
    "velocities": ("velocity", "rotation"),
    "motion": ("1", "per_length"),
    "displacement": ("length", "1"),
    "speeds": ("speed", "spin"),
    "momentum": ("impulse", "angular_impulse"),
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
    "claimed": "that no better answer was found than the status says, without associative flow that it does not fall "
    "before",
    "course": "how it was solved: scheme, programs, iterations, steps and ends of paths, sizes, reductions",
    "words": "reasons and remarks in words",
    "standing": "that it stands only by self-stress, or that it is doubtful whether it stands",
    "falls": "which block falls first",
    "modes": "of modes of vibration: which blocks joints do not hold",
    "history": "of elastic joints: the forces that they remember, and how stiff they are",
    "soil": "load factors of soil that slides with a dilatancy, beside the answer",
    "curve": "of a pushover: energies, errors of its load factors, where it jumps, which blocks fall without the rest, "
    "its end; areas, stiffness and history of contact points, and which body's face carries their frame",
    "time": "of a structure in time: what happens between the states that are kept",
}
"""kinds of statements by the words that declarations have for them, in the order in which they are told"""


@dataclass(frozen=True)
class Quantity:
    """A quantity.

    words    : its meaning
    dims     : names of its dimensions; none for a single value
    group    : of the result file, whose dataset it is; ``*`` stands for the name of a load case; empty: none
    asked    : of a load case, it is there whether that is solved or not
    index_of : for indices: the dimension they count (``body`` for blocks and then grounds)
    start_of : for offsets of ragged arrays: the dimension they divide
    open     : non-finite values are allowed: nan for "nothing to say", inf for "unlimited"; an empty text for nothing
    part     : quantities of one part are all there or all missing; empty: always there
    unverified : kind of statement, where the run alone can make it and ``mbla verify`` does not verify it
    proved   : texts that are verified all the same, as others prove them
    table    : whose column it is; empty: none
    files    : what the column stands in: ``table``, ``json``, and meshes by their kind
    names    : what tables say in the place of numbers, one for each
    record, attribute : the dataclass, and its field, that it is
    of       : its value, from what it belongs to; None where there is none
    stored   : the value in the result file, from what that group belongs to
    annotation : type of that value, as it is written
    items    : in the JSON record, what each item of the value is, and what each of the items of that is
    inside   : in the JSON record, the group of quantities that it is, or that each of its items is
    missing  : in the JSON record it is left out where its value is empty
    """

    name: str
    kind: Kind
    words: str
    unit: UnitKind = "1"
    dims: tuple[str, ...] = ()
    group: str = ""
    asked: bool = False
    index_of: str = ""
    start_of: str = ""
    open: bool = False
    part: str = ""
    unverified: str = ""
    proved: tuple[str, ...] = ()
    table: str = ""
    files: tuple[str, ...] = ()
    names: Callable[[Any], Sequence[str]] | None = field(default=None, repr=False)
    record: type | None = None
    attribute: str = ""
    of: Callable[[Any], Any] = field(default=lambda _: None, repr=False)
    stored: Callable[[Any], Any] = field(default=lambda _: None, repr=False)
    annotation: str = ""
    items: tuple[str, ...] = ()
    inside: Any = field(default=None, repr=False)
    missing: bool = False

    @property
    def path(self) -> str:
        """Group and name: the dataset of the result file."""
        return f"{self.group}/{self.name}"

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
