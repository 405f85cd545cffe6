"""A table as CSV: RFC 4180, UTF-8, units in the header, full precision; nothing but Python's own module is needed."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any

import numpy as np

from mbla.results.record.column import Values
from mbla.results.tables.table import Table


def table_csv(table: Table) -> str:
    """The text of the file of an exported table; see ``csv_text``."""
    return csv_text(table.header, table.values)


def csv_text(header: Sequence[str], columns: Sequence[Values]) -> str:
    """Columns under their header, lines end in CR LF.

    Numbers are written so that reading them gives the same bits; the decimal separator is a full stop. What does not
    exist (nan, masked, no text) is an empty cell, infinity is ``inf``, truth is ``True`` or ``False``.
    """
    stream = io.StringIO(newline="")
    writer = csv.writer(stream, lineterminator="\r\n")
    writer.writerow(header)
    writer.writerows(zip(*(_cells(values) for values in columns), strict=True))
    return stream.getvalue()


def _cells(values: Values) -> list[Any]:
    """Python's own numbers, of which csv writes the shortest text that reads back to the same; None: empty."""
    cells: list[Any] = values.tolist()
    if values.dtype.kind == "f":
        for row in np.flatnonzero(np.isnan(values)).tolist():
            cells[row] = None
    return cells
