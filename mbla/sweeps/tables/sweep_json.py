"""A sweep as one JSON object: what ``--json`` prints and ``sweep.json`` holds; the values are in sweep.csv.

Both files are read back here, for pictures.
"""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from mbla import __version__
from mbla.arrays import IntArray
from mbla.errors import FileError, Notice
from mbla.results.disk import file_errors
from mbla.results.record.json_record import NOTICE
from mbla.results.record.json_values import number
from mbla.results.record.objects import Key, json_of
from mbla.results.record.scene import Values
from mbla.sweeps.design.design import DesignDimension
from mbla.sweeps.fragility import fragility_keys
from mbla.sweeps.fragility_curve import curve_keys
from mbla.sweeps.plan import DONE, FAILED, Plain
from mbla.sweeps.results import OWN_COLUMNS
from mbla.sweeps.tables.sweep_table import READ_CELL, SweepColumn, SweepTable, column_values

CSV, JSON = "sweep.csv", "sweep.json"
VERSION = 1
"""of this record and of the layout of sweep.h5; raised by one with every change that an older reader would misread"""


def sweep_json(
    table: SweepTable,
    *,
    sweep: str,
    deck: str,
    created: str,
    exit_code: int,
    left_out: int = 0,
    seconds: float = 0.0,
    notices: Sequence[Notice] = (),
) -> dict[str, Any]:
    """The record of a plain sweep, its files not known yet; arguments as ``SWEEP_RECORD`` describes them."""
    return {
        "mbla": __version__,
        "sweep": sweep,
        "version": VERSION,
        "deck": deck,
        "title": table.title,
        "created": created,
        "exit_code": exit_code,
        "points": counts(table) | {"left_out": left_out},
        "design": {
            "dimensions": [asdict(dimension) for dimension in table.dimensions],
            "samples": table.samples or None,
            "sampling": table.sampling or None,
            "places": _places(table.dimensions, table.position),
        },
        "columns": [asdict(column) for column in table.columns],
        "fragility": [],
        "fragility_curves": [],
        "notices": [json_of(NOTICE, notice) for notice in notices],
        "time": {"total": number(seconds)},
        "files": [],
    }


def counts(table: SweepTable) -> dict[str, int]:
    """Points of the table: all, done, failed, and those that have not been solved yet."""
    states = table["state"].tolist()
    done, failed = states.count(DONE), states.count(FAILED)
    return {"all": len(table), "done": done, "failed": failed, "unfinished": len(table) - done - failed}


def _places(dimensions: Sequence[DesignDimension], position: IntArray) -> list[int] | None:
    """Place of each point in the full design, the last dimension fastest, from 0; None where all are there."""
    shape = tuple(dimension.size for dimension in dimensions)
    places = np.ravel_multi_index(tuple(position.T), shape) if shape else np.zeros(len(position), dtype=np.int64)
    return None if np.array_equal(places, np.arange(np.prod(shape))) else [int(place) for place in places]


def positions_at(places: Sequence[int] | None, dimensions: Sequence[DesignDimension]) -> IntArray:
    """Positions along each dimension, (n_points, n_dimensions), from the places; the way back.

    Raises ValueError where a place lies outside the design.
    """
    shape = tuple(dimension.size for dimension in dimensions)
    where = np.arange(np.prod(shape, dtype=np.int64)) if places is None else np.array(places, dtype=np.int64)
    return np.stack(np.unravel_index(where, shape), axis=1) if shape else np.zeros((len(where), 0), dtype=np.int64)


def read_sweep_table(path: Path) -> SweepTable:
    """The table of a sweep from its folder, its sweep.csv or its sweep.json.

    Raises FileError: there is none, it cannot be read, it is no table of a sweep, or the two files do not belong
    together.
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
    dimensions = tuple(DesignDimension(**dimension) for dimension in design["dimensions"])
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


SWEEP_RECORD: tuple[Key, ...] = (
    Key("mbla", "string", "version of the program"),
    Key("sweep", "string", "file name of the sweep file"),
    Key("version", "integer", "version of this record and of sweep.h5; a reader checks it first"),
    Key("deck", "string", "base deck, as the sweep file names it"),
    Key("title", "string", "title of the sweep; without one the name of its file"),
    Key("created", "string", "date of the run, UTC, ISO 8601"),
    Key("exit_code", "integer", "exit status of the sweep: 0, or 8 where points failed"),
    Key("points", "object", "counts of points"),
    Key("points.all", "integer", "in the table"),
    Key("points.done", "integer", "with a verified answer for every load case"),
    Key("points.failed", "integer", "without"),
    Key("points.unfinished", "integer", "not solved yet"),
    Key("points.left_out", "integer", "of the design, left out by constraints; not in the table"),
    Key("design", "object", "how the points lie"),
    Key("design.dimensions", "list", "axes of the design, the slowest first"),
    Key("design.dimensions[]", "object", "an axis"),
    Key("design.dimensions[].name", "string", "parameter of a grid, or kind of a set of points"),
    Key("design.dimensions[].size", "integer", "positions along it"),
    Key("design.samples", "string?", "the axis whose points are a random sample of distributions"),
    Key("design.sampling", "string?", "random, latin_hypercube or sobol for that"),
    Key("design.places", "list?", "place of each row in the full design, the last axis fastest; null: all are there"),
    Key("design.places[]", "integer", "a place, from 0"),
    Key("columns", "list", "columns of sweep.csv, in their order"),
    Key("columns[]", "object", "a column"),
    Key("columns[].name", "string", "its name"),
    Key("columns[].unit", "string", "unit; empty for plain numbers and text"),
    Key("columns[].words", "string", "what it is"),
    Key("columns[].kind", "string", "float, int, bool or text"),
    Key(
        "columns[].role",
        "string",
        "number, parameter, azimuth, elevation, state, result, exit_code, reason, tries or seconds",
    ),
    Key("columns[].dimension", "string", "of parameters: the axis along which they change"),
    Key("columns[].random", "boolean", "of parameters: they follow a distribution"),
    Key("columns[].case", "string", "of results: load case; empty for values of the entire run"),
    Key("columns[].path", "string", "of results: key path in the JSON record of the run"),
    *fragility_keys("fragility"),
    *curve_keys("fragility_curves"),
    Key("notices", "list", "remarks and warnings"),
    Key("notices[]", "object", "a remark"),
    Key("notices[].severity", "string", "notice or warning"),
    Key("notices[].identifier", "string", "stable identifier"),
    Key("notices[].message", "string", "in words"),
    Key("time", "object", "what it took"),
    Key("time.total", "number", "the entire run by the clock", "time"),
    Key("files", "list", "names of the files of the sweep"),
    Key("files[]", "string", "a file"),
)
