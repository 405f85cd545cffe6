"""PLY, as text or binary: one surface, whose closed parts are the blocks.

Coordinates and the lists of the faces' corners count, wherever they stand; other properties and elements are passed
over. Every element has to be there in full, and nothing besides.

Source: G. Turk, The PLY polygon file format, https://gamma.cs.unc.edu/POWERPLANT/papers/ply.pdf
"""

from __future__ import annotations

import struct
from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import starts
from mbla.model.geometry.geometry import Geometry, check_rows, malformed, unused_points
from mbla.model.geometry.welding import own_vertices

NAMES = {"b": "char int8", "B": "uchar uint8", "h": "short int16", "H": "ushort uint16", "i": "int int32"}
NAMES |= {"I": "uint uint32", "f": "float float32", "d": "double float64"}
TYPES = {name: code for code, names in NAMES.items() for name in names.split()}
"""codes of struct by the names of types"""
BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
CORNERS = ("vertex_indices", "vertex_index")
"""names of the list of a face's corners"""
Row = list[Any]
"""of each property of an element a number, or a list of them"""


@dataclass(frozen=True)
class _Element:
    """What the header states on the vertices, the faces, or something else.

    kinds : by name of the property the type of a number, or those of the length and of the numbers of a list
    """

    count: int
    kinds: dict[str, list[str]] = field(default_factory=dict)


def read_ply(path: Path) -> Geometry:
    """The surface of a PLY file.

    Raises GeometryFileError for files that have other elements than they announce, or neither coordinates nor corners
    of faces.
    """
    header, end, body = path.read_bytes().partition(b"end_header")
    if not end:
        raise malformed("PLY", "its header has no end")
    form, elements = _header(header.decode("utf-8", errors="replace"))
    body = body.removeprefix(b"\r").removeprefix(b"\n")
    if form == "ascii":
        found = _read_text(elements, body)
    elif form in BYTE_ORDERS:
        found = _read_binary(elements, body, BYTE_ORDERS[form])
    else:
        raise malformed("PLY", f"its format {form[:40]!r} is not known")
    axes = [_column(elements, found, "vertex", (axis,)) for axis in "xyz"]
    points = np.array(axes, dtype=np.float64).reshape(3, -1).T
    faces = _column(elements, found, "face", CORNERS) if "face" in elements else []
    corners = np.array(list(chain.from_iterable(faces)), dtype=np.int64)
    check_rows(corners, len(points))
    start = starts(np.array([len(face) for face in faces], dtype=np.int64))
    surface = own_vertices(points, corners, start, np.zeros(len(faces), dtype=np.int64))
    return Geometry(surface, unused_points(len(points), corners))


def _header(text: str) -> tuple[str, dict[str, _Element]]:
    """The format, and the elements by name in their order."""
    form, elements = "", dict[str, _Element]()
    for line in text.split("\n"):
        match line.split():
            case ["format", form, *_]:
                pass
            case ["element", name, count] if count.isdecimal() and len(count) < 19:
                elements[name] = _Element(int(count))
            case ["property", "list", length, kind, name] if elements and {length, kind} <= TYPES.keys():
                elements[list(elements)[-1]].kinds[name] = [TYPES[length], TYPES[kind]]
            case ["property", kind, name] if elements and kind in TYPES:
                elements[list(elements)[-1]].kinds[name] = [TYPES[kind]]
            case ["ply" | "comment" | "obj_info", *_] | []:
                pass
            case _:
                raise malformed("PLY", f"its header has the line {line.strip()[:100]!r}")
    return form, elements


def _column(elements: dict[str, _Element], found: dict[str, list[Row]], name: str, among: tuple[str, ...]) -> list[Any]:
    """Values of a property of an element that has one of some names."""
    kinds = list(elements[name].kinds) if name in elements else []
    place = next((kinds.index(each) for each in among if each in kinds), None)
    if place is None:
        raise malformed("PLY", f"{among[0]} is not among the properties of its {name}")
    return [row[place] for row in found[name]]


def _read_text(elements: dict[str, _Element], body: bytes) -> dict[str, list[Row]]:
    """A line for each row."""
    lines = [line.split() for line in body.split(b"\n") if line.strip()]
    total = sum(element.count for element in elements.values())
    if len(lines) != total:
        raise malformed("PLY", f"it announces {total} elements, a line each, and has {len(lines)} lines")
    found, waiting = dict[str, list[Row]](), iter(lines)
    for name, element in elements.items():
        try:
            found[name] = [_row_of_text(element, next(waiting)) for _ in range(element.count)]
        except (ValueError, IndexError, OverflowError) as error:
            raise malformed("PLY", f"a line of its {name} cannot be read: {error}") from error
    return found


def _row_of_text(element: _Element, fields: list[bytes]) -> Row:
    """Numbers and lists of a line; ValueError where it has more or fewer than it should."""
    row, at = Row(), 0
    for *lengths, kind in element.kinds.values():
        read, count = float if kind in "fd" else int, 1
        if lengths:
            count, at = int(fields[at]), at + 1
        values = [read(each) for each in fields[at : at + max(count, 0)]]
        at += count
        row.append(np.array(values, kind).tolist() if lengths else values[0])  # OverflowError beyond the type
    if at != len(fields):
        raise ValueError(f"it has {len(fields)} numbers in the place of {at}")
    return row


def _read_binary(elements: dict[str, _Element], body: bytes, order: str) -> dict[str, list[Row]]:
    """Numbers one after the other."""
    found, at = dict[str, list[Row]](), 0
    for name, element in elements.items():
        found[name] = []
        for _ in range(element.count if element.kinds else 0):
            row = Row()
            for *lengths, kind in element.kinds.values():
                count = 1
                try:
                    if lengths:
                        (count,) = struct.unpack_from(order + lengths[0], body, at)
                        at += struct.calcsize(order + lengths[0])
                    values = struct.unpack_from(f"{order}{count}{kind}", body, at)
                except struct.error as error:
                    raise malformed("PLY", "it ends before all that its header announces") from error
                at += struct.calcsize(order + kind) * count
                row.append(values if lengths else values[0])
            found[name].append(row)
    if at != len(body):
        raise malformed("PLY", f"what its header announces takes {at} bytes, it has {len(body)}")
    return found
