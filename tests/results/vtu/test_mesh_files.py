"""All files for ParaView of real runs, read back by meshio and vtk."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from mbla.deck.sections.selectors import POSITIONS
from mbla.questions.load_factor import LOAD_FACTOR
from mbla.results.files import OutputFolder
from mbla.results.record.scene import Scene, scene_of
from mbla.results.results import Results
from mbla.results.vtu.loads import DEAD, GUIDE, LIVE, REACTION, load_vectors
from mbla.results.vtu.mesh_files import MESHES, write_model_vtu
from mbla.results.vtu.meshes import LINE, POINT, hinges_mesh, thrust_mesh
from mbla.run import RunOptions, run
from mbla.solution.solution import ContactMode, Status
from mbla.solution.verification.statics import contact_velocities
from tests.decks.folder import BENCHMARKS
from tests.results.no_contacts import without_contacts
from tests.results.pictures.rows_and_columns import row_of_blocks
from tests.results.reading import read_vtk, vtk_array, vtk_volumes
from tests.results.results_page import CELLS, described
from tests.results.synthetic import full_results, tower_mechanics, tower_results

LABELS = {"members", *POSITIONS}
HEAD = "mbla: 1\nmaterials: {stone: {density: 2000}}\njoints: {dry: {friction: 2}}\ncontacts: {joint: dry}\n"
ARCH = (
    HEAD
    + """\
blocks:
  - arch: {group: arch, material: stone, shape: semicircular, span: 4, thickness: 0.6, width: 1, voussoirs: 15}
supports: [{ground: {z: 0}}]
load_cases:
  push: {live: [{acceleration: [1, 0, 0]}]}
  point: {live: [{force: [0, 0, -1000], on: {group: arch, index: 4}, at: [0.75, 0.3, 2.2]}]}
output: {frames: 3}
"""
)
GUIDED = (
    HEAD.replace("friction: 2", "friction: 0.5")
    + """\
blocks:
  - box: {group: bed, material: stone, min: [-1, 0, -1], max: [3, 2, 0]}
  - box: {group: upright, material: stone, min: [0, 0, 0], max: [1, 1, 2]}
