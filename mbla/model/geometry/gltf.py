"""glTF 2.0, as .gltf or .glb: each node with a mesh is kept apart, placed by the transforms of all nodes above it.

By the format's definition lengths are metres and y points upwards. Triangles, strips and fans; what is drawn as points
or lines is left out, and so is the deformation of morphed and skinned meshes (told in a notice).
Numbers stand in accessors over views of buffers, which are in the file, beside it, or a text of base 64.
Source: Khronos Group, glTF 2.0 Specification (2021).
"""

from __future__ import annotations

import base64
import binascii
import struct
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, empty_objects, malformed, parse_json
from mbla.model.geometry.welding import own_vertices
from mbla.model.solids.polyhedra import join_polyhedra
from mbla.model.wording import counted, was

GLB_MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
TRIANGLES, STRIP, FAN = 4, 5, 6
"""modes of primitives that are surfaces"""
UNSIGNED = (5121, 5123, 5125)
"""component types of numbers of corners"""
KNOWN_EXTENSIONS = ("KHR_mesh_quantization", "KHR_texture_transform", "KHR_materials", "KHR_lights_punctual")
"""required extensions that do not change the shape, or need nothing more to be read; beginnings of names"""


def read_gltf(path: Path) -> Geometry:
    """Nodes with meshes, in the order in which the scene lists them.

    Raises
    ------
    GeometryFileError
        for files that are no glTF 2.0, lack a part, or need an extension that changes the shape (compression)
    """
    try:
        document, binary = _parts(path.read_bytes())
        _check_version(document)
        return _geometry(document, Buffers(document, binary, path.parent))
    except (KeyError, IndexError, TypeError, ValueError, AttributeError, OverflowError, struct.error) as error:
        reason = f"lacks {error}" if isinstance(error, KeyError) else str(error)
        raise malformed("glTF", reason) from error


def _parts(content: bytes) -> tuple[dict[str, Any], bytes | None]:
    """The JSON document, and the binary chunk of a .glb; the extension of the name does not matter."""
    if len(content) < 12 or struct.unpack_from("<I", content)[0] != GLB_MAGIC:
        return _document(content), None
    chunks: dict[int, bytes] = {}
    offset = 12
    while offset + 8 <= len(content):
        length, kind = struct.unpack_from("<II", content, offset)
        if offset + 8 + length > len(content):
            raise ValueError("it ends amid a chunk")
        chunks.setdefault(kind, content[offset + 8 : offset + 8 + length])
        offset += 8 + length
    if JSON_CHUNK not in chunks:
        raise ValueError("it has no chunk of JSON")
    return _document(chunks[JSON_CHUNK]), chunks.get(BINARY_CHUNK)


def _document(content: bytes) -> dict[str, Any]:
    try:
        document = parse_json(content)
    except RecursionError:
        raise ValueError("its JSON is nested too deeply") from None
    if not isinstance(document, dict):
        raise TypeError("its JSON is no object")
    return document


def _check_version(document: dict[str, Any]) -> None:
    version = str(document["asset"]["version"])
    if not version.startswith("2."):
        raise ValueError(f"its version is {version}, not 2.0: export it as glTF 2.0")
    unknown = [name for name in document.get("extensionsRequired", []) if not name.startswith(KNOWN_EXTENSIONS)]
    if unknown:
        words = f"needs {', '.join(map(str, unknown))}: export it without compression and without that extension"
        raise GeometryFileError("geometry-not-read", words)


def _geometry(document: dict[str, Any], buffers: Buffers) -> Geometry:
    surfaces, names = [], []
    empty: list[str] = []
    left_out = 0
    deformed = False
    for node, matrix in _placed_nodes(document):
        if "mesh" not in node:
            continue
        mesh = entry_of(document, "meshes", node["mesh"])
        deformed |= "skin" in node or any("targets" in primitive for primitive in mesh["primitives"])
        points, triangles, lines = _surface(document, mesh, buffers)
        left_out += lines
        name = str(node.get("name") or mesh.get("name") or "")
        if not len(triangles):
            empty += [] if lines else [name]
            continue
        placed = points @ matrix[:3, :3].T + matrix[:3, 3]
        block = np.zeros(len(triangles), dtype=np.int64)
        surfaces.append(own_vertices(placed, triangles.reshape(-1), 3 * np.arange(len(triangles) + 1), block))
        names.append(name)
    notices = [*empty_objects(empty)]
    if left_out:
        words = f"{counted(left_out, 'set')} of points or lines {was(left_out)} left out: no block"
        notices.append(Notice("warning", "mesh-cells-left-out", words))
    if deformed:
        words = "the file has skinned or morphed meshes: they are taken as they are without deformation"
        notices.append(Notice("warning", "mesh-deformation-ignored", words))
    return Geometry(join_polyhedra(surfaces), tuple(notices), tuple(names), indexed=False, up="y", unit="m")


