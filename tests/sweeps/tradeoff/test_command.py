"""``mbla tradeoff`` on a small deck: every figure against that of a run, and what it refuses."""

from __future__ import annotations

import csv
import json
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import pytest

import mbla
from mbla.cli import main
from mbla.results.outcome import law_residual
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
    with (folder / "block.out" / "block_tradeoff.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    return Written(deck, status, json.loads(printed.read_text()), words.read_text(), rows, folder / "block.out")


@pytest.mark.parametrize("name", SETTINGS)
def test_every_column_is_that_of_a_run(written: Written, name: str) -> None:
    (row,) = [row for row in written.rows if (row["case"], row["setting"]) == ("push", name)]
    run = mbla.run(written.deck, set=SETTINGS[name], cases="push")
    (case,) = run.records.cases
    assert row["status"] == case.status.value == "solved"
    assert row["verified"] == str(case.checks.verified)
    assert case.solution.mechanics is not None
    expected = {
        "load_factor": case.solution.mechanics.load_factor,
        "lower_bound": case.checks.static_bound,
        "upper_bound": case.checks.kinematic_bound,
        "accuracy": case.checks.gap,
        "residual": law_residual(case.checks),
    }
    for column, value in expected.items():
        assert float(row[column]) == pytest.approx(value, rel=1e-9, abs=1e-12), column
    assert int(row["programs"]) == len(case.solution.programs)
    assert int(row["iterations"]) == sum(program.iterations for program in case.solution.programs)
    assert row["solvers"] == " ".join(dict.fromkeys(p.solver for p in case.solution.programs if p.solver))
    assert 0.0 < float(row["solver_time [s]"]) < float(row["time [s]"])
    assert float(row["processor_time [s]"]) > 0.0
    assert 0.0 <= float(row["memory [MB]"]) < 100.0  # of one block: imports are not charged


def test_another_model_is_told_from_an_error(written: Written) -> None:
    """The lower and rougher block rests on friction of 0.9 instead of turning over at 0.5."""
    rows = {row["setting"]: row for row in written.rows if row["case"] == "push"}
    assert rows["stronger"]["other_model"] == "parameters, joints, blocks"
    assert float(rows["stronger"]["load_factor"]) == pytest.approx(0.9, rel=1e-6)
    assert float(rows["stronger"]["distance"]) == pytest.approx(0.8, rel=1e-5)
    assert rows["stronger"]["front"] == "False"
    assert float(rows["tolerance: 1e-9"]["distance"]) < 1e-8
    assert "other models (parameters, joints, blocks), whose difference is no error:" in written.words


def test_a_load_case_that_nothing_brings_down(written: Written) -> None:
    rows = [row for row in written.rows if row["case"] == "lift" and row["end"] == "done"]
    assert {row["status"] for row in rows} == {"unbounded"}
    assert {row["load_factor"] for row in rows} == {""}
    assert {row["distance"] for row in rows} == {"0.0"}
    assert "all are held against accuracy: reference: unbounded" in written.words


def test_a_setting_that_the_deck_refuses_is_told(written: Written) -> None:
    (told,) = [each for each in written.printed["settings"] if each["name"] == "path"]
    assert told["end"] == "unfit"
    assert told["reason"] == "must be auto, mbla, clarabel or highs"
    assert "path: does not apply" in written.words


def test_record_and_files(written: Written) -> None:
    assert written.status == 0
    assert written.printed["exit_code"] == 0
    assert [case["name"] for case in written.printed["cases"]] == ["lift", "push"]
    assert {case["reference"] for case in written.printed["cases"]} == {"accuracy: reference"}
    assert written.printed["advice"]["setting"] in ("accuracy: reference", "tolerance: 1e-5", "tolerance: 1e-9")
    assert written.printed["advice"]["sentence"] in " ".join(written.words.split())
    names = {path.name for path in written.folder.iterdir()}
    assert set(written.printed["files"]) == names
    assert {"block_tradeoff.csv", "block_tradeoff.json", "block_tradeoff_push.png"} <= names
    stored = json.loads((written.folder / "block_tradeoff.json").read_text(encoding="utf-8"))
    assert stored == written.printed


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
    assert "No setting can be advised: there is no reference for push." in told


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["--set", "analysis.accuracy=best"], 3, "analysis.accuracy = best"),
        (["--case", "pull"], 2, "no load case pull"),
        (["--knob", "analysis.tolerance"], 2, "must be KEY.PATH=VALUE"),
        (["--setting", "a: x.y=1", "--setting", "a: x.y=2"], 2, "two settings of that name"),
    ],
)
def test_refusals(
    deck: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], status: int, words: str
) -> None:
    assert main(["tradeoff", str(deck), *arguments]) == status
    assert words in capsys.readouterr().err
    assert not deck.with_suffix(".out").exists()


def test_a_solver_that_takes_no_cones_does_not_apply(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = tmp_path / "block.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    arguments = ["--set", "analysis.reductions=false", "--setting", "highs: analysis.solver=highs"]
    assert main(["tradeoff", str(deck), *arguments]) == 0
    told = " ".join(capsys.readouterr().out.split())
    assert "highs: does not apply: analysis.solver = highs solves linear programs only" in told
    record = json.loads((tmp_path / "block.out" / "block_tradeoff.json").read_text(encoding="utf-8"))
    assert {run["name"]: run["end"] for run in record["settings"]} == {"accuracy: reference": "done", "highs": "unfit"}
