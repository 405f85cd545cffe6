from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.blocks.barrel_vault import BarrelVaultItem, generate
from mbla.model.blocks.generated import Generated, ItemContext
from tests.model.blocks.assembly import assemble
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))
BASE = {"material": "stone", "span": 4.0, "thickness": 0.3, "courses": 7, "length": 2.0, "unit": 0.5}
TEXT = "barrel_vault: {material: stone, span: 4, thickness: 0.3, courses: 7, length: 2, unit: 0.5, "


def vault(**keys: Any) -> Generated:
    return generate(BarrelVaultItem.model_validate({"shape": "semicircular"} | BASE | keys), SITE)


@pytest.mark.parametrize(
    "keys",
    [
        {},
        {"shape": "segmental", "embrace": 100.0},
        {"shape": "segmental", "rise": 0.8},
        {"shape": "pointed", "rise": 2.6, "courses": 8},
        {"shape": "elliptic", "rise": 1.2},
        {"shape": "catenary", "rise": 1.8},
    ],
)
def test_blocks_are_sound_and_fill_the_section_over_the_length(keys: dict[str, Any]) -> None:
    made = vault(springers="blocks", **keys)
    for part in made.parts:
        built = build_raw(part.polyhedra)
        assert not built.defects
        assert built.notices == ()
        assert built.blocks.convex.all()
    labels = made.parts[0].labels
    volumes = build_raw(made.parts[0].polyhedra).blocks.volumes
    courses = keys.get("courses", 7)
    assert np.bincount(labels["course"]).tolist() == [4 + course % 2 for course in range(courses)]
    per_course = np.bincount(labels["course"], volumes)
    assert per_course == pytest.approx(per_course[::-1], rel=1e-9)  # symmetric
    if keys.get("shape", "segmental") == "segmental":
        turn = {"rise": 4 * np.arctan(0.4), "embrace": np.radians(100)}.get(next(iter([*keys][1:]), ""), np.pi)
        radius, each = 2 / np.sin(turn / 2), turn / 7
        assert per_course == pytest.approx([((radius + 0.3) ** 2 - radius**2) * np.sin(each)] * 7, rel=1e-12)


@pytest.mark.parametrize(("bond", "counts"), [("running", [3, 4, 3]), ("stack", [3, 3, 3])])
def test_units_are_laid_like_those_of_a_wall(bond: str, counts: list[int]) -> None:
    (part,) = vault(bond=bond, courses=3, length=1.4).parts
    assert np.bincount(part.labels["course"]).tolist() == counts
    ends = part.polyhedra.vertices.reshape(-1, 8, 3)[:, :, 1]
    middle = part.labels["course"] == 1
    assert part.labels["unit"][middle].tolist() == list(range(counts[1]))
    expected = [0.25, 0.75, 1.25, 1.4] if bond == "running" else [0.5, 1.0, 1.4]
    assert ends[middle].max(axis=1) == pytest.approx(expected)


def test_contacts_are_complete(tmp_path: Path) -> None:
    built = assemble(tmp_path, TEXT + "shape: segmental, embrace: 120, springers: blocks}", supports="[]")
    assert built.model.fixed.sum() == 2
    each = np.radians(120 / 7)
    radius = 2 / np.sin(np.radians(60))
    profile = ((radius + 0.3) ** 2 - radius**2) / 2 * np.sin(each)
    heads = [3 + course % 2 for course in range(7)]
    assert built.contacts.areas.sum() == pytest.approx(8 * 0.3 * 2 + sum(heads) * profile, rel=1e-9)
    # beds of 2 m with joints at 0.5 m on one side and at 0.25 m + 0.5 m k on the other
    assert len(built.contacts) == 6 * 8 + 2 * 4 + sum(heads)


def test_ground_under_both_springings(tmp_path: Path) -> None:
    built = assemble(tmp_path, TEXT + "shape: segmental, rise: 0.8, springers: ground}", supports="[]")
    assert [len(ground.blocks) for ground in built.model.grounds if ground.blocks is not None] == [4, 4]
    on_ground = built.contacts.bodies[:, 0] >= len(built.model.blocks)
    assert built.contacts.areas[on_ground].sum() == pytest.approx(2 * 0.3 * 2.0, rel=1e-9)
