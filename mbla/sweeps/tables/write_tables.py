"""The files that hold the table of a sweep: all of them appear together, or the earlier ones stay.

As HDF5 it lies along the axes of its design, as xarray opens it. Every dimension of the design has a scale of its name:
the values of a parameter of a grid, else the position, from 0, in a set of points that change several parameters
together, whose parameters are coordinates along it. Results lie over all dimensions. What does not exist (no result, a
point that was left out or is not solved yet) is nan, empty text, or the ``_FillValue`` of integers and truth
values, which xarray shows as nan.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from mbla import __version__
from mbla.errors import UsageError
from mbla.results.files import OutputFolder
from mbla.results.hdf5.result_file import Labelled, LabelledFile, write_labelled_hdf5
from mbla.results.pictures.page import matplotlib_parts
from mbla.results.record.scene import Values
from mbla.results.tables.formats import ParquetColumn, csv_text, parquet_bytes, require_parquet
from mbla.sweeps.tables.sweep_json import CSV, JSON, VERSION, counts
from mbla.sweeps.tables.sweep_table import SweepColumn, SweepTable

FILETYPE = "mbla sweep"
TYPES = {"float": np.float64, "int": np.int64, "bool": np.int8, "text": object}
NONE: dict[str, Any] = {"float": np.nan, "int": int(np.iinfo(np.int64).min), "bool": -1, "text": ""}
"""what stands for no value; of integers and truth values, which are 0 and 1, it is the ``_FillValue``"""
OF_DESIGN = ("parameter", "azimuth", "elevation")
"""roles of columns that lie along one dimension"""


def sweep_hdf5(record: Mapping[str, Any], table: SweepTable) -> bytes:
    """The bytes of sweep.h5; layout: schemas/results.md."""
    scales = {dimension.name: _scale(table, axis) for axis, dimension in enumerate(table.dimensions)}
    arrays: dict[str, Labelled] = {}
    for column in table.of_role(*OF_DESIGN):
        if column.name not in scales:
            arrays[column.name] = _along_one(table, column)
    coordinates = " ".join(arrays) if not any(" " in name for name in arrays) else ""
    for column, values in zip(table.columns, table.values, strict=True):
        if column.role not in OF_DESIGN:
            name = column.name.replace("/", "_")  # a stroke would make a group of what is before it
            arrays[name] = _along_all(table, column, values, coordinates)
    attributes: dict[str, str | int] = {
        "filetype": FILETYPE,
        "version": VERSION,
        "mbla_version": __version__,
        **{key: record[key] for key in ("created", "title", "sweep", "deck")},
        "sampling": table.sampling,
        "complete": int(counts(table)["unfinished"] == 0),
    }
    return write_labelled_hdf5(LabelledFile(attributes, scales, arrays))


def _scale(table: SweepTable, axis: int) -> Labelled:
    dimension = table.dimensions[axis]
    for column in table.of_role(*OF_DESIGN):
        if column.name == dimension.name:
            return _along_one(table, column)
    words = {"units": "1", "long_name": f"position along {dimension.name}, from 0"}
    return Labelled(np.arange(dimension.size, dtype=np.int64), (dimension.name,), words)


def _along_one(table: SweepTable, column: SweepColumn) -> Labelled:
    """A parameter along its dimension."""
    return _labelled(column, _plain(column, table.levels[column.name]), (column.dimension,))


def _along_all(table: SweepTable, column: SweepColumn, values: Values, coordinates: str) -> Labelled:
    shape = tuple(dimension.size for dimension in table.dimensions)
    spread = np.full(shape, NONE[column.kind], dtype=TYPES[column.kind])
    spread[tuple(table.position.T)] = _plain(column, values)
    names = tuple(dimension.name for dimension in table.dimensions)
    return _labelled(column, spread, names, {"coordinates": coordinates} if coordinates else {})


def _plain(column: SweepColumn, values: Values) -> Values:
    """Values (n,) as the file holds them."""
    if column.kind == "text":
        return np.array([value or "" for value in values], dtype=object)
    return np.asarray(np.ma.filled(values.astype(TYPES[column.kind]), NONE[column.kind]))


def _labelled(
    column: SweepColumn, values: Values, dimensions: tuple[str, ...], more: Mapping[str, str] | None = None
) -> Labelled:
    words = {"units": column.unit or "1", "long_name": column.words, "column": column.name, "role": column.role}
    words |= ({"case": column.case} if column.case else {}) | dict(more or {})
    none = NONE[column.kind]
    return Labelled(values, dimensions, words, none if isinstance(none, int) and (values == none).any() else None)


def sweep_parquet(record: Mapping[str, Any], table: SweepTable) -> bytes:
    """The bytes of sweep.parquet, units as metadata; UsageError where pyarrow is not installed."""
    columns = [
        ParquetColumn(column.name, column.kind, column.unit, column.words, values)
        for column, values in zip(table.columns, table.values, strict=True)
    ]
    about = {"table": "sweep", **{key: record[key] for key in ("sweep", "deck", "mbla", "created")}}
    return parquet_bytes(columns, about)


FRAGILITY = "sweep_fragility.csv"
FURTHER = {"parquet": "sweep.parquet", "hdf5": "sweep.h5"}
"""the table in other forms, on request"""
PICTURES = ("png", "svg")


@dataclass(frozen=True)
class StudyResult:
    """What follows from the points of a sweep together.

    columns   : further ones of the table
    record    : further keys of sweep.json
    texts     : further files by name
    pictures  : what draws each, by the stem of its files
    lines     : for a terminal
    exit_code : of the sweep; None for that of every sweep
    """

    columns: Sequence[tuple[SweepColumn, Values]] = ()
    record: Mapping[str, Any] = field(default_factory=dict)
    texts: Mapping[str, str] = field(default_factory=dict)
    pictures: Mapping[str, Callable[[Path], None]] = field(default_factory=dict)
    lines: Sequence[str] = ()
    exit_code: int | None = None


def refuse_tables(folder: Path, further: Collection[str], *, replace: bool) -> None:
    """What ``write_tables`` would refuse, now and not after the work.

    Raises FileError where files of an earlier table are in the way, UsageError without what Parquet needs.
    """
    if "parquet" in further:
        require_parquet()
    names = (CSV, JSON, *(name for form, name in FURTHER.items() if form in further))
    OutputFolder(folder, "sweep", replace, secondary=True).refuse(*names)


def write_tables(
    folder: Path, record: Mapping[str, Any], table: SweepTable, further: Collection[str], study: StudyResult
) -> tuple[dict[str, Any], str]:
    """Write the files; the record with their names, as in sweep.json, and why there are no pictures, if that is so.

    further : keys of ``FURTHER``

    Raises FileError where a file cannot be written, UsageError without what Parquet needs.
    """
    remark = _without_pictures() if study.pictures else ""
    with OutputFolder(folder, "sweep", True, secondary=True) as out:
        out.write_text(CSV, csv_text([column.header for column in table.columns], table.values))
        for name, text in study.texts.items():
            out.write_text(name, text)
        for form, bytes_of in (("parquet", sweep_parquet), ("hdf5", sweep_hdf5)):
            if form in further:
                out.write_bytes(FURTHER[form], bytes_of(record, table))
        for stem, draw in () if remark else study.pictures.items():
            for ending in PICTURES:
                with out.writing(f"{stem}.{ending}") as path:
                    draw(path)
        written = {**record, "files": sorted({*out.names, JSON})}
        out.write_text(JSON, json.dumps(written, indent=1, ensure_ascii=False, allow_nan=False) + "\n")
    return written, remark


def _without_pictures() -> str:
    """Why there can be no pictures; empty where there can."""
    try:
        matplotlib_parts()
    except UsageError as error:
        return f"no pictures: {error}"
    return ""
