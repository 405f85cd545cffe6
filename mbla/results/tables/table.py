"""A table with its description: columns as arrays, units of the deck, ready for CSV, Parquet and pandas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.quantities.quantity import COMPONENTS, Quantity, unit_text
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
    record : the quantities that are its columns
    parts  : what makes its rows, one after the other: results and the cases that are asked for -> parts
    values : of a quantity in a part, (n_rows, ...)
    """

    name: str
    words: str
    record: tuple[Quantity, ...]
    parts: Callable[[Results, tuple[CaseResult, ...]], Iterable[Any]]
    values: Callable[[Quantity, Any], Values]

    @property
    def columns(self) -> tuple[Quantity, ...]:
        """One for each component of the values, in their order; numbers that have names are text.

        Floats are nan where there is no value, integers masked, text is empty.
        """
        return tuple(
            replace(quantity, name=name, unit=unit, kind="text" if quantity.names else quantity.kind)
            for quantity in self.record
            for _, name, unit in quantity.components()
        )


def values_of_case(quantity: Quantity, scene: Scene) -> Values:
    """The value of a quantity in a scene as that of the only row, (1, ...)."""
    value = quantity.of(scene)
    if value is None:
        return _nothing(quantity, 1)
    if quantity.dims == ("sentence",):
        return as_text(["; ".join(value)])
    if quantity.names is not None:
        return as_text([quantity.names(scene)[value]])
    return as_text([str(value)]) if isinstance(value, str) else np.array([value])


def values_in_scene(quantity: Quantity, scene: Scene, count: int) -> Values:
    """Values of a quantity in a scene, (count, ...); where there are none, nothing of its kind in every row."""
    values: Values | None = quantity.of(scene)
    if values is None:
        return _nothing(quantity, count)
    return values if quantity.names is None else as_text(list(quantity.names(scene)))[values.astype(np.int64)]


def _nothing(quantity: Quantity, count: int) -> Values:
    shape = (count, *(len(COMPONENTS[dim]) for dim in quantity.dims if dim in COMPONENTS))
    if quantity.names is not None or quantity.kind == "text":
        return np.full(shape, "", dtype=object)
    if quantity.kind == "float":
        return np.full(shape, np.nan)
    return np.ma.array(np.zeros(shape, dtype=np.int64), mask=True)


def values_of_rows(quantity: Quantity, rows: Sequence[Any]) -> Values:
    """Values of a quantity in a list of rows, (n_rows, ...)."""
    found: list[Any] = [quantity.of(row) for row in rows]
    if quantity.kind == "text":
        return as_text([str(value) for value in found])
    shape = (len(COMPONENTS[dim]) for dim in quantity.dims if dim in COMPONENTS)
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
    for quantity in kind.record:
        found = [kind.values(quantity, part) for part in parts]
        for place, *_ in quantity.components():
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
