"""Pressure on faces: resultants of hydrostatics, Archimedes, and faces that other blocks cover."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.errors import DeckError
from mbla.model import build_model
from mbla.model.model import Model
from tests.model.shapes import deck

DAM = ["box: {group: dam, material: stone, min: [0, 0, 0], max: [2, 3, 4]}"]
WEDGE = [
    "polyhedron: {group: wedge, material: stone, vertices: [[0,0,0],[2,0,0],[0,1,0],[0.4,0.3,1.5]], "
    "faces: [[0,2,1],[0,1,3],[1,2,3],[2,0,3]]}"
]
GROUND = "[{ground: {z: 0}}]"
FIXED = "[{blocks: held}]"
HELD = "box: {group: held, material: stone, min: [90, 90, 90], max: [91, 91, 91]}"


def model(folder: Path, pressure: str, blocks: list[str], supports: str = GROUND, more: str = "") -> Model:
    loads = f"dead: [{{gravity: none}}, {{pressure: {{{pressure}}}{more}}}], live: [{{acceleration: [1, 0, 0]}}]"
    return build_model(deck(folder, blocks, supports, loads))


def load_about(model: Model, point: list[float]) -> FloatArray:
    """Force and moment of the dead load about a point."""
    load = model.load_cases[0].dead_load
    moments = load[:, 3:] + np.cross(model.blocks.centroids - np.array(point), load[:, :3])
    return np.concatenate([load[:, :3].sum(axis=0), moments.sum(axis=0)])


@pytest.mark.parametrize(("level", "depth"), [(4.0, 4.0), (3.0, 3.0), (0.7, 0.7), (9.0, None)])
def test_water_against_a_dam(tmp_path: Path, level: float, depth: float | None) -> None:
    """γ h² b / 2 at a third of the depth; with water above the crest the trapezium."""
    found = load_about(model(tmp_path, f"normal: [-1, 0, 0], level: {level}, per_depth: 10000", DAM), [0, 0, 0])
    if depth is not None:
        force, arm = 10000 * depth**2 / 2 * 3, depth / 3
    else:
        force, arm = 10000 * (9 + 5) / 2 * 4 * 3, 4 / 3 * (2 * 5 + 9) / (5 + 9)
    assert found == pytest.approx([force, 0, 0, 0, force * arm, -force * 1.5], rel=1e-12, abs=1e-7)


def test_uniform_pressure_and_surcharge_below_a_level(tmp_path: Path) -> None:
    plain = load_about(model(tmp_path, "normal: [-1, 0, 0], value: 500", DAM), [0, 0, 0])
    assert plain == pytest.approx([500 * 12, 0, 0, 0, 500 * 12 * 2, -500 * 12 * 1.5], rel=1e-12)
    cut = load_about(model(tmp_path, "normal: [-1, 0, 0], value: 500, level: 2.5", DAM), [0, 0, 0])
    assert cut == pytest.approx([500 * 7.5, 0, 0, 0, 500 * 7.5 * 1.25, -500 * 7.5 * 1.5], rel=1e-12)
    suction = load_about(model(tmp_path, "normal: [-1, 0, 0], value: -500", DAM), [0, 0, 0])
    assert suction == pytest.approx(-plain)


@pytest.mark.parametrize("level", [0.6, 1.5, 4.0])
def test_archimedes(tmp_path: Path, level: float) -> None:
    """Water all around lifts a body by the weight of what it displaces, at the centroid of the part below the level."""
    found = model(tmp_path, f"level: {level}, per_depth: 7", [*WEDGE, HELD], FIXED, ", on: wedge")
    volume = 0.5 * (1 - max(0.0, 1 - level / 1.5) ** 3)
    force = load_about(found, [0, 0, 0])[:3]
    assert force == pytest.approx([0, 0, 7 * volume], rel=1e-12, abs=1e-12)
    if level >= 1.5:
        assert found.load_cases[0].dead_load[0, 3:] == pytest.approx(np.zeros(3), abs=1e-12)


def test_an_l_shaped_face_and_its_moment(tmp_path: Path) -> None:
    """A face that is not convex: an L of area 3, centroid (5/6, 5/6), pushed down by 2 Pa."""
    ell = (
        "polyhedron: {group: ell, material: stone, vertices: [[0,0,0],[2,0,0],[2,1,0],[1,1,0],[1,2,0],[0,2,0],"
        "[0,0,1],[2,0,1],[2,1,1],[1,1,1],[1,2,1],[0,2,1]], faces: [[5,4,3,2,1,0],[6,7,8,9,10,11],[0,1,7,6],[1,2,8,7],"
        "[2,3,9,8],[3,4,10,9],[4,5,11,10],[5,0,6,11]]}"
    )
    found = load_about(model(tmp_path, "normal: [0, 0, 1], value: 2", [ell]), [0, 0, 0])
    assert found == pytest.approx([0, 0, -6, -6 * 5 / 6, 6 * 5 / 6, 0], rel=1e-12)
    # a box on one arm of the L leaves the rest of it free: two squares
    top = "box: {group: top, material: stone, min: [1, 0, 1], max: [2, 1, 2]}"
    both = model(tmp_path, "normal: [0, 0, 1], value: 2", [ell, top], more=", on: ell")
    assert load_about(both, [0, 0, 0]) == pytest.approx([0, 0, -4, -4, 2, 0], rel=1e-12)
    assert [notice.identifier for notice in both.notices] == ["pressure-on-part-of-face"]


def test_no_pressure_between_blocks(tmp_path: Path) -> None:
    """A wall in water: on its joints there is none, so that only its outside counts, which is closed save the foot."""
    wall = ["wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 2.0, courses: 4}"]
    found = model(tmp_path, "value: 1", wall)
    # the pressure on the closed outside adds up to nothing; that on the foot, 0.4 m2, is missing
    assert load_about(found, [1, 0.1, 0]) == pytest.approx([0, 0, -0.4, 0, 0, 0], abs=1e-12)
    everywhere = model(tmp_path, "value: 1, faces: all", wall).load_cases[0].dead_load
    assert everywhere == pytest.approx(np.zeros_like(everywhere), abs=1e-12)
    assert not found.notices


def test_a_face_partly_covered_by_two_blocks(tmp_path: Path) -> None:
    blocks = [
        "box: {group: slab, material: stone, min: [0, 0, 0], max: [10, 2, 1]}",
        "box: {group: post, material: stone, min: [1, 0, 1], max: [2, 1, 3]}",
        "box: {group: post, material: stone, min: [9, 1, 1], max: [11, 3, 3]}",
    ]
    found = model(tmp_path, "normal: [0, 0, 1], value: 1", blocks, more=", on: slab").load_cases[0].dead_load
    # free: 20 - 1 - 1; moments of the two squares at (1.5, 0.5) and (9.5, 1.5) about the middle (5, 1)
    expected = -np.cross([1.5 - 5, 0.5 - 1, 0.5], [0, 0, -1]) - np.cross([9.5 - 5, 1.5 - 1, 0.5], [0, 0, -1])
    assert found[0, 2] == pytest.approx(-18)
    assert found[0, 3:] == pytest.approx(expected, abs=1e-12)


def test_box_and_angle_choose_faces(tmp_path: Path) -> None:
    blocks = ["wall: {group: wall, material: stone, unit: [0.4, 0.2, 0.2], length: 2.0, courses: 4}"]
    words = "normal: [0, -1, 0], value: 1, box: [[-1, -1, 0.4], [3, 1, 0.8]]"
    found = load_about(model(tmp_path, words, blocks), [0, 0, 0])
    assert found[1] == pytest.approx(0.8, rel=1e-12)
    arch = [
        "arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.4, width: 1, voussoirs: 18, "
        "springers: ground}"
    ]
    # joints are radial every 10 degrees, outer faces at 5, 15, ... from the crown on either side
    for within, faces in ((4.9, 0), (5.1, 2), (40, 8), (89, 18)):
        pressure = f"normal: [0, 0, 1], within: {within}, value: 1"
        if faces:
            words = model(tmp_path, pressure, arch, "[]").load_cases[0].dead_words[1]
            assert f"on {faces} faces" in words
        else:
            with pytest.raises(DeckError, match="no face of these blocks lies so: look"):
                model(tmp_path, pressure, arch, "[]")


def earth_pressure(soil: float, wall: float, batter: float, slope: float) -> float:
    """Coulomb's K_a, of the whole pressure: φ, δ, back of the wall from upright, leaning to the soil below, and slope.

    Coulomb 1776; EN 1998-5 annex E (E.3) with no earthquake. All in degrees.
    """
    phi, delta, psi, beta = np.radians([soil, wall, 90.0 - batter, slope])
    root = np.sqrt(np.sin(phi + delta) * np.sin(phi - beta) / (np.sin(psi - delta) * np.sin(psi + beta)))
    return float(np.sin(psi + phi) ** 2 / (np.sin(psi) ** 2 * np.sin(psi - delta) * (1.0 + root) ** 2))


def test_coefficient_of_coulomb() -> None:
    """The usual tables: φ = 30°, level soil, upright backs with δ = 0 (Rankine), 15° and 20°; a back at 10°, smooth."""
    assert earth_pressure(30, 0, 0, 0) == pytest.approx(1 / 3)
    assert earth_pressure(30, 20, 0, 0) == pytest.approx(0.2973, abs=1e-4)
    assert earth_pressure(30, 15, 0, 0) == pytest.approx(0.3014, abs=1e-4)
    assert earth_pressure(30, 0, 10, 0) == pytest.approx(0.4067, abs=2e-4)


@pytest.mark.parametrize("units", ["", "length: mm, force: kN, mass: t"])
@pytest.mark.parametrize("batter", [-12.0, 0.0, 15.0])
@pytest.mark.parametrize("wall", [20.0, -10.0])
def test_earth_pressure_with_wall_friction(tmp_path: Path, units: str, batter: float, wall: float) -> None:
    """½ K γ H² + K q H per width over cos(batter), at δ from the normal of the back, at a third and half of it.

    The soil stands at x > back of a wall 3 m wide (y) and 4 m high, with 18 kN/m3 and 10 kN/m2 on it. The back leans
    to the soil below, if the batter is positive.
    """
    run = 4.0 * np.tan(np.radians(batter))
    coefficient = earth_pressure(30.0, max(wall, 0.0), batter, 0.0)
    whole = coefficient * np.array([10e3, 18e3])
    length, force = (1e3, 1e-3) if units else (1.0, 1.0)
    corners = np.array([(0, 0), (2 + run, 0), (2, 4), (0, 4)]) * length
    points = [[float(x), y * length, float(z)] for y in (0.0, 3.0) for x, z in corners]
    sides = "[[0,1,2,3],[7,6,5,4],[0,4,5,1],[1,5,6,2],[2,6,7,3],[3,7,4,0]]"
    wall_block = f"polyhedron: {{group: wall, material: stone, vertices: {points}, faces: {sides}}}"
    normal = whole * np.cos(np.radians(wall))
    given = (
        f"normal: [1, 0, 0], within: 20, value: {normal[0]} Pa, level: 4 m, per_depth: {normal[1]} N/m^3, "
        f"wall_friction: {wall}"
    )
    loads = f"dead: [{{gravity: none}}, {{pressure: {{{given}}}}}], live: [{{acceleration: [1, 0, 0]}}]"
    found = load_about(build_model(deck(tmp_path, [wall_block], GROUND, loads, units)), [0, 0, 0])
    sizes = np.array([whole[0] * 4.0, whole[1] * 8.0]) * 3.0 / np.cos(np.radians(batter))
    angle = np.radians(batter + wall)  # from the level, downwards, of what pushes to -x
    parts = sizes[:, None] * [-np.cos(angle), 0.0, -np.sin(angle)]
    heights = np.array([2.0, 4.0 / 3.0])
    places = np.column_stack([2.0 + run * (1.0 - heights / 4.0), np.full(2, 1.5), heights])
    expected = np.concatenate([parts.sum(axis=0) * force, np.cross(places, parts).sum(axis=0) * force * length])
    assert found == pytest.approx(expected, rel=1e-10, abs=1e-7)


def test_wall_friction_turns_with_the_structure(tmp_path: Path) -> None:
    """Back faces to every side: each is dragged straight down its slope, by tan δ of what presses it."""
    pyramid = (
        "polyhedron: {group: p, material: stone, vertices: [[0,0,0],[4,0,0],[4,2,0],[0,2,0],[1.5,1.2,3]], "
        "faces: [[0,3,2,1],[0,1,4],[1,2,4],[2,3,4],[3,0,4]]}"
    )
    for normal in ([1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0]):
        given = f"normal: {normal}, within: 60, value: 3"
        pushed = load_about(model(tmp_path, given, [pyramid]), [0, 0, 0])[:3]
        dragged = load_about(model(tmp_path, f"{given}, wall_friction: 30", [pyramid]), [0, 0, 0])[:3] - pushed
        assert np.linalg.norm(dragged) == pytest.approx(np.tan(np.pi / 6) * np.linalg.norm(pushed))
        assert dragged @ pushed == pytest.approx(0.0, abs=1e-12)
        assert np.cross(dragged, pushed)[2] == pytest.approx(0.0, abs=1e-12)  # in the upright plane of the normal
        assert dragged[2] < 0


def test_no_direction_down_a_level_face(tmp_path: Path) -> None:
    given = "level: 4, per_depth: 20, wall_friction: 10"
    with pytest.raises(DeckError, match=r"a level face is among these"):
        model(tmp_path, "level: 5, per_depth: 20, wall_friction: 10", DAM)
    # at the level itself there is no pressure, and the foot stands on the ground
    assert load_about(model(tmp_path, given, DAM), [1, 1.5, 0])[2] < 0


@pytest.mark.parametrize(("units", "length", "force"), [("length: mm, force: kN, mass: t", 1e3, 1e-3)])
def test_units(tmp_path: Path, units: str, length: float, force: float) -> None:
    metres = load_about(model(tmp_path, "normal: [-1, 0, 0], level: 3, per_depth: 10000", DAM), [0, 0, 0])
    size = [each * length for each in (2, 3, 4)]
    box = [f"box: {{group: dam, material: stone, min: [0, 0, 0], max: {size}}}"]
    pressure = "pressure: {normal: [-1, 0, 0], level: 3 m, per_depth: 10 kN/m^3}"
    text = f"dead: [{{gravity: none}}, {{{pressure}}}], live: [{{acceleration: [1, 0, 0]}}]"
    found = load_about(build_model(deck(tmp_path, box, GROUND, text, units)), [0, 0, 0])
    assert found[:3] == pytest.approx(metres[:3] * force, abs=1e-9)
    assert found[3:] == pytest.approx(metres[3:] * force * length, abs=1e-6)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ("value: 500", "pressure 500 N/m2, on 1 face (12 m2)"),
        ("value: 500, level: 3", "pressure 500 N/m2 below z = 3 m, on 1 face (9 m2)"),
        ("level: 3, per_depth: 20", "pressure 20 N/m3 times depth below z = 3 m, on 1 face (9 m2)"),
        ("value: 500, wall_friction: 20", "pressure 500 N/m2, inclined down by 20°, on 1 face (12 m2)"),
        ("value: 500, wall_friction: -2.5", "pressure 500 N/m2, inclined up by 2.5°, on 1 face (12 m2)"),
        ("value: 5, level: 3, per_depth: 20", "pressure 5 N/m2 + 20 N/m3 times depth below z = 3 m, on 1 face (9 m2)"),
    ],
)
def test_words_of_the_listing(tmp_path: Path, keys: str, words: str) -> None:
    assert model(tmp_path, f"normal: [-1, 0, 0], {keys}", DAM).load_cases[0].dead_words == ("no gravity", words)
