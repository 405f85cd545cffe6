"""Settings named on the command line."""

from __future__ import annotations

import pytest

from mbla.errors import UsageError
from mbla.sweeps.tradeoff.knobs import asked_rungs


def test_every_combination_of_knobs_then_settings() -> None:
    rungs = asked_rungs(
        ["analysis.tolerance=1e-6,1e-8", "analysis.solver=mbla,clarabel"], ["fast:  analysis.accuracy=draft a.b=[1,2]"]
    )
    assert [rung.name for rung in rungs] == [
        "tolerance: 1e-6, solver: mbla",
        "tolerance: 1e-6, solver: clarabel",
        "tolerance: 1e-8, solver: mbla",
        "tolerance: 1e-8, solver: clarabel",
        "fast",
    ]
    assert rungs[1].setting.overrides == ("analysis.tolerance=1e-6", "analysis.solver=clarabel")
    assert rungs[4].setting.overrides == ("analysis.accuracy=draft", "a.b=[1,2]")


def test_commas_inside_of_brackets_part_nothing() -> None:
    rungs = asked_rungs(["blocks.0.wall.unit=[1,2,3],[2,3,4]"], [])
    assert [rung.setting.overrides for rung in rungs] == [
        ("blocks.0.wall.unit=[1,2,3]",),
        ("blocks.0.wall.unit=[2,3,4]",),
    ]


@pytest.mark.parametrize("text", ["analysis.tolerance", "=1", "a.b=", "a.b=1,,2"])
def test_a_text_that_is_no_knob(text: str) -> None:
    with pytest.raises(UsageError, match=r"--knob .*must be KEY.PATH=VALUE"):
        asked_rungs([text], [])


@pytest.mark.parametrize("text", ["analysis.tolerance=1", "fast:", ": a=1", "fast: a"])
def test_a_text_that_is_no_setting(text: str) -> None:
    with pytest.raises(UsageError, match=r"--setting .*must be 'NAME"):
        asked_rungs([], [text])


def test_too_many() -> None:
    numbers = ",".join(map(str, range(15)))
    with pytest.raises(UsageError, match="225 settings, more than 200"):
        asked_rungs([f"a={numbers}", f"b={numbers}"], [])
