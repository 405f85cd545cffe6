from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pytest

from mbla.arrays import FloatArray, IntArray
from mbla.errors import FileError
from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.meshio_files import write_mesh
from mbla.model.geometry.readers import READERS, read_geometry
from mbla.model.geometry.repair import repair
from mbla.model.solids.polyhedra import HEXAHEDRON, cuboids
from tests.model.shapes import box, build_raw

FORMATS = {".ply": "ply", ".stl": "stl", ".vtu": "vtu", ".msh": "gmsh", ".inp": "abaqus"}


def blocks_of(path: Path) -> Geometry:
    return repair(read_geometry(path), 1e-3)


def grid() -> tuple[FloatArray, IntArray]:
    """Points and hexahedra of a 3 x 3 wall of unit cubes that share their nodes."""
    least = np.array([[x, 0, z] for z in range(3) for x in range(3)], dtype=float)
    points, cells = np.unique(cuboids(least, least + 1).vertices, axis=0, return_inverse=True)
    return points, cells.reshape(-1, 8)


def quads_of(cells: IntArray) -> IntArray:
    return cells[:, HEXAHEDRON].reshape(-1, 4)


def triangles_of(cells: IntArray) -> IntArray:
    quads = quads_of(cells)
    return np.stack([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]], axis=1).reshape(-1, 3)


def volumes(path: Path) -> list[float]:
    built = build_raw(blocks_of(path).polyhedra)
    assert not built.defects
    return [float(volume) for volume in built.blocks.volumes]


@pytest.mark.parametrize("suffix", [".vtu", ".msh", ".inp"])
def test_each_volume_cell_is_a_block(tmp_path: Path, suffix: str) -> None:
    points, cells = grid()
    path = tmp_path / f"wall{suffix}"
    write_mesh(path, points, [("hexahedron", cells)], file_format=FORMATS[suffix])
    geometry = blocks_of(path)
    built = build_raw(geometry.polyhedra)
    assert (*geometry.notices, *built.notices) == ()
    assert built.blocks.volumes == pytest.approx(np.ones(9))
    assert built.blocks.centroids == pytest.approx(points[cells].mean(axis=1))


@pytest.mark.parametrize("suffix", sorted(FORMATS))
def test_surface_of_touching_blocks_is_split(tmp_path: Path, suffix: str) -> None:
    points, cells = grid()
    path = tmp_path / f"wall{suffix}"
    write_mesh(path, points, [("triangle", triangles_of(cells))], file_format=FORMATS[suffix])
    geometry = blocks_of(path)
    built = build_raw(geometry.polyhedra)
    assert (*geometry.notices, *built.notices) == ()
    assert built.blocks.volumes == pytest.approx(np.ones(9))
    assert built.blocks.centroids == pytest.approx(points[cells].mean(axis=1))
    assert built.blocks.facet_of_face.max() + 1 == 54


def test_every_reader_has_a_round_trip() -> None:
    assert set(READERS) == {*FORMATS, ".obj", ".json", ".dxf"}


CORNERS: dict[str, list[list[float]]] = {
    "tetra": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    "pyramid": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0.5, 0.5, 1]],
    "wedge": [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]],
    "hexahedron": [[float(c) for c in corner] for corner in box()[0]],
    "penta_prism": [[np.cos(a), np.sin(a), z] for z in (0, 1) for a in 2 * np.pi * np.arange(5) / 5],
    "hexa_prism": [[np.cos(a), np.sin(a), z] for z in (0, 1) for a in 2 * np.pi * np.arange(6) / 6],
}
VOLUMES = {
    "tetra": 1 / 6,
    "pyramid": 1 / 3,
    "wedge": 1 / 2,
    "hexahedron": 1.0,
    "penta_prism": 2.5 * np.sin(2 * np.pi / 5),
    "hexa_prism": 3 * np.sin(np.pi / 3),
}


class Cells:
    """A block of cells as meshio would hand it over, for types that it reads but does not write."""

    def __init__(self, kind: str, data: IntArray) -> None:
        self.type, self.data = kind, data


@pytest.mark.parametrize("kind", sorted(CORNERS))
def test_faces_of_each_shape_of_cell_point_outwards(kind: str) -> None:
    from mbla.model.geometry.meshio_files import _volume_cells

    points = np.array(CORNERS[kind])
    built = build_raw(_volume_cells(points, Cells(kind, np.arange(len(points))[None])))
    assert built.notices == ()
    assert built.blocks.volumes == pytest.approx([VOLUMES[kind]])


@pytest.mark.parametrize(("kind", "nodes"), [("tetra10", 10), ("hexahedron20", 20), ("wedge15", 15), ("pyramid13", 13)])
def test_cells_of_higher_order_by_their_corners(tmp_path: Path, kind: str, nodes: int) -> None:
    corners = CORNERS[kind.rstrip("0123456789")]
    # the nodes between the corners do not matter
    points = np.array([*corners, *([9.0, 9.0, 9.0 + i] for i in range(nodes - len(corners)))])
    path = tmp_path / "cell.vtu"
    write_mesh(path, points, [(kind, np.arange(nodes)[None])])
    assert volumes(path) == pytest.approx([VOLUMES[kind.rstrip("0123456789")]])


