"""Records of any kind as arrays and back."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
import pytest

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.results.hdf5.stored_record import StoredRecord, restored, stored
from mbla.solution.time_history.history import TimeHistoryResult
from tests.results.rocking import rocks
from tests.results.synthetic import same


class Colour(StrEnum):
    RED = "red"


@dataclass(frozen=True)
class Inner:
    values: FloatArray
    known: bool


@dataclass
class Outer:
    number: int
    size: float
    colour: Colour
    inner: Inner
    pairs: tuple[tuple[int, float], ...]
    rows: list[Inner]
    by_name: dict[str, IntArray]
    flags: BoolArray
    nothing: Inner | None = None
    derived: float = field(default=0.0, init=False)


OUTER = Outer(
    3,
    np.inf,
    Colour.RED,
    Inner(np.arange(6.0).reshape(2, 3), True),
    ((1, 2.0), (2, -np.inf)),
    [Inner(np.zeros((0, 3)), False), Inner(np.array([np.nan, 1e300, -0.0]), True)],
    {"a": np.arange(4), "b": np.zeros(0, dtype=np.int64)},
    np.array([True, False]),
)


def test_a_record_comes_back() -> None:
    again = restored(Outer, stored(OUTER))
    assert same(again, OUTER)
    assert type(again.rows) is list
    assert again.colour is Colour.RED
    assert same(restored(Outer, stored(replace(OUTER, nothing=OUTER.inner))).nothing, OUTER.inner)


def test_a_history_comes_back() -> None:
    found, again = rocks(), restored(TimeHistoryResult, stored(rocks()))
    for name in ("rows", "frames", "histories", "peaks", "half", "end", "stiffness"):
        assert same(getattr(again, name), getattr(found, name)), name


def test_other_things_are_refused() -> None:
    with pytest.raises(TypeError, match="complex"):
        stored(replace(OUTER, flags=np.zeros(2, dtype=complex)))
    with pytest.raises(TypeError, match="set cannot"):
        stored({"a": {1}})
    found = stored(OUTER)
    with pytest.raises((TypeError, ValueError)):
        restored(Outer, StoredRecord(found.tree.replace('"red"', '"blue"'), found.arrays))
    with pytest.raises(TypeError):
        restored(Outer, StoredRecord(found.tree.replace('"number":3', '"number":"3"'), found.arrays))
    with pytest.raises(ValueError, match="ends before"):
        restored(Outer, StoredRecord(found.tree, {**found.arrays, "f": found.arrays["f"][:3]}))
