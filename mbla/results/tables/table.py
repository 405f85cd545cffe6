"""A table with its description: columns as arrays, units of the deck, ready for CSV, Parquet and pandas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.record.columns import Column
from mbla.results.record.quantity import COMPONENTS, Quantity, unit_text
from mbla.results.record.scene import Scene, Values, as_text
from mbla.results.results import CaseResult, Results

if TYPE_CHECKING:
    import pandas

NO_EXTRA = "this needs an extra that is not installed: pip install 'mbla[tables]'"
DTYPES: dict[str, Any] = {"float": np.float64, "int": np.int64, "bool": np.bool_, "text": object}


@dataclass(frozen=True)
class TableKind:
    """The description of a table.

    words  : what a row is
    record : its columns as the record has them
    parts  : what makes its rows, one after the other: results and the cases that are asked for -> parts
    values : of a column of the record in a part, (n_rows, ...)
    """

    name: str
    words: str
    record: tuple[Column, ...]
    parts: Callable[[Results, tuple[CaseResult, ...]], Iterable[Any]]
    values: Callable[[Column, Any], Values]

    @property
    def columns(self) -> tuple[Quantity, ...]:
        """One for each component of the values, in their order; numbers that have names are text.

        Floats are nan where there is no value, integers masked, text is empty.
        """
        return tuple(
            replace(column.quantity, name=name, unit=unit, kind="text" if column.names else column.quantity.kind)
            for column in self.record
            for _, name, unit in column.quantity.components()
        )


def values_in_scene(column: Column, scene: Scene, count: int) -> Values:
    """Values of a column in a scene, (count, ...); where there are none, nothing of its kind in every row."""
    quantity = column.quantity
    values: Values | str | None = column.of(scene)
    if isinstance(values, str):
        return as_text([values] * count)
    if values is not None and column.names is not None:
        return as_text(list(column.names(scene)))[values.astype(np.int64)]
    if values is not None:
        return as_text(["; ".join(values)]) if quantity.dims == ("sentence",) else values
    shape = (count, *(len(COMPONENTS[dim]) for dim in quantity.dims if dim in COMPONENTS))
    if column.names is not None or quantity.kind == "text":
        return np.full(shape, "", dtype=object)
    if quantity.kind == "float":
        return np.full(shape, np.nan)
    return np.ma.array(np.zeros(shape, dtype=np.int64), mask=True)


def values_of_rows(column: Column, rows: Sequence[Any]) -> Values:
    """Values of a column in a list of rows, (n_rows, ...)."""
    found: list[Any] = [column.of(row) for row in rows]
    if column.quantity.kind == "text":
        return as_text([str(value) for value in found])
    shape = (len(COMPONENTS[dim]) for dim in column.quantity.dims if dim in COMPONENTS)
    return np.array(found).reshape(len(rows), *shape)


@dataclass(frozen=True)
class Table:
    """Values of one table.

    values : an array for each column of ``kind``: float with nan, integers masked where there is none, bool, text
             as objects
    """

    kind: TableKind
    values: tuple[Values, ...]
    units: Units

    def __len__(self) -> int:
        return len(self.values[0])

    def __getitem__(self, name: str) -> Values:
        """The values of a column by its name; KeyError if there is none."""
        return dict(zip(self.unit_of, self.values, strict=True))[name]

    @property
    def unit_of(self) -> dict[str, str]:
        """Units by column, those of the deck; empty for plain numbers and text."""
        return {column.name: unit_in(column, self.units) for column in self.kind.columns}

    @property
    def meaning_of(self) -> dict[str, str]:
        """What each column means, in words."""
        return {column.name: column.words for column in self.kind.columns}

    @property
    def header(self) -> tuple[str, ...]:
        """Names with units, ``centroids_x [m]``."""
        return tuple(f"{name} [{unit}]" if unit else name for name, unit in self.unit_of.items())

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a DataFrame with plain column names; ``attrs`` holds ``units`` and ``meanings`` by column.

        Raises UsageError where pandas is not installed.
        """
        try:
            import pandas
        except ImportError as error:
            raise UsageError("extra-missing", f"tables for pandas: {NO_EXTRA}") from error
        columns = zip(self.kind.columns, self.values, strict=True)
        frame = pandas.DataFrame({column.name: _series(pandas, column, values) for column, values in columns})
        frame.attrs = {"units": self.unit_of, "meanings": self.meaning_of}
        return frame


def unit_in(column: Quantity, units: Units) -> str:
    """The unit of a column in a deck's units; empty for plain numbers and text."""
    return "" if column.unit == "1" else unit_text(column.unit, units)


def table_of(kind: TableKind, results: Results, cases: tuple[CaseResult, ...]) -> Table:
    """The table of that kind for some cases of a result; raises AssertionError for columns of unequal length."""
    parts, columns, values = list(kind.parts(results, cases)), iter(kind.columns), list[Values]()
    for column in kind.record:
        found = [kind.values(column, part) for part in parts]
        for place, *_ in column.quantity.components():
            values.append(_joined(next(columns), [_component(each, place) for each in found]))
    if len({len(column) for column in values}) > 1:
        raise AssertionError(f"columns of {kind.name} differ in length")
    return Table(kind, tuple(values), results.model.units)


def _component(values: Values, place: tuple[int, ...]) -> Values:
    for row in place:
        values = values[:, row]
    return values


def _joined(column: Quantity, parts: list[Values]) -> Values:
    dtype = DTYPES[column.kind]
    joined = np.concatenate([np.zeros(0, dtype=dtype), *(np.ma.getdata(part).astype(dtype) for part in parts)])
    if column.kind != "int":
        return joined
    masks = [np.zeros(0, dtype=bool), *(np.ma.getmaskarray(part) for part in parts)]
    return np.ma.masked_array(joined, np.concatenate(masks))


def _series(pandas: Any, column: Quantity, values: Values) -> Any:
    """Integers of which some are missing as the nullable type of pandas; text as its own."""
    if column.kind != "int":
        return pandas.Series(values, dtype="str" if column.kind == "text" else values.dtype)
    mask = np.ma.getmaskarray(values)
    plain = np.ma.getdata(values)
    return pandas.Series(pandas.arrays.IntegerArray(plain, mask)) if mask.any() else pandas.Series(plain)
