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
from mbla.sweeps.interaction.words import conclusions
from mbla.sweeps.plan import Outcome, Plan, Task
from tests.sweeps.interaction.hand_made import ThisProcess, solved, written


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


def test_a_point_over_the_time_limit_is_told(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--case", "push", "--directions", "1", "--time-limit", "1e-9", "--json"]
    assert main(["interact", str(written(tmp_path)), *arguments]) == 7
    (point,) = json.loads(capsys.readouterr().out)["points"]
    assert (point["status"], point["verified"], point["load_factor"]) == ("time_limit", False, None)


class Interrupted(ThisProcess):
    """A signal comes after the first points, Ctrl-C unless it is another."""

    def __init__(self, after: int, error: type[BaseException] = KeyboardInterrupt) -> None:
        self.after, self.error = after, error

    def _solved(self, plan: Plan, tasks: Sequence[Task]) -> Generator[Outcome, None, None]:
        for number, outcome in enumerate(super()._solved(plan, tasks)):
            if number == self.after:
                raise self.error
            yield outcome


@pytest.mark.parametrize("earlier", [False, True])
def test_an_interrupted_study_is_shown_and_never_written_over_an_earlier_one(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, earlier: bool
) -> None:
    arguments = ["interact", str(written(tmp_path)), "--case", "push", "--directions", "4", "--force"]
    table = tmp_path / "block.out" / "block_interact.csv"
    if earlier:
        assert main(arguments) == 0
    before = table.read_bytes() if earlier else b""
    monkeypatch.setattr("mbla.sweeps.interaction.study.engine_for", lambda _: Interrupted(2))
    assert main(arguments) == 130
    out, err = capsys.readouterr()
    assert "no verified answer at 0, 90 degrees: not solved: interrupted before" in " ".join(out.split())
    assert "interrupted: here is what was found until then" in err
    assert ("the files of the earlier study are left as they are" in err) == earlier
    assert (table.read_bytes() == before) == earlier


@pytest.mark.parametrize("after", [0, 1])
def test_an_interruption_before_the_angles_are_known_writes_nothing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, after: int
) -> None:
    """Of two loads each is solved alone first."""
    arguments = ["interact", str(written(tmp_path)), "--loads", "push", "top", "--set", "parameters.mu=0.4", "-q"]
    for error, status in ((KeyboardInterrupt, 130), (Terminated, 143)):
        engine = Interrupted(after, error)
        monkeypatch.setattr("mbla.sweeps.interaction.study.engine_for", lambda _, engine=engine: engine)
        assert main(arguments) == status
        assert not (tmp_path / "block.out").exists()


def test_the_points_of_two_loads_are_those_of_their_ratio(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The flat block slides under either at 0.4 of its weight; the second load is twice as large."""
    monkeypatch.setattr("mbla.sweeps.interaction.study.engine_for", lambda _: Interrupted(9))
    settings = [
        "--set",
        "parameters.mu=0.4",
        "--set",
        "parameters.h=1",
        "--set",
        "load_cases.top.live=[{acceleration: [0, 2, 0]}]",
    ]
    arguments = ["--loads", "push", "top", "--directions", "3", "--json", *settings]
    assert main(["interact", str(written(tmp_path)), *arguments]) == 0
    points = json.loads(capsys.readouterr().out)["points"]
    assert [point["angle"] for point in points] == pytest.approx([0.0, math.degrees(math.atan(0.5)), 90.0], rel=1e-5)
    assert [point["load_factor"] for point in points][::2] == pytest.approx([0.4, 0.2], rel=1e-5)


def test_vertical_parts_leave_no_domain_and_that_is_told(tmp_path: Path) -> None:
    study = solved(tmp_path, case="slanted", directions=2)
    assert study.domain is None
    told = "no safe domain is drawn: with vertical parts the loads do not lie in one plane through the dead load"
    assert told in conclusions(study)
