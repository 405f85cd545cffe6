"""One column of an exported table as a record: name, type, unit, meaning, and what it is read from."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Generic, TypeAlias, TypeVar

import numpy as np

from mbla.deck.units import Units
from mbla.results.record.quantity import Kind, UnitKind, unit_text

Values: TypeAlias = "np.typing.NDArray[Any]"
Source = TypeVar("Source")


@dataclass(frozen=True)
class Column(Generic[Source]):
    """A column of a table, for any part of its rows.

    kind : float, nan where there is no value; int, masked where there is none; bool; text, empty where there is none
    of   : the values of the rows that one source makes
    """

    name: str
    kind: Kind
    unit: UnitKind
    words: str
    of: Callable[[Source], Values]

    def unit_in(self, units: Units) -> str:
        """The unit in a deck's units; empty for plain numbers and text."""
        return "" if self.unit == "1" else unit_text(self.unit, units)

    def header(self, units: Units) -> str:
        """``centroid_x [m]``; the name alone where there is no unit."""
        unit = self.unit_in(units)
        return f"{self.name} [{unit}]" if unit else self.name


def floats(name: str, unit: UnitKind, words: str, of: Callable[[Source], Values]) -> Column[Source]:
    """A column of floating-point numbers."""
    return Column(name, "float", unit, words, of)


def ints(name: str, words: str, of: Callable[[Source], Values]) -> Column[Source]:
    """A column of whole numbers."""
    return Column(name, "int", "1", words, of)


def bools(name: str, words: str, of: Callable[[Source], Values]) -> Column[Source]:
    """A column of truth values."""
    return Column(name, "bool", "1", words, of)


def texts(name: str, words: str, of: Callable[[Source], Values]) -> Column[Source]:
    """A column of text."""
    return Column(name, "text", "1", words, of)


def vector(name: str, unit: UnitKind, words: str, of: Callable[[Source], Values]) -> tuple[Column[Source], ...]:
    """Three columns ``NAME_x``, ``NAME_y``, ``NAME_z`` of vectors (n, 3)."""
    return tuple(
        Column(f"{name}_{axis}", "float", unit, f"{words}, along {axis}", _component(of, row))
        for row, axis in enumerate("xyz")
    )


def _component(of: Callable[[Source], Values], row: int) -> Callable[[Source], Values]:
    def component(source: Source) -> Values:
        return np.asarray(of(source)[:, row])

    return component


def as_text(values: Sequence[str]) -> Values:
    """Text as an array of objects."""
    array = np.empty(len(values), dtype=object)
    array[:] = list(values)
    return array


def whole(values: Values, missing: int = -1) -> Values:
    """Whole numbers, without those that stand for none."""
    return np.ma.masked_equal(values, missing)
