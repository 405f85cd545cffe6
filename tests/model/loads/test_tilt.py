"""Loads on a tilting table: gravity as seen from the structure."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from tests.asked import tilt_of
from tests.model.shapes import deck

BLOCKS = ["box: {group: base, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"]


def model(folder: Path, axis: str, dead: str = "") -> Model:
    return build_model(deck(folder, BLOCKS, loads=f"{dead}live: [{{tilt: {{axis: {axis}}}}}]"))


@pytest.mark.parametrize(
    ("axis", "down"), [("[0, 2, 0]", [1, 0, 0]), ("[1, 0, 0]", [0, -1, 0]), ("[0, -1, 0]", [-1, 0, 0])]
)
def test_the_table_turns_by_the_right_hand(tmp_path: Path, axis: str, down: list[float]) -> None:
    """About +y the side at +x goes down: after 90 degrees the weight points along +x."""
    found, weight = tilt_of(model(tmp_path, axis).load_cases[0]), 2000 * 9.81
    assert found.loads_at(0)[0] == pytest.approx([0, 0, -weight, 0, 0, 0])
    assert found.loads_at(90)[0, :3] == pytest.approx(np.array(down) * weight, abs=1e-9)
    assert found.loads_at(180)[0, 2] == pytest.approx(weight)
    assert not found.fixed.any()


def test_what_lies_along_the_axis_and_what_is_no_gravity_stays(tmp_path: Path) -> None:
    dead = "dead: [{gravity: [3, 0, -9], factor: 2}, {force: [5, 6, 7], on: base}], "
    built = model(tmp_path, "[1, 0, 0]", dead)
    found = tilt_of(built.load_cases[0])
    assert found.fixed[0, :3] == pytest.approx([5 + 2 * 2000 * 3, 6, 7])
    for angle in (0, 33, 120):
        size = 2 * 2000 * 9
        turned = np.array([0, -size * np.sin(np.deg2rad(angle)), -size * np.cos(np.deg2rad(angle))])
        assert found.loads_at(angle)[0, :3] - found.fixed[0, :3] == pytest.approx(turned, abs=1e-9)
    assert [notice.identifier for notice in built.notices] == ["tilt-turns-gravity-only"]


def test_gravity_along_the_axis_turns_nothing(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="nothing turns: gravity lies along the axis"):
        model(tmp_path, "[0, 0, 1]")


def test_without_gravity_nothing_turns(tmp_path: Path) -> None:
    with pytest.raises(DeckError, match="nothing turns: there is no gravity among the dead loads"):
        model(tmp_path, "[0, 1, 0]", "dead: [{gravity: none}, {force: [5, 6, 7], on: base}], ")
