"""A sweep as one JSON object: what ``--json`` prints and ``sweep.json`` holds; the values are in sweep.csv."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict
from typing import Any

import numpy as np

from mbla import __version__
from mbla.arrays import IntArray
from mbla.errors import Notice
from mbla.results.record.json_record import notice_json
from mbla.results.record.json_values import number
from mbla.results.record.keys import Key
from mbla.sweeps.design.design import Dimension
from mbla.sweeps.fragility import fragility_keys
from mbla.sweeps.plan import DONE, FAILED
from mbla.sweeps.tables.sweep_table import SweepTable

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
        "notices": [notice_json(notice) for notice in notices],
        "time": {"total": number(seconds)},
        "files": [],
    }


def counts(table: SweepTable) -> dict[str, int]:
    """Points of the table: all, done, failed, and those that have not been solved yet."""
    states = table["state"].tolist()
    done, failed = states.count(DONE), states.count(FAILED)
    return {"all": len(table), "done": done, "failed": failed, "unfinished": len(table) - done - failed}


def _places(dimensions: Sequence[Dimension], position: IntArray) -> list[int] | None:
    """Place of each point in the whole design, the last dimension fastest, from 0; None where all are there."""
    shape = tuple(dimension.size for dimension in dimensions)
    places = np.ravel_multi_index(tuple(position.T), shape) if shape else np.zeros(len(position), dtype=np.int64)
    return None if np.array_equal(places, np.arange(np.prod(shape))) else [int(place) for place in places]


def positions_at(places: Sequence[int] | None, dimensions: Sequence[Dimension]) -> IntArray:
    """Positions along each dimension, (n_points, n_dimensions), from the places; the way back.

    Raises
    ------
    ValueError
        a place lies outside the design
    """
    shape = tuple(dimension.size for dimension in dimensions)
    where = np.arange(np.prod(shape, dtype=np.int64)) if places is None else np.array(places, dtype=np.int64)
    return np.stack(np.unravel_index(where, shape), axis=1) if shape else np.zeros((len(where), 0), dtype=np.int64)


SWEEP_RECORD: tuple[Key, ...] = (
    Key("mbla", "string", "version of the program"),
    Key("sweep", "string", "file name of the sweep file"),
    Key("version", "integer", "version of this record and of sweep.h5; a reader checks it first"),
    Key("deck", "string", "base deck, as the sweep file names it"),
    Key("title", "string", "title of the sweep"),
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
    Key("design.places", "list?", "place of each row in the whole design, the last axis fastest; null: all are there"),
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
    Key("columns[].case", "string", "of results: load case; empty for values of the whole run"),
    Key("columns[].path", "string", "of results: key path in the JSON record of the run"),
    *fragility_keys("fragility"),
    Key("notices", "list", "remarks and warnings"),
    Key("notices[]", "object", "a remark"),
    Key("notices[].severity", "string", "notice or warning"),
    Key("notices[].identifier", "string", "stable identifier"),
    Key("notices[].message", "string", "in words"),
    Key("time", "object", "what it took"),
    Key("time.total", "number", "the whole run by the clock", "time"),
    Key("files", "list", "names of the files of the sweep"),
    Key("files[]", "string", "a file"),
)