def _placed_nodes(document: dict[str, Any]) -> Iterator[tuple[dict[str, Any], FloatArray]]:
    """Nodes of the scene, each with its (4, 4) matrix in the scene, parents before children."""
    nodes = document.get("nodes", [])
    scenes = document.get("scenes", [])
    if scenes:
        roots = entry_of(document, "scenes", document.get("scene", 0)).get("nodes", [])
    else:  # a file without scenes is a library of nodes: all that are no children
        children = {child for node in nodes for child in node.get("children", [])}
        roots = [number for number in range(len(nodes)) if number not in children]
    waiting = [(number, np.eye(4)) for number in reversed(roots)]
    placed: set[int] = set()  # the format has trees only; without them few nodes could stand for many
    while waiting:
        number, above = waiting.pop()
        if not 0 <= number < len(nodes):
            raise ValueError(f"node {number} does not exist")
        if number in placed:
            raise ValueError(f"node {number} is in two places, or contains itself")
        placed.add(number)
        matrix = above @ _local_matrix(nodes[number])
        yield nodes[number], matrix
        waiting += [(child, matrix) for child in reversed(nodes[number].get("children", []))]


def _local_matrix(node: dict[str, Any]) -> FloatArray:
    """(4, 4) from a matrix, column by column, or from translation, rotation (quaternion x y z w) and scale."""
    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    x, y, z, w = np.array(node.get("rotation", (0, 0, 0, 1)), dtype=np.float64)
    length = x * x + y * y + z * z + w * w
    if not length > 0:
        raise ValueError("a rotation is the zero quaternion")
    s = 2 / length  # exporters write quaternions in single precision, whose length is not quite one
    rotation = np.array(
        [
            [1 - s * (y * y + z * z), s * (x * y - z * w), s * (x * z + y * w)],
            [s * (x * y + z * w), 1 - s * (x * x + z * z), s * (y * z - x * w)],
            [s * (x * z - y * w), s * (y * z + x * w), 1 - s * (x * x + y * y)],
        ]
    )
    matrix = np.eye(4)
    matrix[:3, :3] = rotation * _three(node, "scale", 1.0)
    matrix[:3, 3] = _three(node, "translation", 0.0)
    return matrix


def _three(node: dict[str, Any], key: str, otherwise: float) -> FloatArray:
    numbers = np.array(node.get(key, (otherwise,) * 3), dtype=np.float64)
    if numbers.shape != (3,):
        raise ValueError(f"a {key} has not three numbers")
    return numbers


def _surface(document: dict[str, Any], mesh: dict[str, Any], buffers: Buffers) -> tuple[FloatArray, IntArray, int]:
    """Points (n, 3) and triangles (m, 3) of all primitives of a mesh, and how many of them are no surfaces."""
    all_points, all_triangles = [np.empty((0, 3))], [np.empty((0, 3), dtype=np.int64)]
    count = left_out = 0
    for primitive in mesh["primitives"]:
        mode = primitive.get("mode", TRIANGLES)
        if mode not in (TRIANGLES, STRIP, FAN):
            left_out += 1
            continue
        points = read_accessor(document, primitive["attributes"]["POSITION"], buffers)
        if points.ndim != 2 or points.shape[1] != 3:
            raise ValueError("a position has not three coordinates")
        rows = np.arange(len(points))
        if "indices" in primitive:
            rows = _corners(document, primitive["indices"], buffers)
        if rows.size and not rows.max() < len(points):
            raise ValueError(f"a triangle names a point that does not exist; there are {len(points)}")
        if mode == TRIANGLES and len(rows) % 3:
            raise ValueError(f"its triangles have {len(rows)} corners, which three do not divide")
        all_points.append(points)
        all_triangles.append(_triangles(rows, mode) + count)
        count += len(points)
    return np.concatenate(all_points), np.concatenate(all_triangles), left_out


def _corners(document: dict[str, Any], number: int, buffers: Buffers) -> IntArray:
    """Corners of triangles by their numbers, (n,)."""
    accessor = entry_of(document, "accessors", number)
    if accessor["componentType"] not in UNSIGNED or accessor["type"] != "SCALAR" or accessor.get("normalized"):
        raise ValueError(f"accessor {number} has no whole numbers of corners")
    return read_accessor(document, number, buffers).astype(np.int64)


