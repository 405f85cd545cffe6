"""A study left from the keyboard: what was measured is told and written, and no earlier study is lost for it."""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from mbla.process.signals import Terminated
from mbla.sweeps.measure.measuring import ChildRun
from mbla.sweeps.tradeoff import ladder_run
from tests.line import BLOCK
from tests.sweeps.tradeoff.hand_made import measured


class LeftAfter:
    """In place of the process that measures: some tasks are answered, the next is interrupted."""

    answered = 1
    error: type[BaseException] = KeyboardInterrupt

    def __init__(self) -> None:
        self.tasks = 0

    def __enter__(self) -> LeftAfter:
        return self

    def __exit__(self, *what: object) -> None:
        return None

    def run(self, *_: Any) -> ChildRun:
        self.tasks += 1
        if self.tasks > self.answered:
            raise self.error
        return ChildRun((measured(0.5, 1.0),), "done")


@pytest.fixture
def command(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> list[str]:
    monkeypatch.setattr(ladder_run, "MeasuringProcess", LeftAfter)
    deck = tmp_path / "block.yaml"
    deck.write_text(BLOCK, encoding="utf-8")
    return ["tradeoff", str(deck), "--knob", "analysis.tolerance=1e-6,1e-7,1e-8"]


def test_what_was_measured_is_told_and_written(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main([*command, "--json"]) == 130
    told = capsys.readouterr()
    record = json.loads(told.out)
    ends = {setting["name"]: setting["end"] for setting in record["settings"]}
    assert list(ends.values()) == ["done", "interrupted", "interrupted", "interrupted"]
    assert record["exit_code"] == 130
    assert "mbla: interrupted: here is what was found until then" in told.err
    words = " ".join(told.err.split())
    assert "tolerance: 1e-6: interrupted before its end" in words
    assert "tolerance: 1e-7, tolerance: 1e-8: not run: interrupted before" in words
    with Path(command[1]).with_suffix(".out").joinpath("block_tradeoff.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [row["load_factor"] for row in rows] == ["0.5", "", "", ""]


def test_an_earlier_study_is_not_replaced_by_half_a_one(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    earlier = Path(command[1]).with_suffix(".out") / "block_tradeoff.csv"
    earlier.parent.mkdir()
    earlier.write_text("earlier", encoding="utf-8")
    assert main([*command, "--force"]) == 130
    told = capsys.readouterr()
    assert "the files of the earlier study are left as they are" in told.err
    assert "accuracy: reference" in told.out
    assert [path.name for path in earlier.parent.iterdir()] == [earlier.name]
    assert earlier.read_text(encoding="utf-8") == "earlier"


def test_a_study_that_is_terminated_says_so(
    command: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(LeftAfter, "error", Terminated)
    assert main([*command, "--json"]) == 143
    record = json.loads(capsys.readouterr().out)
    assert record["exit_code"] == 143
    assert [setting["end"] for setting in record["settings"]] == ["done", *["terminated"] * 3]


def test_before_anything_was_measured_nothing_is_left(
    command: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(LeftAfter, "answered", 0)
    assert main(command) == 130
    assert capsys.readouterr().err == "mbla: interrupted  [exit-130]\n"
    assert not Path(command[1]).with_suffix(".out").exists()


def test_without_the_extra_for_pictures_the_rest_is_written(
    command: list[str], monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(LeftAfter, "answered", 9)
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    assert main(command) == 0
    assert "mbla: no pictures: " in (said := capsys.readouterr().err)
    assert "pictures]" in said
    names = sorted(path.name for path in Path(command[1]).with_suffix(".out").iterdir())
    assert names == ["block_tradeoff.csv", "block_tradeoff.json"]
