"""The table of a sweep and its files, read back by mbla, csv, pandas and xarray; the keys of its record."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Callable, Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pandas
import pytest
import xarray

from mbla.errors import FileError, Notice, UsageError
from mbla.results.record.json_values import json_line
from mbla.results.record.scene import Values
from mbla.sweeps.fragility import Asked, fragility_csv, fragility_of
from mbla.sweeps.fragility_curve import fragility_curves
from mbla.sweeps.tables.sweep_json import SWEEP_RECORD, read_sweep_table, sweep_json
from mbla.sweeps.tables.sweep_table import SweepTable, sweep_table
from mbla.sweeps.tables.write_tables import FRAGILITY, FURTHER, StudyResult, refuse_tables, write_tables
from tests.sweeps.tables.synthetic import (
    ABOUT,
    CREATED,
    FRICTION,
    LEFT_OUT,
    THICKNESS,
    design,
    keys,
    outcomes,
    record,
    table,
)


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("sweep") / "wall.out"
    write_tables(folder, record(), table(), FURTHER, StudyResult())
    return folder


def same(one: Values, other: Values) -> bool:
    """Equal values, missing where the other's are."""
    kinds = one.dtype == other.dtype and isinstance(one, np.ma.MaskedArray) == isinstance(other, np.ma.MaskedArray)
    masks = np.array_equal(np.ma.getmaskarray(one), np.ma.getmaskarray(other))
    plain = one.dtype.kind == "f"
    return bool(kinds and masks and np.array_equal(np.ma.filled(one, 0), np.ma.filled(other, 0), equal_nan=plain))


def same_tables(one: SweepTable, other: SweepTable) -> bool:
    """Equal in all that files hold of a table."""
    values = all(same(a, b) for a, b in zip(one.values, other.values, strict=True))
    plain = ("title", "columns", "dimensions", "samples", "sampling")
    others = all(getattr(one, name) == getattr(other, name) for name in plain)
    return values and others and np.array_equal(one.position, other.position)


def test_rows_stand_in_the_order_of_the_design_whatever_order_outcomes_came_in() -> None:
    found = table()
    assert found["point"].tolist() == [1, 2, 3, 4, 5]
    assert found["t"].tolist() == [*THICKNESS, *THICKNESS[:2]]
    assert found["state"].tolist() == ["done", "done", "done", "failed", "done"]
    backwards = dict(reversed(list(outcomes().items())))
    other = sweep_table(found.title, design(), found.of_role("result"), backwards, keys())
    assert same_tables(found, other)


def test_points_of_one_key_share_their_outcome() -> None:
    one = outcomes()["key1"]
    found = sweep_table("", design(), table().of_role("result"), {"same": one}, ["same"] * 5)
    assert found["load_factor"].tolist() == [0.1 + 0.2] * 5


# --- files --------------------------------------------------------------------------------------------------------


def test_the_csv_has_units_and_every_bit(folder: Path) -> None:
    text = (folder / "sweep.csv").read_bytes().decode("utf-8")
    header, *rows = list(csv.reader(text.splitlines(keepends=True)))
    assert header[:3] == ["point", "mu", "t [m]"]
    assert "model.total_weight [kN]" in header
    assert header[-1] == "seconds [s]"
    assert [float(row[2]) for row in rows] == [*THICKNESS, *THICKNESS[:2]]
    assert rows[0][header.index("load_factor")] == "0.30000000000000004"
    assert rows[1][header.index("load_factor")] == ""
    assert rows[1][header.index("reason")] == 'a block, "the top", falls\nby itself'
    assert text.count("\r\n") == 6


@pytest.mark.parametrize("name", ["", "sweep.csv", "sweep.json"])
def test_the_table_is_read_back_from_its_folder_or_either_file(folder: Path, name: str) -> None:
    assert same_tables(read_sweep_table(folder / name), table())


def test_pandas_reads_both_tables(folder: Path) -> None:
    frame = pandas.read_parquet(folder / "sweep.parquet")
    assert frame.attrs["units"]["t"] == "m"
    assert frame.attrs["units"]["model.total_weight"] == "kN"
    assert frame.attrs["meanings"]["mu"] == "friction"
    assert frame["load_factor"].isna().tolist() == [False, True, False, True, False]
    assert frame.groupby("mu")["state"].count().tolist() == [3, 2]
    text = pandas.read_csv(folder / "sweep.csv", dtype=str)  # numbers of its own lose bits in some versions
    assert text["t [m]"].astype(float).tolist() == frame["t"].tolist()
    assert text["load_factor"].astype(float).equals(frame["load_factor"])


