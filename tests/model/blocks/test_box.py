from __future__ import annotations

from pathlib import Path

import pytest

from mbla.model.blocks.box import BoxItem, generate
from mbla.model.blocks.generated import ItemContext
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))


def test_box() -> None:
    item = BoxItem(material="stone", min=(-1, 2, 3), max=(0, 4, 6))
    (part,) = generate(item, SITE).parts
    built = build_raw(part.polyhedra)
    assert built.notices == ()
    assert built.blocks.volumes == pytest.approx([6])
    assert built.blocks.centroids.tolist() == [[-0.5, 3, 4.5]]