supports: [{blocks: bed}, {blocks: upright, fixed: [rx, ry, rz]}]
load_cases: {push: {live: [{acceleration: [1, 0, 0]}]}}
output: {frames: 2}
"""
)


def solved(folder: Path, text: str) -> tuple[Results, Path]:
    (folder / "deck.yaml").write_text(text, encoding="utf-8")
    return run(folder / "deck.yaml", RunOptions()), folder / "deck.out"


@pytest.fixture(scope="module")
def arch(tmp_path_factory: pytest.TempPathFactory) -> tuple[Results, Path]:
    return solved(tmp_path_factory.mktemp("arch"), ARCH)


@pytest.fixture(scope="module")
def guided(tmp_path_factory: pytest.TempPathFactory) -> tuple[Results, Path]:
    return solved(tmp_path_factory.mktemp("guided"), GUIDED)


def scene_and_mesh(run: tuple[Results, Path], case: str, kind: str) -> tuple[Scene, Any]:
    results, folder = run
    return scene_of(results, results.case(case)), meshio.read(folder / f"deck_{case}_{kind}.vtu")


def kind_of(path: Path, results: Results) -> str:
    """File kind by the end of the name."""
    name = path.stem.removeprefix("deck_")
    for case in results.cases:
        name = name.removeprefix(f"{case.load_case.name}_")
    return "frames" if name.startswith(("frame_", "pushed_")) else name


def test_every_kind_of_file_is_described() -> None:
    assert {*MESHES, "frames", "forces", "supports"} == set(CELLS)


@pytest.mark.parametrize("which", ["arch", "guided"])
def test_every_array_written_is_in_the_table_and_of_its_shape(which: str, request: pytest.FixtureRequest) -> None:
    results, folder = request.getfixturevalue(which)
    for path in folder.glob("*.vtu"):
        kind, mesh, grid = kind_of(path, results), meshio.read(path), read_vtk(path)
        for on, data, read in (
            ("points", mesh.point_data, grid.GetPointData()),
            ("cells", {name: np.concatenate(parts) for name, parts in mesh.cell_data.items()}, grid.GetCellData()),
        ):
            known = described(kind, on)
            assert set(data) - LABELS <= set(known), path.name
            for name in set(data) - LABELS:
                assert data[name].reshape(len(data[name]), -1).shape[1] == (3 if "axis" in known[name].dims else 1), (
                    path.name,
                    name,
                )
                assert vtk_array(read, name) == pytest.approx(data[name], nan_ok=True), (path.name, name)


def test_every_array_of_the_table_is_written_where_there_is_something(arch: Any) -> None:
    results, folder = arch
    for kind in set(MESHES) - {"ties", "modes", "modes_after"}:
        mesh = meshio.read(folder / f"deck_push_{kind}.vtu")
        for on, data in (("points", mesh.point_data), ("cells", mesh.cell_data)):
            assert set(described(kind, on)) - LABELS <= set(data), kind
    assert {kind_of(path, results) for path in folder.glob("*.vtu")} == set(CELLS) - {
        "ties",
        "modes",
        "modes_after",
        "forces",
    }


def test_ties_are_lines_with_their_forces_and_strips_points(tmp_path: Path) -> None:
    results = run(BENCHMARKS["ring_rope_and_strip"], RunOptions(folder=tmp_path))
    mesh = meshio.read(tmp_path / "ring_rope_and_strip_lift_ties.vtu")
    assert [(cells.type, len(cells)) for cells in mesh.cells] == [("line", 2 * 4 + 2), ("vertex", 1)]
    assert set(described("ties", "cells")) <= set(mesh.cell_data)
    assert "displacement" in mesh.point_data
    assert mesh.cell_data["tie_forces"][1] == pytest.approx([4000.0], rel=1e-6)
    assert mesh.cell_data["state"][1].tolist() == [1]
    assert len(results.model.ties) == 5


def test_thrust_line_of_an_arch_is_one_chain_that_touches_the_edge_at_its_four_hinges(arch: Any) -> None:
    scene, mesh = scene_and_mesh(arch, "push", "thrust")
    n_interfaces = len(scene.contacts)
    assert [(cells.type, len(cells)) for cells in mesh.cells] == [("vertex", n_interfaces), ("line", n_interfaces - 1)]
    vertices, lines = (cells.data for cells in mesh.cells)
    assert vertices.ravel().tolist() == list(range(n_interfaces))
    assert lines[:-1, 1].tolist() == lines[1:, 0].tolist()
    assert sorted({lines[0, 0], *lines[:, 1]}) == list(range(n_interfaces))
    kinds, numbers = mesh.cell_data["kind"], mesh.cell_data["line"]
    assert [set(each.tolist()) for each in kinds] == [{POINT}, {LINE}]
    assert [set(each.tolist()) for each in numbers] == [{-1}, {0}]
    at_edge = mesh.point_data["interface"][mesh.point_data["eccentricity"] > 1 - 1e-5]
    hinges = scene_and_mesh(arch, "push", "hinges")[1]
    assert sorted(at_edge.tolist()) == sorted(hinges.cell_data["interface"][0].tolist())
    assert len(at_edge) == 4


@pytest.mark.parametrize(("which", "case"), [("arch", "push"), ("arch", "point"), ("guided", "push")])
def test_reactions_balance_the_loads(which: str, case: str, request: pytest.FixtureRequest) -> None:
    """Forces, and moments about the origin, over all vertices on bodies that can move."""
    scene, mesh = scene_and_mesh(request.getfixturevalue(which), case, "loads")
    data = mesh.point_data
    assert scene.mechanics is not None
    forces = data["dead_forces"] + scene.mechanics.load_factor * data["live_forces"] + data["reaction_forces"]
    own = np.where((data["kind"] == LIVE)[:, None], scene.mechanics.load_factor, 1.0) * data["moments"]
    moments = own + np.cross(mesh.points, forces)
    there = data["fixed"] == 0
    size = np.abs(data["dead_forces"]).sum()
    assert forces[there].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-6 * size)
    assert moments[there].sum(axis=0) == pytest.approx(np.zeros(3), abs=1e-5 * size)
    assert np.abs(data["reaction_forces"]).sum() > 0.1 * size


def test_a_force_at_a_point_acts_on_its_line_and_leaves_no_moment(arch: Any) -> None:
    scene, mesh = scene_and_mesh(arch, "point", "loads")
    live = mesh.point_data["kind"] == LIVE
    assert mesh.point_data["live_forces"][live] == pytest.approx(np.array([[0, 0, -1000.0]]))
    assert mesh.points[live][0, :2] == pytest.approx([0.75, 0.3])
    assert mesh.points[live][0, 2] == pytest.approx(scene.model.blocks.centroids[4, 2])
    assert not mesh.point_data["moments"][live].any()
    dead = mesh.point_data["kind"] == DEAD
    assert mesh.points[dead] == pytest.approx(scene.model.blocks.centroids)


def test_guides_react_and_blocks_say_that_they_are_guided(guided: Any) -> None:
    """The upright block slides at 0.5; its guide takes the moment of the push at half its height."""
    results, _ = guided
    scene, mesh = scene_and_mesh(guided, "push", "blocks")
    assert np.concatenate(mesh.cell_data["guided"]).tolist() == [0, 1]
    kinds = {vectors.kind: vectors for vectors in load_vectors(scene)}
    assert set(kinds) == {DEAD, LIVE, REACTION, GUIDE}
    assert kinds[GUIDE].bodies.tolist() == [1]
    supports = meshio.read(guided[1] / "deck_supports.vtu")
    assert np.concatenate(supports.cell_data["kind"]).tolist() == [1, 2]
    assert vtk_volumes(guided[1] / "deck_supports.vtu") == pytest.approx(results.model.blocks.volumes)


def test_ground_is_a_slab_under_the_springers(arch: Any) -> None:
    """Its top lies in the plane, and it covers both feet of the arch, 5.2 m apart and 1 m wide."""
    results, folder = arch
    mesh = meshio.read(folder / "deck_supports.vtu")
    assert np.concatenate(mesh.cell_data["kind"]).tolist() == [0]
    assert np.concatenate(mesh.cell_data["body"]).tolist() == [len(results.model.blocks)]
    low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
    assert high[2] == pytest.approx(0, abs=1e-12)
    assert low[0] < -0.6
    assert high[0] > 4.6
    assert low[1] < 0
    assert high[1] > 1
    assert vtk_volumes(folder / "deck_supports.vtu").sum() == pytest.approx(np.prod(high - low))


def test_a_hinge_about_a_corner_is_a_vertex(tmp_path: Path) -> None:
    """The tower turns about the corner (1, 1, 1) of its bed."""
    results = tower_results()
    mechanism = np.zeros((3, 6))
    mechanism[1] = [*np.cross([-1, 1, 0], results.model.blocks.centroids[1] - [1, 1, 1]), -1, 1, 0]
    velocities = contact_velocities(results.model, results.contacts, mechanism)
    modes = np.where(velocities[:, 0] > 1e-9, ContactMode.OPEN, ContactMode.STICK)
    case = results.cases[0]
    mechanics = replace(tower_mechanics(), mechanism=mechanism, contact_velocities=velocities, modes=modes)
    case = replace(case, solution=replace(case.solution, mechanics=mechanics))
    path = tmp_path / "hinges.vtu"
    hinges = hinges_mesh(scene_of(replace(results, cases=(case,)), case))
    assert hinges is not None
    hinges.write(path)
    mesh = meshio.read(path)
    assert [(cells.type, cells.data.tolist()) for cells in mesh.cells] == [("vertex", [[0]])]
    assert mesh.points.tolist() == [[1, 1, 1]]
    assert mesh.cell_data["interface"][0].tolist() == [0]
    assert abs(mesh.cell_data["rotation"][0][0]) > 0


def test_what_a_case_does_not_have_is_not_written() -> None:
    """Without a mechanism no hinges, without forces no thrust, without a case no use of friction."""
    results = tower_results()
    falls = scene_of(results, results.cases[1])
    assert falls.forces is None
    assert falls.torsion_use is None
    assert thrust_mesh(falls) is None
    assert hinges_mesh(falls) is None
    assert Scene(results.assembly, None).torsion_use is None


def test_forces_that_lock_leave_guides_the_live_load_alone() -> None:
    """No dead load: the guide takes what the contacts leave of the live load."""
    results = tower_results()
    model = full_results().model
    case = results.cases[0]
    forces = tower_mechanics().contact_forces
    solution = replace(case.solution, mechanics=None, status=Status.UNBOUNDED, lock=0 * forces)
    load_case = replace(case.load_case, question=LOAD_FACTOR)
    locked = replace(case, load_case=load_case, solution=solution, status=Status.UNBOUNDED)
    results = replace(
        results, assembly=replace(results.assembly, model=replace(model, load_cases=(load_case,))), cases=(locked,)
    )
    (guide,) = (each for each in load_vectors(scene_of(results, locked)) if each.kind == GUIDE)
    assert guide.forces == pytest.approx(-load_case.live_load[model.guides.blocks, :3])


@pytest.mark.parametrize("held", [True, False])
def test_supports_have_a_file_where_there_are_any(tmp_path: Path, held: bool) -> None:
    """Blocks on the ground, and the same with nothing below them."""
    results = row_of_blocks(2)
    if not held:
        results = replace(results, assembly=replace(results.assembly, contacts=without_contacts(results.contacts)))
    with OutputFolder(tmp_path, "row") as out:
        write_model_vtu(results, out)
    names = {path.name for path in tmp_path.glob("*.vtu")}
    assert "row_blocks.vtu" in names
    assert ("row_supports.vtu" in names) is held
