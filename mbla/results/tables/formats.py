"""Columns as CSV and as Parquet.

CSV is RFC 4180 in UTF-8, with units in the header and full precision; nothing but Python's own module is needed.
Parquet (only importer of pyarrow; it comes with the extra ``mbla[tables]``) has plain names; each field carries
``unit`` and ``description`` as metadata, which pandas finds in ``attrs`` of the frame that it reads.
"""

from __future__ import annotations

import csv
import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.errors import UsageError
from mbla.results.record.scene import Values
from mbla.results.tables.table import NO_EXTRA, Table, unit_in


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


COMPRESSION = "zstd"


@dataclass(frozen=True)
class ParquetColumn:
    """A column of such a file: ``kind``, ``unit`` and ``words`` as of a column of a table."""

    name: str
    kind: str
    unit: str
    words: str
    values: Values


def table_parquet(table: Table, about: dict[str, str]) -> bytes:
    """The bytes of the file of an exported table; see ``parquet_bytes``."""
    return parquet_bytes(
        [
            ParquetColumn(column.name, column.kind, unit_in(column, table.units), column.words, values)
            for column, values in zip(table.kind.columns, table.values, strict=True)
        ],
        about,
    )


def require_parquet() -> None:
    """Raises UsageError where pyarrow is not installed."""
    try:
        import pyarrow  # noqa: F401
    except ImportError as error:
        raise UsageError("extra-missing", f"--parquet: {NO_EXTRA}") from error


def parquet_bytes(columns: Sequence[ParquetColumn], about: Mapping[str, str]) -> bytes:
    """The bytes of the file; nan stays nan in columns of floats, other values that are missing are null.

    about : where the table comes from, as metadata of the file

    Raises UsageError where pyarrow is not installed.
    """
    require_parquet()
    import pyarrow
    from pyarrow import parquet

    types = {"float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_(), "text": pyarrow.string()}
    fields, arrays = [], []
    for column in columns:
        notes = {"unit": column.unit, "description": column.words}
        fields.append(pyarrow.field(column.name, types[column.kind], metadata=notes))
        mask = np.ma.getmaskarray(column.values) if isinstance(column.values, np.ma.MaskedArray) else None
        arrays.append(pyarrow.array(np.ma.getdata(column.values), type=types[column.kind], mask=mask))
    attributes = {
        "units": {column.name: column.unit for column in columns},
        "meanings": {column.name: column.words for column in columns},
    }
    schema = pyarrow.schema(fields, metadata={**about, "PANDAS_ATTRS": json.dumps(attributes)})
    stream = io.BytesIO()
    parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=schema), stream, compression=COMPRESSION)
    return stream.getvalue()
