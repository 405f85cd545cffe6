from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from mbla.model.blocks.generated import ItemContext, ItemPart, ItemRefused
from mbla.model.blocks.mesh import MeshItem, generate
from mbla.model.solids.build import BuiltBlocks
from tests.model.shapes import box, build_raw


def context(folder: Path) -> ItemContext:
    return ItemContext(1e-3, lambda path, name: folder / name)


def write_obj(path: Path, n: int) -> None:
    lines = []
    for number in range(n):
        vertices, faces = box((2 * number, 0, 0), (2 * number + 1, 1, 1))
        lines += [f"o block {number}", *(f"v {x} {y} {z}" for x, y, z in vertices)]
        lines += [f"f {' '.join(str(corner + 1 + 8 * number) for corner in face)}" for face in faces]
    path.write_text("\n".join(lines))


def test_mesh_is_scaled(tmp_path: Path) -> None:
    write_obj(tmp_path / "row.obj", 3)
    made = generate(MeshItem(material="stone", file="row.obj", scale=0.01), context(tmp_path))
    built = build_raw(made.parts[0].polyhedra)
    assert built.blocks.volumes == pytest.approx([1e-6] * 3)
    assert built.blocks.centroids[2] == pytest.approx([0.045, 0.005, 0.005])


def made(folder: Path, text: str, deck_length: str = "m", **keys: Any) -> tuple[BuiltBlocks, ItemPart, list[str]]:
    (folder / "x.obj").write_text(text)
    context = ItemContext(1e-3, lambda path, name: folder / name, deck_length)
    generated = generate(MeshItem.model_validate({"material": "stone", "file": "x.obj"} | keys), context)
    (part,) = generated.parts
    return build_raw(part.polyhedra), part, [notice.message for notice in generated.notices]


def obj_box(least: tuple[float, ...], greatest: tuple[float, ...], name: str) -> str:
    vertices, faces = box(least, greatest)
    lines = [f"o {name}", *(f"v {x} {y} {z}" for x, y, z in vertices)]
    return "\n".join([*lines, *("f " + " ".join(str(corner - 8) for corner in face) for face in faces)]) + "\n"


@pytest.mark.parametrize(
    ("units", "deck_length", "factor"), [("mm", "m", 1e-3), ("m", "mm", 1e3), ("in", "ft", 1 / 12), (None, "mm", 1.0)]
)
def test_units_of_the_file_are_converted(tmp_path: Path, units: str | None, deck_length: str, factor: float) -> None:
    built, _, told = made(tmp_path, obj_box((0, 0, 0), (1, 2, 3), "a"), deck_length, units=units, scale=2.0)
    assert built.blocks.volumes == pytest.approx([6 * (2 * factor) ** 3], rel=1e-14)
    assert told == []


def test_y_upwards_becomes_z_by_a_rotation(tmp_path: Path) -> None:
    built, _, _ = made(tmp_path, obj_box((0, 0, 0), (1, 2, 3), "a"), up="y")
    assert built.blocks.vertices.min(axis=0).tolist() == [0, -3, 0]
    assert built.blocks.vertices.max(axis=0).tolist() == [1, 0, 2]
    assert built.notices == ()  # a mirror image would have its faces turned


def test_objects_are_members(tmp_path: Path) -> None:
    text = obj_box((0, 0, 0), (1, 1, 1), "Gewölbe 1") + obj_box((0, 0, 1), (1, 1, 2), "key.stone")
    _, part, _ = made(tmp_path, text)
    assert part.member == ["Gewolbe_1", "key.stone"]
    built, part, _ = made(tmp_path, text, members=["Gewölbe 1"])
    assert built.blocks.centroids.tolist() == [[0.5, 0.5, 0.5]]
    assert part.member == ["Gewolbe_1"]


def test_unknown_members_are_refused_all_at_once(tmp_path: Path) -> None:
    with pytest.raises(ItemRefused) as caught:
        made(tmp_path, obj_box((0, 0, 0), (1, 1, 1), "stone"), members=["ston", "stone", "key"])
    assert caught.value.findings == (
        (("members", 0), "unknown member; did you mean stone? the file has: stone"),
        (("members", 2), "unknown member; the file has: stone"),
    )


def test_keys_that_do_not_apply_to_the_file(tmp_path: Path) -> None:
    with pytest.raises(ItemRefused) as caught:
        made(tmp_path, obj_box((0, 0, 0), (1, 1, 1), "stone"), extrude=0.3)
    assert caught.value.findings == ((("extrude",), "applies to drawings (DXF) only: leave it out"),)
    with pytest.raises(ItemRefused) as caught:
        made(tmp_path, obj_box((0, 0, 0), (1, 1, 1), "stone"), join_cells=True)
    assert caught.value.findings == ((("join_cells",), "applies to files with volume cells only: leave it out"),)
