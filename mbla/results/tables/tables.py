"""All tables of a result by name, and their description as a page of words."""

from __future__ import annotations

from collections.abc import Sequence

from mbla.deck.units import Units
from mbla.errors import UsageError
from mbla.results.chosen_cases import chosen_cases
from mbla.results.record.blocks import BLOCK_COLUMNS
from mbla.results.record.cases import CASE_COLUMNS
from mbla.results.record.interfaces import INTERFACE_COLUMNS
from mbla.results.record.points import POINT_COLUMNS
from mbla.results.results import Results
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
