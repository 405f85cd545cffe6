"""The frames of an animation, and the collection that plays them."""

import xml.etree.ElementTree as ElementTree
from pathlib import Path

import meshio
import numpy as np
import pytest

from mbla.results.collapse.motion import drawn_motion, moved_vertices
from mbla.results.record.scene import scene_of
from mbla.results.results import Results
from mbla.results.vtu.vtu import collection_pvd, frame_times, write_frame_vtu
from tests.results.reading import vtk_volumes
from tests.results.synthetic import tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def test_frames_run_from_zero_to_one() -> None:
    assert frame_times(5) == [0.0, 0.25, 0.5, 0.75, 1.0]


def test_blocks_keep_their_volume_in_every_frame(tmp_path: Path, results: Results) -> None:
    path = tmp_path / "frame.vtu"
    for time in frame_times(4):
        write_frame_vtu(path, scene_of(results, results.cases[0]), time)
        assert vtk_volumes(path) == pytest.approx(results.model.blocks.volumes, rel=1e-12)


def test_first_frame_is_as_built_and_last_as_drawn(tmp_path: Path, results: Results) -> None:
    path = tmp_path / "frame.vtu"
    vertices = results.model.blocks.vertices
    write_frame_vtu(path, scene_of(results, results.cases[0]), 0.0)
    assert meshio.read(path).points == pytest.approx(vertices)
    write_frame_vtu(path, scene_of(results, results.cases[0]), 1.0)
    mesh = meshio.read(path)
    moved = moved_vertices(results.model.blocks, drawn_motion(results.model, results.cases[0]))
    assert mesh.points == pytest.approx(moved)
    assert mesh.point_data["displacement"] == pytest.approx(moved - vertices)
    assert np.abs(moved - vertices).max() > 0.1


def test_collection_names_the_frames_in_order_whatever_they_are_called() -> None:
    text = collection_pvd(['a & "b"_000.vtu', "b.vtu"], [0.0, 1.0])
    entries = ElementTree.fromstring(text).findall("Collection/DataSet")
    assert [entry.get("file") for entry in entries] == ['a & "b"_000.vtu', "b.vtu"]
    assert [float(entry.get("timestep", "nan")) for entry in entries] == [0.0, 1.0]
