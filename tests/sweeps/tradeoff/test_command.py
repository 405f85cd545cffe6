"""``mbla tradeoff`` on a small deck: every figure against that of a run, and what it refuses."""

from __future__ import annotations

import csv
import json
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import mbla
from mbla.cli import main
from tests.line import BLOCK

DECK = BLOCK.replace("  push:", "  lift: {live: [{acceleration: [0, 0, -1]}]}\n  push:")
SETTINGS = {
    "tolerance: 1e-5": ("analysis.tolerance=1e-5",),
    "tolerance: 1e-9": ("analysis.tolerance=1e-9",),
    "stronger": ("parameters.mu=0.9", "parameters.h=1"),
}


@dataclass(frozen=True)
class Written:
    """What the command printed and wrote."""

    deck: Path
    status: int
    printed: dict[str, Any]
    words: str
    rows: list[dict[str, str]]
    folder: Path


@pytest.fixture(scope="module")
def written(tmp_path_factory: pytest.TempPathFactory) -> Written:
    folder = tmp_path_factory.mktemp("tradeoff")
    deck = folder / "block.yaml"
    deck.write_text(DECK, encoding="utf-8")
    arguments = ["tradeoff", str(deck), "--json", "--knob", "analysis.tolerance=1e-5,1e-9"]
    arguments += ["--setting", f"stronger: {' '.join(SETTINGS['stronger'])}", "--setting", "path: analysis.solver=none"]
    capture = pytest.MonkeyPatch()
    printed, words = folder / "printed", folder / "words"
    with printed.open("w") as out, words.open("w") as err:
        capture.setattr("sys.stdout", out)
        capture.setattr("sys.stderr", err)
        status = main(arguments)
        capture.undo()
    with (folder / "block_tradeoff.out" / "sweep.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return Written(
        deck, status, json.loads(printed.read_text()), words.read_text(), rows, folder / "block_tradeoff.out"
    )


@pytest.mark.parametrize("name", SETTINGS)
def test_every_column_is_that_of_a_run(written: Written, name: str) -> None:
    (row,) = [row for row in written.rows if row["setting"] == name]
    run = mbla.run(written.deck, set=SETTINGS[name], cases="push")
    (case,) = run.records.cases
    assert row["push.status"] == case.status.value == "solved"
    assert row["push.verified"] == str(case.checks.verified)
    assert case.solution.mechanics is not None
    expected = {
        "load_factor": case.solution.mechanics.load_factor,
        "static_bound": case.checks.static_bound,
        "kinematic_bound": case.checks.kinematic_bound,
        "gap": case.checks.gap,
    }
    for column, value in expected.items():
        assert float(row[f"push.{column}"]) == pytest.approx(value, rel=1e-9, abs=1e-12), column
    assert int(row["push.iterations"]) == sum(program.iterations for program in case.solution.programs)
    assert 0.0 < float(row["push.time.solver [s]"]) < float(row["push.time.total [s]"])


def test_another_model_is_told_from_an_error(written: Written) -> None:
    """The lower and rougher block rests on friction of 0.9 instead of turning over at 0.5."""
    rows = {row["setting"]: row for row in written.rows}
    assert float(rows["stronger"]["push.load_factor"]) == pytest.approx(0.9, rel=1e-6)
    assert float(rows["stronger"]["push.distance"]) == pytest.approx(0.8, rel=1e-5)
    assert rows["stronger"]["push.front"] == "False"
    assert float(rows["tolerance: 1e-9"]["push.distance"]) < 1e-8
    assert [line for line in written.words.splitlines() if "stronger" in line and line.endswith("  other model")]


def test_a_load_case_that_nothing_brings_down(written: Written) -> None:
    rows = [row for row in written.rows if row["state"] == "done"]
    assert {row["lift.status"] for row in rows} == {"unbounded"}
    assert {row["lift.distance"] for row in rows} == {"0.0"}
    assert {row["lift.load_factor"] for row in rows} == {""}


def test_record_files_and_words(written: Written) -> None:
    assert written.status == written.printed["exit_code"] == 0
    record = written.printed["tradeoff"]
    (told,) = [each for each in record["settings"] if each["name"] == "path"]
    assert told["unfit"] == "must be auto, mbla or clarabel"
    assert "path: must be auto" in written.words
    assert [case["name"] for case in record["cases"]] == ["lift", "push"]
    assert {case["reference"] for case in record["cases"]} == {"accuracy: reference"}
    assert record["advice"]["rung"]["name"] in ("accuracy: reference", "tolerance: 1e-5", "tolerance: 1e-9")
    assert record["advice"]["sentence"] in " ".join(written.words.split())
    names = {path.name for path in written.folder.iterdir()}
    assert {*written.printed["files"], "journal.csv"} == names
    assert {"sweep.csv", "sweep.json", "tradeoff_push.png"} <= names
    assert json.loads((written.folder / "sweep.json").read_text(encoding="utf-8")) == written.printed


def test_an_earlier_study_is_refused_before_anything_is_measured(
    written: Written, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(["tradeoff", str(written.deck)]) == 6
    assert "exists already; --force" in capsys.readouterr().err


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "block.yaml"
    path.write_text(BLOCK, encoding="utf-8")
    return path


def test_a_time_limit_that_ends_before_the_reference(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["tradeoff", str(deck), "--time-limit", "0.001"]) == 7
    told = " ".join(capsys.readouterr().out.split())
    assert "not run: the time limit was over" in told
    assert "No setting can be advised: no setting is verified for push." in told


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["--set", "analysis.accuracy=best"], 3, "analysis.accuracy = best"),
        (["--setting", "a: x.y=1", "--setting", "a: x.y=2"], 2, "two settings of that name"),
        (["--set", "load_cases.push={modes: 3}", "--case", "push"], 2, "load case push: it vibrates, without"),
    ],
)
def test_refusals(
    deck: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], status: int, words: str
) -> None:
    assert main(["tradeoff", str(deck), *arguments]) == status
    assert words in capsys.readouterr().err
    assert not deck.with_name("block_tradeoff.out").exists()


@pytest.mark.long
def test_without_the_extra_for_pictures_the_rest_is_written(
    deck: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(["tradeoff", str(deck), "--knob", "analysis.tolerance=1e-6"]) == 0
    assert "mbla: no pictures: " in capsys.readouterr().err
    names = sorted(path.name for path in deck.with_name("block_tradeoff.out").iterdir())
    assert names == ["journal.csv", "sweep.csv", "sweep.json"]
