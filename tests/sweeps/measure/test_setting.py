"""A deck under one setting: values put into it, and knobs left to the accuracy that is asked for."""

from __future__ import annotations

from pathlib import Path

import pytest

from mbla.sweeps.measure.setting import Setting, given_knobs, read_setting
from tests.line import BLOCK

KNOBS = "analysis: {gap: 1.e-3, residual: 1.e-5, max_iterations: 70"


@pytest.fixture
def deck(tmp_path: Path) -> Path:
    """A deck that gives two knobs of accuracy, and a limit of effort."""
    path = tmp_path / "block.yaml"
    path.write_text(BLOCK.replace("analysis: {", f"{KNOBS}, "), encoding="utf-8")
    return path


def test_what_the_setting_says_comes_after_what_holds_for_every_setting(deck: Path) -> None:
    read = read_setting(deck, ("analysis.gap=1e-4", "analysis.residual=1e-6"), Setting(("analysis.gap=1e-5",)))
    assert (read.analysis.gap, read.analysis.residual) == (1e-5, 1e-6)


def test_knobs_that_are_freed_are_left_to_the_accuracy(deck: Path) -> None:
    read = read_setting(deck, (), Setting(freed=("gap",)))
    assert (read.analysis.gap, read.analysis.residual, read.analysis.max_iterations) == (None, 1e-5, 70)


def test_knobs_of_the_deck_are_told_but_for_limits_and_those_of_the_command_line(deck: Path) -> None:
    assert given_knobs(read_setting(deck, (), Setting()), ()) == ("gap", "residual")
    fixed = ("analysis.gap=1e-4",)
    assert given_knobs(read_setting(deck, fixed, Setting()), fixed) == ("residual",)
