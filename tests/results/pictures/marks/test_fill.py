"""Fill in the picture of a model: between the blocks that it lies on and its top."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import mbla
from mbla.results.hdf5.result_file import read_results_hdf5, write_results_hdf5
from mbla.results.pictures.drawing import drawing_of
from mbla.results.pictures.marks.fill import fill_marks
from mbla.results.pictures.options import PictureOptions
from mbla.results.pictures.scene import scene_of
from mbla.results.results import Results

DECK = """mbla: 1
materials: {stone: {density: 2000}, earth: {density: 1800}}
joints: {dry: {friction: 0.6}}
blocks:
  - box: {group: low, material: stone, min: [0, 0, 0], max: [1, 1, 1]}
  - box: {group: high, material: stone, min: [1, 0, 0], max: [2, 1, 2]}
contacts: {joint: dry}
supports: [{ground: {z: 0}}]
fill: {soil: {on: [low, high], material: earth, surface: {point: [0, 0, 2], normal: [-0.5, 0, 1]}}}
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
"""


@pytest.fixture(scope="module")
def results() -> Results:
    return mbla.run(DECK).records


def test_fill_reaches_from_the_blocks_to_its_top(results: Results) -> None:
    (mark,) = fill_marks(scene_of(results, results.cases[0], PictureOptions(), "model"))
    assert mark.pale
    assert mark.name.startswith("fill: soil: earth")
    x, _, z = mark.points.T
    np.testing.assert_allclose(z[(z > 1.0) & (z != 2.0)], 2.0 + 0.5 * x[(z > 1.0) & (z != 2.0)])
    assert mark.points.min(axis=0).tolist() == [0.0, 0.0, 1.0]
    assert mark.points.max(axis=0).tolist() == [2.0, 1.0, 3.0]
    assert mark.outlined
    ends = mark.points[mark.pairs]
    upright = np.ptp(ends[:, :, :2], axis=1).max(axis=1) == 0.0
    assert sorted(ends[upright][:, 0, :2].tolist()) == [[0, 0], [0, 1], [2, 0], [2, 1]]
    around = np.linalg.norm(np.diff(ends[~upright][:, :, :2], axis=1), axis=2).sum()
    assert around == pytest.approx(2 * (2 + 1)), "the top once around"


def test_of_a_result_file_the_fill_is_that_of_its_deck(results: Results, tmp_path: Path) -> None:
    path = tmp_path / "fill.h5"
    path.write_bytes(write_results_hdf5(results))
    back = read_results_hdf5(path)
    (own,), (stored,) = (
        fill_marks(scene_of(each, each.cases[0], PictureOptions(), "model")) for each in (results, back)
    )
    np.testing.assert_array_equal(own.points, stored.points)
    assert own.name == stored.name


def test_fill_is_in_the_picture_of_the_model_alone(results: Results) -> None:
    for kind, pale in (("model", 1), ("mechanism", 0), ("forces", 0)):
        scene = scene_of(results, results.cases[0], PictureOptions(), kind)
        assert sum(mark.pale for mark in drawing_of(scene, kind).marks) == pale
