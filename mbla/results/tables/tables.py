"""All tables of a result by name, and the files of ``mbla export``: CSV and Parquet, put in place together.

One file holds a table for all load cases, with a column ``case``: a spreadsheet filters it, pandas groups by it, and
nothing has to be read from names of files. Tables without rows are written too, so that no earlier file stays behind.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.files import OutputFolder
from mbla.results.record.blocks import BLOCK_COLUMNS
from mbla.results.record.cases import CASE_COLUMNS
from mbla.results.record.contacts import INTERFACE_COLUMNS, POINT_COLUMNS
from mbla.results.results import Results
from mbla.results.series import chosen_cases
from mbla.results.tables.formats import table_csv, table_parquet
from mbla.results.tables.lists import ITERATIONS, NOTICES, PATH, PROGRAMS, REACTIONS, SERIES
from mbla.results.tables.table import Table, TableKind, case_scenes, scene_columns, table_of

CASES = TableKind("cases", "each load case", scene_columns(CASE_COLUMNS, lambda _: 1), case_scenes)
BLOCKS = TableKind(
    "blocks",
    "each block, for each load case",
    scene_columns(BLOCK_COLUMNS, lambda scene: len(scene.model.blocks)),
    case_scenes,
)
INTERFACES = TableKind(
    "interfaces",
    "each interface, for each load case",
    scene_columns(INTERFACE_COLUMNS, lambda scene: len(scene.contacts)),
    case_scenes,
)
POINTS = TableKind(
    "points",
    "each contact point, for each load case",
    scene_columns(POINT_COLUMNS, lambda scene: len(scene.contacts.points)),
    case_scenes,
)

TABLES: dict[str, TableKind] = {
    kind.name: kind
    for kind in (CASES, BLOCKS, INTERFACES, POINTS, REACTIONS, PROGRAMS, ITERATIONS, PATH, SERIES, NOTICES)
}


def tables_of(
    results: Results, names: Sequence[str] | None = None, cases: Sequence[str] | None = None
) -> dict[str, Table]:
    """Tables of a result by name, as ``mbla export`` writes them.

    names : of the tables; None for all, of which those without rows are there too
    cases : names of load cases; None for all that were run

    Raises
    ------
    UsageError
        There is no such table or load case.
    """
    chosen = chosen_cases(results, cases)
    for name in names or ():
        if name not in TABLES:
            raise UsageError("unknown-table", f"no table {name}; there are {', '.join(TABLES)}")
    return {name: table_of(TABLES[name], results, chosen) for name in (TABLES if names is None else names)}


def tables_page() -> str:
    """Every table with its columns, as it stands in schemas/results.md; units as in a deck in m, N, kg."""
    lines: list[str] = []
    for kind in TABLES.values():
        lines += [f"### `{kind.name}`", "", f"One row for {kind.words}.", ""]
        lines += ["| column | type | unit | meaning |", "|---|---|---|---|"]
        for column in kind.columns:
            lines.append(f"| `{column.name}` | {column.kind} | {column.unit_in(Units()) or '–'} | {column.words} |")
        lines.append("")
    return "\n".join(lines)


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
