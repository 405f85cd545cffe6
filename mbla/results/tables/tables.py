"""All tables of a result by name, and the files of ``mbla export``: CSV and Parquet, put in place together.

One file holds a table for all load cases, with a column ``case``: a spreadsheet filters it, pandas groups by it, and
nothing has to be read from names of files. Tables without rows are written too, so that no earlier file stays behind.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.deck.units import Units
from mbla.errors import Notice, UsageError
from mbla.results.collapse.mechanics import Reaction, reactions_of
from mbla.results.files import OutputFolder
from mbla.results.outcome import notices_of
from mbla.results.record.columns import BLOCK_COLUMNS, CASE_COLUMNS, INTERFACE_COLUMNS, POINT_COLUMNS
from mbla.results.record.quantity import STORED, Kind, Quantity, UnitKind, real
from mbla.results.record.scene import Scene, Values, as_text
from mbla.results.results import CaseResult, Results
from mbla.results.series import Series, chosen_cases, factor_of, position_of, series_of
from mbla.results.tables.formats import table_csv, table_parquet
from mbla.results.tables.table import Table, TableColumn, TableKind, case_scenes, described, scene_columns, table_of

# --- Tables of what there is to list: a source is a list of items, a row each ----------------------------------------


def each(name: str, words: str, get: Callable[[Any], Any], kind: Kind = "text", unit: UnitKind = "1") -> TableColumn:
    """A column with what an item has, row by row."""

    def values(items: Sequence[Any]) -> Values:
        found = [get(item) for item in items]
        return as_text(found) if kind == "text" else np.array(found)

    return TableColumn(name, kind, unit, words, values)


def _list_table(name: str, words: str) -> TableKind:
    """A table of the records that a solution lists under one name, as the result file has them."""

    def items(_: Results, cases: tuple[CaseResult, ...]) -> Iterable[list[tuple[CaseResult, Any]]]:
        return [[(case, record) for record in getattr(case.solution, name)] for case in cases]

    def column(quantity: Quantity) -> TableColumn:
        ((_, called, unit),) = quantity.components()
        as_told = str if quantity.kind == "text" else lambda value: value
        return each(called, quantity.words, lambda item: as_told(getattr(item[1], quantity.name)), quantity.kind, unit)

    held = [column(quantity) for quantity in STORED if quantity.place == f"cases/*/{name}"]
    case = each("case", "load case", lambda item: item[0].load_case.name)
    return TableKind(name, words, (case, *held), items)


PROGRAMS = _list_table("programs", "each program that was solved for a load case")
ITERATIONS = _list_table("iterations", "each iteration of each program")
PATH = _list_table("path", "each step of the load path that was followed")


def _reactions(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[list[tuple[Scene, CaseResult, Reaction]]]:
    """Of supports, then of guides, in the order of the listing."""
    for scene, case in zip(case_scenes(results, cases), cases, strict=True):
        if scene.mechanics is not None:
            found = reactions_of(scene.model, scene.contacts, case.load_case, scene.mechanics)
            yield [(scene, case, reaction) for reaction in found]


FIGURES_TOLD = next(column.quantity.words for column in CASE_COLUMNS if column.quantity.name == "figures")

REACTIONS = TableKind(
    "reactions",
    "each support of the structure at collapse, for each load case with forces",
    (
        each("case", "load case", lambda item: item[1].load_case.name),
        each("support", "ground, block, group or guide", lambda item: item[2].support),
        each("figures", FIGURES_TOLD, lambda item: item[0].figures),
        *described(
            real("reaction", "force on the structure, and its moment about the origin", "load", "component"),
            lambda items: np.array([reaction.wrench for *_, reaction in items]).reshape(-1, 6),
        ),
    ),
    _reactions,
)


def _positions(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[list[tuple[Results, Series, CaseResult]]]:
    """Positions of the cases asked for; the worst is that of all."""
    names = {case.load_case.name for case in cases}
    for series in series_of(results.cases):
        yield [(results, series, case) for case in series.cases if case.load_case.name in names]


def _block(item: tuple[Results, Series, CaseResult]) -> str:
    block = int(position_of(item[2]).blocks[0])
    return item[0].model.blocks.name(block) if block >= 0 else ""


def _axles(item: tuple[Results, Series, CaseResult]) -> str:
    return " ".join(f"{place:.9g}" for place in position_of(item[2]).distances.tolist())


SERIES = TableKind(
    "series",
    "each position of each travelling load",
    (
        each("series", "load case of the deck", lambda item: item[1].name),
        each("case", "load case", lambda item: item[2].load_case.name),
        each("position", "number of the position, from 1", lambda item: position_of(item[2]).number, "int"),
        each("count", "positions on the path", lambda item: position_of(item[2]).count, "int"),
        *described(
            real("point", "where the first axle stands, or the only force", "length", "axis"),
            lambda items: np.array([position_of(case).point for *_, case in items]).reshape(-1, 3),
        ),
        each(
            "distance",
            "its distance along the path, of which it may be off",
            lambda item: position_of(item[2]).distance,
            "float",
            "length",
        ),
        each("block", "the block that carries it; empty: it is off the path", _block),
        each("axles", "distances along the path of all axles, the first one first", _axles),
        each("status", "status", lambda item: item[2].status.value),
        each(
            "load_factor",
            "load factor; inf: no multiple brings anything down; empty: no result",
            lambda item: factor_of(item[2]),
            "float",
        ),
        each(
            "worst",
            "the least load factor; none where some position has no result",
            lambda item: item[2] is item[1].worst,
            "bool",
        ),
    ),
    _positions,
)


def _notices(results: Results, cases: tuple[CaseResult, ...]) -> Iterable[tuple[Notice, ...]]:
    return [notices_of(results)]


NOTICES = TableKind(
    "notices",
    "each remark of the run",
    (
        each("severity", "notice or warning", lambda notice: notice.severity),
        each("identifier", "stable identifier", lambda notice: notice.identifier),
        each("message", "in words", lambda notice: notice.message),
        each("case", "load case that it is about; empty: the whole run", lambda notice: notice.case),
    ),
    _notices,
)


# --- All tables by name -----------------------------------------------------------------------------------------------


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
