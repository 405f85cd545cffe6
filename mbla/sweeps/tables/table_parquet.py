"""The table of a sweep as Parquet."""

from __future__ import annotations

from mbla import __version__
from mbla.results.tables.parquet_file import ParquetColumn, parquet_bytes
from mbla.sweeps.tables.sweep_json import SweepRun
from mbla.sweeps.tables.sweep_table import SweepTable


def sweep_parquet(run: SweepRun, table: SweepTable) -> bytes:
    """The bytes of sweep.parquet, units as metadata; UsageError where pyarrow is not installed."""
    columns = [
        ParquetColumn(column.name, column.kind, column.unit, column.words, values)
        for column, values in zip(table.columns, table.values, strict=True)
    ]
    about = {"table": "sweep", "sweep": run.sweep, "deck": run.deck, "mbla": __version__, "created": run.created}
    return parquet_bytes(columns, about)
