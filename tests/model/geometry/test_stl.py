from __future__ import annotations

import struct
from pathlib import Path

import numpy as np
import pytest

from mbla.model.geometry.geometry import GeometryFileError
from mbla.model.geometry.readers import read_geometry
from mbla.model.geometry.repair import repair
from mbla.model.geometry.stl import read_stl
from tests.model.shapes import Shape, box, build_raw

DATA = Path(__file__).parents[3] / "decks" / "tutorials" / "data"


def triangles(shape: Shape) -> list[np.typing.NDArray[np.float64]]:
    vertices = np.array(shape[0], dtype=float)
    return [vertices[[f[0], f[i], f[i + 1]]] for f in shape[1] for i in range(1, len(f) - 1)]


def text(name: str, shape: Shape, end: str = "\n") -> str:
    facets = [
        "facet normal 0 0 0\nouter loop\n"
        + "".join("vertex " + " ".join(f"{x:.6e}" for x in p) + end for p in each)
        + "endloop\nendfacet\n"
        for each in triangles(shape)
    ]
    return f"solid {name}\n{''.join(facets)}endsolid {name}\n"


def volumes(path: Path) -> list[float]:
    built = build_raw(repair(read_stl(path), 1e-3).polyhedra, tolerance=5e-2)
    assert built.defects == ()
    return [float(volume) for volume in built.blocks.volumes]


def test_solids_of_a_text_file_keep_their_names(tmp_path: Path) -> None:
    path = tmp_path / "x.stl"
    path.write_text(text("first stone", box()) + text("second", box((1, 0, 0), (3, 1, 1)), " \r\n"))
    assert volumes(path) == [1, 2]
    assert read_stl(path).names == ("first stone", "second")


@pytest.mark.parametrize("header", [b"written by a test", b"solid in spite of it"])
def test_binary(tmp_path: Path, header: bytes) -> None:
    content = header.ljust(80, b"\0")
    every = triangles(box()) + triangles(box((1, 0, 0), (2, 1, 1)))
    content += struct.pack("<I", len(every))
    for each in every:
        content += struct.pack("<12fH", 0, 0, 0, *each.reshape(-1), 7)
    path = tmp_path / "x.stl"
    path.write_bytes(content)
    assert volumes(path) == [1, 1]
    path.write_bytes(content[:-10])
    with pytest.raises(GeometryFileError, match="is not a well-formed STL file"):
        read_stl(path)


@pytest.mark.parametrize(
    ("content", "message"),
    [
        ("solid\nvertex 1 2 x\nendsolid", "line 2 is no vertex"),
        ("solid\nvertex 1 2 3\nendloop\nendsolid", "the loop that ends in line 3 is no triangle"),
        ("solid\n", "its last solid has no end"),
        ("solid a\nvertex 1 2 3\nendsolid", "the corners of solid 'a' make no complete triangles"),
    ],
)
def test_malformed_text(tmp_path: Path, content: str, message: str) -> None:
    path = tmp_path / "x.stl"
    path.write_text(content)
    with pytest.raises(GeometryFileError, match=message):
        read_stl(path)


def test_the_name_of_a_single_solid_names_no_block(tmp_path: Path) -> None:
    path = tmp_path / "x.stl"
    path.write_text(text("stone", box()))
    assert read_stl(path).names == ()
    path.write_text(text("stone", box()) + text("empty", (box()[0], [])))
    assert read_stl(path).names == ()


def test_solids_without_names_are_one_surface(tmp_path: Path) -> None:
    vertices, faces = box()
    path = tmp_path / "x.stl"
    path.write_text(text("", (vertices, faces[:2])) + text("", (vertices, faces[2:])))
    assert volumes(path) == [1]
    assert len(read_stl(path).polyhedra) == 1
    assert read_stl(path).names == ()


def test_one_name_among_solids_keeps_them_apart(tmp_path: Path) -> None:
    path = tmp_path / "x.stl"
    path.write_text(text("", box()) + text("second", box((1, 0, 0), (3, 1, 1))))
    assert read_stl(path).names == ("", "second")
    assert volumes(path) == [1, 2]


def test_a_binary_file_without_triangles_holds_no_blocks(tmp_path: Path) -> None:
    path = tmp_path / "x.stl"
    path.write_bytes(bytes(84))
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(path)
    assert caught.value.message.identifier == "geometry-without-blocks"


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"ten bytes.", "is not a well-formed STL file, it has 10 bytes"),
        (
            bytes(80) + b"\2\0\0\0" + bytes(50),
            "is not a well-formed STL file: 2 triangles are announced, it has 134 bytes",
        ),
    ],
)
def test_neither_text_nor_binary(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "x.stl"
    path.write_bytes(content)
    with pytest.raises(GeometryFileError) as caught:
        read_stl(path)
    assert str(caught.value) == message
