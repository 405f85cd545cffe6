from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.blocks.cross_vault import CrossVaultItem, generate
from mbla.model.blocks.generated import Generated, ItemContext
from tests.model.blocks.assembly import assemble
from tests.model.blocks.vault_sections import areas_and_centroids, joints_of_circle
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))
BASE = {"material": "stone", "shape": "semicircular", "bay": (4.0, 4.0), "thickness": 0.25, "courses": 9, "unit": 0.6}


def vault(**keys: Any) -> Generated:
    return generate(CrossVaultItem.model_validate(BASE | keys), SITE)


def volume(bay: tuple[float, float], edge: float, half_angle: float, courses: int) -> float:
    """Courses of both pairs of webs from the mitre to the edge, and the frustum of the keystone."""
    joints = joints_of_circle(bay[0] / 2 / np.sin(half_angle), 0.25, half_angle, courses)
    area, centroid = areas_and_centroids(joints)
    stretch = bay[1] / bay[0]
    side = np.arange(courses // 2)
    webs = 0.0
    for across, length in ((1.0, bay[1] / 2 + edge), (stretch, bay[0] / 2 + edge)):
        # the barrel whose section is stretched by `across` runs along the other axis, where it is cut by the diagonal
        reach = np.abs(centroid[side]) * (stretch / across)
        webs += 4 * float((across * area[side] * (length - reach)).sum())
    if courses % 2 == 0:
        return webs
    low, high = joints[courses // 2]
    depth, sides = high[1] - low[1], np.abs([low[0], high[0]])
    frustum = 4 * stretch * depth * (sides[0] ** 2 + sides[0] * sides[1] + sides[1] ** 2) / 3
    ridge = 0.0
    for across, length in ((1.0, bay[1] / 2 + edge), (stretch, bay[0] / 2 + edge)):
        # a trapezoid carried from the sloping side of the keystone to the edge: lengths vary linearly with the height
        scale = stretch / across
        levels = np.array([0.0, 0.5, 1.0])  # Simpson's rule is exact for a quadratic
        half = sides[0] + (sides[1] - sides[0]) * levels
        ridge += 2 * float((2 * across * half * (length - scale * half) * [1, 4, 1]).sum() * depth / 6)
    return float(webs + frustum + ridge)


@pytest.mark.parametrize("courses", [2, 6, 9])
@pytest.mark.parametrize(("bay", "edge"), [((4.0, 4.0), 0.5), ((4.0, 6.0), 0.9), ((4.0, 3.0), 0.4)])
@pytest.mark.parametrize("embrace", [None, 120.0])
def test_volume(bay: tuple[float, float], edge: float, courses: int, embrace: float | None) -> None:
    curve = {} if embrace is None else {"shape": "segmental", "embrace": embrace}
    made = vault(bay=bay, edge=edge, courses=courses, **curve)
    total = 0.0
    for part in made.parts:
        built = build_raw(part.polyhedra)
        assert not built.defects
        assert built.notices == ()
        total += built.blocks.volumes.sum()
    assert total == pytest.approx(volume(bay, edge, np.radians((embrace or 180.0) / 2), courses), rel=1e-12)


def test_volume_goes_to_that_of_two_barrels() -> None:
    """Semicircular shells of radii 2 and 2.25 over 5 m, less what lies inside the other barrel's intrados."""
    errors = []
    for courses in (20, 40):
        parts = vault(courses=courses, edge=0.5, unit=2.0).parts
        total = sum(build_raw(part.polyhedra).blocks.volumes.sum() for part in parts)
        webs = 4 * (np.pi / 2 * (2.25**2 - 2.0**2) * 2.5 / 1 - 2 * (2.25**3 - 2.0**3) / 3)
        errors.append(1 - total / webs)
    assert errors[0] == pytest.approx(4 * errors[1], rel=0.02)
    assert 0 < errors[1] < 2e-3


@pytest.mark.parametrize("keys", ["courses: 9, bay: [4, 4]", "courses: 8, bay: [4, 5]", "courses: 9, bay: [4, 3]"])
@pytest.mark.parametrize("bond", ["running", "stack"])
def test_contacts_are_complete(tmp_path: Path, keys: str, bond: str) -> None:
    """Every face of every block is in contact, but for intrados, extrados, edges and the ledge of springings."""
    built = assemble(
        tmp_path,
        f"cross_vault: {{material: stone, shape: semicircular, thickness: 0.25, unit: 0.6, edge: 0.6, bond: {bond}, "
        f"springers: ground, {keys}}}",
        supports="[]",
    )
    blocks, contacts = built.model.blocks, built.contacts
    bay = (4.0, 4.0 if "[4, 4]" in keys else 5.0 if "[4, 5]" in keys else 3.0)
    stretch, courses = bay[1] / bay[0], 8 if "courses: 8" in keys else 9
    joints = np.abs(joints_of_circle(2.0, 0.25, np.pi / 2, courses)[: courses // 2 + 1])
    beds = 0.0
    for low, high in joints:
        for across, length in ((1.0, bay[1] / 2 + 0.6), (stretch, bay[0] / 2 + 0.6)):
            slant = np.hypot(across * (high[0] - low[0]), high[1] - low[1])
            beds += 4 * slant * (length - stretch / across * (high[0] + low[0]) / 2)
    beds -= 0 if courses % 2 else 2 * 0.25 * (bay[0] / 2 + bay[1] / 2 + 1.2)  # both sides of a ridge are one joint
    if courses % 2:  # the keystone's four sides
        low, high = joints[-1]
        for across in (1.0, stretch):
            slant = np.hypot((stretch / across) * (high[0] - low[0]), high[1] - low[1])
            beds += 2 * slant * across * (low[0] + high[0])
    area, _ = areas_and_centroids(joints_of_circle(2.0, 0.25, np.pi / 2, courses))
    labels = blocks.labels
    heads = 0.0
    for course, span, unit in zip(
        *(labels.position(name) for name in ("course", "span", "unit")),
        strict=True,
    ):
        ridge_beside_keystone = courses % 2 and course == courses // 2 and unit == 0
        if span >= 0 and not ridge_beside_keystone:
            heads += area[course] * (1.0 if span % 2 else stretch)
    assert contacts.areas.sum() == pytest.approx(beds + heads, rel=1e-9)


def test_labels(tmp_path: Path) -> None:
    built = assemble(
        tmp_path,
        "cross_vault: {material: stone, shape: segmental, rise: 1.2, bay: [4, 4], thickness: 0.25, courses: 9, "
        "unit: 0.6, springers: blocks}",
        supports="[]",
    )
    blocks = built.model.blocks
    members = np.array(blocks.labels.members)
    assert (members == "groin").sum() == 16
    assert (members == "keystone").sum() == 1
    assert built.model.fixed.sum() == 4
    span, centroids = blocks.labels.position("span"), blocks.centroids
    for number, (x, y) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
        outwards = centroids[span == number] @ [x, y, 0]
        assert (outwards > np.abs(centroids[span == number] @ [y, x, 0])).all()
    segment = blocks.labels.position("segment")
    for number, (x, y) in enumerate(((1, 1), (-1, 1), (-1, -1), (1, -1))):
        assert (centroids[segment == number][:, :2] * [x, y] > 0).all()
    course = blocks.labels.position("course")
    heights = [centroids[(course == number) & (members == "groin"), 2].mean() for number in range(4)]
    assert heights == sorted(heights)