def test_xarray_opens_the_file_along_the_axes_of_the_design(folder: Path) -> None:
    with xarray.open_dataset(folder / "sweep.h5", engine="h5netcdf") as data:
        assert dict(data.sizes) == {"mu": 2, "sobol": 3}
        assert data.indexes["mu"].tolist() == list(FRICTION)
        assert set(data.coords) == {"mu", "sobol", "t", "seed"}
        assert data["t"].dims == ("sobol",)
        assert data["t"].values.tolist() == list(THICKNESS)
        assert data["t"].attrs["units"] == "m"
        factors = data["load_factor"]
        assert factors.dims == ("mu", "sobol")
        assert factors.sel(mu=0.5).isel(sobol=0) == 0.1 + 0.2
        assert np.isnan(factors.values[LEFT_OUT])
        assert np.isnan(factors.values).sum() == 3  # left out, no equilibrium, failed
        assert factors.attrs["long_name"].startswith("load factor")
        assert data["model.total_weight"].attrs["units"] == "kN"
        assert data["time.solve_standing"].attrs["column"] == "time.solve/standing"
        assert data["state"].values.tolist() == [["done", "done", "done"], ["failed", "done", ""]]
        hinges = data["mechanism.hinges"].values
        assert np.isnan(hinges).tolist() == [[False, True, False], [True, False, True]]
        assert hinges[0, 0] == 4
        verified = data["verified"].values
        assert (verified[0, 0], verified[1, 0], np.isnan(verified[LEFT_OUT])) == (1, 0, True)
        assert data.attrs["filetype"] == "mbla sweep"
        assert (data.attrs["complete"], data.attrs["created"], data.attrs["title"]) == (1, CREATED, "Wände")


def test_files_appear_together_and_nothing_is_overwritten_unasked(folder: Path, tmp_path: Path) -> None:
    told = json.loads((folder / "sweep.json").read_text(encoding="utf-8"))
    names = ["sweep.csv", "sweep.h5", "sweep.json", "sweep.parquet"]
    assert told["files"] == sorted(path.name for path in folder.iterdir()) == names
    (tmp_path / "sweep.h5").write_bytes(b"mine")
    with pytest.raises(FileError, match=r"sweep\.h5: exists already"):
        refuse_tables(tmp_path, FURTHER, replace=False)
    write_tables(tmp_path, record(), table(), FURTHER, StudyResult())
    assert same_tables(read_sweep_table(tmp_path), table())


def test_probabilities_stand_in_the_record_and_in_a_file_of_their_own(tmp_path: Path) -> None:
    found = fragility_of(table(), Asked("load_factor", (0.2,), (), table().samples, table().sampling))
    study = StudyResult(texts={FRAGILITY: fragility_csv(found, table())})
    told, _ = write_tables(tmp_path, record(fragility=found), table(), (), study)
    assert [each["at"] for each in told["fragility"]] == [{"mu": 0.5}, {"mu": 0.7}]
    assert "sweep_fragility.csv" in told["files"]
    frame = pandas.read_csv(tmp_path / "sweep_fragility.csv")
    assert frame["below"].tolist() == [2, 0]  # that which does not stand, and the tiny one
    assert frame["unknown"].tolist() == [0, 1]


