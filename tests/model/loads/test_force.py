"""Forces at points of blocks."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from tests.model.test_load_cases import case, model


def test_force_at_a_point_brings_its_moment(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{force: [10, 20, 30], on: {group: top, index: 0}, at: [1, 0.5, 2.5]}]")
    assert found.live_load[1] == pytest.approx([10, 20, 30, *np.cross([0.5, 0, 0.5], [10, 20, 30])])
    assert found.live_words == ("force (10, 20, 30) N on top[0] at (1, 0.5, 2.5) m",)


@pytest.mark.parametrize(("x", "remarked"), [(1.0, False), (1.01, False), (1.05, True), (-3.0, True)])
def test_force_outside_its_block(tmp_path: Path, x: float, remarked: bool) -> None:
    found = model(tmp_path, f"live: [{{force: [1, 0, 0], on: {{group: top, index: 0}}, at: [{x}, 0.5, 2]}}]")
    assert [notice.identifier for notice in found.notices] == ["force-outside-block"] * remarked


def test_a_couple_has_an_effect(tmp_path: Path) -> None:
    where = "on: {group: top, index: 1}"
    loads = (
        f"live: [{{force: [1, 0, 0], {where}, at: [0.5, 0.5, 4]}}, {{force: [-1, 0, 0], {where}, at: [0.5, 0.5, 3]}}]"
    )
    assert case(tmp_path, loads).live_load[2] == pytest.approx([0, 0, 0, 0, 1, 0])
