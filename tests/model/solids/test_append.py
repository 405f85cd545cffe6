"""Blocks behind blocks, as soil of cells has them."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from mbla.model.solids.append import append_blocks
from tests.model.shapes import box, build


def test_strengths_stay_with_their_blocks_and_others_have_none() -> None:
    units, cells = build(box(), box((2, 0, 0), (3, 1, 1))).blocks, build(box((4, 0, 0), (5, 1, 1))).blocks
    given = replace(units, strengths=np.array([[1.0, 10.0], [2.0, 20.0]]))
    assert append_blocks(units, cells).strengths is None
    both = append_blocks(given, cells).strengths
    assert both is not None
    assert both.tolist() == [[1.0, 10.0], [2.0, 20.0], [np.inf, np.inf]]
    behind = append_blocks(cells, given).strengths
    assert behind is not None
    assert behind.tolist() == [[np.inf, np.inf], [1.0, 10.0], [2.0, 20.0]]
