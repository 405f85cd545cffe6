from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.deck.items.trilithon import TrilithonItem
from mbla.model.generators.cuboids import generate_trilithon
from mbla.model.generators.generator import Site
from tests.model.generators.assembly import assemble

ITEM = "trilithon: {material: stone, upright: [0.6, 0.5, 3], opening: 1.2, lintel: [2.6, 0.7, 0.4]}"


def test_places_and_members() -> None:
    item = TrilithonItem.model_validate(
        {"material": "stone", "upright": (0.6, 0.5, 3.0), "opening": 1.2, "lintel": (2.6, 0.7, 0.4)}
    )
    uprights, lintel = generate_trilithon(item, Site(1e-3, lambda path, name: Path(name))).parts
    left, right = uprights.polyhedra.vertices.reshape(2, 8, 3)
    assert (left.min(axis=0).tolist(), left.max(axis=0).tolist()) == ([0, 0, 0], [0.6, 0.5, 3])
    assert right - left == pytest.approx(np.tile([1.8, 0, 0], (8, 1)))
    assert lintel.polyhedra.vertices.min(axis=0) == pytest.approx([-0.1, -0.1, 3.0])
    assert lintel.polyhedra.vertices.max(axis=0) == pytest.approx([2.5, 0.6, 3.4])
    assert (uprights.member, lintel.member) == ("upright", "lintel")
    assert uprights.labels["unit"].tolist() == [0, 1]


def test_contacts(tmp_path: Path) -> None:
    built = assemble(tmp_path, ITEM)
    assert built.model.blocks.volumes == pytest.approx([0.9, 0.9, 2.6 * 0.7 * 0.4], rel=1e-12)
    assert built.contacts.areas == pytest.approx([0.3] * 4, rel=1e-12)