def test_parquet_without_its_extra_is_refused_before_the_work(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    with pytest.raises(UsageError, match=r"pip install 'mbla\[tables\]'"):
        refuse_tables(tmp_path, {"parquet"}, replace=False)


# --- files that are none ------------------------------------------------------------------------------------------


def _record(change: Callable[[dict], object]) -> Callable[[Path], None]:  # type: ignore[type-arg]
    def apply(folder: Path) -> None:
        path = folder / "sweep.json"
        record = json.loads(path.read_text(encoding="utf-8"))
        change(record)
        path.write_text(json.dumps(record), encoding="utf-8")

    return apply


def _csv(change: Callable[[str], str]) -> Callable[[Path], None]:
    def apply(folder: Path) -> None:
        path = folder / "sweep.csv"
        path.write_bytes(change(path.read_bytes().decode("utf-8")).encode("utf-8"))

    return apply


def _without_state(folder: Path) -> None:
    """A column of every table has another name, in both files."""
    _record(lambda record: next(c for c in record["columns"] if c["name"] == "state").update(name="stat"))(folder)
    _csv(lambda text: text.replace(",state,", ",stat,", 1))(folder)


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (_without_state, "columns are missing"),
        (lambda folder: (folder / "sweep.csv").write_bytes(b"point\xff"), ".*utf-8"),
        (_csv(lambda text: text + '"point'), "unexpected end of data"),
        (lambda folder: (folder / "sweep.csv").unlink(), r"sweep\.csv: there is none"),
        (lambda folder: (folder / "sweep.json").unlink(), r"sweep\.json: there is none"),
        (lambda folder: (folder / "sweep.json").write_text("{"), "are no table of a sweep"),
        (lambda folder: (folder / "sweep.json").write_text("{}"), "are no table of a sweep"),
        (_record(lambda record: record.update(version=99)), "version 99, this mbla reads version"),
        (_record(lambda record: record["columns"].pop()), "its columns differ"),
        (_record(lambda record: record["columns"][0].update(kind="number")), "no table of a sweep: number"),
        (_record(lambda record: record["design"].update(places=None)), "5 rows, 6 points"),
        (_record(lambda record: record["design"].update(places=[0, 1, 2, 3, 99])), "no table"),
        (_csv(lambda text: text.replace("t [m]", "t [mm]")), "its columns differ"),
        (_csv(lambda text: text + text.splitlines(keepends=True)[-1]), "6 rows, 5 points"),
        (_csv(lambda text: text.replace("0.30000000000000004", "0,3", 1)), "its rows are not as long as each other"),
        (_csv(lambda text: text.replace("0.30000000000000004", "a third", 1)), "row 2: load_factor = 'a third'"),
    ],
)
def test_a_file_that_is_no_table_is_refused_in_one_line(
    tmp_path: Path, change: Callable[[Path], None], words: str
) -> None:
    write_tables(tmp_path, record(), table(), (), StudyResult())
    read_sweep_table(tmp_path)
    change(tmp_path)
    with pytest.raises(FileError, match=words) as caught:
        read_sweep_table(tmp_path)
    assert "\n" not in str(caught.value)


TYPES: dict[str, Any] = {
    "string": str,
    "number": float,
    "integer": int,
    "boolean": bool,
    "object": dict,
    "list": list,
    "any": object,
}


def paths(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """Every key path with its value; ``*`` where names are those of parameters."""
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, inside in value.items():
            name = "*" if path.endswith(".at") else key
            yield from paths(inside, f"{path}.{name}" if path else name)
    if isinstance(value, list):
        for item in value:
            yield from paths(item, f"{path}[]")


def test_keys_and_types_of_the_record() -> None:
    full = table()
    asked = Asked("load_factor", (0.2, 0.4), (0.3,), full.samples, full.sampling)
    found, curves = fragility_of(full, asked), fragility_curves(full, replace(asked, samples="", over="mu"))
    made = sweep_json(full, **ABOUT, notices=(Notice("warning", "some", "words"),))
    told = json.loads(json_line(made | {"fragility": found, "fragility_curves": curves, "files": ["sweep.csv"]}))
    described = {key.path: key for key in SWEEP_RECORD}
    seen = set()
    for path, value in paths(told):
        assert path in described, path
        kind = described[path].kind
        assert (value is None and kind.endswith("?")) or isinstance(value, TYPES[kind.rstrip("?")]), path
        seen.add(path)
    assert seen == set(described)


def test_a_table_shows_itself() -> None:
    lines = repr(table()).splitlines()
    assert lines[0] == "Wände: 5 points"
    assert lines[1].split()[:5] == ["point", "mu", "t", "[m]", "seed"]
    assert [line.split()[0] for line in lines[2:7]] == ["1", "2", "3", "4", "5"]
    assert all(len(line) < 100 for line in lines[:-1])
    html = table()._repr_html_()
    assert html.count("<tr>") == 6
    assert "<td>no_equilibrium</td>" in html
    assert "not shown: " in lines[-1]
