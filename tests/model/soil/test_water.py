"""Ground water in soil of cells: what it lifts and presses on, against hydrostatics, and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray
from mbla.model import build_model
from mbla.model.applied_load import AppliedLoad
from mbla.model.model import Model
from tests.model.soil.decks import ARCH, BACKFILL, GROUND, SIDEWAYS, WALL, deck, fill, model, moved_to, refused
from tests.model.soil.test_fill_region import area_over_extrados

WEIGHT = 9810.0
CLAY = (
    "soil: {group: clay, material: earth, outline: [[1.6, 0], [2.6, 0], [2.6, 1], [1.6, 1]], width: 1, "
    "cells: {size: 0.3}, friction_angle: 20}"
)


def wet(keys: str = "level: 0.6", item: str = BACKFILL) -> str:
    return f"{item[:-1]}, water: {{{keys}}}}}"


def water_of(found: Model) -> AppliedLoad:
    """The only load of water, the same in every load case."""
    (load,) = [each for each in found.load_cases[0].dead if each.words.startswith("water")]
    return load


def about(found: Model, load: AppliedLoad, point: FloatArray, *, cells: bool) -> FloatArray:
    """Force and moment about a point of the part of a load that acts on cells, or on blocks."""
    chosen = (found.soil_of_block[load.blocks] >= 0) == cells
    forces = load.wrenches[chosen, :3]
    arms = found.blocks.centroids[load.blocks[chosen]] - point
    return np.append(forces.sum(axis=0), (load.wrenches[chosen, 3:6] + np.cross(arms, forces)).sum(axis=0))


def on_blocks(found: Model, load: AppliedLoad) -> FloatArray:
    """Force and moment about the centroid of every block, (n_blocks, 6)."""
    total = np.zeros((len(found.blocks), 6))
    total[load.blocks] = load.wrenches[:, :6]
    return total


@pytest.mark.parametrize("level", [-0.1, 0.0, 0.35, 0.6, 1.0, 1.7])
def test_wall_and_soil_behind_it(tmp_path: Path, level: float) -> None:
    """The weight of the water in place of the soil lifts it; γ h²/2 at h/3, or a trapezium, presses on the wall."""
    found = model(tmp_path, WALL, wet(f"level: {level}"), supports=GROUND)
    load, depth = water_of(found), min(max(level, 0.0), 1.0)
    up = WEIGHT * 1.6 * depth
    lift = about(found, load, np.array([0.8, 0.5, 0.0]), cells=True)
    assert lift == pytest.approx([0, 0, up, 0, 0, 0], rel=1e-12, abs=1e-9)
    bottom, top = WEIGHT * max(level, 0.0), WEIGHT * (max(level, 0.0) - depth)
    push, moment = (bottom + top) / 2 * depth, (bottom / 6 + top / 3) * depth**2
    on_wall = about(found, load, np.array([0.0, 0.5, 0.0]), cells=False)
    assert on_wall == pytest.approx([-push, 0, 0, 0, -moment, 0], rel=1e-12, abs=1e-9)


def test_cells_are_lifted_as_pressure_on_all_their_faces_does(tmp_path: Path) -> None:
    """Force and moment of every cell, once by its part below the level, once by hydrostatics on its surface."""
    faces = "dead: [{pressure: {level: 0.53, per_depth: 9810, faces: all}, on: backfill}]"
    found = model(tmp_path, WALL, wet("level: 0.53"), supports=GROUND, loads=f"{faces}, {SIDEWAYS}")
    _, pressed, load = found.load_cases[0].dead
    cells = found.soils[0].blocks
    by_surface, by_part = (on_blocks(found, each)[cells] for each in (pressed, load))
    assert by_part == pytest.approx(by_surface, abs=1e-12 * np.abs(by_surface).max())


def test_it_follows_points_that_are_moved(tmp_path: Path) -> None:
    """Moved inside and along edges, the whole is lifted alike, and presses on the wall alike; each cell by its part."""
    read = deck(tmp_path, WALL, wet(), supports=GROUND)
    before = build_model(read)
    (soil,) = before.soils
    shifts = np.where(soil.inside[:, None], [0.02, -0.01], 0.03 * soil.along)
    after = build_model(read, moved_to(soil, soil.points + shifts))
    loads = [water_of(each) for each in (before, after)]
    for cells in (True, False):
        same = [about(each, load, np.zeros(3), cells=cells) for each, load in zip((before, after), loads, strict=True)]
        assert same[0] == pytest.approx(same[1], rel=1e-9, abs=1e-6)
    assert not np.allclose(on_blocks(before, loads[0]), on_blocks(after, loads[1]))
    low = after.blocks.centroids[:, 2] + after.blocks.sizes < 0.6
    low &= after.soil_of_block >= 0
    assert low.any()
    assert on_blocks(after, loads[1])[low, 2] == pytest.approx(WEIGHT * after.blocks.volumes[low], rel=1e-9)


def test_a_cell_that_is_hardly_there_does_not_press_twice(tmp_path: Path) -> None:
    """Behind a cell thinner than the tolerance the next one comes as close to the wall."""
    read = deck(tmp_path, WALL, wet(), supports=GROUND)
    before = build_model(read)
    (soil,) = before.soils
    points, on_wall = soil.points.copy(), np.isclose(soil.points[:, 0], 0.0)
    beside = soil.triangles[on_wall[soil.triangles].sum(axis=1) == 2]
    beside = beside[soil.inside[beside].any(axis=1)][0]
    apex, foot = beside[soil.inside[beside]][0], beside[on_wall[beside]]
    points[apex] = [1e-5, points[foot, 1].mean()]
    after = build_model(read, moved_to(soil, points))
    pushed = [about(each, water_of(each), np.zeros(3), cells=False) for each in (before, after)]
    assert pushed[1] == pytest.approx(pushed[0], rel=1e-9, abs=1e-6)


def test_an_arch_under_water_in_its_fill(tmp_path: Path) -> None:
    """Water presses down on the extrados as much as it lifts the soil over it, and to both sides alike."""
    found = model(tmp_path, ARCH, fill=fill("water: {level: 1.4, unit_weight: 10000}"))
    load = water_of(found)
    middle = np.array([2.0, 1.0, 0.0])
    lift, push = (about(found, load, middle, cells=cells) for cells in (True, False))
    up = 1e4 * 2.0 * area_over_extrados(1.4)
    assert lift == pytest.approx([0, 0, up, 0, 0, 0], rel=1e-9, abs=1e-9 * up)
    assert push == pytest.approx([0, 0, -up, 0, 0, 0], rel=1e-9, abs=1e-9 * up)


def test_saturated_soil_is_heavier_below_the_level(tmp_path: Path) -> None:
    read = deck(tmp_path, WALL, wet("level: 0.6, saturated: stone"), supports=GROUND)
    found = build_model(read)
    cells = found.soils[0].blocks
    assert found.weights[cells].sum() == pytest.approx(1000 * 1.6 * (18 * 0.4 + 24 * 0.6), rel=1e-12)
    middle = found.blocks.added_masses[cells] @ found.blocks.added_mass_points[cells]
    assert middle / found.blocks.added_masses[cells].sum() == pytest.approx([0.8, 0.5, 0.3], rel=1e-12)
    assert water_of(found).words == (
        "water in soil backfill below z = 0.6 m, 9810 N/m3: lifts 20 cells, presses on 1 face (0.6 m2)"
    )


def test_soils_that_touch_have_one_water(tmp_path: Path) -> None:
    """It presses on cells of soil without water as on blocks, and on none of those that stand in it as well."""
    alone = water_of(model(tmp_path, WALL, wet(), CLAY, supports=GROUND))
    both = model(tmp_path, WALL, wet(), wet(item=CLAY), supports=GROUND).load_cases[0].dead_words
    assert "presses on 3 faces (1.2 m2)" in alone.words
    assert ["presses on 1 face (0.6 m2)" in words for words in both] == [False, True, False]
    assert "presses" not in both[2]
    faults = refused(tmp_path, WALL, wet(), wet("level: 0.5", CLAY), supports=GROUND)
    ((key, words),) = faults
    assert key == "blocks[2].soil.water.level"
    assert words.startswith("touches soil backfill with water at z = 0.6")
    apart = CLAY.replace("[[1.6, 0], [2.6, 0], [2.6, 1], [1.6, 1]]", "[[2.6, 0], [3.6, 0], [3.6, 1], [2.6, 1]]")
    assert len(model(tmp_path, WALL, wet(), wet("level: 0.5", apart), supports=GROUND).load_cases[0].dead) == 3


def test_soil_that_is_lighter_with_water_is_refused(tmp_path: Path) -> None:
    lighter = wet("level: 0.6, saturated: earth").replace("material: earth", "material: stone")
    assert refused(tmp_path, WALL, lighter, supports=GROUND)[0][0] == "blocks[1].soil.water.saturated"


def test_soil_that_leans_across_is_refused(tmp_path: Path) -> None:
    leaning = f"{wet()[:-1]}, transform: [{{rotate: {{axis: [1, 0, 0], angle: 10}}}}]}}"
    assert refused(tmp_path, leaning, supports=GROUND)[0][0] == "blocks[0].soil.water"


def test_a_warning_where_the_weight_under_water_is_given(tmp_path: Path) -> None:
    found = [model(tmp_path, WALL, wet(f"level: {level}, unit_weight: 16000"), supports=GROUND) for level in (0.6, -1)]
    warned = [[each.message for each in one.notices if each.identifier == "soil-nearly-floats"] for one in found]
    assert len(warned[0]) == 1
    assert "weighs 1.8e+04 N/m3 and is lifted by 1.6e+04 N/m3" in warned[0][0]
    assert not warned[1]


@pytest.mark.parametrize(
    ("loads", "words"),
    [
        ("dead: [{gravity: none}], live: [{force: [1, 0, 0], on: wall}]", "gravity here is (0, 0, 0) m/s2"),
        ("live: [{tilt: {axis: [0, 1, 0]}}]", "gravity turns against it"),
        (SIDEWAYS, None),
    ],
)
def test_a_warning_where_gravity_is_another(tmp_path: Path, loads: str, words: str | None) -> None:
    found = model(tmp_path, WALL, wet(), supports=GROUND, loads=loads)
    texts = [each.message for each in found.notices if each.identifier == "soil-stress-stays"]
    assert len(texts) == (words is not None)
    assert all("push: water in soil lifts it" in text and str(words) in text for text in texts)