def _triangles(rows: IntArray, mode: int) -> IntArray:
    """(n, 3) rows of points, from the order of a list, a strip (every other one turned) or a fan."""
    if mode == TRIANGLES:
        return rows.reshape(-1, 3)
    if mode == FAN:
        return np.stack([rows[1:-1], rows[2:], np.full(max(len(rows) - 2, 0), rows[0])], axis=1)
    strip = np.stack([rows[:-2], rows[1:-1], rows[2:]], axis=1)
    strip[1::2] = strip[1::2, [0, 2, 1]]
    return strip


COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def entry_of(document: dict[str, Any], key: str, number: Any) -> dict[str, Any]:
    """An entry of one of the document's lists by its number; raises ValueError where there is none.

    >>> entry_of({"meshes": [{}]}, "meshes", -1)
    Traceback (most recent call last):
    ValueError: meshes has no entry -1, but 1 from 0 on
    """
    entries = document.get(key, [])
    if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(entries):
        raise ValueError(f"{key} has no entry {number}, but {len(entries)} from 0 on")
    entry: dict[str, Any] = entries[number]
    return entry


class Buffers:
    """The buffers of a document, each read when it is first needed."""

    def __init__(self, document: dict[str, Any], binary: bytes | None, folder: Path) -> None:
        """``binary`` is the chunk of a .glb that stands for a first buffer without an address."""
        self._entries = document.get("buffers", [])
        self._folder = folder
        self._read: dict[int, bytes] = {} if binary is None else {0: binary}
        if binary is not None and self._entries and "uri" in self._entries[0]:
            self._read = {}

    def __getitem__(self, number: int) -> bytes:
        if number not in self._read:
            self._read[number] = self._load(entry_of({"buffers": self._entries}, "buffers", number))
        return self._read[number]

    def _load(self, entry: dict[str, Any]) -> bytes:
        address = entry["uri"]
        if address.startswith("data:"):
            header, _, text = address.partition(",")
            try:
                return base64.b64decode(text, validate=True) if header.endswith(";base64") else unquote(text).encode()
            except binascii.Error as error:
                raise ValueError(f"a buffer is not base 64: {error}") from error
        name = unquote(address)
        root = self._folder.resolve()
        path = (root / name).resolve()
        if "://" in name or not path.is_relative_to(root):
            raise GeometryFileError(
                "file-outside-folder", f"its buffer {name[:100]} lies outside the folder of the file"
            )
        if not path.is_file():
            raise GeometryFileError(
                "file-missing", f"its buffer {name[:100]} is missing: a .gltf needs the .bin written with it"
            )
        try:
            return path.read_bytes()
        except OSError as error:
            words = f"its buffer {name[:100]} cannot be read: {error.strerror or error}"
            raise GeometryFileError("file-unreadable", words) from error


def read_accessor(document: dict[str, Any], number: int, buffers: Buffers) -> FloatArray:
    """Values of an accessor, (count,) or (count, width); whole numbers that stand for shares are turned into them.

    Raises
    ------
    ValueError
        for accessors without a view of a buffer, and for views that the buffer does not hold
    """
    accessor = entry_of(document, "accessors", number)
    kind, width, count = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]], accessor["count"]
    if isinstance(count, bool) or not isinstance(count, int) or not 0 <= count < 2**31:
        raise ValueError(f"accessor {number} has a count of {count}")
    if "bufferView" not in accessor or "sparse" in accessor:
        raise ValueError(f"accessor {number} has no view of a buffer of its own for its count of {count}, or is sparse")
    values = _view(document, accessor["bufferView"], accessor.get("byteOffset", 0), kind, width, count, buffers)
    if accessor.get("normalized") and kind.kind in "iu":
        largest = 2 ** (8 * kind.itemsize - (kind.kind == "i")) - 1
        values = np.maximum(values / largest, -1.0)
    return values[:, 0] if width == 1 else values


def _view(
    document: dict[str, Any], view: int, offset: int, kind: np.dtype[Any], width: int, count: int, buffers: Buffers
) -> FloatArray:
    entry = entry_of(document, "bufferViews", view)
    stride = entry.get("byteStride") or kind.itemsize * width
    first = entry.get("byteOffset", 0) + offset
    content = buffers[entry["buffer"]]
    if min(first, offset) < 0 or stride < 1 or first % kind.itemsize:
        raise ValueError(
            f"bufferView {view} begins at byte {first}, where no number of {kind.itemsize} bytes can begin"
        )
    if count and first + stride * (count - 1) + kind.itemsize * width > len(content):
        raise ValueError("a buffer is shorter than the document says")
    if not count:
        return np.zeros((0, width))
    rows = np.ndarray((count, width), kind.newbyteorder("<"), content, first, (stride, kind.itemsize))
    return rows.astype(np.float64)
