"""The files of ``mbla export``: tables as CSV and Parquet, put in place together.

One file holds a table for all load cases, with a column ``case``: a spreadsheet filters it, pandas groups by it, and
nothing has to be read from names of files. Tables without rows are written too, so that no earlier file stays behind.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.results.files import OutputFolder
from mbla.results.results import Results
from mbla.results.tables.csv_file import table_csv
from mbla.results.tables.parquet_file import table_parquet
from mbla.results.tables.table import Table
from mbla.results.tables.tables import tables_of


@dataclass(frozen=True)
class Formats:
    """What is written; CSV where nothing is asked for."""

    csv: bool = False
    parquet: bool = False


def export_results(
    results: Results,
    folder: Path,
    stem: str,
    formats: Formats,
    cases: Sequence[str] = (),
    tables: Sequence[str] = (),
    force: bool = False,
) -> list[Path]:
    """Write ``STEM_TABLE.csv`` and ``STEM_TABLE.parquet``; the paths written.

    cases, tables : only these; all where none is named

    Raises
    ------
    UsageError
        No such load case or table, or the extra for Parquet is not installed.
    FileError
        A file is there already and ``force`` is not set, or cannot be written.
    """
    chosen = tables_of(results, tables or None, cases or None)
    with OutputFolder(folder, stem, force, beside=True) as out:
        if formats.csv or not formats.parquet:
            for name, table in chosen.items():
                out.write_text(f"{stem}_{name}.csv", table_csv(table))
        if formats.parquet:
            for name, table in chosen.items():
                out.write_bytes(f"{stem}_{name}.parquet", table_parquet(table, _about(results, table)))
    return [folder / name for name in out.names]


def _about(results: Results, table: Table) -> dict[str, str]:
    return {
        "table": table.kind.name,
        "deck": results.deck.name,
        "deck_sha256": results.deck.sha256,
        "mbla": results.provenance.get("mbla", ""),
        "created": results.created,
    }
