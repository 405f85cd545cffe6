"""Slip lines of soil of cells: a wedge behind a wall that gives way."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.results.collapse.collapse import Failure, mechanism_class
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.soil_pressure import soil_pressures
from mbla.results.demand.demand import demand_of
from mbla.results.listing.listing import listing
from mbla.results.pictures.marks.joints import slip_lines as slip_marks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of as picture_scene
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import Results

DECK = Path(__file__).parents[3] / "decks" / "benchmarks" / "closed_forms" / "active_earth_pressure.yaml"


@pytest.fixture(scope="module")
def results() -> Results:
    return mbla.run(DECK).records


@pytest.fixture(scope="module")
def scene(results: Results) -> Scene:
    return scene_of(results, results.cases[0])


@pytest.fixture(scope="module")
def failure(scene: Scene) -> Failure:
    assert scene.failure is not None
    return scene.failure


def test_a_wedge_slips_on_a_line_and_along_the_wall(failure: Failure) -> None:
    on_rest, on_wall = sorted(failure.slip_lines, key=lambda line: line.clusters)
    assert on_rest.clusters == (2, 0)
    assert on_wall.clusters == (2, 1)
    np.testing.assert_allclose(on_rest.start, [0, 0.5, 0], atol=1e-6)
    np.testing.assert_allclose(on_rest.end, [np.tan(np.radians(30)), 0.5, 1], atol=1e-6)
    assert on_rest.length == pytest.approx(1 / np.cos(np.radians(30)))
    assert on_wall.length == pytest.approx(1)


def test_joints_of_cells_are_told_as_nothing_else(scene: Scene, failure: Failure) -> None:
    assert not (failure.hinge_lines + failure.sliding_planes + failure.cracks)
    assert scene.interfaces is not None
    assert scene.interfaces.in_soil.all()
    assert not any(scene.interfaces.count(mode) for mode in InterfaceMode)
    assert mechanism_class(failure) == "sliding"


def test_the_listing_tells_slip_lines(results: Results) -> None:
    text = " ".join(listing(results).split())
    assert "2 slip lines in soil; 1 of 1 free block and 1 of 3 cells of soil backfill move in 2 rigid parts" in text
    assert "soil backfill on wall 2/1 (0, 0.5, 0) (0, 0.5, 1) 1 " in text
    assert "a wedge of soil backfill, 1 cell" in text


def test_cells_are_no_units_that_crack(results: Results) -> None:
    case = results.cases[0]
    assert case.solution.mechanics is not None
    demand = demand_of(results.assembly, case.load_case, case.solution.mechanics)
    assert np.isnan(demand.pressure[1:]).all()


def test_the_listing_tells_what_soil_presses_with(results: Results) -> None:
    case = results.cases[0]
    assert case.solution.mechanics is not None
    (pressure,) = soil_pressures(results.model, results.contacts, case.solution.mechanics.contact_forces)
    assert (pressure.soil, pressure.group) == (0, "wall")
    assert pressure.force[0] == pytest.approx(-2.1786328, rel=1e-6)  # of Rankine, on a wall that gives way to the left
    assert pressure.point[0] == pytest.approx(0, abs=1e-9)
    assert "backfill on wall -2.1786 0 0 (0, 0.5, " in " ".join(listing(results).split())


BETWEEN_WALLS = """mbla: 1
materials: {stone: {density: 2000}, earth: {density: 1800}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: base, material: stone, min: [0, 0, 0], max: [3, 2, 1]}
  - box: {group: walls, material: stone, min: [0, 0, 1], max: [3, 0.4, 2.2]}
  - box: {group: walls, material: stone, min: [0, 1.6, 1], max: [3, 2, 2.2]}
contacts: {joint: dry}
supports: [{blocks: base}]
fill: {soil: {on: [base, walls], material: earth, level: 2, cells: {size: 0.4}, friction_angle: 20}}
load_cases:
  lorry: {live: [{travel: {force: [0, 0, -1], contact: 0.3, width: 0.8, path: [[1, 1, 2], [2, 1, 2]], positions: 2}}]}
analysis: {flow_rule: associative}
"""


def test_along_walls_beside_it_soil_slips_on_a_surface() -> None:
    """It is no line of its section, where such a surface has no length."""
    results = mbla.run(BETWEEN_WALLS).records
    scene = picture_scene(results, results.cases[0], PictureOptions(), "history")
    assert scene.failure is not None
    assert scene.joint_motion is not None
    of_walls = np.abs(scene.contacts.normals[:, 1]) > 0.9
    beside = [line for line in scene.failure.slip_lines if of_walls[line.interfaces].all()]
    assert beside
    assert all(line.length > 0.1 for line in beside)
    assert all(line.start[1] in (0.4, 1.6) for line in beside)
    assert "soil along walls" in listing(results)
    lines = slip_marks(scene, scene.joint_motion)
    assert len(lines.pairs)
    assert not {1, 2} & set(lines.bodies.ravel().tolist()), "none of the walls"
