from __future__ import annotations

import base64
import errno
import json
import struct
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from mbla.model.geometry.geometry import Geometry, GeometryFileError
from mbla.model.geometry.gltf import read_gltf
from mbla.model.geometry.gltf_accessors import Buffers, read_accessor
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


def test_a_buffer_that_cannot_be_read_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(_: Path) -> bytes:
        raise PermissionError(errno.EACCES, "Permission denied")

    (tmp_path / "part.bin").write_bytes(b"")
    monkeypatch.setattr(Path, "read_bytes", refuse)
    with pytest.raises(GeometryFileError) as caught:
        Buffers({"buffers": [{"byteLength": 168, "uri": "part.bin"}]}, None, tmp_path)[0]
    assert str(caught.value) == "its buffer part.bin cannot be read: Permission denied"
    assert caught.value.message.identifier == "file-unreadable"


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


def test_strips_and_fans() -> None:
    from mbla.model.geometry.gltf import FAN, STRIP, _triangles

    assert _triangles(np.arange(5), STRIP).tolist() == [[0, 1, 2], [1, 3, 2], [2, 3, 4]]
    assert _triangles(np.arange(5), FAN).tolist() == [[1, 2, 0], [2, 3, 0], [3, 4, 0]]


def test_quantized_positions(tmp_path: Path) -> None:
    content = np.concatenate([POINTS, np.zeros((8, 1))], axis=1).astype(np.int16) * 32767
    data = content.astype("<i2").tobytes() + TRIANGLES.tobytes()
    accessors = [
        {"bufferView": 0, "componentType": 5122, "normalized": True, "count": 8, "type": "VEC3"},
        {"bufferView": 1, "componentType": 5123, "count": 36, "type": "SCALAR"},
    ]
    views = [{"buffer": 0, "byteLength": 64, "byteStride": 8}, {"buffer": 0, "byteOffset": 64, "byteLength": 72}]
    buffers = [{"byteLength": len(data), "uri": "data:;base64," + _base64(data)}]
    keys = {"accessors": accessors, "bufferViews": views, "buffers": buffers}
    geometry = written(tmp_path, document([{"mesh": 0}], extensionsRequired=["KHR_mesh_quantization"], **keys))
    assert boxes(geometry) == [pytest.approx([1, 0.5, 0.5, 0.5])]


def test_sparse_positions(tmp_path: Path) -> None:
    extra = np.array([4, 5, 6, 7], dtype="<u2").tobytes() + (POINTS[4:] + np.array([0, 0, 1])).astype("<f4").tobytes()
    data = POINTS.tobytes() + TRIANGLES.tobytes() + extra
    views = [
        {"buffer": 0, "byteLength": 96},
        {"buffer": 0, "byteOffset": 96, "byteLength": 72},
        {"buffer": 0, "byteOffset": 168, "byteLength": 8},
        {"buffer": 0, "byteOffset": 176, "byteLength": 48},
    ]
    base = document([{"mesh": 0}], bufferViews=views, buffers=[{"uri": "data:;base64," + _base64(data)}])
    sparse = {"indices": {"bufferView": 2, "componentType": 5123}, "values": {"bufferView": 3}, "count": 4}
    base["accessors"][0]["sparse"] = sparse
    assert boxes(written(tmp_path, base)) == [pytest.approx([2, 0.5, 0.5, 1.0])]


def test_points_and_lines_are_left_out_with_a_notice(tmp_path: Path) -> None:
    base = document([{"mesh": 0}])
    base["meshes"][0]["primitives"].append({"attributes": {"POSITION": 0}, "mode": 1})
    geometry = written(tmp_path, base)
    assert [notice.message for notice in geometry.notices] == ["1 set of points or lines was left out: no block"]


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"asset": {"version": "1.0"}}, "its version is 1.0, not 2.0"),
        ({"asset": {}}, "lacks 'version'"),
        ({"extensionsRequired": ["KHR_draco_mesh_compression"]}, "needs KHR_draco_mesh_compression: export it without"),
        ({"nodes": [{"children": [0]}]}, "node 0 is in two places, or contains itself"),
        ({"scenes": [{"nodes": [3]}]}, "node 3 does not exist"),
        ({"buffers": [{"uri": "data:;base64,AAAA"}]}, "a buffer is shorter than the document says"),
        ({"buffers": [{"uri": "gone.bin"}]}, "its buffer gone.bin is missing"),
    ],
)
def test_malformed(tmp_path: Path, keys: dict[str, Any], message: str) -> None:
    with pytest.raises(GeometryFileError, match=message):
        written(tmp_path, document([{"mesh": 0}]) | keys)


@pytest.mark.parametrize("content", [b"", b"[]", b"{", b"glTF" + bytes(8), bytes(range(256)), b"[" * 100_000])
def test_rubbish(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "bad.glb"
    path.write_bytes(content)
    with pytest.raises(GeometryFileError):
        read_gltf(path)


def test_values_of_an_accessor_are_rows_unless_they_are_single_numbers(tmp_path: Path) -> None:
    content = document([{"mesh": 0}])
    buffers = Buffers(content, None, tmp_path)
    assert read_accessor(content, 0, buffers).shape == POINTS.shape
    assert read_accessor(content, 1, buffers).tolist() == TRIANGLES.reshape(-1).tolist()
