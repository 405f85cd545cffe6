"""``mbla interact`` from the command line: its files, its figures against those of runs, what it refuses."""

from __future__ import annotations

import csv
import json
import math
from collections.abc import Generator, Sequence
from pathlib import Path

import pytest

import mbla
from mbla.cli import main
from mbla.process.signals import Terminated
from mbla.sweeps import command
from mbla.sweeps.engine.engine import EngineOptions, outcomes_of
from mbla.sweeps.plan import Plan, PointOutcome, Task
from tests.sweeps.interaction.hand_made import written


def rows_of(folder: Path) -> list[dict[str, str]]:
    with (folder / "sweep.csv").open(newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_files_and_figures(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    deck = written(tmp_path)
    arguments = ["interact", str(deck), "--case", "push", "--directions", "3", "--set", "parameters.by=2", "--json"]
    assert main([*arguments, "--flow-rule", "non_associative", "--accuracy", "draft"]) == 0
    out, err = capsys.readouterr()
    printed, folder = json.loads(out), tmp_path / "block_interact.out"
    assert {path.name for path in folder.iterdir()} == {*printed["files"], "journal.csv"}
    assert {"sweep.csv", "sweep.json"} <= set(printed["files"])
    assert json.loads((folder / "sweep.json").read_text(encoding="utf-8")) == printed
    assert printed["interaction"]["least"]["angles"] == [0.0]
    rows = rows_of(folder)
    assert [row["azimuth [degree]"] for row in rows] == ["0.0", "120.0", "240.0"]
    settings = ["parameters.by=2", "analysis.flow_rule=non_associative", "analysis.accuracy=draft"]
    live = "[{acceleration: [-0.5, 0.8660254037844387, 0]}]"
    run = mbla.run(deck, set=[*settings, f"load_cases.push.live={live}"], cases="push", output=None)
    (case,) = run.records.cases
    assert case.solution.mechanics is not None
    assert float(rows[1]["load_factor"]) == pytest.approx(case.solution.mechanics.load_factor, rel=1e-9)
    assert float(rows[1]["factor_x"]) == pytest.approx(-0.5 * case.solution.mechanics.load_factor, rel=1e-9)
    assert float(rows[1]["kinematic_bound"]) == pytest.approx(case.checks.kinematic_bound, rel=1e-9)
    assert float(rows[0]["load_factor"]) == pytest.approx(0.5, rel=1e-6)
    assert "least load factor: 0.5 at 0 degrees" in " ".join(err.split())
    assert main(arguments) == 6
    assert "exists already; --force" in capsys.readouterr().err


@pytest.mark.long
def test_a_point_over_the_time_limit_is_told(tmp_path: Path) -> None:
    arguments = ["--case", "push", "--directions", "1", "--time-limit", "1e-9", "-q"]
    assert main(["interact", str(written(tmp_path)), *arguments]) == 7
    (row,) = rows_of(tmp_path / "block_interact.out")
    assert (row["status"], row["verified"], row["load_factor"]) == ("time_limit", "False", "")


@pytest.mark.long
@pytest.mark.parametrize(("error", "status"), [(KeyboardInterrupt, 130), (Terminated, 143)])
def test_an_interrupted_study_is_gone_on_with_by_the_same_command(
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
    error: type[BaseException],
    status: int,
) -> None:
    arguments = ["interact", str(written(tmp_path)), "--case", "push", "--directions", "4"]
    begun: list[int] = []

    def interrupted(options: EngineOptions, plan: Plan, tasks: Sequence[Task]) -> Generator[PointOutcome, None, None]:
        begun.append(len(tasks))
        for number, outcome in enumerate(outcomes_of(options, plan, tasks)):
            if number == 1 and len(begun) == 1:
                raise error
            yield outcome

    monkeypatch.setattr(command, "outcomes_of", interrupted)
    assert main(arguments) == status
    assert "1 finished point in the journal, the same command continues" in capsys.readouterr().err
    assert main(arguments) == 0
    assert begun == [4, 3]
    assert len(rows_of(tmp_path / "block_interact.out")) == 4


@pytest.mark.long
def test_the_points_of_two_loads_are_those_of_their_ratio(tmp_path: Path) -> None:
    """The flat block slides under either at 0.4 of its weight; the second load is twice as large."""
    settings = ("parameters.mu=0.4", "parameters.h=1", "load_cases.top.live=[{acceleration: [0, 2, 0]}]")
    arguments = ["--loads", "push", "top", "--directions", "3", "-q", *(f"--set={text}" for text in settings)]
    assert main(["interact", str(written(tmp_path)), *arguments]) == 0
    angles = [float(row["angle [degree]"]) for row in rows_of(tmp_path / "block_interact_push_top.out")]
    assert angles == pytest.approx([0.0, math.degrees(math.atan(0.5)), 90.0], rel=1e-5)
