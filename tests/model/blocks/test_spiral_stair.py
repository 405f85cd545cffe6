from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.spiral_stair import SpiralStairItem, generate
from tests.model.blocks.assembly import assemble
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))
BASE = {
    "material": "stone",
    "treads": 6,
    "inner_radius": 0.3,
    "outer_radius": 1.2,
    "rise": 0.18,
    "angle": 20.0,
    "overlap": 4.0,
}
TEXT = (
    "spiral_stair: {material: stone, treads: 30, inner_radius: 0.3, outer_radius: 1.2, rise: 0.18, angle: 20, "
    "overlap: 4, built_in: 0.2, foot: ground, "
)


def stair(**keys: Any) -> Generated:
    return generate(SpiralStairItem.model_validate(BASE | keys), SITE)


def sector(*degrees: float, radii: tuple[float, float] = (0.3, 1.4)) -> float:
    """Area of pieces of a ring, straight between their angles."""
    return float(sum(np.sin(np.radians(angle)) * (radii[1] ** 2 - radii[0] ** 2) / 2 for angle in degrees))


@pytest.mark.parametrize("rebate", [0.0, 0.05])
@pytest.mark.parametrize("facets", [1, 3])
def test_volumes(rebate: float, facets: int) -> None:
    treads, shelves, heads = stair(built_in=0.2, wall="pocket", rebate=rebate, facets=facets).parts
    built = [build_raw(part.polyhedra) for part in (treads, shelves, heads)]
    assert all(not each.defects and each.notices == () for each in built)
    between = [16 / facets] * facets
    whole = 0.18 * sector(4, *between, 4)
    rebated = whole + rebate * sector(*between, 4)
    assert built[0].blocks.volumes == pytest.approx([whole, *[rebated] * 5], rel=1e-12)
    wall = (1.2, 1.4)
    assert built[1].blocks.volumes == pytest.approx([(0.18 - rebate) * sector(*between, 4, radii=wall)] * 5, rel=1e-12)
    free = 0.18 * sector(4, *between, radii=wall)
    assert built[2].blocks.volumes == pytest.approx([free] * 5 + [0.18 * sector(4, *between, 4, radii=wall)], rel=1e-12)
    assert [part.member for part in (treads, shelves, heads)] == ["", "shelf", "head"]
    assert [part.fixed for part in (treads, shelves, heads)] == [False, True, True]
    assert shelves.labels["tread"].tolist() == [1, 2, 3, 4, 5]
    assert heads.labels["tread"].tolist() == treads.labels["tread"].tolist() == [0, 1, 2, 3, 4, 5]


@pytest.mark.parametrize("rebate", [0.0, 0.05])
@pytest.mark.parametrize("wall", ["shelf", "pocket"])
def test_contacts_are_complete_over_more_than_a_turn(tmp_path: Path, wall: str, rebate: float) -> None:
    built = assemble(tmp_path, f"{TEXT} wall: {wall}, rebate: {rebate}}}", supports="[]")
    foot = sector(4, 16, 4)
    on_each_other = sector(4) + rebate * 1.1
    on_shelves, ring = sector(16, 4, radii=(1.2, 1.4)), (1.2, 1.4)
    # shelves and heads also stand beside the ends of treads: upright faces of the ring's width
    beside = {"shelf": 29 * 0.2 * (0.18 - rebate), "pocket": 29 * 0.2 * (0.18 - rebate) + 29 * 0.2 * 0.18}[wall]
    above = 29 * sector(4, 16, radii=ring) + sector(4, 16, 4, radii=ring) if wall == "pocket" else 0.0
    expected = foot + 29 * (on_each_other + on_shelves) + above + beside
    assert built.contacts.areas.sum() == pytest.approx(expected, rel=1e-9)
    assert len(built.model.grounds) == 1


def test_treads_rise_counter_clockwise() -> None:
    (part,) = stair(built_in=0.2).parts
    centroids = build_raw(part.polyhedra).blocks.centroids
    angles = np.degrees(np.arctan2(centroids[:, 1], centroids[:, 0]))
    assert angles == pytest.approx(12 + 20 * np.arange(6))
    assert centroids[:, 2] == pytest.approx(0.09 + 0.18 * np.arange(6))
