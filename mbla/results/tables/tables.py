"""All tables of a result by name, and the files of ``mbla export``: CSV and Parquet, put in place together.

One file holds a table for all load cases, with a column ``case``: a spreadsheet filters it, pandas groups by it, and
nothing has to be read from names of files. Tables without rows are written too, so that no earlier file stays behind.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from pathlib import Path
from typing import Any

from mbla.errors import UsageError
from mbla.results.files import OutputFolder
from mbla.results.outcome import notices_of
from mbla.results.quantities import further, history_tables, series, solving, steps, supports, ties, time_spectra
from mbla.results.quantities.group import Group
from mbla.results.quantities.quantity import Quantity
from mbla.results.quantities.registry import columns_of
from mbla.results.record.scene import Scene, Values, as_text, scene_of
from mbla.results.results import CaseResult, Results
from mbla.results.series import chosen_cases
from mbla.results.tables.formats import table_csv, table_parquet
from mbla.results.tables.table import Table, TableKind, table_of, values_in_scene, values_of_case, values_of_rows

CASE = Quantity("case", "text", "load case")


# --- Tables of arrays: a part is a load case as a scene -------------------------------------------------------------


def _scenes(results: Results, cases: tuple[CaseResult, ...]) -> list[Scene]:
    return [scene_of(results, case) for case in cases]


def _of_scenes(name: str, words: str, count: Callable[[Scene], int]) -> TableKind:
    """Quantities after the name of the load case; ``count``: rows of a scene."""

    def values(quantity: Quantity, scene: Scene) -> Values:
        if quantity is CASE:
            return as_text([scene.solved.load_case.name] * count(scene))
        return values_of_case(quantity, scene) if name == "cases" else values_in_scene(quantity, scene, count(scene))

    return TableKind(name, words, (CASE, *_in_tables(name)), _scenes, values)


def _in_tables(name: str) -> Iterator[Quantity]:
    return (quantity for quantity in columns_of(name) if "table" in quantity.files)


CASES = _of_scenes("cases", "each load case", lambda _: 1)
BLOCKS = _of_scenes("blocks", "each block, for each load case", lambda scene: len(scene.model.blocks))
INTERFACES = _of_scenes("interfaces", "each interface, for each load case", lambda scene: len(scene.contacts))
POINTS = _of_scenes("points", "each contact point, for each load case", lambda scene: len(scene.contacts.points))


# --- Tables of what there is to list: a part is a list of rows ------------------------------------------------------


def _of_rows(group: Group[Any], words: str) -> TableKind:
    """What each load case lists, after its name."""

    def parts(results: Results, cases: tuple[CaseResult, ...]) -> Iterator[tuple[str, list[Any]]]:
        for scene in _scenes(results, cases):
            yield scene.solved.load_case.name, list(group.owner(scene) or ())

    def values(quantity: Quantity, part: tuple[str, list[Any]]) -> Values:
        name, rows = part
        return as_text([name] * len(rows)) if quantity is CASE else values_of_rows(quantity, rows)

    return TableKind(group.table, words, (CASE, *_in_tables(group.table)), parts, values)


REACTIONS = _of_rows(supports.REACTIONS, "each support of the structure at collapse, for each load case with forces")
TIES = _of_rows(ties.TIES, "each tie, for each load case with forces")
PROGRAMS = _of_rows(solving.PROGRAMS, "each program that was solved for a load case")
ITERATIONS = _of_rows(solving.ITERATIONS, "each iteration of each program")
PATH = _of_rows(solving.PATH, "each step of the path of elastic joints that was followed")
CURVE = _of_rows(steps.CURVE, "each step of a pushover")
MODES = _of_scenes("modes", "each mode of vibration", lambda scene: len(scene.solved.solution.further.modes))
MODES_AFTER = _of_scenes(
    "modes_after",
    "each mode of vibration after a time history",
    lambda scene: len(scene.solved.solution.further.modes_after),
)
HISTORY = _of_scenes(
    "history",
    "each instant of the base and of each point that the deck names, of a structure in time",
    lambda scene: _count(history_tables.point_histories(scene)),
)
HISTORY_INTERFACES = _of_scenes(
    "history_interfaces",
    "each instant of each interface that the deck names, of a structure in time",
    lambda scene: _count(history_tables.interface_histories(scene)),
)
HISTORY_STEPS = _of_scenes(
    "history_steps",
    "each step of a structure in time",
    lambda scene: len(scene.solved.solution.further.time_history.rows or ()),
)
SPECTRA = _of_scenes(
    "spectra",
    "each period of the response spectra of the base and of each point that the deck names, of a structure in time",
    lambda scene: _count(time_spectra.spectra_in_rows(scene)),
)
SENSITIVITY = _of_rows(further.SENSITIVITY, "each parameter by which the load factor is known to change")


def _count(
    found: history_tables.PointHistories | history_tables.InterfaceHistories | time_spectra.SpectraInRows | None,
) -> int:
    return 0 if found is None else found.count


def _positions(results: Results, cases: tuple[CaseResult, ...]) -> list[list[Any]]:
    """Positions of the cases asked for; the worst is that of all."""
    names = {case.load_case.name for case in cases}
    return [[row for row in series.positions(results) if row.case.load_case.name in names]]


SERIES = TableKind(
    "series", "each position of each travelling load", tuple(columns_of("series")), _positions, values_of_rows
)
NOTICES = TableKind(
    "notices",
    "each remark of the run",
    tuple(columns_of("notices")),
    lambda results, _: [notices_of(results)],
    values_of_rows,
)


# --- All tables by name -----------------------------------------------------------------------------------------------


TABLES: dict[str, TableKind] = {
    kind.name: kind
    for kind in (
        *(CASES, BLOCKS, INTERFACES, POINTS, REACTIONS, TIES, PROGRAMS, ITERATIONS, PATH, CURVE),
        *(MODES, MODES_AFTER, HISTORY, HISTORY_INTERFACES, HISTORY_STEPS, SPECTRA),
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
    """Write ``STEM_TABLE.csv`` and ``STEM_TABLE.parquet``; their paths.

    Files that are there already with the same content, such as the curve that the run wrote, stay as they are.

    cases, tables : only these; all where none is named

    Raises
    ------
    UsageError
        No such load case or table, or the extra for Parquet is not installed.
    FileError
        A file is there already with another content and ``force`` is not set, or cannot be written.
    """
    chosen = tables_of(results, tables or None, cases or None)
    files: dict[str, bytes] = {}
    for name, table in chosen.items():
        if csv:
            files[f"{stem}_{name}.csv"] = table_csv(table).encode()
        if parquet:
            files[f"{stem}_{name}.parquet"] = table_parquet(table, _about(results, table))
    with OutputFolder(folder, stem, force, secondary=True) as out:
        for name, content in files.items():
            if not _is_there(folder / name, content):
                out.write_bytes(name, content)
    return [folder / name for name in sorted(files)]


def _is_there(path: Path, content: bytes) -> bool:
    """Whether a file has that content already."""
    try:
        return path.is_file() and path.read_bytes() == content
    except OSError:
        return False


def _about(results: Results, table: Table) -> dict[str, str]:
    return {
        "table": table.kind.name,
        "deck": results.deck.name,
        "deck_sha256": results.deck.sha256,
        "mbla": results.provenance.get("mbla", ""),
        "created": results.created,
    }
