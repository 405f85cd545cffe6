"""Cells of soil as blocks: they fill their region, carry its weight, and have the laws of the soil and of its walls."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mbla.contacts.contacts import Contacts
from mbla.contacts.search import find_contacts
from mbla.deck.deck import Deck
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.soil.decks import ARCH, BACKFILL, FOOTING, GROUND, WALL, deck, fill, model

LAWS = "cohesion: 5000, tensile_strength: 2000, dilatancy: 10, wall: {friction_angle: 12, cohesion: 700}"


def built(of: Deck) -> tuple[Model, Contacts]:
    found = build_model(of)
    return found, find_contacts(found, of.contacts)


def laws(found: Model, contacts: Contacts) -> dict[tuple[str, str], set[str]]:
    """Joint laws between groups, of which ground is one."""
    kinds = np.array([*found.blocks.groups, *("ground" for _ in found.grounds)])
    result: dict[tuple[str, str], set[str]] = {}
    for pair, law in zip(contacts.bodies, contacts.joints, strict=True):
        one, other = sorted(kinds[pair].tolist())
        result.setdefault((one, other), set()).add(contacts.joint_names[law])
    return result


@pytest.mark.parametrize("size", [0.2, 0.5])
def test_prisms_fill_the_region_and_weigh_what_it_weighs(tmp_path: Path, size: float) -> None:
    found = model(tmp_path, ARCH, fill=fill(cells=f"size: {size}"))
    (soil,) = found.soils
    cells = found.blocks.volumes[soil.blocks]
    areas = soil.areas(soil.points)
    assert cells == pytest.approx(2.0 * areas, rel=1e-9)
    assert found.weights[soil.blocks].sum() == pytest.approx(18000 * 2.0 * areas.sum(), rel=1e-12)
    middles = soil.points[soil.triangles].mean(axis=1)
    assert found.blocks.centroids[soil.blocks] == pytest.approx(np.insert(middles, 1, 1.0, axis=1), abs=1e-12)
    assert set(found.blocks.groups[soil.first :]) == {"soil"}
    assert found.blocks.labels.position("cell")[soil.blocks].tolist() == list(range(len(cells)))
    assert not found.notices
    assert not found.fixed.any()


def test_they_touch_each_other_the_arch_and_the_ground(tmp_path: Path) -> None:
    """All that bounds the region but its top is a surface in contact."""
    found, contacts = built(deck(tmp_path, ARCH, fill=fill(cells="size: 0.4, beyond: 1")))
    (soil,) = found.soils
    sides = np.concatenate([soil.triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    _, first, counts = np.unique(np.sort(sides, axis=1), axis=0, return_index=True, return_counts=True)
    ends = soil.points[sides[first]]
    inner = counts == 2
    on_top = ~inner & (np.abs(ends[..., 1] - 1.5).max(axis=1) < 1e-12)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    of_soil = np.isin(contacts.bodies, soil.blocks).sum(axis=1)
    assert (of_soil == 2).sum() == inner.sum()
    assert contacts.areas[of_soil == 2].sum() == pytest.approx(2.0 * lengths[inner].sum(), rel=1e-9)
    assert contacts.areas[of_soil == 1].sum() == pytest.approx(2.0 * lengths[~inner & ~on_top].sum(), rel=1e-9)


def test_laws_between_cells_and_on_all_else(tmp_path: Path) -> None:
    found, contacts = built(deck(tmp_path, ARCH, fill=fill(LAWS, "size: 0.4, beyond: 1")))
    assert laws(found, contacts) == {
        ("soil", "soil"): {"soil"},
        ("arch", "soil"): {"soil.wall"},
        ("ground", "soil"): {"soil"},
        ("arch", "arch"): {"dry"},
        ("arch", "ground"): {"dry"},
    }
    soil, wall = found.joints["soil"], found.joints["soil.wall"]
    tangents = [math.tan(math.radians(angle)) for angle in (30, 10, 12)]
    assert (soil.friction, soil.dilatancy, wall.friction) == pytest.approx(tuple(tangents))
    assert (soil.cohesion, soil.tensile_strength, wall.cohesion, wall.tensile_strength) == (5000, 2000, 700, 0)


def test_walls_have_two_thirds_of_the_angle(tmp_path: Path) -> None:
    wall = model(tmp_path, ARCH, fill=fill()).joints["soil.wall"]
    assert wall.friction == pytest.approx(math.tan(math.radians(20)))


def test_overrides_hold_for_soil_where_they_name_it(tmp_path: Path) -> None:
    every = "overrides: [{orientation: bed, joint: rough}, {orientation: head, joint: rough}"
    contacts = f", {every}, {{between: [backfill, ground], joint: dry}}]"
    found = laws(*built(deck(tmp_path, WALL, BACKFILL, supports=GROUND, contacts=contacts)))
    assert found == {
        ("backfill", "backfill"): {"backfill"},
        ("backfill", "wall"): {"backfill.wall"},
        ("backfill", "ground"): {"dry"},
        ("ground", "wall"): {"rough"},
    }


def test_two_soils_share_the_law_of_less_friction(tmp_path: Path) -> None:
    other = BACKFILL.replace("backfill", "clay").replace("friction_angle: 30", "friction_angle: 20, cohesion: 1000")
    other = other.replace("[[0, 0], [1.6, 0], [1.6, 1], [0, 1]]", "[[1.6, 0], [2.6, 0], [2.6, 1], [1.6, 1]]")
    found = laws(*built(deck(tmp_path, WALL, BACKFILL, other, FOOTING, supports=GROUND)))
    assert found["backfill", "clay"] == {"clay"}
    assert found["backfill", "footing"] == {"backfill.wall"}
