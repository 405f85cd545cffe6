"""Rows of figures: replaced where the same is measured again, added where anything else is."""

from __future__ import annotations

import csv
from pathlib import Path

import pytest

from tests.performance import recording
from tests.performance.recording import record


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setattr(recording, "RESULTS", tmp_path)
    monkeypatch.setattr(recording, "versions", lambda: "mbla 1")
    return tmp_path


def rows_of(folder: Path, benchmark: str) -> list[dict[str, str]]:
    with (folder / f"{benchmark}.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def growth(blocks: int, solver: float) -> dict[str, object]:
    return {"family": "wall", "flow_rule": "associative", "blocks": blocks, "solver": solver}


def test_what_is_measured_again_replaces_the_row_before(folder: Path) -> None:
    for blocks, solver in ((105, 1.0), (410, 4.0), (105, 1.5)):
        record("growth", growth(blocks, solver))
    assert [(row["blocks"], row["solver"]) for row in rows_of(folder, "growth")] == [("410", "4"), ("105", "1.5")]


def test_another_version_keeps_the_rows_of_the_one_before(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    record("growth", growth(105, 1.0))
    monkeypatch.setattr(recording, "versions", lambda: "mbla 2")
    record("growth", growth(105, 1.5))
    assert [(row["versions"], row["solver"]) for row in rows_of(folder, "growth")] == [
        ("mbla 1", "1"),
        ("mbla 2", "1.5"),
    ]


def test_a_row_of_other_columns_is_refused_and_the_file_stays(folder: Path) -> None:
    record("growth", growth(105, 1.0))
    before = (folder / "growth.csv").read_bytes()
    with pytest.raises(ValueError, match="has the columns"):
        record("growth", growth(105, 1.0) | {"clock": 2.0})
    assert (folder / "growth.csv").read_bytes() == before
    assert [path.name for path in folder.iterdir()] == ["growth.csv"]
