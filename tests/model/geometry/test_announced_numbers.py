"""Cells of VTU files: those of too many or too few points are refused, pixels and voxels turned into what they are.

Files that announce other numbers of points and cells than they have are refused, however few are missing. Names that a
Gmsh file gives to its physical groups.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.meshio_files import NODES, POLYGON, write_mesh
from mbla.model.geometry.readers import read_geometry
from mbla.model.geometry.repair import repair
from tests.model.shapes import box, build_raw
from tests.trust.geometry.formats import FORMATS
from tests.trust.geometry.stones import arch

CUBE = [list(map(float, corner)) for corner in box()[0]]
ALONG_AXES = [[x, y, z] for z in (0, 1) for y in (0, 1) for x in (0, 1)]


def vtu(
    path: Path,
    points: Sequence[Sequence[float]],
    cells: Sequence[int],
    offsets: Sequence[int],
    types: Sequence[int],
    kind: str = "Int64",
) -> Geometry:
    """What is read of a file of these lists.

    kind : of numbers of the offsets
    """
    lists = {"connectivity": ("Int64", cells), "offsets": (kind, offsets), "types": ("UInt8", types)}
    arrays = [
        f'<DataArray type="{each}" Name="{name}" format="ascii">{" ".join(map(str, values))} </DataArray>'
        for name, (each, values) in lists.items()
    ]
    places = " ".join(str(value) for point in points for value in point)
    path.write_text(
        '<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>'
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(types)}"><Points>'
        f'<DataArray type="Float64" NumberOfComponents="3" format="ascii">{places}</DataArray></Points>'
        f"<Cells>{''.join(arrays)}</Cells></Piece></UnstructuredGrid></VTKFile>"
    )
    return read_geometry(path)


def volumes(geometry: Geometry) -> list[float]:
    built = build_raw(geometry.polyhedra)
    assert not built.defects
    return [float(volume) for volume in built.blocks.volumes]


@pytest.mark.parametrize(
    ("cells", "offsets", "types", "message"),
    [
        (range(7), [7], [12], "cell 0 (from 0), of VTK type 12, needs 8 and has 7 points"),
        ([*range(8), *range(7)], [8, 15], [12, 12], "cell 1 (from 0), of VTK type 12, needs 8 and has 7 points"),
        ([*range(8), 0, *range(8)], [8, 17], [12, 12], "cell 1 (from 0), of VTK type 12, needs 8 and has 9 points"),
        ([*range(8), *range(4)], [4, 3], [10, 10], "cell 1 (from 0), of VTK type 10, needs 4 and has -1 points"),
        (range(2), [2], [7], "cell 0 (from 0), of VTK type 7, needs 3 and has 2 points"),
        (range(7), [8], [12], "its cells have 8 points by their offsets and 7 in their list"),
        ([0, *range(8)], [8], [12], "its cells have 8 points by their offsets and 9 in their list"),
    ],
)
def test_cells_of_too_few_and_too_many_points(
    tmp_path: Path, cells: Sequence[int], offsets: list[int], types: list[int], message: str
) -> None:
    with pytest.raises(GeometryFileError) as caught:
        vtu(tmp_path / "x.vtu", CUBE, cells, offsets, types)
    assert str(caught.value) == f"is not a well-formed VTU file: {message}"


@pytest.mark.parametrize("kind", [0, 4, 70, 99])
def test_a_type_that_is_not_read_is_named(tmp_path: Path, kind: int) -> None:
    with pytest.raises(GeometryFileError) as caught:
        vtu(tmp_path / "x.vtu", CUBE, [*range(8), 0, 1, 2], [8, 11], [12, kind])
    words = f"cell 1 (from 0) cannot be read: it is of VTK type {kind}; export the mesh without such cells"
    assert str(caught.value) == words


@pytest.mark.parametrize("kind", ["UInt8", "UInt64", "Int32"])
def test_whole_cells_of_two_types(tmp_path: Path, kind: str) -> None:
    geometry = vtu(tmp_path / "x.vtu", CUBE, [*range(8), 0, 1, 3, 4], [8, 12], [12, 10], kind)
    assert volumes(geometry) == pytest.approx([1, 1 / 6])


def test_voxels_are_hexahedra(tmp_path: Path) -> None:
    geometry = vtu(tmp_path / "x.vtu", [*CUBE, *ALONG_AXES], range(16), [8, 16], [12, 11])
    assert geometry.cells
    assert volumes(geometry) == pytest.approx([1, 1])


def test_pixels_are_quadrilaterals(tmp_path: Path) -> None:
    faces = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 4, 5], [2, 3, 6, 7], [0, 2, 4, 6], [1, 3, 5, 7]]
    corners = [corner for face in faces for corner in face]
    geometry = vtu(tmp_path / "x.vtu", ALONG_AXES, corners, range(4, 25, 4), [8] * 6)
    assert volumes(repair(geometry, 1e-3)) == pytest.approx([1])


@pytest.mark.parametrize("kind", sorted(NODES))
def test_every_type_is_read_or_left_out(tmp_path: Path, kind: int) -> None:
    """A tetrahedron beside it, so that there is a block."""
    points = [*CUBE, *([0.1 * i, 0.2 * i, 3.0 + i] for i in range(20))]
    corners = [0, 1, 3, 4, *range(NODES[kind])]
    geometry = vtu(tmp_path / "x.vtu", points, corners, [4, 4 + NODES[kind]], [10, kind])
    left_out = [notice.message for notice in geometry.notices if notice.identifier == "mesh-cells-left-out"]
    assert len(geometry.polyhedra) == (2 if not left_out and kind != 1 else 1)


def test_polygons_have_as_many_points_as_they_like(tmp_path: Path) -> None:
    points = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 2, 0]]
    geometry = vtu(tmp_path / "x.vtu", points, [0, 1, 2, 0, 1, 2, 3, 4], [3, 8], [POLYGON, POLYGON])
    assert np.diff(geometry.polyhedra.loop_start).tolist() == [3, 5]


@pytest.mark.parametrize(
    ("number", "other"),
    [(0, 7), (0, 5), (0, -1), (1, 5), (1, 3), (1, -4), (1, 99), (26, 5), (26, 3), ("end", 30), ("end", 32)],
)
def test_polyhedra_of_too_few_and_too_many_faces_or_points(tmp_path: Path, number: int | str, other: int) -> None:
    """One of the numbers of faces and of points is another, or where the faces of the first polyhedron end."""
    vertices, faces = box()
    path = tmp_path / "cells.vtu"
    cells = [[np.array(face) + first for face in faces] for first in (0, 8)]
    points = np.concatenate([np.array(vertices, dtype=float), np.array(vertices, dtype=float) + 5])
    write_mesh(path, points, [("polyhedron8", cells)])
    assert volumes(read_geometry(path)) == pytest.approx([1, 1])
    listed = [n for cell in cells for n in (6, *(n for face in cell for n in (4, *face.tolist())))]
    ends = [31, 62]
    if isinstance(number, int):
        listed[number] = other
    else:
        ends[0] = other
    text = path.read_text()
    for name, values in (("faces", listed), ("faceoffsets", ends)):
        text = re.sub(
            f'<DataArray[^>]*Name="{name}"[^>]*>[^<]*',
            f'<DataArray type="Int64" Name="{name}" format="ascii">{" ".join(map(str, values))}',
            text,
        )
    path.write_text(text)
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert str(caught.value) == (
        "is not a well-formed VTU file: the faces of polyhedron 0 (from 0) have more or fewer points than they announce"
    )


@pytest.mark.parametrize(
    ("kind", "one", "other", "message"),
    [
        ("ply", b"face 54", b"face 48", "announces 120 elements, a line each, and has 126 lines"),
        ("ply", b"\n4 0 3 2 1\n", b"\n5 0 3 2 1\n", "it has 5 numbers in the place of 6"),
        ("ply binary", b"face 54", b"face 48", "what its header announces takes 2688 bytes, it has 2808"),
        ("ply binary", b"face 54", b"face 55", "it ends before all that its header announces"),
        ("vtu cells", b'Cells="9', b'Cells="10', "is not a well-formed VTU file"),
        ("vtu cells", b"12 12 12", b"12 99 12", "cell 1 .from 0. cannot be read: it is of VTK type 99; "),
        ("msh cells", b"$Elements\n9", b"$Elements\n8", "announces 8 elements and has 9 elements"),
        ("msh", b"$Nodes\n72", b"$Nodes\n1000000000000", "announces 1000000000000 nodes and has 72 nodes"),
        (
            "msh cells",
            b"$Elements\n9",
            b"$Elements\n1000000000000",
            "announces 1000000000000 elements and has 9 elements",
        ),
    ],
)
def test_refused(tmp_path: Path, kind: str, one: bytes, other: bytes, message: str) -> None:
    ((name, content),) = FORMATS[kind].write(arch()).items()
    assert one in content
    (tmp_path / name).write_bytes(content)
    assert len(read_geometry(tmp_path / name).polyhedra)
    (tmp_path / name).write_bytes(content.replace(one, other, 1))
    with pytest.raises(GeometryFileError, match=message):
        read_geometry(tmp_path / name)


@pytest.mark.parametrize("kind", ["msh", "msh cells"])
def test_groups_name_their_blocks(tmp_path: Path, kind: str) -> None:
    stones = arch()
    ((name, content),) = FORMATS[kind].write(stones).items()
    path = tmp_path / name
    path.write_bytes(content)
    assert read_geometry(path).names == tuple(stone.name for stone in stones)


def test_groups_without_names_name_nothing(tmp_path: Path) -> None:
    ((name, content),) = FORMATS["msh cells"].write(arch()).items()
    before, _, rest = content.partition(b"$PhysicalNames")
    path = tmp_path / name
    path.write_bytes(before + rest.partition(b"$EndPhysicalNames\n")[2])
    assert read_geometry(path).names == ()


def test_groups_of_cells_of_two_shapes(tmp_path: Path) -> None:
    text = (
        '$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 1 "foot"\n3 2 "cap"\n$EndPhysicalNames\n'
        "$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 0\n6 0 0 -1\n$EndNodes\n"
        "$Elements\n2\n1 4 2 2 1 1 2 3 4\n2 7 2 1 1 1 2 5 3 6\n$EndElements\n"
    )
    path = tmp_path / "stones.msh"
    path.write_text(text)
    assert read_geometry(path).names == ("cap", "foot")
