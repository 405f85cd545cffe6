"""``mbla interact`` from the command line: its files, its figures against those of runs, what it refuses."""

from __future__ import annotations

import csv
import json
from pathlib import Path

import pytest

import mbla
from mbla.cli import main
from tests.studies.interact.hand_made import solved, written


def test_files_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = written(tmp_path)
    arguments = ["interact", str(deck), "--case", "push", "--directions", "3", "--set", "parameters.by=2", "--json"]
    assert main([*arguments, "--flow-rule", "non_associative", "--accuracy", "draft"]) == 0
    out, err = capsys.readouterr()
    printed = json.loads(out)
    assert {path.name for path in (tmp_path / "block.out").iterdir()} == set(printed["files"])
    assert {"block_interact.csv", "block_interact.json"} <= set(printed["files"])
    stored = json.loads((tmp_path / "block.out" / "block_interact.json").read_text(encoding="utf-8"))
    assert stored == printed
    assert printed["flow_rule"] == "non_associative"
    assert printed["least"]["angles"] == [0.0]
    with (tmp_path / "block.out" / "block_interact.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["azimuth [degree]"] for row in rows] == ["0.0", "120.0", "240.0"]
    settings = ["parameters.by=2", "analysis.flow_rule=non_associative", "analysis.accuracy=draft"]
    live = "[{acceleration: [-0.5, 0.8660254037844387, 0]}]"
    run = mbla.run(deck, set=[*settings, f"load_cases.push.live={live}"], cases="push", output=None)
    (case,) = run.records.cases
    assert case.solution.mechanics is not None
    assert float(rows[1]["load_factor"]) == pytest.approx(case.solution.mechanics.load_factor, rel=1e-9)
    assert float(rows[1]["kinematic_bound"]) == pytest.approx(case.checks.kinematic_bound, rel=1e-9)
    assert "least load factor: 0.5 at azimuth 0 degrees" in " ".join(err.split())
    assert main(arguments) == 6
    assert "exists already; --force" in capsys.readouterr().err


def test_a_point_that_cannot_be_asked_fails_alone(tmp_path: Path) -> None:
    """At 135 degrees a load and the same the other way cancel each other: exit status of the deck that this is."""
    same = ["load_cases.named.live=[{acceleration: [1, 0, 0]}]"]
    study = solved(tmp_path, same, loads=("push", "named"), directions=3, start=90.0, end=180.0)
    assert [point.answered for point in study.points] == [True, False, True]
    assert "cancel each other" in study.points[1].reason
    assert study.exit_code == 3


@pytest.mark.parametrize(
    ("arguments", "status", "words"),
    [
        (["--set", "analysis.accuracy=best"], 3, "analysis.accuracy = best"),
        (["--case", "pull"], 2, "no load case pull"),
        ([], 2, "several load cases"),
    ],
)
def test_refusals_write_nothing(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], status: int, words: str
) -> None:
    assert main(["interact", str(written(tmp_path)), *arguments]) == status
    assert words in capsys.readouterr().err
    assert not (tmp_path / "block.out").exists()


@pytest.mark.long
def test_two_processes_give_the_same_table(tmp_path: Path) -> None:
    pytest.importorskip("distributed")
    deck = written(tmp_path)
    tables = []
    for workers in ("1", "2"):
        out = tmp_path / workers
        assert (
            main(["interact", str(deck), "--case", "top", "--directions", "6", "-j", workers, "-o", str(out), "-q"])
            == 0
        )
        with (out / "block_interact.csv").open(newline="", encoding="utf-8") as file:
            tables.append([{k: v for k, v in row.items() if k != "time [s]"} for row in csv.DictReader(file)])
    assert tables[0] == tables[1]
