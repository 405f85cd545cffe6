"""Parts of a glTF file that stand in for each other, or are not where it says: binary chunk, buffers, views."""

from __future__ import annotations

import base64
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.gltf import read_gltf
from mbla.model.geometry.repair import repair
from tests.model.shapes import box, build_raw

POINTS = np.array(box()[0], dtype=np.float32)
TRIANGLES = np.array([t for f in box()[1] for t in (f[:3], [f[0], *f[2:]])], dtype=np.uint16)


def document(nodes: list[dict[str, Any]], **keys: Any) -> dict[str, Any]:
    """A file with one mesh, the unit cube, and its nodes."""
    content = POINTS.tobytes() + TRIANGLES.tobytes()
    base = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": nodes,
        "meshes": [{"name": "cube", "primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": 0, "byteLength": 96},
            {"buffer": 0, "byteOffset": 96, "byteLength": 72},
        ],
        "buffers": [{"byteLength": 168, "uri": "data:application/octet-stream;base64," + _base64(content)}],
    }
    return base | keys


def _base64(content: bytes) -> str:
    return base64.b64encode(content).decode()


def written(folder: Path, content: dict[str, Any]) -> Geometry:
    path = folder / "model.gltf"
    path.write_text(json.dumps(content))
    return read_gltf(path)


def boxes(geometry: Geometry) -> list[list[float]]:
    """Volume and centroid of each block."""
    built = build_raw(repair(geometry, 1e-3).polyhedra)
    assert not built.defects
    return [[v, *c] for v, c in zip(built.blocks.volumes.tolist(), built.blocks.centroids.tolist(), strict=True)]


def test_y_is_up_and_lengths_are_metres(tmp_path: Path) -> None:
    geometry = written(tmp_path, document([{"mesh": 0}]))
    assert (geometry.up, geometry.unit, geometry.names) == ("y", "m", ("cube",))
    assert boxes(geometry) == [pytest.approx([1, 0.5, 0.5, 0.5])]


def test_transforms_of_all_nodes_above_apply_in_turn(tmp_path: Path) -> None:
    """The cube doubled, turned by 90 degrees about y (x to -z, z to x), moved; then all of it moved along z."""
    turn = [0, np.sin(np.pi / 4), 0, np.cos(np.pi / 4)]
    nodes: list[dict[str, Any]] = [
        {"name": "wall", "children": [1, 2], "translation": [0, 0, 10]},
        {"name": "stone a", "mesh": 0, "scale": [2, 2, 2], "rotation": turn, "translation": [5, 0, 0]},
        {"name": "stone b", "mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 7, 8, 9, 1]},
    ]
    geometry = written(tmp_path, document(nodes))
    assert geometry.names == ("stone a", "stone b")
    assert boxes(geometry) == [
        pytest.approx([8, 6, 1, 9], rel=1e-6),
        pytest.approx([1, 7.5, 8.5, 19.5]),
    ]


def test_binary_file_with_its_own_buffer(tmp_path: Path) -> None:
    content = POINTS.tobytes() + TRIANGLES.tobytes()
    text = json.dumps(document([{"mesh": 0}], buffers=[{"byteLength": 168}])).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(content), 0x004E4942) + content
    path = tmp_path / "model.glb"
    path.write_bytes(struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks)
    assert boxes(read_gltf(path)) == [pytest.approx([1, 0.5, 0.5, 0.5])]
    path.write_bytes(path.read_bytes()[:-20])
    with pytest.raises(GeometryFileError, match="ends amid a chunk"):
        read_gltf(path)


def test_a_buffer_beside_the_file(tmp_path: Path) -> None:
    (tmp_path / "the data.bin").write_bytes(POINTS.tobytes() + TRIANGLES.tobytes())
    beside = [{"byteLength": 168, "uri": "the%20data.bin"}]
    assert len(boxes(written(tmp_path, document([{"mesh": 0}], buffers=beside)))) == 1


@pytest.mark.parametrize("address", ["../data.bin", "/etc/passwd", "http://example.org/data.bin"])
def test_a_buffer_outside_the_folder_is_refused(tmp_path: Path, address: str) -> None:
    with pytest.raises(GeometryFileError, match="outside the folder"):
        written(tmp_path, document([{"mesh": 0}], buffers=[{"byteLength": 168, "uri": address}]))


def test_primitives_of_a_mesh_make_one_surface(tmp_path: Path) -> None:
    """Exporters write one primitive for each material."""
    meshes = [{"primitives": [{"attributes": {"POSITION": 0}, "indices": i} for i in (1, 2)]}]
    halves = [
        {"bufferView": 0, "componentType": 5126, "count": 8, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "count": 18, "type": "SCALAR"},
        {"bufferView": 1, "byteOffset": 36, "componentType": 5123, "count": 18, "type": "SCALAR"},
    ]
    geometry = written(tmp_path, document([{"mesh": 0, "name": "a"}], meshes=meshes, accessors=halves))
    assert boxes(geometry) == [pytest.approx([1, 0.5, 0.5, 0.5])]


