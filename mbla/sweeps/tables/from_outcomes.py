"""From the outcomes of a sweep, in whatever order they came, to its table in the order of the design."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from mbla.results.tables.column import Values
from mbla.sweeps.design.design import Design, DesignColumn
from mbla.sweeps.outcome import Outcome
from mbla.sweeps.plan import Plain
from mbla.sweeps.tables.own_columns import AFTER, POINT, STATE
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable


def sweep_table(
    title: str,
    design: Design,
    columns: Sequence[SweepColumn],
    outcomes: Mapping[str, Outcome],
    keys: Sequence[str],
    *,
    unfinished: bool = False,
) -> SweepTable:
    """The table: number of the point, what the design sets, state, results, and how it ended.

    columns    : of results, as ``result_columns`` makes them
    keys       : key of each point of the design, in their order; points with one key have one outcome
    unfinished : points without an outcome have a row without values; KeyError for them otherwise
    """
    if len(keys) != len(design.points):
        raise AssertionError(f"{len(keys)} keys of {len(design.points)} points")
    found = [outcomes.get(key) if unfinished else outcomes[key] for key in keys]
    parts: list[tuple[SweepColumn, Values]] = [
        (POINT, column_values("int", [point.number for point in design.points])),
        *(
            (_of_design(column), column_values(column.kind, [point.values[row] for point in design.points]))
            for row, column in enumerate(design.columns)
        ),
        (STATE, _own("state", "text", found)),
        *(
            (column, column_values(column.kind, [None if o is None else o.results.get(column.name) for o in found]))
            for column in columns
        ),
        *((column, _own(column.name, column.kind, found)) for column in AFTER),
    ]
    names = [column.name for column, _ in parts]
    if twice := sorted({name for name in names if names.count(name) > 1}):
        raise AssertionError(f"columns of one name: {', '.join(twice)}")
    position = np.array([point.position for point in design.points], dtype=np.int64)
    return SweepTable(
        title=title,
        columns=tuple(column for column, _ in parts),
        values=tuple(values for _, values in parts),
        dimensions=design.dimensions,
        position=position.reshape(len(design.points), len(design.dimensions)),
        levels=_levels(design),
        samples=design.samples,
        sampling=design.sampling,
    )


def _levels(design: Design) -> dict[str, Values]:
    pairs = zip(design.columns, design.levels, strict=True)
    return {column.name: column_values(column.kind, values) for column, values in pairs}


def column_values(kind: str, values: Sequence[Plain]) -> Values:
    """Values of one column as an array: nan, masked or None where there is none.

    Lists, which decks take as vectors, are text.

    Raises
    ------
    ValueError
        a value is not of that kind
    """
    if kind == "text":
        texts = np.empty(len(values), dtype=object)
        texts[:] = [None if value is None or value == "" else as_text(value) for value in values]
        return texts
    numbers: dict[str, type] = {"float": float, "int": int, "bool": bool}
    for value in values:
        fits = isinstance(value, bool) == (kind == "bool") and isinstance(value, bool | int | float)
        if value is not None and not (fits and (kind != "int" or isinstance(value, int))):
            raise ValueError(f"{value!r} in a column of kind {kind}")
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


def _own(name: str, kind: str, found: Sequence[Outcome | None]) -> Values:
    return column_values(kind, [None if outcome is None else getattr(outcome, name) for outcome in found])


def _of_design(column: DesignColumn) -> SweepColumn:
    return SweepColumn(
        column.name, column.unit, column.words, column.kind, column.role, column.dimension, column.random
    )
