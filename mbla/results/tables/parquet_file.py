"""A table as Parquet (only importer of pyarrow; it comes with the extra ``mbla[tables]``).

Names of columns are plain; each field carries ``unit`` and ``description`` as metadata. pandas finds them in ``attrs``
of the frame that it reads.
"""

from __future__ import annotations

import io
import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from mbla.errors import UsageError
from mbla.results.record.column import Values
from mbla.results.tables.table import NO_EXTRA, Table

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
            ParquetColumn(column.name, column.kind, column.unit_in(table.units), column.words, values)
            for column, values in zip(table.kind.columns, table.values, strict=True)
        ],
        about,
    )


def require_parquet() -> None:
    """UsageError where pyarrow is not installed."""
    try:
        import pyarrow  # noqa: F401
    except ImportError as error:
        raise UsageError("extra-missing", f"--parquet: {NO_EXTRA}") from error


def parquet_bytes(columns: Sequence[ParquetColumn], about: Mapping[str, str]) -> bytes:
    """The bytes of the file; nan stays nan in columns of floats, other values that are missing are null.

    about : where the table comes from, as metadata of the file

    Raises
    ------
    UsageError
        pyarrow is not installed.
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
