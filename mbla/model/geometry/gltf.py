"""glTF 2.0, as .gltf or .glb: each node with a mesh is kept apart, placed by the transforms of all nodes above it.

By the format's definition lengths are metres and y points upwards. Lists of triangles are read, which is how blocks are
exported; what is drawn in another mode is left out with a warning, and meshes are taken as they are undeformed.
Numbers stand in accessors over views of buffers, which are in the file, beside it, or a text of base 64.

Source: Khronos Group, glTF 2.0 Specification (2021).
"""

from __future__ import annotations

import base64
import struct
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from mbla.arrays import FloatArray
from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, empty_objects, parse_json, well_formed
from mbla.model.geometry.welding import triangle_soup
from mbla.model.solids.polyhedra import join_polyhedra
from mbla.model.wording import counted, was

GLB_MAGIC, JSON_CHUNK, BINARY_CHUNK = 0x46546C67, 0x4E4F534A, 0x004E4942
TRIANGLES = 4
"""mode of primitives that are lists of triangles"""
COMPONENTS = {5120: "<i1", 5121: "<u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC3": 3}
"""of corners by their numbers, and of points"""
KNOWN_EXTENSIONS = ("KHR_texture_transform", "KHR_materials", "KHR_lights_punctual")
"""required extensions that do not change the shape, or need nothing more to be read; beginnings of names"""


def read_gltf(path: Path) -> Geometry:
    """Nodes with meshes, in the order in which the scene lists them.

    Raises
    ------
    GeometryFileError
        for files that are no glTF 2.0, lack a part, or need an extension that changes the shape (compression)
    """
    with well_formed("glTF"):
        return _geometry(_Document(path))


def _parts(content: bytes) -> tuple[Any, bytes | None]:
    """The JSON document, and the binary chunk of a .glb; the extension of the name does not matter."""
    if len(content) < 12 or struct.unpack_from("<I", content)[0] != GLB_MAGIC:
        return parse_json(content), None
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
    return parse_json(chunks[JSON_CHUNK]), chunks.get(BINARY_CHUNK)


class _Document:
    """The JSON of a file, with its buffers, each read when it is first needed."""

    def __init__(self, path: Path) -> None:
        self._folder = path.parent.resolve()
        self.content, self._binary = _parts(path.read_bytes())
        version = str(self.content["asset"]["version"])
        if not version.startswith("2."):
            raise ValueError(f"its version is {version}, not 2.0: export it as glTF 2.0")
        required = map(str, self.content.get("extensionsRequired", []))
        if unknown := [name for name in required if not name.startswith(KNOWN_EXTENSIONS)]:
            words = f"needs {', '.join(unknown)}: export it without compression and without that extension"
            raise GeometryFileError("geometry-not-read", words)
        self.buffer = cache(self._buffer)

    def entry(self, key: str, number: Any) -> Any:
        """An entry of one of the lists by its number; raises ValueError where there is none."""
        entries = self.content.get(key, [])
        if isinstance(number, bool) or not isinstance(number, int) or not 0 <= number < len(entries):
            raise ValueError(f"{key} has no entry {number}, but {len(entries)} from 0 on")
        return entries[number]

    def _buffer(self, number: int) -> bytes:
        entry = self.entry("buffers", number)
        if number == 0 and "uri" not in entry and self._binary is not None:
            return self._binary
        address = entry["uri"]
        if address.startswith("data:"):
            header, _, text = address.partition(",")
            return base64.b64decode(text, validate=True) if header.endswith(";base64") else unquote(text).encode()
        path, name = (self._folder / unquote(address)).resolve(), unquote(address)[:100]
        if "://" in name or not path.is_relative_to(self._folder):
            raise GeometryFileError("file-outside-folder", f"its buffer {name} lies outside the folder of the file")
        if not path.is_file():
            words = f"its buffer {name} is missing: a .gltf needs the .bin written with it"
            raise GeometryFileError("file-missing", words)
        try:
            return path.read_bytes()
        except OSError as error:
            words = f"its buffer {name} cannot be read: {error.strerror or error}"
            raise GeometryFileError("file-unreadable", words) from error

    def values(self, number: int, shape: str) -> FloatArray:
        """Values of an accessor, (count, width).

        shape : ``VEC3`` for points, ``SCALAR`` for whole numbers of corners

        Raises ValueError for accessors without a view of a buffer, and for views that the buffer does not hold.
        """
        accessor = self.entry("accessors", number)
        kind, width = np.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[shape]
        count, begin = accessor["count"], accessor.get("byteOffset", 0)
        if accessor["type"] != shape or kind.kind != ("u" if width == 1 else "f") or accessor.get("normalized"):
            raise ValueError(f"accessor {number} has not {'whole numbers of corners' if width == 1 else 'points'}")
        if "bufferView" not in accessor or "sparse" in accessor or type(count) is not int or min(count, begin) < 0:
            raise ValueError(f"accessor {number} has no view of a buffer of its own for its count of {count}")
        if not count:
            return np.zeros((0, width))
        view = self.entry("bufferViews", accessor["bufferView"])
        stride = view.get("byteStride") or kind.itemsize * width
        first, content = view.get("byteOffset", 0) + begin, self.buffer(view["buffer"])
        if not 0 <= first <= len(content) - stride * (count - 1) - kind.itemsize * width:
            raise ValueError("a buffer is shorter than the document says")
        if first % kind.itemsize or stride < 1:
            raise ValueError(f"bufferView {accessor['bufferView']} begins at byte {first}, amid a number")
        return np.ndarray((count, width), kind, content, first, (stride, kind.itemsize)).astype(np.float64)


