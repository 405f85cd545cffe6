from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.blocks.column import ColumnItem, corner_radius, generate, regular_polygon
from mbla.model.blocks.generated import Generated, ItemContext
from tests.model.blocks.assembly import assemble
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))


def column(**keys: Any) -> Generated:
    return generate(ColumnItem.model_validate({"material": "stone", "radius": 0.5, **keys}), SITE)


@pytest.mark.parametrize("sides", [3, 4, 7, 24, 360])
def test_equal_areas_give_the_volume_of_a_cylinder(sides: int) -> None:
    built = build_raw(column(height=4.0, drums=5, sides=sides).parts[0].polyhedra)
    assert not built.defects
    assert built.notices == ()
    assert built.blocks.convex.all()
    assert built.blocks.volumes == pytest.approx([np.pi * 0.25 * 0.8] * 5, rel=1e-12)


@pytest.mark.parametrize(
    ("kind", "area"),
    [("inscribed", 0.5 * 8 * np.sin(np.pi / 4) * 0.25), ("circumscribed", 8 * np.tan(np.pi / 8) * 0.25)],
)
def test_polygons_inside_and_outside_the_circle(kind: str, area: float) -> None:
    (part,) = column(height=3.0, drums=2, sides=8, polygon=kind).parts
    assert build_raw(part.polyhedra).blocks.volumes == pytest.approx([1.5 * area] * 2, rel=1e-12)
    reach = part.polyhedra.vertices[:, 0].max()
    assert reach == pytest.approx(0.5 * np.cos(np.pi / 8) if kind == "inscribed" else 0.5, rel=1e-12)


def test_tapered_drums_have_the_volume_of_a_truncated_cone() -> None:
    built = build_raw(column(height=5.0, drums=7, top_radius=0.3).parts[0].polyhedra)
    assert not built.defects
    assert built.blocks.volumes.sum() == pytest.approx(np.pi * 5 * (0.25 + 0.15 + 0.09) / 3, rel=1e-12)


def test_entasis_is_a_parabola_over_the_height() -> None:
    (part,) = column(height=4.0, drums=4, top_radius=0.4, entasis=0.02, polygon="circumscribed").parts
    corners = part.polyhedra.vertices
    reach = [corners[np.isclose(corners[:, 2], z), 0].max() for z in range(5)]
    assert reach == pytest.approx([0.5, 0.475 + 0.015, 0.45 + 0.02, 0.425 + 0.015, 0.4])


def test_a_flat_faces_x() -> None:
    for sides in (3, 4, 5, 24):
        corners = regular_polygon(sides)
        assert np.sort(corners[:, 0])[-2:] == pytest.approx([np.cos(np.pi / sides)] * 2)
        assert corner_radius(sides, "circumscribed") * corners[:, 0].max() == pytest.approx(1.0)


def test_base_and_capital(tmp_path: Path) -> None:
    built = assemble(
        tmp_path,
        "column: {material: stone, radius: 0.5, top_radius: 0.4, height: 4, drums: 4, sides: 12, "
        "base: {side: 1.4, height: 0.3}, capital: {radius: 0.6, height: 0.25}}",
    )
    blocks, contacts = built.model.blocks, built.contacts
    assert blocks.labels.members == ("base", "drum", "drum", "drum", "drum", "capital")
    assert blocks.labels.position("drum").tolist() == [-1, 0, 1, 2, 3, -1]
    assert built.volume_of("base") == pytest.approx([1.4**2 * 0.3], rel=1e-12)
    assert built.volume_of("capital") == pytest.approx([np.pi * 0.36 * 0.25], rel=1e-12)
    assert blocks.centroids[:, 2] == pytest.approx(np.sort(blocks.centroids[:, 2]))
    radii = np.array([0.5, 0.475, 0.45, 0.425, 0.4])
    assert np.sort(contacts.areas) == pytest.approx(np.sort([1.4**2, *(np.pi * radii**2)]), rel=1e-12)
