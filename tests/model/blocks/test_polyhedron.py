from __future__ import annotations

from pathlib import Path

from mbla.model.blocks.generated import ItemContext
from mbla.model.blocks.polyhedron import PolyhedronItem, generate
from tests.model.shapes import TETRAHEDRON

SITE = ItemContext(1e-3, lambda path, name: Path(name))


def test_polyhedron() -> None:
    item = PolyhedronItem.model_validate({"material": "stone", "vertices": TETRAHEDRON[0], "faces": TETRAHEDRON[1]})
    (part,) = generate(item, SITE).parts
    assert part.polyhedra.vertices.tolist() == TETRAHEDRON[0]
    assert part.polyhedra.loops.reshape(-1, 3).tolist() == TETRAHEDRON[1]
