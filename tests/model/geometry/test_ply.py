"""PLY files: properties in any order, what cannot be read is named."""

from __future__ import annotations

import struct
from collections.abc import Sequence
from pathlib import Path

import pytest

from mbla.model.geometry.geometry import GeometryFileError
from mbla.model.geometry.readers import read_geometry

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


def binary() -> bytes:
    points = b"".join(struct.pack("<3f", *point) for point in POINTS)
    return points + b"".join(struct.pack("<B3i", 3, *face) for face in FACES)


@pytest.mark.parametrize(
    ("as_text", "of_vertex", "of_face", "message"),
    [
        (True, PLACE, ("list uchar int corners",), "vertex_indices is not among the properties of its face"),
        (True, (*PLACE, "half grün"), (CORNERS,), "its header has the line 'property half grün'"),
        (False, ("float x", "float y", "float w"), (CORNERS,), "z is not among the properties of its vertex"),
        (True, (*PLACE, "uchar red"), (CORNERS,), "a line of its vertex cannot be read: list index out of range"),
        (False, PLACE, (CORNERS, "int id"), "it ends before all that its header announces"),
    ],
)
def test_what_cannot_be_read(
    tmp_path: Path, as_text: bool, of_vertex: Sequence[str], of_face: Sequence[str], message: str
) -> None:
    with pytest.raises(GeometryFileError) as caught:
        tetrahedron(tmp_path / "x.ply", header(as_text, of_vertex, of_face), binary() if not as_text else text())
    assert str(caught.value) == f"is not a well-formed PLY file: {message}"


def test_a_corner_of_an_immense_number(tmp_path: Path) -> None:
    with pytest.raises(GeometryFileError, match="a line of its face cannot be read"):
        tetrahedron(
            tmp_path / "x.ply", header(True, PLACE, (CORNERS,)), text(faces="3 {} {} 9999999999999999999999999{}")
        )


def test_faces_before_vertices(tmp_path: Path) -> None:
    lines = header(True, PLACE, [CORNERS])
    points, faces = text().splitlines(keepends=True)[:4], text().splitlines(keepends=True)[4:]
    assert tetrahedron(tmp_path / "x.ply", [*lines[:2], *lines[6:8], *lines[2:6], lines[-1]], b"".join(faces + points))


def test_other_properties_are_passed_over(tmp_path: Path) -> None:
    of_vertex = ("int16 a", *PLACE, "list uchar int marks", "char b")
    of_face = ("uchar red", CORNERS, "list uchar float texcoord", "float64 weight")
    body = text("7 {} {} {} 2 5 6 8", "255 3 {} {} {} 1 0.5 0.5")
    assert tetrahedron(tmp_path / "x.ply", header(True, of_vertex, of_face), body) == POINTS
    body = b"".join(struct.pack("<h3fB2ib", 7, *point, 2, 5, 6, 8) for point in POINTS)
    body += b"".join(struct.pack("<BB3iBfd", 255, 3, *face, 1, 0.5, 0.5) for face in FACES)
    assert tetrahedron(tmp_path / "x.ply", header(False, of_vertex, of_face), body) == POINTS


def test_faces_with_different_numbers_of_corners(tmp_path: Path) -> None:
    """A pyramid over a square, in the other order of bytes."""
    faces = [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
    points = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1)]
    lines = [line.replace("4", "5") for line in header(False, PLACE, [CORNERS])]
    lines[1] = "format binary_big_endian 1.0"
    body = b"".join(struct.pack(">3f", *point) for point in points)
    body += b"".join(struct.pack(f">B{len(face)}i", len(face), *face) for face in faces)
    assert len(tetrahedron(tmp_path / "x.ply", lines, body)) == 5
    with pytest.raises(GeometryFileError, match=r"what its header announces takes 129 bytes, it has 130$"):
        tetrahedron(tmp_path / "x.ply", lines, body + b"0")


def test_comments_are_no_properties(tmp_path: Path) -> None:
    lines = header(True, PLACE, [CORNERS])
    lines[2:2] = ["comment element vertex 9", "obj_info element face 9", "comment"]
    lines[-1:-1] = ["comment property list uchar int old", "comment property uchar red"]
    assert tetrahedron(tmp_path / "x.ply", lines, text()) == POINTS
    with pytest.raises(
        GeometryFileError, match=r"a line of its face cannot be read: it has 4 numbers in the place of 5$"
    ):
        tetrahedron(tmp_path / "x.ply", lines, text().replace(b"3 1 2 3", b"4 1 2 3"))


@pytest.mark.parametrize(
    ("count", "corner", "place", "name", "axes"),
    [
        ("uchar", "int", "float", "vertex_index", "xyz"),
        ("ushort", "int", "float64", "vertex_indices", "zyx"),
        ("uchar", "ushort", "float", "vertex_indices", "xyz"),
    ],
)
def test_names_of_types_in_binary_files(
    tmp_path: Path, count: str, corner: str, place: str, name: str, axes: str
) -> None:
    points = [point if axes == "xyz" else point[::-1] for point in POINTS]
    body = b"".join(struct.pack(f"<3{PACKED[place]}", *point) for point in points)
    body += b"".join(struct.pack(f"<{PACKED[count]}3{PACKED[corner]}", 3, *face) for face in FACES)
    lines = header(False, [f"{place} {axis}" for axis in axes], [f"list {count} {corner} {name}"])
    assert tetrahedron(tmp_path / "x.ply", lines, body) == POINTS
