"""The planar scene of a deck with cells of soil against the program of the deck itself."""

from __future__ import annotations

import numpy as np
import pytest

from mbla.soil_mesh.moving import move_corners
from mbla.soil_mesh.planar_program import find_mechanism, with_unit_live_load
from mbla.soil_mesh.scene_of_assembly import Cells, SoilScene, scene_of_assembly
from tests.line import case_of, line_of
from tests.soil_mesh.scenes import grid

LENGTH, DEPTH, WIDTH = 3.0, 1.0, 2.0
HEAD = """\
mbla: 1
materials: {{stone: {{density: 2000}}, clay: {{density: 1800}}}}
joints:
  clay: {{friction: {friction}, cohesion: 20000}}
  rough: {{friction: 0.5}}
supports: [{{ground: {{z: 0}}, joint: clay}}, {{ground: {{x: 0}}, joint: clay}}{more}]
contacts: {{joint: clay, overrides: [{{between: [footing, soil], joint: rough}}]}}
load_cases:
  down: {{live: [{{{live}}}]}}
analysis: {{flow_rule: associative}}
blocks:
  - box: {{group: footing, material: stone, min: [1, 0, 1], max: [2, 2, 1.2]}}
"""
CELL = """\
  - polyhedron:
      group: soil
      material: clay
      vertices: {vertices}
      faces: [[0, 1, 2], [5, 4, 3], [3, 4, 1, 0], [4, 5, 2, 1], [5, 3, 0, 2]]
"""
POINTS, TRIANGLES = grid(np.linspace(0.0, LENGTH, 7), np.linspace(0.0, DEPTH, 3), crossed=True)
AXES = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])


def deck(points: np.ndarray, friction: float, live: str, more: str = "") -> str:
    cells = [
        CELL.format(vertices=[[x, y, z] for y in (0.0, WIDTH) for x, z in points[corners].tolist()])
        for corners in TRIANGLES
    ]
    return HEAD.format(friction=friction, live=live, more=more) + "".join(cells)


def scene_of(text: str) -> SoilScene:
    line = line_of(text)
    cells = Cells(POINTS, TRIANGLES, 1 + np.arange(len(TRIANGLES)), AXES, np.zeros(len(POINTS), dtype=bool))
    scene = scene_of_assembly(line.assembly, line.load_case, cells)
    assert scene is not None
    return scene


@pytest.mark.parametrize("friction", [0.0, 0.4])
@pytest.mark.parametrize("live", ["force: [0, 0, -1000], on: footing", "acceleration: [1, 0, 0]"])
@pytest.mark.parametrize("more", ["", ", {blocks: footing, slide: [0, 0, 1]}"])
def test_a_scene_has_the_load_factor_of_its_deck(friction: float, live: str, more: str) -> None:
    text = deck(POINTS, friction, live, more)
    own = scene_of(text)
    scene, unit = with_unit_live_load(own.scene, own.points)
    mechanism = find_mechanism(scene, own.points)
    _, solved = case_of(text)
    assert mechanism is not None
    assert solved.solution.mechanics is not None
    assert mechanism.load_factor / unit == pytest.approx(solved.solution.mechanics.load_factor, rel=1e-6)


def test_the_deck_on_moved_corners_has_the_load_factor_of_the_moved_scene() -> None:
    live = "force: [0, 0, -1000], on: footing"
    own = scene_of(deck(POINTS, 0.0, live))
    moved = move_corners([own.scene], own.points, own.motions)
    outline = np.isin(POINTS[:, 0], [0.0, LENGTH]) | np.isin(POINTS[:, 1], [0.0, DEPTH])
    points = moved.points[: len(POINTS)]
    assert np.abs(points - POINTS)[~outline].max() > 0.05
    off = (points - POINTS)[outline]
    sides = np.isin(POINTS[outline, 0], [0.0, LENGTH])
    assert np.abs(off[sides, 0]).max() == 0.0
    assert np.abs(off[~sides, 1]).max() == 0.0
    _, solved = case_of(deck(points, 0.0, live))
    assert solved.solution.mechanics is not None
    assert moved.load_factor == pytest.approx(solved.solution.mechanics.load_factor, rel=1e-5)
    assert moved.load_factor < 0.95 * moved.load_factors[0, 0]
