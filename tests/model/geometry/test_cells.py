"""Two unit cubes on each other, six tetrahedra each, that fit together face on face."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from mbla.arrays import FloatArray, IntArray
from mbla.model.blocks.generated import ItemContext
from mbla.model.blocks.mesh import MeshItem, generate
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.solids.polyhedra import cuboids
from tests.model.shapes import build_raw, rotation

SIX = np.array([[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]])
"""tetrahedra of a cube, around its diagonal"""
ENTITY = np.repeat([1, 2], 6)


def two_bricks(shared: bool) -> tuple[FloatArray, IntArray]:
    """Points, which the bricks share or not, and tetrahedra."""
    least = np.array([[0, 0, 0], [0, 0, 1]], dtype=float)
    points = cuboids(least, least + 1).vertices
    cells = np.concatenate([SIX, SIX + 8])
    if shared:
        points, rows = np.unique(points, axis=0, return_inverse=True)
        cells = rows.reshape(-1)[cells]
    return points, cells


def made(path: Path, **keys: object) -> tuple[list[float], list[tuple[str, str]]]:
    """Volumes of the blocks of a file, and what was said of them."""
    item = MeshItem.model_validate({"material": "stone", "file": path.name} | keys)
    generated = generate(item, ItemContext(1e-3, lambda _, name: path.parent / name))
    built = build_raw(generated.parts[0].polyhedra)
    assert not built.defects
    said = [(notice.identifier, notice.message) for notice in generated.notices]
    return [float(volume) for volume in built.blocks.volumes], said


def written(folder: Path, suffix: str, shared: bool, physical: IntArray | None = None, turn: int | None = None) -> Path:
    points, cells = two_bricks(shared)
    path = folder / f"bricks{suffix}"
    none = np.zeros(12, dtype=int)
    tags = {"gmsh:physical": [none if physical is None else physical], "gmsh:geometrical": [ENTITY]}
    points = points if turn is None else points @ rotation(turn).T * 1000
    kind = "gmsh22" if suffix == ".msh" else "vtu"
    write_mesh(path, points, [("tetra", cells)], None, tags if suffix == ".msh" else None, kind)
    return path


@pytest.mark.parametrize("shared", [True, False])
def test_tetrahedra_of_a_finite_element_mesh_are_told(tmp_path: Path, shared: bool) -> None:
    volumes, said = made(written(tmp_path, ".msh", shared))
    assert volumes == pytest.approx([1 / 6] * 12)
    words = "12 tetrahedra share whole faces and are a block each, as of the mesh of a finite-element program"
    wanted = f"bricks.msh: {words}; join_cells: true makes 2 blocks of the 12 cells"
    assert said == [("cells-not-joined", wanted)]


@pytest.mark.parametrize("turn", [None, 0])
@pytest.mark.parametrize("shared", [True, False])
def test_geometric_entities_are_sets_where_there_are_no_groups(tmp_path: Path, shared: bool, turn: int | None) -> None:
    volumes, said = made(written(tmp_path, ".msh", shared, turn=turn), join_cells=True)
    assert volumes == pytest.approx([1 if turn is None else 1e9] * 2)
    assert said == []


def test_groups_without_names_are_sets(tmp_path: Path) -> None:
    volumes, _ = made(written(tmp_path, ".msh", True, np.full(12, 7)), join_cells=True)
    assert volumes == pytest.approx([2])
    volumes, _ = made(written(tmp_path, ".msh", True, np.repeat([3, 4, 4], 4)), join_cells=True)
    assert sorted(volumes) == pytest.approx([4 / 6, 8 / 6])


def test_without_any_sets_what_fits_together_is_one(tmp_path: Path) -> None:
    path = written(tmp_path, ".vtu", True)
    volumes, said = made(path)
    assert len(volumes) == 12
    assert said[0][1].endswith("join_cells: true makes 1 block of the 12 cells")
    assert made(path, join_cells=True)[0] == pytest.approx([2])


def test_tetrahedra_that_share_no_face_and_hexahedra_that_do_are_blocks(tmp_path: Path) -> None:
    apart = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1], [1, 1, 0]], dtype=float)
    path = tmp_path / "apart.vtu"
    write_mesh(path, apart, [("tetra", np.array([[0, 1, 2, 3], [1, 5, 4, 2]]))])
    assert made(path)[1] == []
    stacked = np.array([[0, 0, 0], [0, 0, 1]], dtype=float)
    points, rows = np.unique(cuboids(stacked, stacked + 1).vertices, axis=0, return_inverse=True)
    path = tmp_path / "wall.vtu"
    write_mesh(path, points, [("hexahedron", rows.reshape(-1, 8))])
    assert made(path) == ([1, 1], [])
