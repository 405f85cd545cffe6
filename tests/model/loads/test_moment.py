"""Moments on blocks."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from tests.model.test_load_cases import case


def test_moment_turns_one_block_about_its_centroid(tmp_path: Path) -> None:
    found = case(tmp_path, "live: [{moment: [1, -2, 3], on: {group: top, index: 1}}]")
    block = int(np.flatnonzero(np.any(found.live_load, axis=1)).item())
    assert found.live_load[block].tolist() == [0, 0, 0, 1, -2, 3]
    (words,) = found.live_words
    assert "moment (1, -2, 3)" in words