def test_points_and_lines_are_left_out_with_a_notice(tmp_path: Path) -> None:
    base = document([{"mesh": 0}])
    base["meshes"][0]["primitives"].append({"attributes": {"POSITION": 0}, "mode": 1})
    geometry = written(tmp_path, base)
    assert [notice.message for notice in geometry.notices] == ["1 primitive was left out: no list of triangles"]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"asset": {"version": "1.0"}}, "its version is 1.0, not 2.0"),
        ({"asset": {}}, "lacks 'version'"),
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "needs KHR_draco_mesh_compression: export it without"),
        ({"nodes": [{"children": [0]}]}, "node 0 is in two places, or contains itself"),
        ({"buffers": [{"uri": "data:;base64,AAAA"}]}, "a buffer is shorter than the document says"),
        ({"buffers": [{"uri": "gone.bin"}]}, "its buffer gone.bin is missing"),
    ],
)
def test_malformed(tmp_path: Path, keys: dict[str, Any], message: str) -> None:
    with pytest.raises(GeometryFileError, match=message):
        written(tmp_path, document([{"mesh": 0}]) | keys)


MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942


def address(content: bytes) -> str:
    return "data:application/octet-stream;base64," + base64.b64encode(content).decode()


def binary(folder: Path, *chunks: tuple[int, bytes]) -> Geometry:
    """A .glb of some chunks."""
    body = b"".join(struct.pack("<II", len(content), kind) + content for kind, content in chunks)
    path = folder / "model.glb"
    path.write_bytes(struct.pack("<III", MAGIC, 2, 12 + len(body)) + body)
    return read_gltf(path)


def test_a_first_buffer_with_an_address_is_not_the_binary_chunk(tmp_path: Path) -> None:
    text = json.dumps(document([{"mesh": 0}])).encode()
    geometry = binary(tmp_path, (JSON_CHUNK, text), (BINARY_CHUNK, bytes(168)))
    assert boxes(geometry) == [pytest.approx([1, 0.5, 0.5, 0.5])]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"scenes": [{"nodes": [1]}]}, "nodes has no entry 1, but 1 from 0 on"),
        ({"scenes": [{"nodes": [-1]}]}, "nodes has no entry -1, but 1 from 0 on"),
        ({"nodes": [{"mesh": 1}]}, "meshes has no entry 1, but 1 from 0 on"),
        ({"scene": 2}, "scenes has no entry 2, but 1 from 0 on"),
    ],
)
def test_an_entry_that_does_not_exist_is_named(tmp_path: Path, keys: dict[str, Any], message: str) -> None:
    with pytest.raises(GeometryFileError, match=f": {message}$"):
        written(tmp_path, document([{"mesh": 0}]) | keys)


def refusal(folder: Path, content: dict[str, Any]) -> str:
    with pytest.raises(GeometryFileError) as caught:
        written(folder, content)
    return str(caught.value)


@pytest.mark.parametrize(
    ("accessor", "keys", "message"),
    [
        (0, {"type": "VEC2"}, "accessor 0 has not points"),
        (0, {"count": 7}, "a triangle names a point that does not exist; there are 7"),
        (0, {"count": -1}, "accessor 0 has no view of a buffer of its own for its count of -1"),
        (0, {"count": True}, "accessor 0 has no view of a buffer of its own for its count of True"),
        (1, {"count": 35}, "its triangles have 35 corners, which three do not divide"),
        (1, {"count": 37}, "a buffer is shorter than the document says"),
        (1, {"componentType": 5122}, "accessor 1 has not whole numbers of corners"),
        (1, {"normalized": True}, "accessor 1 has not whole numbers of corners"),
        (1, {"type": "VEC3", "count": 12}, "accessor 1 has not whole numbers of corners"),
    ],
)
def test_numbers_that_are_no_points_or_corners(
    tmp_path: Path, accessor: int, keys: dict[str, Any], message: str
) -> None:
    base = document([{"mesh": 0}])
    base["accessors"][accessor] |= keys
    assert refusal(tmp_path, base) == f"is not a well-formed glTF file: {message}"


def test_a_file_without_scenes_shows_the_nodes_that_are_no_children(tmp_path: Path) -> None:
    nodes: list[dict[str, Any]] = [{"mesh": 0}, {"children": [0], "translation": [0, 0, 3]}, {"name": "camera"}]
    base = document(nodes)
    del base["scenes"], base["scene"]
    assert boxes(written(tmp_path, base)) == [pytest.approx([1, 0.5, 0.5, 3.5])]


def test_objects_without_triangles_are_told(tmp_path: Path) -> None:
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
        "1 primitive was left out: no list of triangles",
    ]
