from __future__ import annotations

from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.blocks.dome import DomeItem, generate
from mbla.model.blocks.generated import Generated, ItemContext, ItemRefused
from tests.model.blocks.assembly import assemble
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))
BASE = {"material": "stone", "span": 4.0, "thickness": 0.3, "rings": 5, "segments": 8}


def dome(**keys: Any) -> Generated:
    return generate(DomeItem.model_validate(BASE | keys), SITE)


def ring_volume(sides: int, lower: float, upper: float, radius: float = 2.0, thickness: float = 0.3) -> float:
    """Of a ring between two angles from the crown, by n sin(2 pi/n) A rho."""
    moment = ((radius + thickness) ** 3 - radius**3) * np.sin(lower - upper) * (np.sin(lower) + np.sin(upper)) / 6
    return float(sides * np.sin(2 * np.pi / sides) * moment)


@pytest.mark.parametrize(
    ("keys", "sides"),
    [({}, 16), ({"facets": 6}, 48), ({"bond": "stack"}, 8), ({"bond": "stack", "facets": 3, "segments": 3}, 9)],
)
def test_rings_have_the_volume_of_polyhedral_rings(keys: dict[str, Any], sides: int) -> None:
    rings, keystone = dome(**keys).parts
    built, top = build_raw(rings.polyhedra), build_raw(keystone.polyhedra)
    assert not built.defects
    assert not top.defects
    assert built.notices == top.notices == ()
    segments = keys.get("segments", 8)
    joints = np.linspace(np.pi / 2, np.pi / 2 / 11, 6)
    expected = [ring_volume(sides, low, high) / segments for low, high in pairwise(joints)]
    assert built.blocks.volumes == pytest.approx(np.repeat(expected, segments), rel=1e-12)
    # the keystone: a frustum of a pyramid over polygons with corners at radii r1 and r2
    r1, r2, height = 2 * np.sin(joints[-1]), 2.3 * np.sin(joints[-1]), 0.3 * np.cos(joints[-1])
    area = sides / 2 * np.sin(2 * np.pi / sides)
    assert top.blocks.volumes == pytest.approx([area * height * (r1**2 + r1 * r2 + r2**2) / 3], rel=1e-12)


