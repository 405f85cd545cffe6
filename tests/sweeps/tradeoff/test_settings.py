"""The settings that are known, and those named on the command line."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mbla.deck import read_deck
from mbla.errors import UsageError
from mbla.sweeps.tradeoff.settings import Setting, given_knobs, named_settings, settings_of
from tests.line import BLOCK


@pytest.fixture
def path(tmp_path: Path) -> Path:
    path = tmp_path / "block.yaml"
    path.write_text(BLOCK, encoding="utf-8")
    return path


def test_presets_are_free_of_the_knobs_that_the_deck_sets_by_itself(path: Path) -> None:
    path.write_text(re.sub("analysis: .*", "analysis: {tolerance: 1e-5, gap: 1e-3}", BLOCK), encoding="utf-8")
    fixed = ("analysis.gap=1e-2",)
    deck = read_deck(path, fixed)
    assert given_knobs(deck, fixed) == ("tolerance",)  # the user wants the other one so
    standard = settings_of(deck, fixed, [])[0]
    assert standard.settings == {"analysis": {"gap": 1e-2, "accuracy": "standard"}}


def test_what_does_not_apply_is_the_same_or_is_another_model(path: Path) -> None:
    settings = [
        Setting("own"),
        Setting("path", {"analysis.solver": "none"}),
        Setting("again", {"analysis.accuracy": "standard"}),
        Setting("points", {"contacts.points.per_edge": 3}),
    ]
    found = settings_of(read_deck(path), (), settings)[1:]
    assert [setting.unfit for setting in found] == ["", "must be auto, mbla or clarabel", "the same as own", ""]
    assert [setting.model for setting in found] == ["", "", "", "contacts"]


def test_every_combination_of_knobs_then_settings() -> None:
    settings = named_settings(
        ["analysis.tolerance=1e-6,1e-8", "analysis.solver=mbla,clarabel"], ["fast:  analysis.accuracy=draft a.b=[1,2]"]
    )
    assert [setting.name for setting in settings] == [
        "tolerance: 1e-6, solver: mbla",
        "tolerance: 1e-6, solver: clarabel",
        "tolerance: 1e-8, solver: mbla",
        "tolerance: 1e-8, solver: clarabel",
        "fast",
    ]
    assert settings[1].settings == {"analysis.tolerance": 1e-6, "analysis.solver": "clarabel"}
    assert settings[4].settings == {"analysis.accuracy": "draft", "a.b": [1, 2]}


def test_commas_inside_of_brackets_part_nothing() -> None:
    settings = named_settings(["blocks.0.wall.unit=[1,2,3],[2,3,4]"], [])
    assert [setting.settings for setting in settings] == [
        {"blocks.0.wall.unit": [1, 2, 3]},
        {"blocks.0.wall.unit": [2, 3, 4]},
    ]


@pytest.mark.parametrize("text", ["analysis.tolerance", "=1", "a.b=", "a.b=1,,2"])
def test_a_text_that_is_no_knob(text: str) -> None:
    with pytest.raises(UsageError, match=r"--knob .*must be KEY.PATH=VALUE"):
        named_settings([text], [])


@pytest.mark.parametrize("text", ["analysis.tolerance=1", "fast:", ": a=1", "fast: a"])
def test_a_text_that_is_no_setting(text: str) -> None:
    with pytest.raises(UsageError, match=r"--setting .*must be 'NAME"):
        named_settings([], [text])


def test_too_many() -> None:
    numbers = ",".join(map(str, range(15)))
    with pytest.raises(UsageError, match="225 settings, more than 200"):
        named_settings([f"a={numbers}", f"b={numbers}"], [])