def test_mixed_volume_cells_in_file_order(tmp_path: Path) -> None:
    tetra = np.array(CORNERS["tetra"])
    cube = np.array(CORNERS["hexahedron"]) + np.array([5, 0, 0])
    path = tmp_path / "mixed.vtu"
    cells = [("hexahedron", 4 + np.arange(8)[None]), ("tetra", np.arange(4)[None])]
    write_mesh(path, np.concatenate([tetra, cube]), cells)
    assert volumes(path) == pytest.approx([1, 1 / 6])


def test_boundary_triangles_beside_volume_cells_are_left_out_with_a_notice(tmp_path: Path) -> None:
    points, cells = grid()
    path = tmp_path / "wall.msh"
    write_mesh(path, points, [("triangle", triangles_of(cells)), ("hexahedron", cells)], file_format="gmsh22")
    geometry = blocks_of(path)
    assert len(geometry.polyhedra) == 9
    assert [notice.message for notice in geometry.notices] == [
        "cells were left out: 108 of type triangle; in files with volume cells only these become blocks"
    ]


def test_hexahedron_collapsed_to_a_wedge(tmp_path: Path) -> None:
    points = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]])
    path = tmp_path / "wedge.vtu"
    write_mesh(path, points, [("hexahedron", np.array([[0, 1, 2, 2, 3, 4, 5, 5]]))])
    assert volumes(path) == pytest.approx([0.5])


RUBBISH = [
    b"",
    b"solid\nfacet",
    b"ply\nformat ascii 1.0\n",
    b"<VTKFile",
    b"$MeshFormat\n9 9 9\n",
    b"*NODE\n1, a\n",
    bytes(range(256)) * 9,
]


@pytest.mark.parametrize("suffix", sorted(FORMATS))
@pytest.mark.parametrize("content", RUBBISH, ids=lambda content: content[:6].decode("latin-1").strip() or "empty")
def test_malformed_files_are_refused_in_silence(
    tmp_path: Path, suffix: str, content: bytes, capfd: pytest.CaptureFixture[str]
) -> None:
    path = tmp_path / f"bad{suffix}"
    path.write_bytes(content)
    with pytest.raises(
        GeometryFileError, match=r"^(is not a well-formed|the file holds no blocks|line 2 cannot)"
    ) as caught:
        read_geometry(path)
    assert str(tmp_path) not in str(caught.value)
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("missing", [9, 4, -1])
def test_a_cell_that_names_a_missing_point(tmp_path: Path, missing: int) -> None:
    path = tmp_path / "bad.vtu"
    write_mesh(path, np.zeros((4, 3)), [("tetra", np.array([[0, 1, 2, missing]]))])
    with pytest.raises(GeometryFileError, match=f"names point {missing}, which does not exist; there are 4"):
        read_geometry(path)


def test_unknown_extension(tmp_path: Path) -> None:
    (tmp_path / "wall.step").write_text("")
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(tmp_path / "wall.step")
    assert str(caught.value) == (
        "unknown kind of geometry file; known are .obj, .ply, .stl, .vtu, .msh, .inp, .json, .dxf"
    )


def test_write_mesh_keeps_points_cells_and_data(tmp_path: Path) -> None:
    points, cells = grid()
    data: dict[str, Any] = {"displacement": points * 0.5, "number": np.arange(len(points))}
    path = tmp_path / "out.vtu"
    write_mesh(path, points, [("hexahedron", cells)], data, {"block": [np.arange(9)]})
    mesh = meshio.read(path)
    assert mesh.points == pytest.approx(points)
    assert mesh.cells[0].data.tolist() == cells.tolist()
    assert mesh.point_data["displacement"] == pytest.approx(points * 0.5)
    assert mesh.cell_data["block"][0].tolist() == list(range(9))


def test_write_mesh_says_which_file_it_could_not_write(tmp_path: Path) -> None:
    path = tmp_path / "nowhere" / "out.vtu"
    with pytest.raises(FileError, match=r"out\.vtu: cannot be written: No such file"):
        write_mesh(path, np.zeros((1, 3)), [("vertex", np.array([[0]]))])


def test_what_a_library_says_while_it_writes_is_logged(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, caplog: pytest.LogCaptureFixture
) -> None:
    monkeypatch.setattr(meshio, "write", lambda *_, **__: sys.stdout.write("not\nas it was\n"))
    write_mesh(tmp_path / "out.vtu", np.zeros((1, 3)), [("vertex", np.array([[0]]))])
    assert caplog.messages == [f"{tmp_path / 'out.vtu'}: not as it was"]


def test_meshio_is_imported_only_when_needed() -> None:
    code = "import sys; import mbla.model; sys.exit('meshio' in sys.modules)"
    assert subprocess.run([sys.executable, "-c", code], check=False).returncode == 0


def test_a_face_without_corners(tmp_path: Path) -> None:
    path = tmp_path / "bad.ply"
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n0\n"
    )
    with pytest.raises(GeometryFileError):
        read_geometry(path)


VTU = (
    '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>'
    '<Piece NumberOfPoints="4" NumberOfCells="1"><Points>'
    '<DataArray type="Float64" NumberOfComponents="{components}" format="ascii">{points}</DataArray></Points><Cells>'
    '<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>'
    '<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>'
    '<DataArray type="UInt8" Name="types" format="ascii">9</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>'
)


def test_points_in_a_plane_lie_at_height_zero(tmp_path: Path) -> None:
    path = tmp_path / "plane.vtu"
    path.write_text(VTU.format(components=2, points="0 0 1 0 1 1 0 1"))
    assert read_geometry(path).polyhedra.vertices.tolist() == [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
