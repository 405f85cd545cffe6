"""Headers of PLY files: what is not read, or would be taken for something else, is named."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path

import pytest

from mbla.model.geometry import read_geometry
from mbla.model.geometry.geometry import GeometryFileError

POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
FACES = [(0, 2, 1), (0, 1, 3), (0, 3, 2), (1, 2, 3)]
PLACE = ("float x", "float y", "float z")
CORNERS = "list uchar int vertex_indices"
FORMS = {True: "ascii", False: "binary_little_endian"}
PACKED = {"float": "f", "float64": "d", "uchar": "B", "ushort": "H", "uint16": "H", "int": "i"}


def header(as_text: bool, of_vertex: Sequence[str], of_face: Sequence[str]) -> list[str]:
    vertex, face = (["property " + each for each in properties] for properties in (of_vertex, of_face))
    return ["ply", f"format {FORMS[as_text]} 1.0", "element vertex 4", *vertex, "element face 4", *face, "end_header"]


def tetrahedron(path: Path, lines: Sequence[str], body: bytes = b"") -> list[list[float]]:
    """Vertices that are read of a file."""
    path.write_bytes("".join(f"{line}\n" for line in lines).encode() + body)
    polyhedra = read_geometry(path).polyhedra
    assert len(polyhedra) == 1
    vertices: list[list[float]] = polyhedra.vertices.tolist()
    return vertices


def text(points: str = "{} {} {}", faces: str = "3 {} {} {}") -> bytes:
    lines = [*(points.format(*point) for point in POINTS), *(faces.format(*face) for face in FACES)]
    return ("\n".join(lines) + "\n").encode()


@pytest.mark.parametrize(
    ("as_text", "of_vertex", "of_face", "message"),
    [
        (True, PLACE, ("uchar red", CORNERS), "property 'red' of its faces {} it stands before vertex_indices"),
        (
            True,
            PLACE,
            (CORNERS, "list uchar float texcoord"),
            "property 'texcoord' of its faces {} it is a list other than vertex_indices",
        ),
        (
            True,
            PLACE,
            ("list uchar int corners",),
            "property 'corners' of its faces {} it is a list other than vertex_indices",
        ),
        (True, (*PLACE, "list uchar uchar marks"), (CORNERS,), "property 'marks' of its vertices {} it is a list"),
        (True, (*PLACE, "half grün"), (CORNERS,), "property 'grün' of its vertices {} type half is not known"),
        (False, (*PLACE, "list uchar uchar marks"), (CORNERS,), "property 'marks' of its vertices {} it is a list"),
        (
            False,
            (*PLACE, "short a"),
            (CORNERS,),
            "property 'a' of its vertices {} type short is not known in binary files",
        ),
        (
            False,
            PLACE,
            (CORNERS, "int id"),
            "property 'id' of its faces {} faces of binary files may have nothing but vertex_indices",
        ),
        (
            False,
            PLACE,
            (CORNERS, CORNERS),
            "property 'vertex_indices' of its faces {} it is a list other than vertex_indices",
        ),
    ],
)
def test_properties_that_are_not_read(
    tmp_path: Path, as_text: bool, of_vertex: Sequence[str], of_face: Sequence[str], message: str
) -> None:
    with pytest.raises(GeometryFileError) as caught:
        tetrahedron(tmp_path / "x.ply", header(as_text, of_vertex, of_face), text())
    assert str(caught.value) == message.format("cannot be read:") + "; export the mesh without it"


@pytest.mark.parametrize(
    ("as_text", "of_vertex", "message"),
    [
        (True, ("float x", "float y", "float a", "float z"), "their first properties are not x, y and z"),
        (True, ("float a", *PLACE), "their first properties are not x, y and z"),
        (True, ("float x", "float y"), "their first properties are not x, y and z"),
        (False, ("float x", "float y"), "x, y or z is not among their properties"),
    ],
)
def test_vertices_without_a_place(tmp_path: Path, as_text: bool, of_vertex: Sequence[str], message: str) -> None:
    """With something between y and z, a mesh of text was flat."""
    with pytest.raises(GeometryFileError) as caught:
        tetrahedron(tmp_path / "x.ply", header(as_text, of_vertex, [CORNERS]))
    assert str(caught.value) == f"its vertices cannot be read: {message}"


def test_faces_before_vertices(tmp_path: Path) -> None:
    lines = header(True, PLACE, [CORNERS])
    with pytest.raises(GeometryFileError) as caught:
        tetrahedron(tmp_path / "x.ply", [*lines[:2], *lines[6:8], *lines[2:6], lines[-1]])
    words = "its faces cannot be read: they stand before its vertices; export the mesh with vertices first"
    assert str(caught.value) == words


def test_properties_after_the_place_and_after_the_corners(tmp_path: Path) -> None:
    of_vertex, of_face = (*PLACE, "int16 a", "char b"), (CORNERS, "uchar red", "float64 weight")
    body = text("{} {} {} 7 8", "3 {} {} {} 255 0.5")
    assert tetrahedron(tmp_path / "x.ply", header(True, of_vertex, of_face), body) == POINTS


def test_comments_are_no_properties(tmp_path: Path) -> None:
    lines = header(True, PLACE, [CORNERS])
    lines[2:2] = ["comment element vertex 9", "obj_info element face 9", "comment"]
    lines[-1:-1] = ["comment property list uchar int old", "comment property uchar red"]
    assert tetrahedron(tmp_path / "x.ply", lines, text()) == POINTS
    with pytest.raises(GeometryFileError, match=r"line 22 announces 4 corners and has 3$"):
        tetrahedron(tmp_path / "x.ply", lines, text().replace(b"3 1 2 3", b"4 1 2 3"))


@pytest.mark.parametrize(("count", "corner"), [("uchar", "int"), ("ushort", "int"), ("uchar", "ushort")])
@pytest.mark.parametrize("place", ["float", "float64"])
@pytest.mark.parametrize("name", ["vertex_index", "vertex_indices"])
@pytest.mark.parametrize("axes", ["xyz", "zyx"])
def test_names_of_types_in_binary_files(
    tmp_path: Path, count: str, corner: str, place: str, name: str, axes: str
) -> None:
    points = [point if axes == "xyz" else point[::-1] for point in POINTS]
    body = b"".join(struct.pack(f"<3{PACKED[place]}", *point) for point in points)
    body += b"".join(struct.pack(f"<{PACKED[count]}3{PACKED[corner]}", 3, *face) for face in FACES)
    lines = header(False, [f"{place} {axis}" for axis in axes], [f"list {count} {corner} {name}"])
    assert tetrahedron(tmp_path / "x.ply", lines, body) == POINTS
