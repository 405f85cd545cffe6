from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.model.blocks.generated import ItemContext
from mbla.model.blocks.trilithon import TrilithonItem, generate


def test_places_and_members() -> None:
    item = TrilithonItem.model_validate(
        {"material": "stone", "upright": (0.6, 0.5, 3.0), "opening": 1.2, "lintel": (2.6, 0.7, 0.4)}
    )
    uprights, lintel = generate(item, ItemContext(1e-3, lambda path, name: Path(name))).parts
    left, right = uprights.polyhedra.vertices.reshape(2, 8, 3)
    assert (left.min(axis=0).tolist(), left.max(axis=0).tolist()) == ([0, 0, 0], [0.6, 0.5, 3])
    assert right - left == pytest.approx(np.tile([1.8, 0, 0], (8, 1)))
    assert lintel.polyhedra.vertices.min(axis=0) == pytest.approx([-0.1, -0.1, 3.0])
    assert lintel.polyhedra.vertices.max(axis=0) == pytest.approx([2.5, 0.6, 3.4])
    assert (uprights.member, lintel.member) == ("upright", "lintel")
    assert uprights.labels["unit"].tolist() == [0, 1]
