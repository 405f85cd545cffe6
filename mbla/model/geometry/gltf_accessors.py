"""Numbers of a glTF file: accessors over views of buffers, in the file, beside it, or in a text of base 64."""

from __future__ import annotations

import base64
import binascii
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.geometry.geometry import GeometryFileError

COMPONENTS = {5120: np.int8, 5121: np.uint8, 5122: np.int16, 5123: np.uint16, 5125: np.uint32, 5126: np.float32}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


def entry_of(document: dict[str, Any], key: str, number: Any) -> dict[str, Any]:
    """An entry of one of the document's lists by its number; ValueError where there is none.

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
