"""Knobs of speed against accuracy from the command line: which word wins, and that the run takes it."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from mbla.cli import main
from tests.line import BLOCK


def told(deck: Path, capsys: pytest.CaptureFixture[str], *arguments: str) -> tuple[dict[str, str], dict[str, Any]]:
    """Settings of the listing, and the load case in JSON."""
    assert main(["run", str(deck), "--force", "--json", *arguments]) == 0
    (case,) = json.loads(capsys.readouterr().out)["cases"]
    listing = (deck.with_suffix(".out") / f"{deck.stem}.lst").read_text(encoding="utf-8")
    section = listing.split("Units and analysis settings")[1].split("\n\n")[0]
    rows = [line.split(None, 1) for line in section.splitlines()]
    return {row[0]: row[1] for row in rows if len(row) == 2}, case


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    path = tmp_path / "block.yaml"
    text = BLOCK.replace("flow_rule: associative", "flow_rule: associative, accuracy: reference, gap: 1.e-6")
    path.write_text(text, encoding="utf-8")
    return path


def test_the_word_of_the_command_line_wins_over_that_of_the_deck_but_not_over_its_knobs(
    deck: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    own, case = told(deck, capsys)
    assert (own["accuracy"], own["tolerance"], own["gap"]) == ("reference", "1e-10", "1e-06")
    assert case["standing"]["verdict"] == "yes"
    draft, case = told(deck, capsys, "--accuracy", "draft")
    assert (draft["accuracy"], draft["tolerance"], draft["gap"]) == ("draft", "1e-08", "1e-06")
    assert draft["standing"] == "false"
    assert case["standing"] is None


def test_a_knob_of_the_command_line_wins_over_all(deck: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["--set", "analysis.gap=1e-4", "--set", "analysis.standing=true", "--set", "analysis.tolerance=1e-7"]
    knobs, case = told(deck, capsys, "--accuracy", "draft", *arguments)
    assert (knobs["tolerance"], knobs["gap"]) == ("1e-07", "0.0001")
    assert case["standing"]["verdict"] == "yes"
