"""Gravity, given or not."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.model.test_load_cases import case


def test_default_dead_load_is_gravity(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{acceleration: [1, 0, 0]}]")
    assert found.dead_load[:, 2] == pytest.approx(-9.81 * 2000 * np.array([1, 2, 1]))
    assert not found.dead_load[:, [0, 1, 3, 4, 5]].any()
    assert found.dead_words == ("gravity (0, 0, -9.81) m/s2",)
    assert found.name == "push"


def test_no_dead_load_at_all(tmp_path: Path) -> None:
    found = case(tmp_path, "dead: [{gravity: none}], live: [{acceleration: [1, 0, 0]}]")
    assert not found.dead_load.any()
    assert found.dead_words == ("no gravity",)


@pytest.mark.parametrize(("dead", "pushed"), [("[]", 0), ("[{force: [1, 0, 0], on: {group: top, index: 0}}]", 1)])
def test_gravity_acts_beside_dead_loads_without_it(tmp_path: Path, dead: str, pushed: float) -> None:
    found = case(tmp_path, f"dead: {dead}, live: [{{acceleration: [0, 0, -1]}}]")
    assert found.dead_load[:, 2] == pytest.approx(found.live_load[:, 2])
    assert found.dead_load[1, 0] == pushed
    assert found.dead_words[0] == "gravity (0, 0, -9.81) m/s2"
