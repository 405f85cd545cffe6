"""What is turned, where to, and what is refused; loads are those of the model that a setting gives."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck import read_deck
from mbla.errors import UsageError
from mbla.sweeps.design.directions import horizontal
from mbla.sweeps.interaction.question import direction_question
from mbla.sweeps.plan import override_texts
from tests.sweeps.interaction.hand_made import live_load, question, written

WEIGHT = 2000 * 9.81 * 2


@pytest.mark.parametrize("case", ["push", "named", "slanted"])
def test_azimuths_are_absolute_whatever_the_direction_of_the_deck(tmp_path: Path, case: str) -> None:
    """``named`` pushes along +y in the deck: -0.5 times a named load of 2 along -y."""
    asked = question(tmp_path, case=case, directions=12)
    assert asked.absolute
    for azimuth, settings in zip(asked.angles, asked.settings, strict=True):
        load, _ = live_load(tmp_path, override_texts(settings), case)
        vertical = -0.5 * WEIGHT if case == "slanted" else 0.0
        assert load == pytest.approx([*np.multiply(horizontal(azimuth, 1.0), WEIGHT), vertical, 0, 0, 0], abs=1e-9)


def test_loads_that_point_apart_are_turned_together_from_where_they_are(tmp_path: Path) -> None:
    asked = question(tmp_path, case="apart", directions=4)
    assert not asked.absolute
    assert "the angle by which they are turned together" in asked.words[0]
    load, _ = live_load(tmp_path, override_texts(asked.settings[0]), "apart")
    assert load[:2] == pytest.approx([WEIGHT, WEIGHT])
    load, _ = live_load(tmp_path, override_texts(asked.settings[1]), "apart")
    assert load[:2] == pytest.approx([-WEIGHT, WEIGHT])


def test_the_axis_cases_add_up_to_every_point(tmp_path: Path) -> None:
    """Else the powers in them would not say what a mechanism bounds at other azimuths."""
    asked = question(tmp_path, case="top", directions=7)
    axes = [live_load(tmp_path, asked.fixed, name)[0] for name in asked.pair]
    for azimuth, settings in zip(asked.angles, asked.settings, strict=True):
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
        ({"case": "tilted"}, "its live load tilts"),
        ({"case": "push", "start": 10.0}, "--from and --to apply with --loads"),
        ({"case": "push", "directions": 0}, "--directions 0: 1 to 3600"),
        ({"case": "push", "loads": ("push", "top")}, "--case and --loads"),
    ],
)
def test_refusals(tmp_path: Path, asked: dict[str, Any], words: str) -> None:
    with pytest.raises(UsageError, match=words):
        question(tmp_path, **asked)


def test_half_of_a_structure_is_refused(tmp_path: Path) -> None:
    level = direction_question(read_deck(written(tmp_path), ["symmetry=[{z: 2}]"]), "push", 4)
    assert level.angles == (0.0, 90.0, 180.0, 270.0)  # halves one above the other are pushed the same way
    with pytest.raises(UsageError, match=r"symmetry\.0: the deck gives half of the structure"):
        direction_question(read_deck(written(tmp_path), ["symmetry=[{y: 2}]"]), "push", 4)
