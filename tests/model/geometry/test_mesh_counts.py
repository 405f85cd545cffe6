"""Files that announce other numbers of points and cells than they have are refused, however few are missing."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from mbla.model.geometry import read_geometry
from mbla.model.geometry.geometry import GeometryFileError
from tests.trust.geometry.formats import FORMATS
from tests.trust.geometry.stones import arch


@pytest.mark.parametrize(
    ("kind", "one", "other", "message"),
    [
        ("ply", b"face 54", b"face 48", "announces 72 vertices and 48 faces, a line each, and has 126 lines"),
        ("ply", b"\n4 0 3 2 1\n", b"\n5 0 3 2 1\n", "line 82 announces 5 corners and has 4"),
        ("ply binary", b"face 54", b"face 48", "what its header announces takes 2688 bytes, it has 2808"),
        ("ply binary", b"face 54", b"face 55", "it ends before all that its header announces"),
        ("ply", b"\n4 0 3 2 1\n", b"\n" + 30 * b"1" + b" 0 3 2 1\n", "line 82 announces 1{20} corners and has 4"),
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


@pytest.mark.parametrize(
    ("kind", "before", "words"),
    [
        ("ply", b"element vertex ", "PLY"),
        ("ply", b"element face ", "PLY"),
        ("ply binary", b"element vertex ", "PLY"),
        ("ply binary", b"element face ", "PLY"),
        ("vtu cells", b'NumberOfPoints="', "VTU"),
        ("vtu", b'NumberOfCells="', "VTU"),
    ],
)
@pytest.mark.parametrize("digits", [19, 5000])
def test_a_number_of_many_digits(tmp_path: Path, kind: str, before: bytes, words: str, digits: int) -> None:
    """Python refuses to read one of more than 4,300."""
    ((name, content),) = FORMATS[kind].write(arch()).items()
    assert content.count(before) == 1
    (tmp_path / name).write_bytes(re.sub(before + rb"\d+", before + digits * b"1", content))
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(tmp_path / name)
    assert str(caught.value) == f"is not a well-formed {words} file: it announces a number of {digits} digits"


@pytest.mark.parametrize("digits", [18, 19, 5000])
def test_a_face_of_text_that_announces_corners_in_many_digits(tmp_path: Path, digits: int) -> None:
    ((name, content),) = FORMATS["ply"].write(arch()).items()
    (tmp_path / name).write_bytes(content.replace(b"\n4 0 3 2 1\n", b"\n" + digits * b"4" + b" 0 3 2 1\n", 1))
    with pytest.raises(GeometryFileError) as caught:
        read_geometry(tmp_path / name)
    told = min(digits, 20) * "4"
    assert str(caught.value) == f"is not a well-formed PLY file: line 82 announces {told} corners and has 4"


def test_corners_of_a_face_are_told_without_its_other_properties(tmp_path: Path) -> None:
    path = tmp_path / "x.ply"
    path.write_text(
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 2\nproperty list uchar int vertex_indices\nproperty uchar red\nproperty uchar blue\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2 255 0\n4 0 1 2 255 0\n"
    )
    with pytest.raises(GeometryFileError, match=r"line 17 announces 4 corners and has 3$"):
        read_geometry(path)
