"""A table with its description: columns as arrays, units of the deck, ready for CSV, Parquet and pandas."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.record.columns import Column
from mbla.results.record.quantity import COMPONENTS, Kind, Quantity, UnitKind, unit_text
from mbla.results.record.scene import Scene, Values, as_text, scene_of
from mbla.results.results import CaseResult, Results

if TYPE_CHECKING:
    import pandas

NO_EXTRA = "this needs an extra that is not installed: pip install 'mbla[tables]'"
DTYPES: dict[str, Any] = {"float": np.float64, "int": np.int64, "bool": np.bool_, "text": object}


@dataclass(frozen=True)
class TableColumn:
    """One column of a table.

    kind : float, nan where there is no value; int, masked where there is none; bool; text, empty where there is none
    of   : the values of the rows that one source makes
    """

    name: str
    kind: Kind
    unit: UnitKind
    words: str
    of: Callable[[Any], Values]

    def unit_in(self, units: Units) -> str:
        """The unit in a deck's units; empty for plain numbers and text."""
        return "" if self.unit == "1" else unit_text(self.unit, units)

    def header(self, units: Units) -> str:
        """``centroids_x [m]``; the name alone where there is no unit."""
        unit = self.unit_in(units)
        return f"{self.name} [{unit}]" if unit else self.name


def described(quantity: Quantity, of: Callable[[Any], Values]) -> tuple[TableColumn, ...]:
    """Columns of a quantity, one for each component of its values (n_rows, ...)."""
    return tuple(
        TableColumn(name, quantity.kind, unit, quantity.words, partial(_component, of, place))
        for place, name, unit in quantity.components()
    )


def _component(of: Callable[[Any], Values], place: tuple[int, ...], source: Any) -> Values:
    values = of(source)
    for row in place:
        values = values[:, row]
    return values


def _named(column: Column, of: Callable[[Any], Values]) -> tuple[TableColumn, ...]:
    """Columns of one of the record; numbers with names are text."""
    text = column.names is not None or column.quantity.kind == "text"
    return described(replace(column.quantity, kind="text") if text else column.quantity, of)


def scene_columns(columns: Sequence[Column], count: Callable[[Scene], int]) -> tuple[TableColumn, ...]:
    """Columns of the record as those of a table, after the name of the load case; ``count``: rows of a scene."""

    def case(scene: Scene) -> Values:
        return as_text([scene.case.load_case.name if scene.case else ""] * count(scene))

    own = (column for column in columns if "table" in column.files)
    found = (each for column in own for each in _named(column, partial(_values, column, count)))
    return (TableColumn("case", "text", "1", "load case", case), *found)


def _values(column: Column, count: Callable[[Scene], int], scene: Scene) -> Values:
    """Values of a column, (n_rows, ...); where there are none, nothing of its kind in every row."""
    quantity = column.quantity
    values: Values | None = column.of(scene)
    if values is not None:
        if column.names is not None:
            return as_text(list(column.names(scene)))[values.astype(np.int64)]
        return as_text(["; ".join(values)]) if quantity.dims == ("sentence",) else values
    shape = (count(scene), *(len(COMPONENTS[dim]) for dim in quantity.dims if dim in COMPONENTS))
    if column.names is not None or quantity.kind == "text":
        return np.full(shape, "", dtype=object)
    return (
        np.full(shape, np.nan) if quantity.kind == "float" else np.ma.array(np.zeros(shape, dtype=np.int64), mask=True)
    )


def list_columns(columns: Sequence[Column]) -> tuple[TableColumn, ...]:
    """The same of a table whose sources are lists of rows."""
    return tuple(each for column in columns for each in _named(column, partial(_listed, column)))


def _listed(column: Column, rows: Sequence[Any]) -> Values:
    """Values of a column, (n_rows, ...), row by row."""
    found: list[Any] = [column.of(row) for row in rows]
    if column.quantity.kind == "text":
        return as_text([str(value) for value in found])
    shape = (len(COMPONENTS[dim]) for dim in column.quantity.dims if dim in COMPONENTS)
    return np.array(found).reshape(len(rows), *shape)


