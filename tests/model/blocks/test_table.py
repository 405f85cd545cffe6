from __future__ import annotations

from pathlib import Path

import pytest

from mbla.model.blocks.generated import ItemContext, ItemPart, ItemRefused
from mbla.model.blocks.table import TableItem, generate
from tests.model.shapes import box, build_raw

SHAPES = {"low": box((0, 0, 0), (1, 1, 1)), "high": box((0, 0, 1), (1, 2, 3))}
VERTICES = "block,vertex,x,y,z\n" + "".join(
    f"{name},P{i},{x},{y},{z}\n" for i in range(8) for name, (points, _) in SHAPES.items() for x, y, z in [points[i]]
)
FACES = "block,face,v1,v2,v3,v4\n" + "".join(
    f"{name},{i},{','.join(f'P{corner}' for corner in faces[i])}\n"
    for name, (_, faces) in SHAPES.items()
    for i in range(6)
)


def part(folder: Path, vertices: str = VERTICES, faces: str = FACES) -> ItemPart:
    (folder / "v.csv").write_text(vertices)
    (folder / "f.csv").write_text(faces)
    item = TableItem(material="stone", vertices="v.csv", faces="f.csv")
    return generate(item, ItemContext(1e-3, lambda path, name: folder / name)).parts[0]


def test_blocks_in_order_of_their_first_vertex_with_rows_in_any_order(tmp_path: Path) -> None:
    lines = FACES.splitlines()
    made = part(tmp_path, faces="\n".join([lines[0], *lines[:0:-1]]))
    built = build_raw(made.polyhedra)
    assert built.notices == ()
    assert built.blocks.volumes == pytest.approx([1, 4], rel=1e-14)
    assert made.member == ["low", "high"]


def test_faces_of_any_number_of_corners(tmp_path: Path) -> None:
    faces = FACES.replace("low,0,P0,P3,P2,P1", "low,0,P0,P3,P2\nlow,6,P0,P2,P1")
    assert build_raw(part(tmp_path, faces=faces).polyhedra).blocks.volumes == pytest.approx([1, 4])


@pytest.mark.parametrize(
    ("vertices", "faces", "key", "message"),
    [
        (VERTICES + "low,P0,1,1,1\n", FACES, "vertices", "v.csv:18: block low has a vertex P0 in line 2"),
        (VERTICES + "low,,1,1,1\n", FACES, "vertices", "v.csv:18: vertex is empty"),
        (VERTICES + "low,P9,1,one,1\n", FACES, "vertices", "v.csv:18: y = one: must be a finite number"),
        (VERTICES + "top,P0,1,1,1\n", FACES, "faces", "f.csv: block top has no faces"),
        (VERTICES, FACES + "mid,0,P0,P1,P2\n", "faces", "f.csv:14: block mid has no vertices"),
        (VERTICES, FACES + "low,9,P0,P1,P9\n", "faces", "f.csv:14: block low has no vertex P9"),
        (VERTICES, FACES + "low,9,P0,P1\n", "faces", "f.csv:14: a face has at least three corners, this one has 2"),
        ("x\n1\n", FACES, "vertices", "v.csv:1: column block is missing"),
    ],
)
def test_faults_by_file_and_line(tmp_path: Path, vertices: str, faces: str, key: str, message: str) -> None:
    with pytest.raises(ItemRefused) as caught:
        part(tmp_path, vertices, faces)
    assert ((key,), message) in caught.value.findings
