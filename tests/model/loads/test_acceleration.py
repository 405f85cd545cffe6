"""Accelerations of masses; patterns by height have tests of their own."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.model.test_load_cases import case


def test_acceleration_on_a_selection(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{acceleration: [1, 0, 0], on: top}]")
    assert found.live_load[:, 0] == pytest.approx(9.81 * 2000 * np.array([0, 2, 1]))
    assert found.live_words == ("acceleration (1, 0, 0) g on 2 blocks",)


@pytest.mark.parametrize(
    ("units", "gravity"),
    [
        ("length: mm, force: kN, mass: t", 9810),
        ("length: ft, force: lbf, mass: lb", 32.185),
        ("length: m, force: kN", 9.81),
    ],
)
def test_an_acceleration_of_one_g_weighs_as_much_as_gravity(tmp_path: Path, units: str, gravity: float) -> None:
    found = case(tmp_path, f"dead: [{{gravity: [0, 0, {-gravity}]}}], live: [{{acceleration: [0, 0, -1]}}]", units)
    assert found.dead_load == pytest.approx(found.live_load, rel=1e-5)
