"""Files of ``mbla export``: what pandas reads is what the tables hold; nothing is replaced unasked."""

from __future__ import annotations

import csv
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pandas
import pytest
from pyarrow import parquet

from mbla.cli import main
from mbla.deck.units import Units
from mbla.process.run_options import RunOptions
from mbla.results.hdf5.result_file import write_results_hdf5
from mbla.results.results import Results
from mbla.results.tables.tables import TABLES, export_results, tables_of
from mbla.run import run
from tests.line import BLOCK
from tests.results.synthetic import full_results


@pytest.fixture(scope="module")
def results() -> Results:
    """Units that are not the default, and a message that a careless writer would break."""
    full = full_results()
    message = 'says "no",\nsays µ, ends; = 1'
    notices = tuple(replace(notice, message=message) for notice in full.notices)
    assembly = replace(full.assembly, model=replace(full.model, units=Units("mm", "kN", "t")))
    return replace(full, assembly=assembly, notices=notices)


@pytest.fixture(scope="module")
def folder(results: Results, tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("tables")
    export_results(results, folder, "tower", parquet=True)
    return folder


def test_every_table_is_there_in_both_formats(folder: Path) -> None:
    names = {path.name for path in folder.iterdir()}
    assert names == {f"tower_{name}.{suffix}" for name in TABLES for suffix in ("csv", "parquet")}


@pytest.mark.parametrize("name", TABLES)
def test_csv_reads_back_to_the_same_bits(results: Results, folder: Path, name: str) -> None:
    table = tables_of(results)[name]
    read = pandas.read_csv(folder / f"tower_{name}.csv", engine="python", dtype=str)  # its own numbers lose bits
    assert tuple(read.columns) == table.header
    assert len(read) == len(table)
    for column, head, values in zip(table.kind.columns, table.header, table.values, strict=True):
        back = read[head]
        if column.kind == "text":
            assert ["" if pandas.isna(cell) else cell for cell in back] == values.tolist()
        else:
            expected = np.ma.filled(values.astype(float), np.nan)
            named = {"True": "1", "False": "0", "": "nan"}
            figures = [float(named.get(cell, cell)) for cell in back.fillna("")]
            assert np.array_equal(figures, expected, equal_nan=True), column.name


def test_csv_is_rfc_4180(folder: Path) -> None:
    data = (folder / "tower_notices.csv").read_bytes()
    assert data.startswith(b"severity,identifier,message,case\r\n")
    assert b'"says ""no"",\nsays \xc2\xb5, ends; = 1",\r\n' in data
    with (folder / "tower_blocks.csv").open(encoding="utf-8", newline="") as stream:
        rows = list(csv.reader(stream, strict=True))
    assert {len(row) for row in rows} == {len(TABLES["blocks"].columns)}
    assert "nan" not in (cell for row in rows for cell in row)


@pytest.mark.parametrize("name", TABLES)
def test_parquet_reads_back_with_units(results: Results, folder: Path, name: str) -> None:
    table, path = tables_of(results)[name], folder / f"tower_{name}.parquet"
    read = pandas.read_parquet(path)
    assert read.attrs == {"units": table.unit_of, "meanings": table.meaning_of}
    pandas.testing.assert_frame_equal(read, table.to_pandas(), check_dtype=False, check_column_type=False)
    schema = parquet.read_schema(path)
    for column in table.kind.columns:
        notes = schema.field(column.name).metadata
        assert notes[b"unit"].decode() == table.unit_of[column.name]
        assert notes[b"description"].decode() == column.words
    assert schema.metadata[b"deck"] == b"tower.yaml"


def test_the_command_writes_beside_the_result(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    path = tmp_path / "tower.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    assert main(["export", str(path), "--table", "cases,points"]) == 0
    assert capsys.readouterr().out.split() == [str(tmp_path / f"tower_{name}.csv") for name in ("cases", "points")]
    (tmp_path / "tower_cases.csv").write_text("of mine\n", encoding="utf-8")
    assert main(["export", str(path), "--table", "cases"]) == 6
    assert main(["export", str(path), "--table", "cases", "--force"]) == 0
    assert main(["export", str(path), "--table", "cases"]) == 0
    assert main(["export", str(path), "--table", "beams", "--force"]) == 2
    assert main(["export", str(path), "--case", "beams", "--force"]) == 2
    assert main(["export", str(tmp_path / "none.h5")]) == 6
    assert path.exists()


def test_the_curve_that_the_run_wrote_is_not_in_the_way(tmp_path: Path) -> None:
    """It is the table of that name, and stays as it is."""
    (tmp_path / "deck.yaml").write_text(BLOCK, encoding="utf-8")
    pushed = ("parameters.mu=0.8", "load_cases.push.pushover={step: 0.1, until: 0.2, error: true}")
    run(tmp_path / "deck.yaml", RunOptions(folder=tmp_path, overrides=pushed))
    before = (curve := tmp_path / "deck_curve.csv").stat()
    assert main(["export", str(tmp_path / "deck.h5")]) == 0
    assert (curve.stat().st_ino, curve.stat().st_mtime_ns) == (before.st_ino, before.st_mtime_ns)
    assert (tmp_path / "deck_blocks.csv").exists()


def test_csv_needs_no_extra(tmp_path: Path) -> None:
    """Without pandas and pyarrow CSV is written, and Parquet says what to install."""
    path = tmp_path / "tower.h5"
    path.write_bytes(write_results_hdf5(full_results()))
    code = (
        "import sys\n"
        "sys.modules.update(pandas=None, pyarrow=None)\n"
        "from mbla.cli import main\n"
        "print(main(['export', sys.argv[1]]), main(['export', sys.argv[1], '--parquet']))"
    )
    run = subprocess.run([sys.executable, "-c", code, str(path)], capture_output=True, text=True, check=True)
    assert run.stdout.splitlines()[-1] == "0 2"
    assert "pip install 'mbla[tables]'" in run.stderr
    assert not list(tmp_path.glob("*.parquet"))
