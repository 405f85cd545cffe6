"""A table as Parquet (only importer of pyarrow; it comes with the extra ``mbla[tables]``).

Names of columns are plain; each field carries ``unit`` and ``description`` as metadata. pandas finds them in ``attrs``
of the frame that it reads.
"""

from __future__ import annotations

import io
import json

import numpy as np

from mbla.errors import UsageError
from mbla.results.tables.table import NO_EXTRA, Table

COMPRESSION = "zstd"


def table_parquet(table: Table, about: dict[str, str]) -> bytes:
    """The bytes of the file; nan stays nan in columns of floats, whole numbers that are missing are null.

    about : where the table comes from, as metadata of the file

    Raises
    ------
    UsageError
        pyarrow is not installed.
    """
    try:
        import pyarrow
        from pyarrow import parquet
    except ImportError as error:
        raise UsageError(f"--parquet: {NO_EXTRA}") from error
    types = {"float": pyarrow.float64(), "int": pyarrow.int64(), "bool": pyarrow.bool_(), "text": pyarrow.string()}
    fields, arrays = [], []
    for column, values in zip(table.kind.columns, table.values, strict=True):
        notes = {"unit": column.unit_in(table.units), "description": column.words}
        fields.append(pyarrow.field(column.name, types[column.kind], metadata=notes))
        mask = np.ma.getmaskarray(values) if column.kind == "int" else None
        arrays.append(pyarrow.array(np.ma.getdata(values), type=types[column.kind], mask=mask))
    attributes = {"units": table.unit_of, "meanings": table.meaning_of}
    schema = pyarrow.schema(fields, metadata={**about, "PANDAS_ATTRS": json.dumps(attributes)})
    stream = io.BytesIO()
    parquet.write_table(pyarrow.Table.from_arrays(arrays, schema=schema), stream, compression=COMPRESSION)
    return stream.getvalue()
