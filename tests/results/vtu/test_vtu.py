"""Files of blocks, contact points and interfaces, and the frames of an animation."""

import xml.etree.ElementTree as ElementTree
from dataclasses import replace
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from mbla.assembly.assembly import Assembly
from mbla.model.solids.blocks import labels_of
from mbla.results.collapse.interface_modes import InterfaceMode
from mbla.results.collapse.motion import SHARE_OF_SIZE, drawn_motion, movable_size, moved_vertices
from mbla.results.quantities.blocks import names_of
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import Results
from mbla.results.vtu.mesh_files import collection_pvd
from mbla.results.vtu.meshes import Mesh, blocks_mesh, contacts_mesh, frame_mesh, interfaces_mesh
from mbla.solution.solution import Status
from tests.results.reading import read_vtk, vtk_array, vtk_volumes
from tests.results.synthetic import tower_mechanics, tower_results


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def written(path: Path, mesh: Mesh | None) -> None:
    assert mesh is not None
    mesh.write(path)


@pytest.fixture
def path(tmp_path: Path) -> Path:
    return tmp_path / "file.vtu"


def test_blocks(path: Path, results: Results) -> None:
    written(path, blocks_mesh(Scene(results.assembly, results.cases[0])))
    for points, displacement, cells, data in (by_meshio(path), by_vtk(path)):
        assert points == pytest.approx(results.model.blocks.vertices)
        assert cells == 3
        assert displacement.shape == (24, 3)
        largest = np.linalg.norm(displacement, axis=1).max()
        assert largest == pytest.approx(SHARE_OF_SIZE * movable_size(results.model))
        assert data["block"].tolist() == [0, 1, 2]
        assert [names_of(results.model.blocks.groups)[int(i)] for i in data["groups"]] == ["base", "tower", "brick"]
        assert data["weights"] == pytest.approx([45, 10, 10])
        assert data["fixed"].tolist() == [1, 0, 0]
        assert data["parts"].tolist() == [0, 1, 0]
        assert data["drawn_rotations"][1, 1] > 0
        assert data["drawn_displacements"].shape == (3, 3)
    assert vtk_volumes(path) == pytest.approx(results.model.blocks.volumes)


NAMES = ("block", "groups", "weights", "fixed", "parts", "drawn_rotations", "drawn_displacements")


def by_meshio(path: Path) -> Any:
    mesh = meshio.read(path)
    data = {name: np.concatenate(mesh.cell_data[name]) for name in NAMES}
    return mesh.points, mesh.point_data["displacement"], sum(map(len, mesh.cells)), data


def by_vtk(path: Path) -> Any:
    grid = read_vtk(path)
    points = np.array([grid.GetPoint(i) for i in range(grid.GetNumberOfPoints())])
    data = {name: vtk_array(grid.GetCellData(), name) for name in NAMES}
    return points, vtk_array(grid.GetPointData(), "displacement"), grid.GetNumberOfCells(), data


def test_contact_forces_carry_the_weights(path: Path, results: Results) -> None:
    written(path, contacts_mesh(Scene(results.assembly, results.cases[0])))
    mesh, grid = meshio.read(path), read_vtk(path)
    assert [(cells.type, len(cells)) for cells in mesh.cells] == [("vertex", 8)]
    assert grid.GetNumberOfCells() == 8
    forces = vtk_array(grid.GetPointData(), "global_forces")
    assert forces == pytest.approx(mesh.point_data["global_forces"])
    assert forces[:4].sum(axis=0) == pytest.approx([-5, 0, 10])
    assert forces[4:].sum(axis=0) == pytest.approx([-5, 0, 10])
    assert mesh.point_data["modes"].tolist() == [2, 0, 0, 2, 0, 0, 0, 0]
    assert mesh.point_data["normal_forces"] == pytest.approx(tower_mechanics().contact_forces[:, 0])
    assert mesh.point_data["shear_forces"][:4] == pytest.approx([0, 2.5, 2.5, 0])
    assert mesh.point_data["opening"][[0, 3]] == pytest.approx([0.1, 0.1])
    assert mesh.point_data["interface"].tolist() == [0] * 4 + [1] * 4
    assert mesh.point_data["bodies_a"].tolist() == [0] * 4 + [3] * 4


