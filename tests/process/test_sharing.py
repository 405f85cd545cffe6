"""What points have in common is kept by content, read-only, and in bounded memory."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.process.sharing import Memory, content_hash, once, shared, sharing


@dataclass(frozen=True)
class Wall:
    name: str
    heights: FloatArray
    contact: sp.csr_array


def wall(height: float = 1.0) -> Wall:
    return Wall("wall", np.array([height, 2.0]), sp.csr_array(np.eye(2)))


def test_same_content_in_other_objects_is_worked_out_once() -> None:
    asked: list[float] = []

    @shared("doubled")
    def doubled(of: Wall, *, times: float = 2.0) -> FloatArray:
        asked.append(times)
        return times * of.heights

    memory = Memory()
    with sharing(memory):
        first, again = doubled(wall()), doubled(wall())
        other = doubled(wall(), times=3.0)
    assert first is again
    assert other.tolist() == [3.0, 6.0]
    assert asked == [2.0, 3.0]
    assert memory.found == {"doubled": 1}
    assert doubled(wall()) is not first  # nothing is open any more
    assert asked == [2.0, 3.0, 2.0]


def test_contents_that_differ_in_one_bit_differ() -> None:
    assert content_hash(wall(1.0)) == content_hash(wall(1.0))
    assert content_hash(wall(1.0)) != content_hash(wall(np.nextafter(1.0, 2.0)))
    assert content_hash((0.0,)) != content_hash((-0.0,))
    assert content_hash((1,)) != content_hash((1.0,))
    assert content_hash(np.zeros(2)) != content_hash(np.zeros(2, dtype=np.float32))
    names = "".join(["wa", "ll"]), "".join(["wa", "ll"])
    assert content_hash((names[0], names[0])) == content_hash(names), "which equal objects are one counts for nothing"


def test_what_is_kept_cannot_be_changed() -> None:
    with sharing(Memory()):
        kept = once("wall", (), wall)
        with pytest.raises(ValueError, match="read-only"):
            kept.heights[0] = 3.0
        with pytest.raises(ValueError, match="read-only"):
            kept.contact.data[0] = 3.0


def test_errors_and_what_does_not_last_are_not_kept() -> None:
    memory = Memory()

    def fails() -> Wall:
        raise ValueError("no wall")

    with sharing(memory):
        with pytest.raises(ValueError, match="no wall"):
            once("wall", (), fails)
        assert once("wall", (), wall, lasts=lambda _: False).name == "wall"
    assert len(memory) == 0


def test_memory_is_bounded_and_what_was_used_last_stays() -> None:
    memory = Memory(most_bytes=8000, most_results=50)
    with sharing(memory):
        for number in range(1000):
            once("heights", (number,), lambda: np.zeros(100))
            once("heights", (0,), lambda: np.zeros(100))
    assert (memory.size, len(memory)) == (8000, 10)
    assert memory.found == {"heights": 1000}
    with sharing(memory):
        for number in range(100):
            once("name", (number,), lambda: "wall")
    assert len(memory) == 50
