"""The files that hold the table of a sweep: all of them appear together, or the earlier ones stay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from mbla import __version__
from mbla.results.files import OutputFolder
from mbla.results.tables.formats import ParquetColumn, csv_text, parquet_bytes, require_parquet
from mbla.sweeps.fragility import Fragility, fragility_csv, fragility_json
from mbla.sweeps.tables.read_table import CSV, JSON
from mbla.sweeps.tables.sweep_json import SweepRun, record_text, sweep_json
from mbla.sweeps.tables.sweep_table import SweepTable
from mbla.sweeps.tables.table_hdf5 import sweep_hdf5


def sweep_parquet(run: SweepRun, table: SweepTable) -> bytes:
    """The bytes of sweep.parquet, units as metadata; UsageError where pyarrow is not installed."""
    columns = [
        ParquetColumn(column.name, column.kind, column.unit, column.words, values)
        for column, values in zip(table.columns, table.values, strict=True)
    ]
    about = {"table": "sweep", "sweep": run.sweep, "deck": run.deck, "mbla": __version__, "created": run.created}
    return parquet_bytes(columns, about)


def sweep_csv(table: SweepTable) -> str:
    """The text of sweep.csv: units in the header, a row for each point; see ``csv_text`` for the cells."""
    return csv_text([column.header for column in table.columns], table.values)


PARQUET, HDF5, FRAGILITY = "sweep.parquet", "sweep.h5", "sweep_fragility.csv"


@dataclass(frozen=True)
class TableFiles:
    """What is written beside sweep.csv and sweep.json.

    others : files of the sweep that others write, listed in the record
    """

    parquet: bool = False
    hdf5: bool = False
    others: tuple[str, ...] = ()


def table_names(files: TableFiles, fragility: bool = False) -> tuple[str, ...]:
    """Names of the files that ``write_tables`` will write, for ``OutputFolder.refuse`` before the work."""
    asked = ((PARQUET, files.parquet), (HDF5, files.hdf5), (FRAGILITY, fragility))
    return (CSV, JSON, *(name for name, wanted in asked if wanted))


def refuse_tables(folder: Path, files: TableFiles, *, replace: bool, fragility: bool = False) -> None:
    """What ``write_tables`` would refuse, now and not after the work.

    Raises
    ------
    FileError
        files of an earlier table are in the way
    UsageError
        what Parquet needs is not installed
    """
    if files.parquet:
        require_parquet()
    OutputFolder(folder, "sweep", replace, beside=True).refuse(*table_names(files, fragility))


def write_tables(
    folder: Path,
    force: bool,
    run: SweepRun,
    table: SweepTable,
    files: TableFiles,
    fragility: Sequence[Fragility] = (),
) -> dict[str, Any]:
    """Write the files; the record, as in sweep.json.

    Raises
    ------
    FileError
        a file is there already and ``force`` is not set, or cannot be written
    UsageError
        what Parquet needs is not installed
    """
    names = table_names(files, bool(fragility))
    record = sweep_json(run, table, fragility_json(fragility), sorted({*names, *files.others}))
    with OutputFolder(folder, "sweep", force, beside=True) as out:
        out.write_text(CSV, sweep_csv(table))
        out.write_text(JSON, record_text(record))
        if files.parquet:
            out.write_bytes(PARQUET, sweep_parquet(run, table))
        if files.hdf5:
            out.write_bytes(HDF5, sweep_hdf5(run, table))
        if fragility:
            out.write_text(FRAGILITY, fragility_csv(fragility))
    return record