def test_interfaces(path: Path, results: Results) -> None:
    written(path, interfaces_mesh(Scene(results.assembly, results.cases[0])))
    mesh, grid = meshio.read(path), read_vtk(path)
    data = {name: np.concatenate(values) for name, values in mesh.cell_data.items()}
    assert grid.GetNumberOfCells() == 2
    assert [grid.GetCellType(i) for i in range(2)] == [7, 7]
    assert data["areas"] == pytest.approx([1, 1])
    assert data["resultant_forces"] == pytest.approx(np.array([[-5, 0, 10], [-5, 0, 10]]))
    assert data["normal_forces"] == pytest.approx([10, 10])
    assert data["shear_forces"] == pytest.approx([5, 5])
    assert data["resultant_moments"][0] == pytest.approx([0, -5, 0])
    assert data["modes"].tolist() == [InterfaceMode.HINGE, InterfaceMode.STICK]
    assert data["work"] == pytest.approx([0, 0])
    assert vtk_array(grid.GetCellData(), "gaps") == pytest.approx([0, 0])


def test_interfaces_with_different_numbers_of_corners(path: Path, results: Results) -> None:
    """The second loses a corner; a corner that bounds a hole is not part of the outline."""
    contacts = replace(results.contacts, outline=np.array([4, 3]))
    written(path, interfaces_mesh(Scene(Assembly(results.model, contacts), results.cases[0])))
    grid = read_vtk(path)
    corners = [grid.GetCell(i).GetNumberOfPoints() for i in range(2)]
    assert corners == [3, 4]
    assert vtk_array(grid.GetCellData(), "interface").tolist() == [1, 0]


def test_case_without_mechanism_shows_the_model_and_what_falls(path: Path, results: Results) -> None:
    written(path, contacts_mesh(Scene(results.assembly, results.cases[1])))
    assert "global_forces" not in meshio.read(path).point_data
    written(path, interfaces_mesh(Scene(results.assembly, results.cases[1])))
    assert "modes" not in meshio.read(path).cell_data
    written(path, blocks_mesh(Scene(results.assembly, results.cases[1])))
    mesh = meshio.read(path)
    assert mesh.point_data["displacement"][8:16, 2].max() < 0
    assert np.concatenate(mesh.cell_data["parts"]).tolist() == [0, 1, 0]


def test_forces_that_lock_a_structure_are_shown_where_there_is_no_load_factor(path: Path, results: Results) -> None:
    lock = np.zeros((8, 3))
    lock[:4] = [2.0, -1.0, 0.0]
    solution = replace(results.cases[0].solution, mechanics=None, lock=lock)
    case = replace(results.cases[0], solution=solution, status=Status.UNBOUNDED)
    written(path, contacts_mesh(Scene(results.assembly, case)))
    data = meshio.read(path).point_data
    assert data["global_forces"][:4].sum(axis=0) == pytest.approx([-4, 0, 8])
    assert "modes" not in data
    written(path, interfaces_mesh(Scene(results.assembly, case)))
    cells = {name: np.concatenate(values) for name, values in meshio.read(path).cell_data.items()}
    assert cells["normal_forces"] == pytest.approx([8, 0])
    assert "modes" not in cells


def test_labels_of_items_are_cell_data(path: Path, results: Results) -> None:
    labels = labels_of(3, ("", "pier", "lintel"), {"course": np.array([0, 1, -1])})
    blocks = replace(results.model.blocks, labels=labels)
    written(path, blocks_mesh(Scene(Assembly(replace(results.model, blocks=blocks), results.contacts), None)))
    data = {name: np.concatenate(values).tolist() for name, values in meshio.read(path).cell_data.items()}
    assert data["members"] == [0, 2, 1]
    assert data["course"] == [0, 1, -1]
    assert "voussoir" not in data


# --- Frames of an animation, and the collection that plays them -----------------------------------------------------


def test_first_frame_is_as_built_and_last_as_drawn(tmp_path: Path, results: Results) -> None:
    path = tmp_path / "frame.vtu"
    vertices = results.model.blocks.vertices
    scene = scene_of(results, results.cases[0])
    written(path, frame_mesh(scene, np.zeros_like(scene.motion)))
    assert meshio.read(path).points == pytest.approx(vertices)
    written(path, frame_mesh(scene, scene.motion))
    mesh = meshio.read(path)
    moved = moved_vertices(results.model.blocks, drawn_motion(results.model, results.cases[0]))
    assert mesh.points == pytest.approx(moved)
    assert mesh.point_data["displacement"] == pytest.approx(moved - vertices)
    assert np.abs(moved - vertices).max() > 0.1


def test_collection_names_the_frames_in_order_whatever_they_are_called() -> None:
    text = collection_pvd({'a & "b"_000.vtu': 0.0, "b.vtu": 1.0})
    entries = ElementTree.fromstring(text).findall("Collection/DataSet")
    assert [entry.get("file") for entry in entries] == ['a & "b"_000.vtu', "b.vtu"]
    assert [float(entry.get("timestep", "nan")) for entry in entries] == [0.0, 1.0]
