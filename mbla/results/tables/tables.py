"""All tables of a result by name, and the files of ``mbla export``: CSV and Parquet, put in place together.

One file holds a table for all load cases, with a column ``case``: a spreadsheet filters it, pandas groups by it, and
nothing has to be read from names of files. Tables without rows are written too, so that no earlier file stays behind.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from operator import itemgetter
from pathlib import Path
from types import SimpleNamespace
from typing import Any

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.collapse.mechanics import reactions_of
from mbla.results.collapse.ties import tie_rows
from mbla.results.files import OutputFolder
from mbla.results.outcome import notices_of
from mbla.results.record.columns import (
    BLOCK_COLUMNS,
    CASE_COLUMNS,
    INTERFACE_COLUMNS,
    POINT_COLUMNS,
    Column,
    columns_of,
)
from mbla.results.record.quantity import STORED, Quantity
from mbla.results.record.scene import Scene, Values, scene_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import chosen_cases, factor_of, position_of, series_of
from mbla.results.tables.formats import table_csv, table_parquet
from mbla.results.tables.table import Table, TableKind, table_of, unit_in, values_in_scene, values_of_rows
from mbla.solution.solution import Solution

CASE = Quantity("case", "text", "load case")


# --- Tables of arrays: a part is a load case as a scene -------------------------------------------------------------


def _scenes(results: Results, cases: tuple[CaseResult, ...]) -> list[Scene]:
    return [scene_of(results, case) for case in cases]


def _of_scenes(name: str, words: str, columns: Sequence[Column], count: Callable[[Scene], int]) -> TableKind:
    """Columns of the record after the name of the load case; ``count``: rows of a scene."""

    def values(column: Column, scene: Scene) -> Values:
        return values_in_scene(column, scene, count(scene))

    case = Column(CASE, lambda scene: scene.case.load_case.name, None, ("table",))
    own = (column for column in columns if "table" in column.files)
    return TableKind(name, words, (case, *own), _scenes, values)


CASES = _of_scenes("cases", "each load case", CASE_COLUMNS, lambda _: 1)
BLOCKS = _of_scenes("blocks", "each block, for each load case", BLOCK_COLUMNS, lambda scene: len(scene.model.blocks))
INTERFACES = _of_scenes(
    "interfaces", "each interface, for each load case", INTERFACE_COLUMNS, lambda scene: len(scene.contacts)
)
POINTS = _of_scenes(
    "points", "each contact point, for each load case", POINT_COLUMNS, lambda scene: len(scene.contacts.points)
)


# --- Tables of what there is to list: a part is a list of rows ------------------------------------------------------


def _list_table(name: str, words: str, of: Callable[[Solution], Sequence[object]]) -> TableKind:
    """A table of records that a solution lists, as the result file has them under a name."""

    def rows(_: Results, cases: tuple[CaseResult, ...]) -> Iterator[list[Any]]:
        for case in cases:
            yield [vars(record) | {"case": case.load_case.name} for record in of(case.solution)]

    held = (quantity for quantity in STORED if quantity.place == f"cases/*/{name}")
    columns = tuple(Column(each, itemgetter(each.name), None, ("table",)) for each in (CASE, *held))
    return TableKind(name, words, columns, rows, values_of_rows)


PROGRAMS = _list_table("programs", "each program that was solved for a load case", lambda solution: solution.programs)
ITERATIONS = _list_table("iterations", "each iteration of each program", lambda solution: solution.iterations)
PATH = _list_table("path", "each step of the path of elastic joints that was followed", lambda solution: solution.path)

CURVE = _list_table("curve", "each step of a pushover", lambda solution: solution.further.pushover.curve)
SENSITIVITY = _list_table(
    "sensitivity",
    "each parameter by which the load factor is known to change",
    lambda solution: solution.further.sensitivity,
)


def _reactions(results: Results, cases: tuple[CaseResult, ...]) -> Iterator[list[Any]]:
    """Of supports, then of guides, in the order of the listing."""
    for scene, case in zip(_scenes(results, cases), cases, strict=True):
        if scene.mechanics is not None:
            found = reactions_of(scene.model, scene.contacts, case.load_case, scene.mechanics)
            yield [SimpleNamespace(scene=scene, case=case, **vars(reaction)) for reaction in found]


REACTIONS = TableKind(
    "reactions",
    "each support of the structure at collapse, for each load case with forces",
    columns_of("reactions"),
    _reactions,
    values_of_rows,
)


def _ties(results: Results, cases: tuple[CaseResult, ...]) -> Iterator[list[Any]]:
    """Of every load case with forces, in the order of the deck."""
    for scene, case in zip(_scenes(results, cases), cases, strict=True):
        if scene.mechanics is not None:
            rows = tie_rows(scene.model, scene.mechanics)
            yield [SimpleNamespace(case=case, tie=row) for row in rows]


TIES = TableKind("ties", "each tie, for each load case with forces", columns_of("ties"), _ties, values_of_rows)


def _positions(results: Results, cases: tuple[CaseResult, ...]) -> Iterator[list[Any]]:
    """Positions of the cases asked for; the worst is that of all."""
    names, blocks = {case.load_case.name for case in cases}, results.model.blocks
    for series in series_of(results.cases):
        rows = []
        for case in (case for case in series.cases if case.load_case.name in names):
            at = position_of(case)
            block = int(at.blocks[0])
            carrier = blocks.name(block) if block >= 0 else ""
            axles = " ".join(f"{place:.9g}" for place in at.distances.tolist())
            found = {"load_factor": factor_of(case), "worst": case is series.worst, "carrier": carrier, "axles": axles}
            rows.append(SimpleNamespace(series=series, case=case, at=at, **found))
        yield rows


SERIES = TableKind("series", "each position of each travelling load", columns_of("series"), _positions, values_of_rows)
NOTICES = TableKind(
    "notices",
    "each remark of the run",
    columns_of("notices"),
    lambda results, _: [notices_of(results)],
    values_of_rows,
)


# --- All tables by name -----------------------------------------------------------------------------------------------


TABLES: dict[str, TableKind] = {
    kind.name: kind
    for kind in (
        *(CASES, BLOCKS, INTERFACES, POINTS, REACTIONS, TIES, PROGRAMS, ITERATIONS, PATH, CURVE),
        *(SENSITIVITY, SERIES, NOTICES),
    )
}


def tables_of(
    results: Results, names: Sequence[str] | None = None, cases: Sequence[str] | None = None
) -> dict[str, Table]:
    """Tables of a result by name, as ``mbla export`` writes them.

    names : of the tables; None for all, of which those without rows are there too
    cases : names of load cases; None for all that were run

    Raises UsageError where there is no such table or load case.
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
            lines.append(f"| `{column.name}` | {column.kind} | {unit_in(column, Units()) or '–'} | {column.words} |")
        lines.append("")
    return "\n".join(lines)


def export_results(
    results: Results,
    folder: Path,
    stem: str,
    cases: Sequence[str] = (),
    tables: Sequence[str] = (),
    *,
    csv: bool = True,
    parquet: bool = False,
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
    with OutputFolder(folder, stem, force, secondary=True) as out:
        for name, table in chosen.items():
            if csv:
                out.write_text(f"{stem}_{name}.csv", table_csv(table))
            if parquet:
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
