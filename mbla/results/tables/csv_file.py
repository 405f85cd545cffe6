"""A table as CSV: RFC 4180, UTF-8, units in the header, full precision; nothing but Python's own module is needed."""

from __future__ import annotations

import csv
import io
from typing import Any

import numpy as np

from mbla.results.tables.column import Column, Values
from mbla.results.tables.table import Table


def table_csv(table: Table) -> str:
    """The text of the file, lines end in CR LF.

    Numbers are written so that reading them gives the same bits; the decimal separator is a full stop. What does not
    exist (nan, masked, no text) is an empty cell, infinity is ``inf``, truth is ``True`` or ``False``.
    """
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerow(table.header)
    columns = [_cells(column, values) for column, values in zip(table.kind.columns, table.values, strict=True)]
    writer.writerows(zip(*columns, strict=True))
    return stream.getvalue()


def _cells(column: Column[Any], values: Values) -> list[Any]:
    """Python's own numbers, of which csv writes the shortest text that reads back to the same; None: empty."""
    if column.kind == "float":
        cells: list[Any] = values.tolist()
        for row in np.flatnonzero(np.isnan(values)).tolist():
            cells[row] = None
        return cells
    return list(values.tolist())
