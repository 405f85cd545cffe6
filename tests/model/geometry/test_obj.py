from __future__ import annotations

from pathlib import Path

import pytest

from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.obj import read_obj
from mbla.model.geometry.repair import repair
from tests.model.shapes import box, build_raw

DATA = Path(__file__).parents[3] / "decks" / "tutorials" / "data"
CUBE = """v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 0 0 1
v 1 0 1
v 1 1 1
v 0 1 1
"""
FACES = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"


def blocks_of(path: Path) -> Geometry:
    return repair(read_obj(path), 1e-3)


def volumes(path: Path, text: str) -> list[float]:
    path.write_text(text)
    built = build_raw(blocks_of(path).polyhedra)
    assert not built.defects
    return [float(volume) for volume in built.blocks.volumes]


def obj(path: Path) -> Path:
    return path / "blocks.obj"


def test_cross_vault() -> None:
    geometry = blocks_of(DATA / "crossvault.obj")
    built = build_raw(geometry.polyhedra)
    assert len(built.blocks) == 184
    assert not built.defects
    assert len(built.blocks.vertices) == 1624
    assert len(built.blocks.face_normals) == 1264
    assert [notice.identifier for notice in (*geometry.notices, *built.notices)] == ["faces-not-quite-planar"]
    assert built.blocks.volumes.sum() == pytest.approx(3524256.03, abs=0.01)


def test_the_data_carries_its_licence_and_origin() -> None:
    assert "MIT License" in (DATA / "LICENSE-compas_dem.txt").read_text()
    assert "559107e09615ccb6e960f6ac15a11a3e00b60799" in (DATA / "README.md").read_text()


def test_objects_are_blocks(tmp_path: Path) -> None:
    second = CUBE.replace("v 0", "v 5").replace("v 1", "v 7")
    shifted = "\n".join("f " + " ".join(str(int(c) + 8) for c in line.split()[1:]) for line in FACES.splitlines())
    text = f"o one\n{CUBE}{FACES}o two\n{second}{shifted}\n"
    assert volumes(obj(tmp_path), text) == [1, 2]


