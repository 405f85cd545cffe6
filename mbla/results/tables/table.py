"""A table with its description: columns as arrays, units of the deck, ready for CSV, Parquet and pandas."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.results import CaseResult, Results
from mbla.results.tables.column import Column, Values

if TYPE_CHECKING:
    import pandas

NO_EXTRA = "this needs an extra that is not installed: pip install 'mbla[tables]'"
DTYPES: dict[str, Any] = {"float": np.float64, "int": np.int64, "bool": np.bool_, "text": object}


@dataclass(frozen=True)
class TableKind:
    """The description of a table.

    words   : what a row is
    columns : in their order
    sources : what makes its rows, part by part: results and the cases that are asked for -> sources of the columns
    """

    name: str
    words: str
    columns: tuple[Column[Any], ...]
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
        """Names with units, ``centroid_x [m]``."""
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


def _joined(column: Column[Any], parts: list[Values]) -> Values:
    dtype = DTYPES[column.kind]
    joined = np.concatenate([np.zeros(0, dtype=dtype), *(np.ma.getdata(part).astype(dtype) for part in parts)])
    if column.kind != "int":
        return joined
    masks = [np.zeros(0, dtype=bool), *(np.ma.getmaskarray(part) for part in parts)]
    return np.ma.masked_array(joined, np.concatenate(masks))


def _series(pandas: Any, column: Column[Any], values: Values) -> Any:
    """Whole numbers of which some are missing as the nullable type of pandas; text as its own."""
    if column.kind != "int":
        return pandas.Series(values, dtype="str" if column.kind == "text" else values.dtype)
    mask = np.ma.getmaskarray(values)
    plain = np.ma.getdata(values)
    return pandas.Series(pandas.arrays.IntegerArray(plain, mask)) if mask.any() else pandas.Series(plain)
