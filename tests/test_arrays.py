"""Ragged arrays, distinct values, records that are alike."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray, alike, distinct, row_of_item, starts


@pytest.mark.parametrize("values", [[], [3], [2, 2, 2], [5, -1, 5, 0, -1, 7]])
def test_distinct_values_ascend_and_occur_once(values: list[int]) -> None:
    found = distinct(np.array(values, dtype=np.int64))
    assert found.tolist() == sorted(set(values))
    assert found.dtype == np.int64


def test_items_of_a_ragged_array_know_their_rows() -> None:
    start = starts(np.array([2, 0, 3]))
    assert start.tolist() == [0, 2, 2, 5]
    assert row_of_item(start).tolist() == [0, 0, 2, 2, 2]


@dataclass(frozen=True)
class Wall:
    name: str
    heights: FloatArray
    contact: sp.csr_array
    beside: Wall | None = None


def wall(height: float = 1.0, contact: float = 1.0, name: str = "wall") -> Wall:
    return Wall(name, np.array([height, 2.0]), sp.csr_array(contact * np.eye(2)))


def test_records_are_alike_where_no_bit_differs() -> None:
    assert alike(wall(), wall())
    beside = Wall("wall", np.zeros(2), sp.csr_array((2, 2)), wall())
    assert alike(beside, Wall("wall", np.zeros(2), sp.csr_array((2, 2)), wall()))
    others = [wall(np.nextafter(1.0, 2.0)), wall(contact=2.0), wall(contact=0.0), wall(name="pier"), beside, None]
    assert not any(alike(wall(), other) for other in others)
    assert not alike(beside, Wall("wall", np.zeros(2), sp.csr_array((2, 2)), wall(2.0)))
    assert not alike(np.zeros(2), np.zeros(2, dtype=np.float32))
    stored = [
        sp.csr_array((np.array(data), np.array(columns), [0, 2]))
        for data, columns in (([1, 2], [0, 1]), ([2, 1], [1, 0]))
    ]
    assert alike(*stored), "however it is stored"
    assert not alike(wall(np.nan), wall(np.nan))
