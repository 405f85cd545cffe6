from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.deck.items.arch import ArchItem
from mbla.model.generators.arch import generate_arch
from mbla.model.generators.generator import Generated, ItemRefused, Site
from tests.model.shapes import build_raw

SITE = Site(1e-3, lambda path, name: Path(name))


def arch(**keys: Any) -> Generated:
    base = {"material": "stone", "shape": "semicircular", "span": 4.0, "thickness": 0.3, "width": 1.0, "voussoirs": 27}
    return generate_arch(ArchItem.model_validate(base | keys), SITE)


@pytest.mark.parametrize("keys", [{}, {"shape": "segmental", "embrace": 100}, {"shape": "segmental", "embrace": 300}])
@pytest.mark.parametrize("count", [3, 27])
def test_straight_edged_voussoirs_have_the_volume_of_triangles(keys: dict[str, Any], count: int) -> None:
    each = np.radians(keys.get("embrace", 180)) / count
    inner = 2.0 / np.sin(count * each / 2)
    area = 0.5 * np.sin(each) * ((inner + 0.3) ** 2 - inner**2)
    built = build_raw(arch(voussoirs=count, **keys).parts[0].polyhedra)
    assert not built.defects
    assert built.notices == ()
    assert built.blocks.convex.all()
    assert built.blocks.volumes == pytest.approx([area] * count, rel=1e-12)


@pytest.mark.parametrize(
    "keys",
    [
        {},
        {"shape": "segmental", "rise": 0.5},
        {"shape": "segmental", "rise": 3.5},
        {"shape": "segmental", "embrace": 90},
        {"shape": "segmental", "embrace": 200},
        {"shape": "segmental", "embrace": 359},
    ],
)
def test_intrados_springings(keys: dict[str, Any]) -> None:
    corners = arch(**keys).parts[0].polyhedra.vertices
    for springing in ([0, 0, 0], [4, 0, 0], [0, 1, 0], [4, 1, 0]):
        assert np.linalg.norm(corners - springing, axis=1).min() == 0
    assert corners[:, 1].min() == 0
    assert corners[:, 1].max() == 1


@pytest.mark.parametrize("rise", [0.5, 2.0, 3.5])
def test_rise(rise: float) -> None:
    corners = arch(shape="segmental", rise=rise, voussoirs=20).parts[0].polyhedra.vertices
    assert corners[:, 2].max() == pytest.approx(rise + 0.3)
    crown = corners[np.abs(corners[:, 0] - 2) < 1e-9]
    assert sorted(crown[:, 2]) == pytest.approx([rise] * 4 + [rise + 0.3] * 4)


def test_a_rise_of_half_the_span_is_a_semicircle() -> None:
    round_arch, segmental = arch(), arch(shape="segmental", rise=2.0)
    assert segmental.parts[0].polyhedra.vertices == pytest.approx(round_arch.parts[0].polyhedra.vertices, abs=1e-12)


def test_corners_lie_on_radial_joints() -> None:
    corners = arch(shape="segmental", embrace=120, voussoirs=6).parts[0].polyhedra.vertices
    radius = 2 / np.sin(np.radians(60))
    arms = corners[:, [0, 2]] - [2, -radius * np.cos(np.radians(60))]
    reach = np.linalg.norm(arms, axis=1)
    assert np.unique(reach.round(9)).tolist() == pytest.approx([radius, radius + 0.3])
    angles = np.degrees(np.arctan2(arms[:, 0], arms[:, 1]))
    assert np.unique(angles.round(6)).tolist() == pytest.approx([-60, -40, -20, 0, 20, 40, 60], abs=1e-6)


def test_order_is_from_left_to_right() -> None:
    built = build_raw(arch().parts[0].polyhedra)
    assert (np.diff(built.blocks.centroids[:, 0]) > 0).all()


@pytest.mark.parametrize("embrace", [90, 180, 240])
def test_ground_under_both_springings(embrace: float) -> None:
    made = arch(shape="segmental", embrace=embrace, springers="ground", joint="bed", voussoirs=9)
    left, right = made.grounds
    assert [left.blocks.tolist(), right.blocks.tolist()] == [[0], [8]]
    assert [left.joint, right.joint] == ["bed", "bed"]
    half = np.radians(embrace / 2)
    assert left.normal == pytest.approx([np.cos(half), 0, np.sin(half)])
    assert right.normal == pytest.approx([-np.cos(half), 0, np.sin(half)])
    corners = made.parts[0].polyhedra.vertices.reshape(-1, 8, 3)
    for ground in made.grounds:
        heights = (corners[ground.blocks[0]] - ground.point) @ ground.normal
        assert sorted(heights)[:4] == pytest.approx([0] * 4, abs=1e-12)
        assert min(sorted(heights)[4:]) > 0.1


@pytest.mark.parametrize("embrace", [90, 180, 240])
def test_fixed_blocks_behind_both_springings(embrace: float) -> None:
    made = arch(shape="segmental", embrace=embrace, springers="blocks", voussoirs=9)
    voussoirs, springers = made.parts
    assert (voussoirs.suffix, voussoirs.fixed) == ("", False)
    assert (springers.suffix, springers.fixed) == ("_springers", True)
    built = build_raw(springers.polyhedra)
    assert not built.defects
    assert built.notices == ()
    assert built.blocks.volumes == pytest.approx([0.3 * 0.3] * 2)
    half = np.radians(embrace / 2)
    radius = 2 / np.sin(half)
    middle = np.array([2, 0.5, -radius * np.cos(half)])
    for centroid, side in zip(built.blocks.centroids, (-1, 1), strict=True):
        joint = middle + (radius + 0.15) * np.array([side * np.sin(half), 0, np.cos(half)])
        back = np.array([side * np.cos(half), 0, -np.sin(half)])
        assert centroid == pytest.approx(joint + 0.15 * back)


def test_no_springers_unless_asked() -> None:
    made = arch()
    assert len(made.parts) == 1
    assert made.grounds == ()


@pytest.mark.parametrize(("embrace", "count", "least"), [(180, 1, 2), (359, 1, 2), (200, 1, 2)])
def test_too_few_voussoirs(embrace: float, count: int, least: int) -> None:
    with pytest.raises(ItemRefused) as caught:
        arch(shape="segmental", embrace=embrace, voussoirs=count)
    assert caught.value.findings == (
        (("voussoirs",), f"too few: at least {least}, so that each spans less than 180 degrees"),
    )


def test_one_voussoir_may_span_a_flat_arch() -> None:
    built = build_raw(arch(shape="segmental", embrace=60, voussoirs=1).parts[0].polyhedra)
    assert not built.defects