def test_vertices_may_all_come_first_and_objects_may_share_them(tmp_path: Path) -> None:
    vertices = "".join(f"v {x} {y} {z}\n" for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    upper = "\n".join("f " + " ".join(str(int(c) + 4) for c in line.split()[1:]) for line in FACES.splitlines())
    assert volumes(obj(tmp_path), f"{vertices}o low\n{FACES}o high\n{upper}\n") == [1, 1]


def test_groups_are_blocks_where_there_are_no_objects(tmp_path: Path) -> None:
    vertices = "".join(f"v {x} {y} {z}\n" for z in (0, 1, 2) for x, y in ((0, 0), (1, 0), (1, 1), (0, 1)))
    upper = "\n".join("f " + " ".join(str(int(c) + 4) for c in line.split()[1:]) for line in FACES.splitlines())
    assert volumes(obj(tmp_path), f"{vertices}g low\n{FACES}g high\n{upper}\n") == [1, 1]


def test_groups_inside_an_object_are_one_block(tmp_path: Path) -> None:
    first, rest = FACES.split("\n", 1)
    assert volumes(obj(tmp_path), f"o cube\n{CUBE}g bottom\n{first}\ng rest\n{rest}") == [1]


def test_a_file_without_objects_is_split_into_closed_parts(tmp_path: Path) -> None:
    second = CUBE.replace("v 0", "v 5").replace("v 1", "v 7")
    shifted = "\n".join("f " + " ".join(str(int(c) + 8) for c in line.split()[1:]) for line in FACES.splitlines())
    assert volumes(obj(tmp_path), f"{CUBE}{second}{FACES}{shifted}\n") == [1, 2]


@pytest.mark.parametrize("form", ["{}/{}", "{}//{}", "{}/{}/{}"])
def test_texture_and_normal_indices_are_ignored(tmp_path: Path, form: str) -> None:
    faces = "\n".join("f " + " ".join(form.format(c, c, c) for c in line.split()[1:]) for line in FACES.splitlines())
    text = f"mtllib x.mtl\no cube\n{CUBE}vt 0 0\nvn 0 0 1\nusemtl stone\ns off\n{faces}\n"
    assert volumes(obj(tmp_path), text) == [1]


def test_negative_indices_count_back(tmp_path: Path) -> None:
    faces = "\n".join("f " + " ".join(str(int(c) - 9) for c in line.split()[1:]) for line in FACES.splitlines())
    assert volumes(obj(tmp_path), f"o one\n{CUBE}{faces}\no two\n{CUBE}{faces}\n") == [1, 1]


def test_comments_colours_tabs_and_continued_lines(tmp_path: Path) -> None:
    vertices = CUBE.replace("v 0 0 0", "v\t0\t0 0 1.0 0.5 0.5 # corner")
    faces = FACES.replace("f 1 4 3 2", "f 1 4 \\\n 3 2")
    assert volumes(obj(tmp_path), f"# a cube\n\no cube\n{vertices}{faces}") == [1]


def test_unwelded_corners_are_merged_with_a_notice(tmp_path: Path) -> None:
    vertices, faces = box()
    lines = ["o cube"]
    for number, face in enumerate(faces):
        lines += ["v " + " ".join(map(str, vertices[corner])) for corner in face]
        lines.append("f " + " ".join(str(4 * number + i) for i in (1, 2, 3, 4)))
    assert volumes(obj(tmp_path), "\n".join(lines)) == [1]
    assert [notice.message for notice in blocks_of(obj(tmp_path)).notices] == [
        "16 vertices were merged with another of their block at the same place"
    ]


def test_an_empty_object_is_no_block(tmp_path: Path) -> None:
    assert volumes(obj(tmp_path), f"o nothing\no cube\n{CUBE}{FACES}o nothing\n") == [1]


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("v 1 2", "line 1 cannot be read: a vertex has three coordinates"),
        ("v 1 2 x", "line 1 cannot be read: could not convert string to float: 'x'"),
        (CUBE + "f 1 2", "line 9 cannot be read: a face has at least three corners"),
        (CUBE + "f 1 2 0", "line 9 cannot be read: there is no vertex 0, 8 precede this line"),
        (CUBE + "f 1 2 9", "line 9 cannot be read: there is no vertex 9, 8 precede this line"),
        (CUBE + "f 1 2 -9", "line 9 cannot be read: there is no vertex -9, 8 precede this line"),
        (50 * "w", f"line 1 cannot be read: '{40 * 'w'}' is no keyword of OBJ"),
        (CUBE + "f 1 2 a", "line 9 cannot be read: invalid literal for int() with base 10: 'a'"),
    ],
)
def test_malformed(tmp_path: Path, text: str, message: str) -> None:
    obj(tmp_path).write_text(text)
    with pytest.raises(GeometryFileError) as caught:
        read_obj(obj(tmp_path))
    assert str(caught.value) == message


def test_lines_go_on_after_a_backslash_even_where_the_file_ends(tmp_path: Path) -> None:
    text = CUBE + FACES.replace("f 4 1 5 8\n", "f 4 \\\n 1 \\\n\\\n5 8 \\\n")
    assert volumes(obj(tmp_path), text) == pytest.approx([1.0])


@pytest.mark.parametrize(
    ("extra", "words"),
    [
        ("v 9 9 9\n", "1 of the 9 vertices of the file"),
        ("v 9 9 9\nv 8 8 8\n", "2 of the 10 vertices of the file"),
    ],
)
def test_vertices_that_no_face_uses_are_counted(tmp_path: Path, extra: str, words: str) -> None:
    obj(tmp_path).write_text(f"{CUBE}{extra}{FACES}")
    assert [(notice.identifier, notice.message) for notice in read_obj(obj(tmp_path)).notices] == [
        ("file-vertices-unused", f"{words} used by no face: is it complete?")
    ]
