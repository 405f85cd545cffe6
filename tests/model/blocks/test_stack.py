from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.blocks.generated import ItemContext
from mbla.model.blocks.stack import StackItem, generate

SITE = ItemContext(1e-3, lambda path, name: Path(name))


def corners(**keys: Any) -> FloatArray:
    """Least corner of each block."""
    item = StackItem.model_validate({"material": "stone", "block": (1.0, 0.5, 0.2), **keys})
    (part,) = generate(item, SITE).parts
    assert part.labels["drum"].tolist() == list(range(item.count))
    boxes = part.polyhedra.vertices.reshape(-1, 8, 3)
    assert boxes.max(axis=1) - boxes.min(axis=1) == pytest.approx(np.tile([1.0, 0.5, 0.2], (item.count, 1)))
    return np.asarray(boxes.min(axis=1))


def test_upright() -> None:
    assert corners(count=3) == pytest.approx(np.array([[0, 0, 0], [0, 0, 0.2], [0, 0, 0.4]]))
    assert corners(count=1).tolist() == [[0, 0, 0]]


def test_leaning() -> None:
    assert corners(count=3, shift=(0.1, -0.2))[:, :2] == pytest.approx(np.array([[0, 0], [0.1, -0.2], [0.2, -0.4]]))


def test_offsets_one_by_one() -> None:
    assert corners(count=3, offsets=[0.3, -0.1])[:, 0] == pytest.approx([0, 0.3, 0.2])


@pytest.mark.parametrize("count", [2, 9])
def test_at_a_harmonic_overhang_of_one_every_edge_is_below_a_centre_of_gravity(count: int) -> None:
    left = corners(count=count, overhang=1.0)[:, 0]
    for joint in range(1, count):
        assert left[joint:].mean() + 0.5 == pytest.approx(left[joint - 1] + 1.0, abs=1e-12)
