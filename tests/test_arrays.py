"""Ragged arrays and distinct values."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.arrays import distinct, row_of_item, starts


@pytest.mark.parametrize("values", [[], [3], [2, 2, 2], [5, -1, 5, 0, -1, 7]])
def test_distinct_values_ascend_and_occur_once(values: list[int]) -> None:
    found = distinct(np.array(values, dtype=np.int64))
    assert found.tolist() == sorted(set(values))
    assert found.dtype == np.int64


def test_items_of_a_ragged_array_know_their_rows() -> None:
    start = starts(np.array([2, 0, 3]))
    assert start.tolist() == [0, 2, 2, 5]
    assert row_of_item(start).tolist() == [0, 0, 2, 2, 2]
