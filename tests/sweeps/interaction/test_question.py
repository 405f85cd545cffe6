"""What is turned or added, where to, and what is refused; loads are those of the model that a setting gives."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import UsageError
from mbla.model import build_model
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.question import angles_between, closes, question_of, stretched
from mbla.sweeps.plan import override_texts
from tests.sweeps.interaction.hand_made import live_load, options, question, written


def test_ranges() -> None:
    assert angles_between(0.0, 360.0, 4) == [0.0, 90.0, 180.0, 270.0]
    assert angles_between(0.0, 90.0, 3) == [0.0, 45.0, 90.0]
    assert angles_between(-90.0, 270.0, 4) == [-90.0, 0.0, 90.0, 180.0]
    assert closes(-90.0, 270.0)
    assert not closes(0.0, 359.0)


def test_angles_are_even_in_the_units_of_both_axes() -> None:
    """(cos, sin / 20) of the angles lies at 0, 30, 60, 90 degrees."""
    angles = angles_between(0.0, 90.0, 4, ratio=20.0)
    seen = [math.degrees(math.atan2(horizontal(angle, 1.0)[1] / 20, horizontal(angle, 1.0)[0])) for angle in angles]
    assert seen == pytest.approx([0, 30, 60, 90], abs=1e-9)
    assert (angles[0], angles[-1]) == (0.0, 90.0)


@pytest.mark.parametrize("ratio", [1e-6, 0.3, 7.0, 1e6])
def test_a_stretched_circle_keeps_its_axes_and_its_turns(ratio: float) -> None:
    angles = angles_between(-90.0, 270.0, 8, ratio)
    assert angles[::2] == [-90.0, 0.0, 90.0, 180.0]
    assert angles == sorted(angles)
    assert stretched(stretched(200.0, ratio), 1 / ratio) == pytest.approx(200.0, rel=1e-9)


WEIGHT = 2000 * 9.81 * 2


@pytest.mark.parametrize("case", ["push", "named", "slanted"])
def test_azimuths_are_absolute_whatever_the_direction_of_the_deck(tmp_path: Path, case: str) -> None:
    """``named`` pushes along +y in the deck: -0.5 times a named load of 2 along -y."""
    asked = question(tmp_path, case=case, directions=12)
    for azimuth, settings in asked.settings.items():
        load, _ = live_load(tmp_path, override_texts(settings), case)
        vertical = -0.5 * WEIGHT if case == "slanted" else 0.0
        assert load == pytest.approx([*np.multiply(horizontal(azimuth, 1.0), WEIGHT), vertical, 0, 0, 0], abs=1e-9)


def test_loads_that_point_apart_are_turned_together_from_where_they_are(tmp_path: Path) -> None:
    asked = question(tmp_path, case="apart", directions=4)
    assert "azimuth 0 is as the deck directs its loads" in asked.words
    load, _ = live_load(tmp_path, override_texts(asked.settings[asked.angles[0]]), "apart")
    assert load[:2] == pytest.approx([WEIGHT, WEIGHT])
    load, _ = live_load(tmp_path, override_texts(asked.settings[asked.angles[1]]), "apart")
    assert load[:2] == pytest.approx([-WEIGHT, WEIGHT])


def test_the_axis_cases_add_up_to_every_point(tmp_path: Path) -> None:
    """Else the powers in them would not say what a mechanism bounds at other azimuths."""
    asked = question(tmp_path, case="top", directions=7)
    axes = [live_load(tmp_path, asked.fixed, name)[0] for name in asked.pair]
    for azimuth, settings in asked.settings.items():
        load, _ = live_load(tmp_path, override_texts(settings), "top")
        cosine, sine = horizontal(azimuth, 1.0)
        assert load == pytest.approx(cosine * axes[0] + sine * axes[1], abs=1e-9)


def test_the_names_of_a_deck_are_left_alone(tmp_path: Path) -> None:
    """A load case of the deck may have the name that the load along x would take."""
    own = ["load_cases.interact_0={live: [{acceleration: [0, 1, 0]}]}"]
    asked = question(tmp_path, own, case="push", directions=4)
    assert asked.pair == ("interact_0_", "interact_90")
    along_x, _ = live_load(tmp_path, [*own, *asked.fixed], "interact_0_")
    assert along_x == pytest.approx([WEIGHT, 0, 0, 0, 0, 0], abs=1e-9)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({}, "several load cases: choose one with --case, of push, top,"),
        ({"case": "pull"}, "no load case pull in the deck"),
        ({"case": "down"}, "no live load has a horizontal part"),
        ({"case": "twist"}, "load_cases.twist.live.1 is a moment, which is not turned"),
        ({"case": "tilted"}, "its live load travels or tilts"),
        ({"case": "push", "start": 10.0}, "--from and --to apply with --loads"),
        ({"case": "push", "directions": 0}, "--directions 0: 1 to 3600"),
        ({"case": "push", "loads": ("push", "top")}, "--case and --loads"),
    ],
)
def test_refusals(tmp_path: Path, asked: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        question(tmp_path, **asked)


@pytest.mark.parametrize(
    ("case", "words"),
    [
        ("{modes: 3}", "it vibrates, there is no live load"),
        ("{time_history: {motion: {pulse: sine, amplitude: 1 g, duration: 1, direction: x}}}", "it moves in time"),
    ],
)
def test_cases_without_a_live_load(tmp_path: Path, case: str, words: str) -> None:
    with pytest.raises(UsageError, match=words):
        question(tmp_path, [f"load_cases.other={case}"], case="other")


def test_half_of_a_structure_is_refused(tmp_path: Path) -> None:
    alone = "load_cases={push: {live: [{acceleration: [1, 0, 0]}]}}"
    with pytest.raises(UsageError, match="symmetry: the deck gives half of the structure"):
        question(tmp_path, [alone, "symmetry=[{y: 2}]"], case="push", directions=4)


def test_both_act_with_cosine_and_sine(tmp_path: Path) -> None:
    asked = question(tmp_path, loads=("named", "top"), directions=7, start=0.0, end=360.0)
    own = [live_load(tmp_path, (), name)[0] for name in ("named", "top")]
    for angle, settings in asked.settings.items():
        load, dead = live_load(tmp_path, override_texts(settings), asked.case)
        cosine, sine = horizontal(angle, 1.0)
        assert load == pytest.approx(cosine * own[0] + sine * own[1], abs=1e-9)
        assert dead == pytest.approx(live_load(tmp_path, (), "top")[1])


def test_a_dead_load_of_their_own_goes_along(tmp_path: Path) -> None:
    overrides = ["load_cases.push.dead=[{gravity: [0, 0, -5]}]"]
    asked = question(tmp_path, overrides, loads=("push", "weighed"), directions=2)
    _, dead = live_load(tmp_path, [*overrides, *override_texts(asked.settings[asked.angles[0]])], asked.case)
    assert dead == pytest.approx([0, 0, -5 * 2000 * 2, 0, 0, 0])


def test_a_table_named_by_an_included_file_is_found(tmp_path: Path) -> None:
    """A setting is looked for from the main deck, whatever file named the table first."""
    (tmp_path / "below").mkdir()
    (tmp_path / "below" / "forces.csv").write_text("group,index,fx,fy,fz\nblock,0,0,7,0\n", encoding="utf-8")
    case = "load_cases: {rows: {live: [{table: forces.csv}]}}\n"
    (tmp_path / "below" / "rows.yaml").write_text(case, encoding="utf-8")
    text = written(tmp_path).read_text(encoding="utf-8")
    path = tmp_path / "main.yaml"
    path.write_text(text + "include: [below/rows.yaml]\n", encoding="utf-8")
    deck = read_deck(path)
    asked = question_of(deck, options(loads=("rows", "push"), directions=3))
    model = build_model(read_deck(path, override_texts(asked.settings[asked.angles[0]])))
    (found,) = [one for one in model.load_cases if one.name == asked.case]
    assert found.live_load[0] == pytest.approx([0, 7, 0, 0, 0, 0])


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"loads": ("push", "push")}, "name two different load cases"),
        ({"loads": ("push", "pull")}, "no load case pull"),
        ({"loads": ("push", "tilted")}, "load case tilted: its live load travels or tilts"),
        ({"loads": ("push", "weighed")}, "push and weighed have different dead loads"),
        ({"loads": ("push", "top"), "start": 90.0, "end": 90.0}, "the end must lie above"),
        ({"loads": ("push", "top"), "end": 361.0}, "by 360 degrees at most"),
        ({"loads": ("push", "top"), "directions": 1}, "--directions 1: 2 to 3600"),
    ],
)
def test_refusals_of_two_loads(tmp_path: Path, asked: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        question(tmp_path, **asked)
