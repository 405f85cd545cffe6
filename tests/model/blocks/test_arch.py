"""Shapes of arches, rings, units across the width, skew plans and piers."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from shapely.geometry import Polygon
from shapely.ops import unary_union

from mbla.arrays import FloatArray
from mbla.contacts import find_contacts
from mbla.deck.sections.contacts import ContactsSection
from mbla.model.blocks.arch import ArchItem, generate
from mbla.model.blocks.generated import Generated, ItemContext, ItemRefused
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polyhedra import join_polyhedra
from tests.contacts.structures import blocks_of, model_of
from tests.model.shapes import build_raw

SITE = ItemContext(1e-3, lambda path, name: Path(name))


def arch(**keys: Any) -> Generated:
    base = {"material": "stone", "shape": "semicircular", "span": 4.0, "thickness": 0.3, "width": 1.0, "voussoirs": 27}
    return generate(ArchItem.model_validate(base | keys), SITE)


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


SPAN, THICKNESS, WIDTH, COUNT = 4.0, 0.5, 1.5, 13
POINTS = [[0, 0], [0.4, 1.0], [1.3, 1.7], [2.6, 1.8], [3.7, 0.9], [4.0, 0.2]]
SHAPES: dict[str, dict[str, Any]] = {
    "semicircular": {},
    "segmental": {"rise": 0.8},
    "pointed": {"rise": 3.0},
    "elliptic": {"rise": 1.2},
    "catenary": {"rise": 2.5},
    "basket": {"rise": 1.3, "side_angle": 55},
    "points": {"span": None, "points": POINTS},
}
SMOOTH = [shape for shape in SHAPES if shape != "pointed"]

every_shape = pytest.mark.parametrize("shape", list(SHAPES))


def arch_of_arch_shapes(shape: str, **keys: Any) -> Generated:
    base = {"material": "stone", "shape": shape, "span": SPAN, "thickness": THICKNESS, "width": WIDTH}
    return generate(ArchItem.model_validate(base | {"voussoirs": COUNT} | SHAPES[shape] | keys), SITE)


def built(made: Generated) -> Blocks:
    return blocks_of(join_polyhedra([part.polyhedra for part in made.parts]))


def area_of_contacts(blocks: Blocks) -> tuple[int, float]:
    """Number and total area of interfaces; the first block is held, so that nothing hangs in the air."""
    found = find_contacts(model_of(blocks, fixed=[0]), ContactsSection(joint="dry"))
    assert not found.report.notices, [notice.message for notice in found.report.notices]
    return len(found.areas), float(found.areas.sum())


def corners(made: Generated) -> FloatArray:
    """Of voussoirs that are quadrilaterals in section: (n, 4, 2), intrados left and right, extrados right and left."""
    return made.parts[0].polyhedra.vertices.reshape(-1, 8, 3)[:, 4:][..., [0, 2]]


def outline_area(made: Generated) -> float:
    """Area of the section from its outline alone: intrados and extrados as two chains of chords."""
    section = corners(made)
    chain = [*section[:, 0], section[-1, 1], section[-1, 2], *section[::-1, 3]]
    return float(Polygon(chain).area)


@every_shape
@pytest.mark.parametrize("line", ["intrados", "centre"])
def test_volume_is_that_between_the_two_chains_of_chords(shape: str, line: str) -> None:
    made = arch_of_arch_shapes(shape, line=line, voussoirs=COUNT - 1)
    blocks = built(made)
    assert len(blocks) == COUNT - 1
    assert blocks.volumes.sum() == pytest.approx(outline_area(made) * WIDTH, rel=1e-12)
    sections = [Polygon(section) for section in corners(made)]
    assert all(section.is_valid for section in sections)
    assert unary_union(sections).area == pytest.approx(blocks.volumes.sum() / WIDTH, rel=1e-9)


@pytest.mark.parametrize("shape", SMOOTH)
def test_area_in_the_limit_is_length_and_turn_times_thickness(shape: str) -> None:
    """Between a curve and the line beside it lies the area L t + a t^2 / 2, a the angle that the curve turns by."""
    made = arch_of_arch_shapes(shape, voussoirs=2000)
    section = corners(made)
    length = np.linalg.norm(section[:, 1] - section[:, 0], axis=1).sum()
    ends = section[[0, -1], [3, 2]] - section[[0, -1], [0, 1]]
    first, last = np.arctan2(ends[:, 1], ends[:, 0])
    turn = (first - last) % (2 * np.pi)
    area = length * THICKNESS + turn * THICKNESS**2 / 2
    assert built(made).volumes.sum() == pytest.approx(area * WIDTH, rel=1e-6)


@every_shape
@pytest.mark.parametrize("rings", [1, 3])
def test_contacts_are_complete(shape: str, rings: int) -> None:
    """Radial joints carry the thickness; joints between rings carry the chords between them."""
    made = arch_of_arch_shapes(shape, rings=rings, voussoirs=COUNT - 1)
    section = corners(made).reshape(rings, COUNT - 1, 4, 2)
    radial = np.linalg.norm(section[:, :-1, 2] - section[:, :-1, 1], axis=-1).sum()
    between = np.linalg.norm(section[1:, :, 1] - section[1:, :, 0], axis=-1).sum()
    count, area = area_of_contacts(built(made))
    assert count == rings * (COUNT - 2) + (rings - 1) * (COUNT - 1)
    assert area == pytest.approx((radial + between) * WIDTH, rel=1e-9)


@every_shape
def test_rings_fill_the_arch(shape: str) -> None:
    one, three = arch_of_arch_shapes(shape), arch_of_arch_shapes(shape, rings=3)
    assert built(three).volumes.sum() == pytest.approx(built(one).volumes.sum(), rel=1e-12)
    labels = three.parts[0].labels
    assert labels["ring"].tolist() == np.repeat([0, 1, 2], COUNT).tolist()
    assert labels["voussoir"].tolist() == list(range(COUNT)) * 3


@every_shape
def test_joints_are_normal_to_the_intrados(shape: str) -> None:
    """With many voussoirs the chords on both sides of a joint come close to the tangent."""
    count = 400 if shape != "pointed" else 80
    section = corners(arch_of_arch_shapes(shape, voussoirs=count))
    chords = section[:, 1] - section[:, 0]
    joints = section[:, 2] - section[:, 1]
    tangents = chords[:-1] / np.linalg.norm(chords[:-1], axis=1, keepdims=True) + (
        chords[1:] / np.linalg.norm(chords[1:], axis=1, keepdims=True)
    )
    across = np.abs((tangents * joints[:-1]).sum(axis=1)) / np.linalg.norm(tangents, axis=1) / THICKNESS
    if shape == "pointed":  # its chords next to the apex differ in length
        across = np.delete(across, [count // 2 - 2, count // 2])
    assert across.max() < 0.02


@every_shape
def test_half_the_thickness_lies_on_both_sides_of_a_centre_line(shape: str) -> None:
    of_line, around = (
        corners(arch_of_arch_shapes(shape, thickness=1e-9, voussoirs=12)),
        corners(arch_of_arch_shapes(shape, line="centre", voussoirs=12)),
    )
    section = around if shape != "pointed" else around[:-1]  # beside an apex the middle lies on the axis
    middle = (section[:, 0] + section[:, 3]) / 2
    if shape == "pointed":
        keep = np.arange(len(middle)) != 6
        assert middle[keep] == pytest.approx(of_line[:-1, 0][keep], abs=1e-6)
    else:
        assert middle == pytest.approx(of_line[:, 0], abs=1e-6)


@every_shape
def test_thickness_grows_from_crown_to_springing(shape: str) -> None:
    section = corners(arch_of_arch_shapes(shape, springing_thickness=0.9, voussoirs=12))
    thickness = np.linalg.norm(
        np.concatenate([section[:, 3], section[-1:, 2]]) - np.concatenate([section[:, 0], section[-1:, 1]]), axis=1
    )
    assert thickness[[0, -1]] == pytest.approx([0.9, 0.9])
    assert (np.diff(thickness[:7]) < 0).all()
    if shape not in ("points", "pointed"):  # no joint at half the length, or one in the plane of symmetry
        assert thickness[6] == pytest.approx(0.5)


# --- pointed arches -----------------------------------------------------------------------------------------------


def test_an_odd_pointed_arch_has_a_keystone_around_its_apex() -> None:
    made = arch_of_arch_shapes("pointed")
    blocks = built(made)
    assert np.flatnonzero(~blocks.convex).tolist() == [COUNT // 2]
    even, odd = built(arch_of_arch_shapes("pointed", voussoirs=38)), built(arch_of_arch_shapes("pointed", voussoirs=39))
    assert odd.volumes.sum() == pytest.approx(even.volumes.sum(), rel=1e-3)
    count, area = area_of_contacts(blocks)
    assert count == COUNT - 1
    assert area == pytest.approx((COUNT - 1) * THICKNESS * WIDTH)


def test_a_pointed_arch_in_the_limit_is_two_sectors_cut_at_the_axis() -> None:
    radius = (SPAN**2 / 4 + 9.0) / SPAN
    offset = radius - SPAN / 2

    def half(reach: float) -> float:
        angle = np.arccos(offset / reach)
        return float(angle * reach**2 / 2 - offset * reach * np.sin(angle) / 2)

    area = 2 * (half(radius + THICKNESS) - half(radius))
    assert built(arch_of_arch_shapes("pointed", voussoirs=80)).volumes.sum() == pytest.approx(area * WIDTH, rel=3e-4)


# --- across the width ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize("shape", ["semicircular", "pointed"])
@pytest.mark.parametrize("skew", [0.0, 30.0, -45.0])
def test_running_bond_across_the_width(shape: str, skew: float) -> None:
    one, made = arch_of_arch_shapes(shape, skew=skew), arch_of_arch_shapes(shape, skew=skew, units_across=3, rings=2)
    blocks = built(made)
    assert len(blocks) == 3 * COUNT + 4 * COUNT  # of a voussoir, one ring starts with half a block
    assert blocks.volumes.sum() == pytest.approx(built(one).volumes.sum(), rel=1e-12)
    labels = made.parts[0].labels
    first = (labels["voussoir"] == 0) & (labels["ring"] == 0)
    assert labels["unit"][first].tolist() == [0, 1, 2]
    second = (labels["voussoir"] == 1) & (labels["ring"] == 0)
    assert blocks.volumes[second] / blocks.volumes[second].sum() == pytest.approx([1 / 6, 1 / 3, 1 / 3, 1 / 6])


@pytest.mark.parametrize("skew", [0.0, 40.0])
def test_contacts_of_a_skew_arch(skew: float) -> None:
    """Joints are parallelograms along the sheared width; faces across it keep the area of the section."""
    made = arch_of_arch_shapes("elliptic", skew=skew, units_across=2, voussoirs=6)
    section = corners(arch_of_arch_shapes("elliptic", voussoirs=6))
    joints = section[:-1, 2] - section[:-1, 1]
    along = np.array([np.tan(np.radians(skew)), 1.0, 0.0])
    beds = np.linalg.norm(np.cross(np.insert(joints, 1, 0.0, axis=1), WIDTH * along), axis=1).sum()
    faces = np.array([Polygon(each).area for each in section])
    count, area = area_of_contacts(built(made))
    assert count == 3 * 1 + 3 * 2 + 5 * 4  # joints within even and odd voussoirs, then of two against three blocks
    assert area == pytest.approx(beds + faces[::2].sum() + 2 * faces[1::2].sum(), rel=1e-9)


def test_skew_ground_carries_the_springing_joints() -> None:
    made = arch_of_arch_shapes("segmental", skew=25, springers="ground", units_across=2, rings=2, joint="bed")
    vertices = made.parts[0].polyhedra.vertices.reshape(-1, 8, 3)
    assert [len(ground.blocks) for ground in made.grounds] == [2 + 3] * 2
    for ground in made.grounds:
        heights = np.sort((vertices[ground.blocks] - ground.point) @ ground.normal, axis=1)
        assert heights[:, :4] == pytest.approx(np.zeros((5, 4)), abs=1e-12)
        assert (heights[:, 4] > 0.1).all()
        assert ground.joint == "bed"


def test_skew_springer_blocks_touch_the_whole_joint() -> None:
    made = arch_of_arch_shapes("elliptic", skew=25, springers="blocks", units_across=2)
    blocks = blocks_of(join_polyhedra([part.polyhedra for part in made.parts]))
    without = area_of_contacts(built(arch_of_arch_shapes("elliptic", skew=25, units_across=2)))
    count, area = area_of_contacts(blocks)
    assert count - without[0] == 4
    assert area - without[1] == pytest.approx(2 * THICKNESS * WIDTH / np.cos(0.0), rel=1e-9)


# --- piers --------------------------------------------------------------------------------------------------------

PIERS = {"height": 3.0, "width": 0.8, "courses": 4}


@pytest.mark.parametrize("skew", [0.0, 20.0])
@every_shape
def test_arch_on_piers(shape: str, skew: float) -> None:
    made = arch_of_arch_shapes(shape, piers=PIERS, skew=skew)
    level = shape in ("semicircular", "pointed", "elliptic", "basket")
    assert [part.member for part in made.parts] == ["voussoir", "pier", *(["springer"] if not level else [])]
    pier = made.parts[1]
    assert pier.labels["course"].tolist() == [0, 0, 1, 1, 2, 2, 3, 3]
    assert pier.labels["unit"].tolist() == [0, 1] * 4
    volumes = blocks_of(pier.polyhedra).volumes
    assert volumes == pytest.approx([3.0 / 4 * 0.8 * WIDTH] * 8, rel=1e-12)
    count, area = area_of_contacts(built(made))
    alone = area_of_contacts(built(arch_of_arch_shapes(shape, skew=skew)))
    assert count == alone[0] + 6 + 2 + (0 if level else 2)
    bearing = 2 * 0.8 * WIDTH if not level else 0.0
    joint = made.parts[0].polyhedra.vertices.reshape(-1, 8 if shape != "pointed" else 1, 3)
    if skew == 0 and shape != "pointed":
        ends = np.linalg.norm(joint[0, 7] - joint[0, 4]) + np.linalg.norm(joint[-1, 6] - joint[-1, 5])
        assert area == pytest.approx(alone[1] + 6 * 0.8 * WIDTH + bearing + ends * WIDTH, rel=1e-9)


def test_a_pier_as_wide_as_the_springing_joint_reaches() -> None:
    """The springer block is then a triangle."""
    section = corners(arch_of_arch_shapes("catenary"))
    reach = float(-section[0, 3, 0])
    made = arch_of_arch_shapes("catenary", piers=PIERS | {"width": reach})
    springers = blocks_of(made.parts[2].polyhedra)
    assert springers.volumes == pytest.approx([reach * section[0, 3, 1] / 2 * WIDTH] * 2, rel=1e-9)


# --- refusals and invariance --------------------------------------------------------------------------------------


def test_joints_that_cross_are_refused() -> None:
    with pytest.raises(ItemRefused, match="joints of voussoir 59 cross"):
        arch_of_arch_shapes("pointed", voussoirs=120)
    assert len(built(arch_of_arch_shapes("pointed", voussoirs=40))) == 40


@pytest.mark.parametrize("shape", list(SHAPES))
def test_units_of_length_do_not_matter(shape: str) -> None:
    keys = dict(SHAPES[shape])
    large = {key: value * 1000 for key, value in keys.items() if key == "rise"}
    if shape == "points":
        large["points"] = (1000 * np.array(POINTS)).tolist()
    else:
        large["span"] = SPAN * 1000
    metres = arch_of_arch_shapes(shape).parts[0].polyhedra.vertices
    millimetres = (
        arch_of_arch_shapes(shape, **large, thickness=THICKNESS * 1000, width=WIDTH * 1000).parts[0].polyhedra.vertices
    )
    assert millimetres / 1000 == pytest.approx(metres, abs=1e-12)