@pytest.mark.long
def test_volume_goes_to_that_of_the_hemisphere_with_the_square_of_the_facets() -> None:
    shell = 2 / 3 * np.pi * (2.3**3 - 2.0**3)
    errors = []
    for n in (1, 2, 4):
        parts = dome(rings=8 * n, segments=16 * n).parts
        volume = sum(build_raw(part.polyhedra).blocks.volumes.sum() for part in parts)
        errors.append(1 - volume / shell)
    assert 0 < errors[2] < 2e-3
    assert errors[0] / errors[1] == pytest.approx(4, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(4, rel=0.1)


@pytest.mark.parametrize("embrace", [60.0, 140.0, 220.0])
def test_springing_of_a_segmental_dome(embrace: float) -> None:
    rings, _, springers = dome(shape="segmental", embrace=embrace, springers="blocks").parts
    corners = rings.polyhedra.vertices
    assert np.abs(corners - [2.0, 0, 0]).max(axis=1).min() < 1e-12
    assert springers.fixed
    assert springers.suffix == "_springers"
    assert springers.labels["segment"].tolist() == list(range(8))
    assert not build_raw(springers.polyhedra).defects


def area_of_bed(sides: int, angle: float) -> float:
    """Of the polygonal funnel through a joint: trapezoids between chords of both circles."""
    inner, outer = 2.0 * np.sin(angle), 2.3 * np.sin(angle)
    half = np.pi / sides
    slant = np.hypot(0.3 * np.cos(angle), 0.3 * np.sin(angle) * np.cos(half))
    return float(sides * np.sin(half) * (inner + outer) * slant)


@pytest.mark.parametrize(("bond", "sides"), [("running", 16), ("stack", 8)])
def test_contacts_are_complete(tmp_path: Path, bond: str, sides: int) -> None:
    """Funnels facet by facet, as many upright joints as blocks, and the ring around the keystone."""
    item = f"dome: {{material: stone, span: 4, thickness: 0.3, rings: 5, segments: 8, bond: {bond}}}"
    built = assemble(tmp_path, item)
    joints = np.linspace(np.pi / 2, np.pi / 2 / 11, 6)
    beds = [area_of_bed(sides, angle) for angle in joints]
    upright = [0.5 * np.sin(low - high) * (2.3**2 - 2.0**2) for low, high in pairwise(joints)]
    contacts = built.contacts
    assert contacts.areas.sum() == pytest.approx(sum(beds) + 8 * sum(upright), rel=1e-12)
    # level ground: one polygon per block; keystone: all facets of a block are interfaces of their own
    assert len(contacts) == 8 + 4 * sides + sides + 5 * 8


def test_a_hemisphere_on_a_wide_drum(tmp_path: Path) -> None:
    built = assemble(
        tmp_path,
        "dome: {material: stone, span: 4, thickness: 0.3, rings: 5, segments: 8, oculus: 0.8, springers: ground, "
        "drum: {height: 1.5, courses: 3, thickness: 0.5}}",
        supports="[]",
    )
    area = 8 * np.sin(np.pi / 8)
    assert built.volume_of("drum") == pytest.approx([area * (2.5**2 - 2.0**2) * 0.5 / 8] * 24, rel=1e-12)
    labels = built.model.blocks.labels
    assert labels.position("course").tolist() == [*np.repeat([0, 1, 2], 8), *[-1] * 40]
    assert labels.position("ring").tolist() == [*[-1] * 24, *np.repeat(range(5), 8)]
    assert labels.position("segment").tolist() == [*range(8)] * 8
    assert [ground.label for ground in built.model.grounds] == ["ground under dome[0] and 7 more"]
    beds = np.sort(built.contacts.areas[np.abs(built.contacts.normals[:, 2]) > 1 - 1e-9])
    assert beds.sum() == pytest.approx(area * (3 * (2.5**2 - 2.0**2) + (2.3**2 - 2.0**2)), rel=1e-11)


@pytest.mark.parametrize("thickness", ["", "thickness: 0.45"])
def test_a_segmental_dome_on_a_bevelled_drum(tmp_path: Path, thickness: str) -> None:
    built = assemble(
        tmp_path,
        "dome: {material: stone, shape: segmental, embrace: 120, span: 4, thickness: 0.3, rings: 3, segments: 8, "
        f"springers: ground, drum: {{height: 1, courses: 2, {thickness}}}}}",
        supports="[]",
    )
    width = 0.45 if thickness else 0.3
    # the last course: a rectangle up to the springing, a triangle over it, a ledge outside
    run, rise = 0.3 * np.sin(np.pi / 3), 0.3 * np.cos(np.pi / 3)
    triangle, ledge = run * rise / 2, (width - run) * rise
    moment = width * 0.5 * (2 + width / 2) + triangle * (2 + run * 2 / 3) + ledge * (2 + (run + width) / 2)
    drum = built.volume_of("drum")
    assert drum[8:].sum() == pytest.approx(16 * np.sin(np.pi / 8) * moment, rel=1e-12)


def test_a_dome_in_running_bond_turns_every_other_ring() -> None:
    corners: FloatArray = dome().parts[0].polyhedra.vertices.reshape(40, 12, 3)
    first = np.degrees(np.arctan2(corners[::8, 0, 1], corners[::8, 0, 0]))
    assert first == pytest.approx([0, 22.5, 0, 22.5, 0])


@pytest.mark.parametrize(
    ("keys", "findings"),
    [
        ({"oculus": 4.0}, [(("oculus",), "must be < 4, the greatest diameter of the intrados")]),
        ({"keystone": 5.0}, [(("keystone",), "must be < 4, the greatest diameter of the intrados")]),
        (
            {"drum": {"height": 1, "courses": 2, "thickness": 0.2}},
            [(("drum", "thickness"), "must be >= 0.3, so that the dome stands on the drum")],
        ),
        (
            {"shape": "segmental", "embrace": 200, "drum": {"height": 0.1, "courses": 2, "thickness": 0.3}},
            [(("drum", "courses"), "too many: the springing joint cuts through the last course")],
        ),
    ],
)
def test_refused(keys: dict[str, Any], findings: list[Any]) -> None:
    with pytest.raises(ItemRefused) as caught:
        dome(**keys)
    assert list(caught.value.findings) == findings