def _geometry(document: _Document) -> Geometry:
    surfaces, names, empty = [], [], list[str]()
    left_out = 0
    for node, matrix in _placed_nodes(document):
        if "mesh" not in node:
            continue
        mesh = document.entry("meshes", node["mesh"])
        drawn = [each for each in mesh["primitives"] if each.get("mode", TRIANGLES) == TRIANGLES]
        left_out += len(mesh["primitives"]) - len(drawn)
        triangles = np.concatenate([np.empty((0, 3, 3)), *(_triangles(document, each) for each in drawn)])
        name = str(node.get("name") or mesh.get("name") or "")
        if len(triangles):
            surfaces.append(triangle_soup([triangles @ matrix[:3, :3].T + matrix[:3, 3]]))
            names.append(name)
        elif len(drawn) == len(mesh["primitives"]):
            empty.append(name)
    notices = [*empty_objects(empty)]
    if left_out:
        words = f"{counted(left_out, 'primitive')} {was(left_out)} left out: no list of triangles"
        notices.append(Notice("warning", "mesh-cells-left-out", words))
    return Geometry(join_polyhedra(surfaces), tuple(notices), tuple(names), indexed=False, up="y", unit="m")


def _placed_nodes(document: _Document) -> Iterator[tuple[dict[str, Any], FloatArray]]:
    """Nodes of the scene, each with its (4, 4) matrix in the scene, parents before children."""
    nodes = document.content.get("nodes", [])
    if document.content.get("scenes"):
        roots = document.entry("scenes", document.content.get("scene", 0)).get("nodes", [])
    else:  # a file without scenes is a library of nodes: all that are no children
        children = {child for node in nodes for child in node.get("children", [])}
        roots = [number for number in range(len(nodes)) if number not in children]
    waiting = [(number, np.eye(4)) for number in reversed(roots)]
    placed: set[int] = set()  # the format has trees only; without them few nodes could stand for many
    while waiting:
        number, above = waiting.pop()
        node = document.entry("nodes", number)
        if number in placed:
            raise ValueError(f"node {number} is in two places, or contains itself")
        placed.add(number)
        matrix = above @ _local_matrix(node)
        yield node, matrix
        waiting += [(child, matrix) for child in reversed(node.get("children", []))]


def _local_matrix(node: dict[str, Any]) -> FloatArray:
    """(4, 4) from a matrix, column by column, or from translation, rotation (quaternion x y z w) and scale.

    Exporters write quaternions in single precision, whose length is not quite one.
    """
    from scipy.spatial.transform import Rotation

    if "matrix" in node:
        return np.array(node["matrix"], dtype=np.float64).reshape(4, 4).T
    matrix = np.eye(4)
    turn = Rotation.from_quat(np.array(node.get("rotation", (0, 0, 0, 1)), dtype=np.float64)).as_matrix()
    matrix[:3, :3] = turn * np.array(node.get("scale", (1, 1, 1)), dtype=np.float64).reshape(3)
    matrix[:3, 3] = np.array(node.get("translation", (0, 0, 0)), dtype=np.float64).reshape(3)
    return matrix


def _triangles(document: _Document, primitive: dict[str, Any]) -> FloatArray:
    """Corners of the triangles of a primitive, (n, 3, 3)."""
    points = document.values(primitive["attributes"]["POSITION"], "VEC3")
    rows = np.arange(len(points))
    if "indices" in primitive:
        rows = document.values(primitive["indices"], "SCALAR")[:, 0].astype(np.int64)
        if rows.size and rows.max() >= len(points):
            raise ValueError(f"a triangle names a point that does not exist; there are {len(points)}")
    if len(rows) % 3:
        raise ValueError(f"its triangles have {len(rows)} corners, which three do not divide")
    found: FloatArray = points[rows.reshape(-1, 3)]
    return found
