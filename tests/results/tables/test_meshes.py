"""VTKHDF files as vtk reads them: counts, volumes, data, steps in time."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import h5py
import numpy as np
import pytest

from mbla.results.collapse.motion import drawn_motion, moved_vertices
from mbla.results.results import Results
from mbla.results.tables.export import Formats, export_results
from mbla.results.tables.meshes import FIGURES, FRAMES, case_vtkhdf
from mbla.solution.solution import Status
from tests.results.no_contacts import without_contacts
from tests.results.reading import grid_volumes, read_vtkhdf, vtk_array, vtk_version, vtkhdf_times
from tests.results.shapes import BRICK, PYRAMID, TETRA, WEDGE, blocks_of
from tests.results.synthetic import tower_results

pytest.importorskip("vtkmodules.vtkIOHDF")
pytestmark = pytest.mark.skipif(
    vtk_version() < (9, 6), reason="readers of VTK up to 9.5 do not come back from polyhedra"
)


@pytest.fixture(scope="module")
def results() -> Results:
    return tower_results()


def written(results: Results, row: int, folder: Path) -> Path:
    path = folder / "case.vtkhdf"
    path.write_bytes(case_vtkhdf(results, results.cases[row]))
    return path


def loose(shapes: Any) -> Results:
    """Three blocks of any shape without contacts, the middle one falling."""
    results = tower_results()
    model = replace(results.model, blocks=blocks_of(shapes), grounds=())
    return replace(results, model=model, contacts=without_contacts(results.contacts), cases=results.cases[1:])


def test_grids_hold_blocks_interfaces_and_points(results: Results, tmp_path: Path) -> None:
    grids = read_vtkhdf(written(results, 0, tmp_path))
    cells = {name: grid.GetNumberOfCells() for name, grid in grids.items()}
    assert cells == {"blocks": 3, "interfaces": 2, "points": 8}
    assert grid_volumes(grids["blocks"]) == pytest.approx(results.model.blocks.volumes)
    blocks, interfaces, points = (grids[name].GetCellData() for name in ("blocks", "interfaces", "points"))
    mechanics = results.cases[0].solution.mechanics
    assert mechanics is not None
    assert vtk_array(blocks, "velocity") == pytest.approx(mechanics.mechanism[:, :3])
    assert vtk_array(points, "N") == pytest.approx(mechanics.contact_forces[:, 0])
    assert vtk_array(points, "mode").tolist() == mechanics.modes.tolist()
    assert vtk_array(interfaces, "mode").tolist() == [3, 0]
    assert vtk_array(interfaces, "area") == pytest.approx(results.contacts.areas)
    assert vtk_array(interfaces, "normal") == pytest.approx(results.contacts.normals)


def test_areas_of_polygons_are_those_of_the_interfaces(results: Results, tmp_path: Path) -> None:
    from vtkmodules.vtkFiltersVerdict import vtkCellSizeFilter

    sizes = vtkCellSizeFilter()
    sizes.SetInputData(read_vtkhdf(written(results, 0, tmp_path))["interfaces"])
    sizes.Update()
    assert vtk_array(sizes.GetOutput().GetCellData(), "Area") == pytest.approx(results.contacts.areas)


def test_steps_play_the_motion_as_drawn(results: Results, tmp_path: Path) -> None:
    path, case = written(results, 0, tmp_path), results.cases[0]
    times = vtkhdf_times(path)
    assert times == pytest.approx(np.linspace(0, 1, FRAMES))
    motion = drawn_motion(results.model, case)
    for time in (times[0], times[3], times[-1]):
        grid = read_vtkhdf(path, time)["blocks"]
        expected = moved_vertices(results.model.blocks, time * motion)
        points = [grid.GetPoint(row) for row in range(grid.GetNumberOfPoints())]
        assert np.array(points) == pytest.approx(expected)
        assert vtk_array(grid.GetPointData(), "displacement") == pytest.approx(expected - results.model.blocks.vertices)
        assert grid_volumes(grid) == pytest.approx(results.model.blocks.volumes)


@pytest.mark.parametrize("shapes", [[TETRA, BRICK, WEDGE], [BRICK, PYRAMID, TETRA]], ids=["mixed", "polyhedra"])
def test_every_shape_keeps_its_volume_and_its_data(tmp_path: Path, shapes: Any) -> None:
    results = loose(shapes)
    path = written(results, 0, tmp_path)
    for time in (0.0, 1.0):
        (grid,) = read_vtkhdf(path, time).values()
        blocks = vtk_array(grid.GetCellData(), "block").astype(int)
        assert sorted(blocks) == [0, 1, 2]
        assert grid_volumes(grid) == pytest.approx(results.model.blocks.volumes[blocks], rel=1e-12)
        velocity = vtk_array(grid.GetCellData(), "certificate_velocity")
        assert velocity[:, 2].tolist() == [-1.0 if block == 1 else 0.0 for block in blocks]


def test_what_is_no_result_says_so(results: Results, tmp_path: Path) -> None:
    doubtful = replace(results, cases=(replace(results.cases[0], status=Status.NOT_VERIFIED),))
    for which, row, expected in ((results, 0, "result"), (doubtful, 0, "best_iterate"), (results, 1, "")):
        path = written(which, row, tmp_path)
        for grid in read_vtkhdf(path).values():
            assert set(vtk_array(grid.GetCellData(), "figures")) == {FIGURES.index(expected)}
        with h5py.File(path) as file:
            assert file.attrs["status"].decode() == which.cases[row].status.value
            assert np.isnan(file.attrs["load_factor"]) == (expected != "result")


def test_a_case_without_motion_has_one_step(results: Results, tmp_path: Path) -> None:
    case = results.cases[1]
    still = replace(case, solution=replace(case.solution, certificate=None))
    path = written(replace(results, cases=(still,)), 0, tmp_path)
    assert vtkhdf_times(path) == []  # one step is none to vtk
    assert set(read_vtkhdf(path)) == {"blocks", "interfaces", "points"}


def test_same_case_gives_same_bytes(results: Results) -> None:
    assert case_vtkhdf(results, results.cases[0]) == case_vtkhdf(tower_results(), tower_results().cases[0])


def test_one_file_for_each_case(results: Results, tmp_path: Path) -> None:
    paths = export_results(results, tmp_path, "tower", Formats(vtkhdf=True))
    assert [path.name for path in paths] == ["tower_fall.vtkhdf", "tower_push_x.vtkhdf"]
    assert [path.name for path in tmp_path.iterdir() if path not in paths] == []
