"""The table of a sweep read back from its files, for pictures: sweep.csv, and sweep.json, which says what it holds."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from mbla.errors import FileError
from mbla.results.disk import file_errors
from mbla.results.record.scene import Values
from mbla.sweeps.design.design import Dimension
from mbla.sweeps.plan import Plain
from mbla.sweeps.results import OWN_COLUMNS
from mbla.sweeps.tables.sweep_json import VERSION, positions_at
from mbla.sweeps.tables.sweep_table import READ_CELL, SweepColumn, SweepTable, column_values

CSV, JSON = "sweep.csv", "sweep.json"


def read_sweep_table(path: Path) -> SweepTable:
    """The table of a sweep from its folder, its sweep.csv or its sweep.json.

    Raises
    ------
    FileError
        there is none, it cannot be read, it is no table of a sweep, or the two files do not belong together
    """
    folder = path if path.is_dir() else path.parent
    if path != folder and path.name not in (CSV, JSON):
        raise FileError("sweep-table-damaged", f"{path}: is no table of a sweep; name its folder, {CSV} or {JSON}")
    content: dict[str, bytes] = {}
    for name in (JSON, CSV):
        if not (folder / name).is_file():
            words = f"{folder / name}: there is none; mbla sweep writes {CSV} and {JSON} into one folder"
            raise FileError("sweep-table-damaged", words)
        with file_errors(folder / name):
            content[name] = (folder / name).read_bytes()
    try:
        record = json.loads(content[JSON].decode("utf-8"))
        if record["version"] != VERSION:
            raise ValueError(f"{JSON} is of version {record['version']}, this mbla reads version {VERSION}")
        text = io.StringIO(content[CSV].decode("utf-8"), newline="")
        return _table(record, list(csv.reader(text, strict=True)))
    except (KeyError, TypeError, ValueError, IndexError, RecursionError, csv.Error) as error:
        what = " ".join(str(error.args[0]).split()) if error.args else type(error).__name__
        words = f"{folder}: {JSON} and {CSV} are no table of a sweep: {what}"
        raise FileError("sweep-table-damaged", words) from error


def _table(record: dict[str, Any], rows: Sequence[Sequence[str]]) -> SweepTable:
    columns = tuple(SweepColumn(**column) for column in record["columns"])
    design = record["design"]
    dimensions = tuple(Dimension(**dimension) for dimension in design["dimensions"])
    if not rows or list(rows[0]) != [column.header for column in columns]:
        raise ValueError("its columns differ")
    places = design["places"]
    points = math.prod(dimension.size for dimension in dimensions) if places is None else len(places)
    if len(rows) - 1 != points:
        raise ValueError(f"{len(rows) - 1} rows, {points} points")
    position = positions_at(places, dimensions)
    if not set(OWN_COLUMNS) <= {column.name for column in columns}:
        raise ValueError("columns are missing")
    if any(len(row) != len(columns) for row in rows):
        raise ValueError("its rows are not as long as each other")
    cells = list(zip(*rows[1:], strict=True)) or [()] * len(columns)
    return SweepTable(
        title=str(record["title"]),
        columns=columns,
        values=tuple(_values(column, own) for column, own in zip(columns, cells, strict=True)),
        dimensions=dimensions,
        position=position,
        samples=design["samples"] or "",
        sampling=design["sampling"] or "",
    )


def _values(column: SweepColumn, cells: Sequence[str]) -> Values:
    read = READ_CELL[column.kind]
    values: list[Plain] = []
    for row, cell in enumerate(cells, 2):
        try:
            values.append(read(cell) if cell else None)
        except (KeyError, ValueError) as error:
            raise ValueError(f"row {row}: {column.name} = {cell[:40]!r}") from error
    return column_values(column.kind, values)