def case_scenes(results: Results, cases: tuple[CaseResult, ...]) -> list[Scene]:
    """Sources of tables that have rows for every load case."""
    return [scene_of(results, case) for case in cases]


@dataclass(frozen=True)
class TableKind:
    """The description of a table.

    words   : what a row is
    columns : in their order
    sources : what makes its rows, part by part: results and the cases that are asked for -> sources of the columns
    """

    name: str
    words: str
    columns: tuple[TableColumn, ...]
    sources: Callable[[Results, tuple[CaseResult, ...]], Iterable[Any]]


@dataclass(frozen=True)
class Table:
    """Values of one table.

    values : an array for each column of ``kind``: float with nan, whole numbers masked where there is none, bool, text
             as objects
    """

    kind: TableKind
    values: tuple[Values, ...]
    units: Units

    def __len__(self) -> int:
        return len(self.values[0])

    def __getitem__(self, name: str) -> Values:
        """The values of a column by its name; KeyError if there is none."""
        for column, values in zip(self.kind.columns, self.values, strict=True):
            if column.name == name:
                return values
        raise KeyError(name)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns."""
        return tuple(column.name for column in self.kind.columns)

    @property
    def unit_of(self) -> dict[str, str]:
        """Units by column, those of the deck; empty for plain numbers and text."""
        return {column.name: column.unit_in(self.units) for column in self.kind.columns}

    @property
    def meaning_of(self) -> dict[str, str]:
        """What each column means, in words."""
        return {column.name: column.words for column in self.kind.columns}

    @property
    def header(self) -> tuple[str, ...]:
        """Names with units, ``centroids_x [m]``."""
        return tuple(column.header(self.units) for column in self.kind.columns)

    def to_pandas(self) -> pandas.DataFrame:
        """The table as a DataFrame with plain column names; ``attrs`` holds ``units`` and ``meanings`` by column.

        Raises
        ------
        UsageError
            pandas is not installed.
        """
        try:
            import pandas
        except ImportError as error:
            raise UsageError("extra-missing", f"tables for pandas: {NO_EXTRA}") from error
        frame = pandas.DataFrame(
            {
                column.name: _series(pandas, column, values)
                for column, values in zip(self.kind.columns, self.values, strict=True)
            }
        )
        frame.attrs = {"units": self.unit_of, "meanings": self.meaning_of}
        return frame


def table_of(kind: TableKind, results: Results, cases: tuple[CaseResult, ...]) -> Table:
    """The table of that kind for some cases of a result."""
    sources = list(kind.sources(results, cases))
    columns = [[column.of(source) for source in sources] for column in kind.columns]
    values = tuple(_joined(column, parts) for column, parts in zip(kind.columns, columns, strict=True))
    if len({len(column) for column in values}) > 1:
        raise AssertionError(f"columns of {kind.name} differ in length")
    return Table(kind, values, results.model.units)


def _joined(column: TableColumn, parts: list[Values]) -> Values:
    dtype = DTYPES[column.kind]
    joined = np.concatenate([np.zeros(0, dtype=dtype), *(np.ma.getdata(part).astype(dtype) for part in parts)])
    if column.kind != "int":
        return joined
    masks = [np.zeros(0, dtype=bool), *(np.ma.getmaskarray(part) for part in parts)]
    return np.ma.masked_array(joined, np.concatenate(masks))


def _series(pandas: Any, column: TableColumn, values: Values) -> Any:
    """Whole numbers of which some are missing as the nullable type of pandas; text as its own."""
    if column.kind != "int":
        return pandas.Series(values, dtype="str" if column.kind == "text" else values.dtype)
    mask = np.ma.getmaskarray(values)
    plain = np.ma.getdata(values)
    return pandas.Series(pandas.arrays.IntegerArray(plain, mask)) if mask.any() else pandas.Series(plain)
