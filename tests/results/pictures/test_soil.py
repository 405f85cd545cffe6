"""Soil of cells in the plane: one tone, the outline of what moves together, and slip lines."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.results.pictures.drawing import Drawing, drawing_of
from mbla.results.pictures.marks.forces import drawn_resultants
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.page import SOIL
from mbla.results.pictures.plane import seen_edges
from mbla.results.pictures.scene import PictureScene, bounding_edges, scene_of
from mbla.results.results import Results
from mbla.results.view3d.scene import block_texts

DECK = Path(__file__).parents[3] / "decks" / "benchmarks" / "closed_forms" / "active_earth_pressure.yaml"


@pytest.fixture(scope="module")
def results() -> Results:
    return mbla.run(DECK).records


def drawn(results: Results, kind: str) -> tuple[PictureScene, Drawing]:
    scene = scene_of(results, results.cases[0], PictureOptions(), kind)
    return scene, drawing_of(scene, kind)


@pytest.mark.parametrize("kind", ["model", "mechanism", "forces"])
def test_soil_has_one_tone(results: Results, kind: str) -> None:
    scene, drawing = drawn(results, kind)
    assert {drawing.colours[row] for row in np.flatnonzero(scene.model.soil_of_block >= 0)} == {SOIL}
    assert ("soil", SOIL) in drawing.legend


def test_at_rest_it_has_one_outline(results: Results) -> None:
    scene, drawing = drawn(results, "model")
    assert drawing.flat is not None
    assert len(seen_edges(scene.model.blocks, drawing.flat)) == 4 + 3 * 3
    assert (
        len(bounding_edges(scene, seen_edges(scene.model.blocks, drawing.flat))) == 4 + 5
    )  # its top has a corner at the wedge


def test_a_wedge_that_slips_has_its_own(results: Results) -> None:
    scene, drawing = drawn(results, "mechanism")
    assert drawing.flat is not None
    assert len(bounding_edges(scene, seen_edges(scene.model.blocks, drawing.flat))) == 4 + 3 + 4


def test_slip_lines_lie_on_both_sides(results: Results) -> None:
    scene, drawing = drawn(results, "mechanism")
    (mark,) = (mark for mark in drawing.marks if mark.name == "slip line")
    lines = np.unique(np.hstack([mark.points[mark.pairs][:, :, [0, 2]].reshape(-1, 4), mark.bodies[::2, :1]]), axis=0)
    assert len(lines) >= 4  # the wall and the wedge, the wedge and what rests
    assert {row for row in mark.bodies.ravel().tolist() if row >= 1} <= set(
        np.flatnonzero(scene.model.soil_of_block >= 0)
    )
    assert not {"hinge", "sliding", "opening"} & {mark.name for mark in drawing.marks}


def test_of_forces_those_on_blocks_and_ground_are_drawn(results: Results) -> None:
    scene, _ = drawn(results, "forces")
    cells = np.append(scene.model.soil_of_block >= 0, [False] * len(scene.model.grounds))
    bodies = scene.contacts.bodies[drawn_resultants(scene)]
    assert len(bodies)
    assert not cells[bodies].all(axis=1).any()


def test_the_browser_names_the_soil(results: Results) -> None:
    scene, _ = drawn(results, "mechanism")
    texts = block_texts(scene.model, scene.clusters)
    assert texts[0].startswith("wall[0]<br>")
    assert sorted(texts[1:]) == ["soil backfill<br>at rest", "soil backfill<br>at rest", "soil backfill<br>part 2"]
