"""Cells of soil are named as soil."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.model.soil.names import body_in_words, counted_with_soil, is_cell, named_with_soil
from tests.model.soil.decks import BACKFILL, GROUND, WALL, model


def test_blocks_and_cells_together(tmp_path: Path) -> None:
    blocks = model(tmp_path, WALL, BACKFILL, supports=GROUND).blocks
    every = np.arange(len(blocks))
    assert is_cell(blocks).tolist() == [False] + [True] * (len(blocks) - 1)
    assert body_in_words(0, blocks) == "wall[0]"
    assert body_in_words(3, blocks) == "a cell of soil backfill"
    assert named_with_soil(every, blocks) == "soil backfill and wall[0]"
    assert named_with_soil(every[:1], blocks) == "wall[0]"
    assert counted_with_soil(every, blocks) == f"1 block and {len(blocks) - 1} cells of soil"
    assert counted_with_soil(every[1:2], blocks) == "1 cell of soil"
