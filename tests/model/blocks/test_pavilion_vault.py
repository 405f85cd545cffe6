from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.blocks.generated import Generated, ItemContext
from mbla.model.blocks.pavilion_vault import PavilionVaultItem, generate
from tests.model.blocks.assembly import assemble
from tests.model.blocks.vault_sections import areas_and_centroids, joints_of_circle
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))
BASE = {"material": "stone", "shape": "semicircular", "bay": (4.0, 4.0), "thickness": 0.25, "courses": 9, "unit": 0.6}


def vault(**keys: Any) -> Generated:
    return generate(PavilionVaultItem.model_validate(BASE | keys), SITE)


@pytest.mark.parametrize("courses", [3, 9])
@pytest.mark.parametrize("length", [3.0, 4.0, 6.0])
@pytest.mark.parametrize("embrace", [None, 120.0])
def test_volume(length: float, courses: int, embrace: float | None) -> None:
    curve = {} if embrace is None else {"shape": "segmental", "embrace": embrace}
    made = vault(bay=(4.0, length), courses=courses, **curve)
    total = 0.0
    for part in made.parts:
        built = build_raw(part.polyhedra)
        assert not built.defects
        assert built.notices == ()
        total += built.blocks.volumes.sum()
    half = np.radians((embrace or 180.0) / 2)
    joints = joints_of_circle(2 / np.sin(half), 0.25, half, courses)
    area, centroid = areas_and_centroids(joints)
    side = np.arange(courses // 2)
    rings = 8 * length / 4 * float((area[side] * np.abs(centroid[side])).sum())
    (low, high), sides = joints[courses // 2], np.abs(joints[courses // 2, :, 0])
    frustum = length * (high[1] - low[1]) * (sides[0] ** 2 + sides[0] * sides[1] + sides[1] ** 2) / 3
    assert total == pytest.approx(rings + frustum, rel=1e-12)


def test_volume_goes_to_that_of_the_shell() -> None:
    """Two barrels cut over the diagonals: eight pieces whose length is the distance from the middle."""
    errors = []
    for courses in (21, 41):
        total = sum(build_raw(part.polyhedra).blocks.volumes.sum() for part in vault(courses=courses, unit=2.0).parts)
        errors.append(1 - total / (8 * (2.25**3 - 2.0**3) / 3))
    assert 0 < errors[1] < 2e-3
    assert errors[0] / errors[1] == pytest.approx((41 / 21) ** 2, rel=0.05)


@pytest.mark.parametrize("keys", ["bay: [4, 4]", "bay: [4, 6], bond: stack", "bay: [4, 3], unit: 0.35"])
def test_contacts_are_complete(tmp_path: Path, keys: str) -> None:
    built = assemble(
        tmp_path,
        "pavilion_vault: {material: stone, shape: semicircular, thickness: 0.25, courses: 9, springers: ground, "
        f"{keys if 'unit' in keys else keys + ', unit: 0.6'}}}",
        supports="[]",
    )
    stretch = float(keys[9]) / 4
    joints = np.abs(joints_of_circle(2.0, 0.25, np.pi / 2, 9)[:5])
    beds = 0.0
    for low, high in joints:
        for across in (1.0, stretch):
            slant = np.hypot(across * (high[0] - low[0]), high[1] - low[1])
            beds += 2 * slant * (stretch / across) * (low[0] + high[0])
    area, _ = areas_and_centroids(joints_of_circle(2.0, 0.25, np.pi / 2, 9))
    labels = built.model.blocks.labels
    course, span = labels.position("course"), labels.position("span")
    heads = 0.0
    for number in range(4):
        for web in range(4):
            joints_in_web = ((course == number) & (span == web)).sum() + 1
            heads += joints_in_web * area[number] * (stretch if web % 2 else 1.0)
    assert built.contacts.areas.sum() == pytest.approx(beds + heads, rel=1e-9)
