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
