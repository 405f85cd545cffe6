"""The table of a sweep: one row for each point in the order of the design, whatever order they were solved in."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np

from mbla.arrays import IntArray
from mbla.deck.units import Units
from mbla.results.quantities.group import Field, Group
from mbla.results.record.scene import Values
from mbla.results.tables.table import unit_in
from mbla.sweeps.design.design import Design, DesignDimension
from mbla.sweeps.design.design import SweepColumn as SweepColumn
from mbla.sweeps.plan import Plain, PointOutcome
from mbla.sweeps.tables.display import sweep_html, sweep_lines


@dataclass(frozen=True)
class SweepTable:
    """Points of a sweep with their results.

    values     : an array (n_points,) for each column: float with nan, integers and truth values masked where there
                 is none, text as objects with None
    dimensions : axes of the design, slowest first
    position   : (n_points, n_dimensions) of each point along them, from 0
    levels     : of each column of the design, its values along its dimension, also those at which constraints leave no
                 point; not known of a table that is read back from its files
    samples, sampling : as of ``Design``
    """

    title: str
    columns: tuple[SweepColumn, ...]
    values: tuple[Values, ...]
    dimensions: tuple[DesignDimension, ...]
    position: IntArray
    levels: Mapping[str, Values] = field(default_factory=dict)
    samples: str = ""
    sampling: str = ""

    def __len__(self) -> int:
        return len(self.position)

    def __getitem__(self, name: str) -> Values:
        """The values of a column by its name; KeyError if there is none."""
        for column, values in zip(self.columns, self.values, strict=True):
            if column.name == name:
                return values
        raise KeyError(name)

    def __repr__(self) -> str:
        return "\n".join(sweep_lines(self))

    def _repr_html_(self) -> str:
        return sweep_html(self)

    def of_role(self, *roles: str) -> tuple[SweepColumn, ...]:
        """Columns with one of these roles."""
        return tuple(column for column in self.columns if column.role in roles)


def with_columns(table: SweepTable, columns: Sequence[tuple[SweepColumn, Values]]) -> SweepTable:
    """The table with more columns at its end."""
    return replace(
        table,
        columns=(*table.columns, *(column for column, _ in columns)),
        values=(*table.values, *(values for _, values in columns)),
    )


POINT = SweepColumn("point", "", "number of the point in the design, from 1", "int", "number")
OUTCOME = Group[PointOutcome](lambda outcome: outcome)
OUTCOME.fields(
    PointOutcome,
    state=Field("done: every load case has a verified answer; failed: one has none"),
    exit_code=Field("exit status that `mbla run` of the same deck ends with"),
    reason=Field("why it failed or has no load factor"),
    tries=Field("how often it was begun"),
    seconds=Field("time by the clock, of the last try", unit="time"),
)
STATE, *AFTER = (
    SweepColumn(each.name, unit_in(each, Units()), each.words, each.kind, each.name) for each in OUTCOME.quantities
)
"""columns before and after the results"""


def sweep_table(
    title: str,
    design: Design,
    columns: Sequence[SweepColumn],
    outcomes: Mapping[str, PointOutcome],
    keys: Sequence[str],
) -> SweepTable:
    """The table: number of the point, what the design sets, state, results, and how it ended.

    columns  : of results, as ``result_columns`` makes them
    outcomes : by key; points without one, which are not solved yet, have a row without values
    keys     : key of each point of the design, in their order; points with one key have one outcome
    """
    found = [outcomes.get(key) for key in keys]
    cells: list[tuple[SweepColumn, Sequence[Plain]]] = [(POINT, [point.number for point in design.points])]
    cells += [(column, [point.values[row] for point in design.points]) for row, column in enumerate(design.columns)]
    cells += [(STATE, _own(STATE, found))]
    cells += [(each, [None if one is None else one.results.get(each.name) for one in found]) for each in columns]
    cells += [(column, _own(column, found)) for column in AFTER]
    both = zip(design.columns, design.levels, strict=True)
    levels = {column.name: column_values(column.kind, values) for column, values in both}
    position = np.array([point.position for point in design.points], dtype=np.int64)
    return SweepTable(
        title=title,
        columns=tuple(column for column, _ in cells),
        values=tuple(column_values(column.kind, values) for column, values in cells),
        dimensions=design.dimensions,
        position=position.reshape(len(design.points), len(design.dimensions)),
        levels=levels,
        samples=design.samples,
        sampling=design.sampling,
    )


READ_CELL: Mapping[str, Callable[[str], Plain]] = {
    "float": float,
    "int": int,
    "bool": {"True": True, "False": False}.__getitem__,
    "text": str,
}
"""from a cell of a CSV file that is not empty to its value, by the kind of its column"""


def column_values(kind: str, values: Sequence[Plain]) -> Values:
    """Values of one column as an array: nan, masked or None where there is none.

    Lists, which decks take as vectors, are text.
    """
    if kind == "text":
        texts = np.empty(len(values), dtype=object)
        texts[:] = [None if value is None or value == "" else as_text(value) for value in values]
        return texts
    numbers: dict[str, type] = {"float": float, "int": int, "bool": bool}
    if kind == "float":
        return np.array([np.nan if value is None else value for value in values], dtype=np.float64)
    plain: Any = [numbers[kind](0 if value is None else value) for value in values]
    return np.ma.masked_array(np.array(plain, dtype=numbers[kind]), [value is None for value in values])


def as_text(value: Plain) -> str:
    """A value of a deck in one line: text as it is, others as YAML has them."""
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, list):
        return f"[{', '.join(as_text(item) for item in value)}]"
    if isinstance(value, dict):
        return f"{{{', '.join(f'{key}: {as_text(item)}' for key, item in value.items())}}}"
    return "null" if value is None else str(value)


def _own(column: SweepColumn, found: Sequence[PointOutcome | None]) -> list[Plain]:
    return [None if outcome is None else getattr(outcome, column.name) for outcome in found]
