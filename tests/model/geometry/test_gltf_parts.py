"""Parts of a glTF file that stand in for each other, or are not where it says: binary chunk, buffers, views."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.gltf import read_gltf
from tests.model.geometry.test_gltf import POINTS, TRIANGLES, boxes, document, written

MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942


def address(content: bytes) -> str:
    return "data:application/octet-stream;base64," + base64.b64encode(content).decode()


def binary(folder: Path, *chunks: tuple[int, bytes]) -> Geometry:
    """A .glb of some chunks."""
    body = b"".join(struct.pack("<II", len(content), kind) + content for kind, content in chunks)
    path = folder / "model.glb"
    path.write_bytes(struct.pack("<III", MAGIC, 2, 12 + len(body)) + body)
    return read_gltf(path)


def test_a_binary_file_of_a_header_alone_has_no_document(tmp_path: Path) -> None:
    with pytest.raises(GeometryFileError, match="it has no chunk of JSON"):
        binary(tmp_path)


def test_a_first_buffer_with_an_address_is_not_the_binary_chunk(tmp_path: Path) -> None:
    text = json.dumps(document([{"mesh": 0}])).encode()
    geometry = binary(tmp_path, (JSON_CHUNK, text), (BINARY_CHUNK, bytes(168)))
    assert boxes(geometry) == [pytest.approx([1, 0.5, 0.5, 0.5])]


def test_a_rotation_about_any_axis_turns_as_quaternions_do(tmp_path: Path) -> None:
    turn = Rotation.from_quat([0.1, -0.7, 0.4, 0.5])
    node = {"mesh": 0, "rotation": turn.as_quat().tolist(), "translation": [1, 2, 3]}
    polyhedra = written(tmp_path, document([node])).polyhedra
    placed = turn.apply(POINTS.astype(float)[TRIANGLES.reshape(-1)]) + np.array([1, 2, 3])
    assert polyhedra.vertices[polyhedra.loops] == pytest.approx(placed)


def test_primitives_over_points_of_their_own_make_one_surface(tmp_path: Path) -> None:
    """Bottom and top of the cube with its points, and its sides with the same points in reverse order."""
    ends, sides = TRIANGLES[:4], 7 - TRIANGLES[4:]
    data = POINTS.tobytes() + POINTS[::-1].tobytes() + ends.tobytes() + sides.astype(np.uint16).tobytes()
    lengths = [96, 96, 24, 48]
    keys: dict[str, Any] = {
        "meshes": [{"primitives": [{"attributes": {"POSITION": i}, "indices": i + 2} for i in (0, 1)]}],
        "accessors": [
            *({"bufferView": i, "componentType": 5126, "count": 8, "type": "VEC3"} for i in (0, 1)),
            *({"bufferView": i, "componentType": 5123, "count": lengths[i] // 2, "type": "SCALAR"} for i in (2, 3)),
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": sum(lengths[:i]), "byteLength": length} for i, length in enumerate(lengths)
        ],
        "buffers": [{"byteLength": len(data), "uri": address(data)}],
    }
    polyhedra = written(tmp_path, document([{"mesh": 0}], **keys)).polyhedra
    assert polyhedra.vertices[polyhedra.loops].tolist() == POINTS[TRIANGLES.reshape(-1)].tolist()


def test_numbers_of_corners_of_one_byte_each(tmp_path: Path) -> None:
    data = POINTS.tobytes() + TRIANGLES.astype(np.uint8).tobytes()
    base = document([{"mesh": 0}], buffers=[{"byteLength": len(data), "uri": address(data)}])
    base["accessors"][1]["componentType"] = 5121
    assert boxes(written(tmp_path, base)) == [pytest.approx([1, 0.5, 0.5, 0.5])]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"scenes": [{"nodes": [1]}]}, "node 1 does not exist"),
        ({"scenes": [{"nodes": [-1]}]}, "node -1 does not exist"),
        ({"nodes": [{"mesh": 1}]}, "meshes has no entry 1, but 1 from 0 on"),
        ({"scene": 2}, "scenes has no entry 2, but 1 from 0 on"),
    ],
)
def test_an_entry_that_does_not_exist_is_named(tmp_path: Path, keys: dict[str, Any], message: str) -> None:
    with pytest.raises(GeometryFileError, match=f": {message}$"):
        written(tmp_path, document([{"mesh": 0}]) | keys)


@pytest.mark.parametrize(("of_view", "of_accessor", "first"), [(96, -96, 0), (0, -4, -4), (-4, 0, -4), (95, 0, 95)])
def test_numbers_that_begin_before_their_view_or_amid_a_number_are_refused(
    tmp_path: Path, of_view: int, of_accessor: int, first: int
) -> None:
    base = document([{"mesh": 0}])
    base["bufferViews"][1]["byteOffset"] = of_view
    base["accessors"][1]["byteOffset"] = of_accessor
    with pytest.raises(GeometryFileError, match=f"begins at byte {first}, where no number of 2 bytes can begin"):
        written(tmp_path, base)


def refusal(folder: Path, content: dict[str, Any]) -> str:
    with pytest.raises(GeometryFileError) as caught:
        written(folder, content)
    return str(caught.value)


@pytest.mark.parametrize(
    ("entry", "message"),
    [
        ({"rotation": [0, 0, 0, 0]}, "a rotation is the zero quaternion"),
        ({"scale": [2]}, "a scale has not three numbers"),
        ({"translation": [1, 2]}, "a translation has not three numbers"),
    ],
)
def test_a_place_that_is_none(tmp_path: Path, entry: dict[str, Any], message: str) -> None:
    words = refusal(tmp_path, document([{"mesh": 0} | entry]))
    assert words == f"is not a well-formed glTF file: {message}"


@pytest.mark.parametrize(
    ("accessor", "keys", "message"),
    [
        (0, {"type": "VEC2"}, "a position has not three coordinates"),
        (0, {"count": 7}, "a triangle names a point that does not exist; there are 7"),
        (0, {"count": -1}, "accessor 0 has a count of -1"),
        (0, {"count": True}, "accessor 0 has a count of True"),
        (1, {"count": 35}, "its triangles have 35 corners, which three do not divide"),
        (1, {"count": 37}, "a buffer is shorter than the document says"),
        (1, {"componentType": 5122}, "accessor 1 has no whole numbers of corners"),
        (1, {"normalized": True}, "accessor 1 has no whole numbers of corners"),
        (1, {"type": "VEC3", "count": 12}, "accessor 1 has no whole numbers of corners"),
    ],
)
def test_numbers_that_are_no_points_or_corners(
    tmp_path: Path, accessor: int, keys: dict[str, Any], message: str
) -> None:
    base = document([{"mesh": 0}])
    base["accessors"][accessor] |= keys
    assert refusal(tmp_path, base) == f"is not a well-formed glTF file: {message}"


def test_points_without_values(tmp_path: Path) -> None:
    base = document([{"mesh": 0}])
    del base["accessors"][0]["bufferView"]
    words = "is not a well-formed glTF file: accessor 0 has no values: no bufferView for its count of 8"
    assert refusal(tmp_path, base) == words


def test_a_buffer_that_is_not_base_64(tmp_path: Path) -> None:
    base = document([{"mesh": 0}], buffers=[{"byteLength": 168, "uri": "data:application/octet-stream;base64,ab!"}])
    assert refusal(tmp_path, base).startswith("is not a well-formed glTF file: a buffer is not base 64: ")


def test_a_file_without_scenes_shows_the_nodes_that_are_no_children(tmp_path: Path) -> None:
    nodes: list[dict[str, Any]] = [{"mesh": 0}, {"children": [0], "translation": [0, 0, 3]}, {"name": "camera"}]
    base = document(nodes)
    del base["scenes"], base["scene"]
    assert boxes(written(tmp_path, base)) == [pytest.approx([1, 0.5, 0.5, 3.5])]


def test_objects_without_triangles_and_meshes_that_deform_are_told(tmp_path: Path) -> None:
    primitive = document([])["meshes"][0]["primitives"][0]
    meshes = [
        {"name": "cube", "primitives": [primitive | {"targets": [{"POSITION": 0}]}]},
        {"name": "nothing", "primitives": []},
        {"name": "axis", "primitives": [primitive | {"mode": 1}]},
    ]
    base = document([{"mesh": number} for number in range(3)], meshes=meshes, scenes=[{"nodes": [0, 1, 2]}])
    geometry = written(tmp_path, base)
    assert geometry.names == ("cube",)
    assert [str(notice.message) for notice in geometry.notices] == [
        "1 object was left out, without faces: nothing",
        "1 set of points or lines was left out: no block",
        "the file has skinned or morphed meshes: they are taken as they are without deformation",
    ]
