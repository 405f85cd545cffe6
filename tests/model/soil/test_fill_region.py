"""The region between an arch and the top of its fill: its area, its corners, its ends, and what it may not be."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model.model import Model
from tests.model.soil.decks import ARCH, LEVEL, fill, model, refused

RADIUS = (4.0 / 4 * 4.0 + 1.0) / 2.0
OUTER = RADIUS + 0.3
HALF = math.asin(2.0 / RADIUS)
JOINTS = np.linspace(-HALF, HALF, 16)
EXTRADOS = np.stack([2.0 + OUTER * np.sin(JOINTS), 1.0 - RADIUS + OUTER * np.cos(JOINTS)], axis=1)


def area_over_extrados(level: float) -> float:
    """Between the chords of the extrados and a level."""
    heights = level - EXTRADOS[:, 1]
    return float((np.diff(EXTRADOS[:, 0]) * (heights[1:] + heights[:-1]) / 2.0).sum())


def area_of(found: Model) -> float:
    (soil,) = found.soils
    return float(soil.areas(soil.points).sum())


def missing(points: FloatArray, among: FloatArray) -> float:
    """Greatest distance of a point from the nearest of others."""
    return float(np.linalg.norm(points[:, None] - among[None], axis=2).min(axis=1).max())


def test_over_a_segmental_arch(tmp_path: Path) -> None:
    found = model(tmp_path, ARCH, fill=fill())
    (soil,) = found.soils
    assert area_of(found) == pytest.approx(area_over_extrados(LEVEL), rel=1e-12)
    assert np.array_equal(soil.axes, [[1, 0, 0], [0, 0, 1], [0, 1, 0]])
    assert soil.extent == pytest.approx([0.0, 2.0])
    ends = np.array([[EXTRADOS[0, 0], LEVEL], [EXTRADOS[-1, 0], LEVEL]])
    corners = np.concatenate([EXTRADOS, ends])
    assert len(soil.points[soil.fixed]) == len(corners)
    assert missing(corners, soil.points[soil.fixed]) < 1e-12
    assert sum(ground.label.endswith("end of soil") for ground in found.grounds) == 2


def test_beyond_the_ends_on_ground_at_the_foot(tmp_path: Path) -> None:
    found = model(tmp_path, ARCH, fill=fill(cells="size: 0.4, beyond: 1.5"))
    besides = 2 * 1.5 * (LEVEL - EXTRADOS[0, 1])
    assert area_of(found) == pytest.approx(area_over_extrados(LEVEL) + besides, rel=1e-12)
    labels = [ground.label for ground in found.grounds[2:]]
    assert labels == [
        f"ground {where} the {side} end of soil" for side in ("left", "right") for where in ("at", "under")
    ]
    upright, under = found.grounds[2:4]
    assert upright.normal == pytest.approx([1, 0, 0])
    assert under.normal == pytest.approx([0, 0, 1])
    assert under.outline is not None
    assert np.ptp(under.outline, axis=0) == pytest.approx([1.5, 2.0, 0.0])


def test_level_ground_of_the_deck_carries_what_stands_on_it(tmp_path: Path) -> None:
    """Beyond a wall on the ground."""
    wall = "box: {group: arch, material: stone, min: [0, 0, 0], max: [1, 2, 1]}"
    found = model(tmp_path, wall, fill=fill(cells="size: 0.4, beyond: 1"), supports="[{ground: {z: 0}}]")
    assert area_of(found) == pytest.approx(0.5 + 2 * 1.5, rel=1e-12)
    assert [ground.label for ground in found.grounds] == [
        "ground at the left end of soil",
        "ground at the right end of soil",
        "ground z = 0",
    ]


def test_below_a_sloping_top(tmp_path: Path) -> None:
    text = fill().replace(f"level: {LEVEL}", f"surface: {{point: [2, 0, {LEVEL}], normal: [-0.05, 0, 1]}}")
    assert area_of(model(tmp_path, ARCH, fill=text)) == pytest.approx(area_over_extrados(LEVEL), rel=1e-9)
    across = text.replace("[-0.05, 0, 1]", "[0, 0.05, 1]")
    assert refused(tmp_path, ARCH, fill=across)[0][0] == "fill.soil.surface.normal"


def test_along_any_horizontal_direction(tmp_path: Path) -> None:
    turned = ARCH[:-1] + ", transform: {rotate: {axis: [0, 0, 1], angle: 30}}}"
    (soil,) = model(tmp_path, turned, fill=fill()).soils
    cosine, sine = math.cos(math.pi / 6), math.sin(math.pi / 6)
    assert soil.axes == pytest.approx(np.array([[cosine, sine, 0], [0, 0, 1], [-sine, cosine, 0]]))
    assert soil.areas(soil.points).sum() == pytest.approx(area_over_extrados(LEVEL), rel=1e-9)


def spandrel(low: float, high: float, left: float = -1.0, group: str = "spandrel") -> str:
    """A wall on the arch along one of its faces."""
    corners = f"min: [{left}, {low}, -0.5], max: [5, {high}, 1.5]"
    return f"box: {{group: {group}, material: stone, {corners}}}"


def test_between_spandrel_walls(tmp_path: Path) -> None:
    """That these boxes lie in the arch is for the search of contacts to refuse."""
    (soil,) = model(tmp_path, ARCH, spandrel(0, 0.3), spandrel(1.6, 2), fill=fill()).soils
    assert soil.extent == pytest.approx([0.3, 1.6])


@pytest.mark.parametrize("box", [spandrel(0.5, 1), spandrel(0, 2), spandrel(0, 1, left=4.0)])
def test_blocks_in_it_are_refused(tmp_path: Path, box: str) -> None:
    ((key, words),) = refused(tmp_path, ARCH, box, fill=fill())
    assert key == "fill.soil.on"
    assert "overlaps spandrel[0]" in words


def test_a_level_below_the_extrados_is_refused(tmp_path: Path) -> None:
    ((key, words),) = refused(tmp_path, ARCH, fill=fill(level=1.2))
    assert key == "fill.soil.level"
    assert "0.09465 below" in words


def test_blocks_that_change_across_are_refused(tmp_path: Path) -> None:
    half = "box: {group: arch, material: stone, min: [0, 0, 0], max: [1, 1, 1]}"
    rest = "box: {group: arch, material: stone, min: [0, 1, 0], max: [1, 2, 1.2]}"
    ((key, words),) = refused(tmp_path, half, rest, fill=fill(), supports="[{ground: {z: 0}}]")
    assert key == "fill.soil.on"
    assert "arch[1]" in words
    dome = "dome: {group: arch, material: stone, span: 2, thickness: 0.2, rings: 3, segments: 8}"
    assert refused(tmp_path, dome, fill=fill(), supports="[{ground: {z: 0}}]")[0][0] == "fill.soil.on"


def test_corners_of_what_stands_on_top_are_corners(tmp_path: Path) -> None:
    pad = f"box: {{group: pad, material: stone, min: [1.1, 0, {LEVEL}], max: [1.4, 2, 1.7]}}"
    (soil,) = model(tmp_path, ARCH, pad, fill=fill()).soils
    assert missing(np.array([[1.1, LEVEL], [1.4, LEVEL]]), soil.points[soil.fixed]) < 1e-12


BRIDGE = (
    "bridge: {group: arch, material: stone, shape: segmental, spans: [4], rise: 1, thickness: 0.3, voussoirs: 15, "
    "width: 2, abutments: {width: 1, height: 1, courses: 2}, spandrels: edges, spandrel_thickness: 0.3, "
    "unit: [0.8, 0.4], cover: 0.3}"
)
"""Its walls rise to z = 1.595, over an arch as of `ARCH`."""


@pytest.mark.parametrize("more", ["", ", backing: 1", ", parapets: {height: 0.5, thickness: 0.4}"])
def test_a_whole_bridge_carries_it_between_its_spandrel_walls(tmp_path: Path, more: str) -> None:
    """They may be higher than the road, and so may what stands on them."""
    whole = model(tmp_path, BRIDGE[:-1] + more + "}", fill=fill(cells="size: 0.5, beyond: 3"))
    (soil,) = whole.soils
    assert soil.extent == pytest.approx([0.3, 1.7])
    members = ", ".join(f"{{group: arch, member: {each}}}" for each in ("voussoir", "springer", "abutment"))
    others = fill(cells="size: 0.5, beyond: 3").replace("on: arch", f"on: [{members}]")
    if "backing" not in more:
        (same,) = model(tmp_path, BRIDGE[:-1] + more + "}", fill=others).soils
        assert np.array_equal(same.points, soil.points)
    volumes = whole.blocks.volumes[whole.soil_of_block < 0].sum(), whole.blocks.volumes[soil.blocks].sum()
    assert volumes[1] == pytest.approx(1.4 * area_of(whole))
    assert area_of(whole) > area_over_extrados(LEVEL)


def test_a_wall_along_one_face_of_what_carries_it(tmp_path: Path) -> None:
    (soil,) = model(tmp_path, ARCH, spandrel(0, 0.3, group="arch"), fill=fill()).soils
    assert soil.extent == pytest.approx([0.3, 2])


def test_walls_of_two_thicknesses_are_refused(tmp_path: Path) -> None:
    thin = spandrel(0, 0.2, group="arch").replace("max: [5,", "max: [2,")
    thick = spandrel(0, 0.3, left=2, group="arch")
    ((key, words),) = refused(tmp_path, ARCH, thin, thick, fill=fill())
    assert key == "fill.soil.on"
    assert "arch[15] thinner" in words
