"""PLY, as text or binary: one surface, whose closed parts are the blocks.

Coordinates and the lists of the faces' corners count, wherever they stand; other properties and elements are passed
over. Every element has to be there in full, and nothing beside them.
Source: G. Turk, The PLY polygon file format, https://gamma.cs.unc.edu/POWERPLANT/papers/ply.pdf
"""

from __future__ import annotations

from dataclasses import dataclass, field
from itertools import chain
from pathlib import Path
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, starts
from mbla.model.geometry.geometry import Geometry, GeometryFileError, check_rows, malformed, unused_points
from mbla.model.geometry.welding import own_vertices
from mbla.model.wording import counted

TYPES = {"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4", "float": "f4"}
TYPES |= {"double": "f8"} | {
    f"{kind}{bits}": f"{kind[0]}{bits // 8}" for kind in ("int", "uint") for bits in (8, 16, 32)
}
TYPES |= {"float32": "f4", "float64": "f8"}
"""types of numpy by their names"""
BYTE_ORDERS = {"binary_little_endian": "<", "binary_big_endian": ">"}
CORNERS = ("vertex_indices", "vertex_index")
"""names of the list of a face's corners"""
DIGITS = 18
"""most of a number that is looked at: Python itself reads none of more than 4,300"""


@dataclass(frozen=True)
class _Element:
    """What the header says of the vertices, the faces, or something else: a type each, lists with that of their length.

    kinds : (type,) of a number, (type of the length, type) of a list, by name of the property
    """

    count: int
    kinds: dict[str, tuple[str, ...]] = field(default_factory=dict)


def read_ply(path: Path) -> Geometry:
    """The surface of a PLY file.

    Raises
    ------
    GeometryFileError
        for files that have other elements than they announce, or neither coordinates nor corners of faces
    """
    header, end, body = path.read_bytes().partition(b"end_header")
    if not end:
        raise _malformed("its header has no end")
    form, elements = _header(header.decode("utf-8", errors="replace"))
    body = body.removeprefix(b"\r").removeprefix(b"\n")
    if form == "ascii":
        found = _read_text(elements, body, header.count(b"\n") + 2)
    elif form in BYTE_ORDERS:
        found = _read_binary(elements, body, BYTE_ORDERS[form])
    else:
        raise _malformed(f"its format {form[:40]!r} is not known")
    points, faces = _points(found.get("vertex", {})), _faces(found.get("face"))
    counts = np.array([len(face) for face in faces], dtype=np.int64)
    corners = np.fromiter(chain.from_iterable(faces), dtype=np.int64, count=int(counts.sum()))
    check_rows(corners, len(points))
    surface = own_vertices(points, corners, starts(counts), np.zeros(len(faces), dtype=np.int64))
    return Geometry(surface, unused_points(len(points), corners))


def _malformed(reason: str) -> GeometryFileError:
    return malformed("PLY", reason)


def _header(text: str) -> tuple[str, dict[str, _Element]]:
    """The format, and the elements by name in their order."""
    form, elements = "", dict[str, _Element]()
    for line in text.split("\n"):
        match line.split():
            case ["format", form, *_]:
                pass
            case ["element", name, count]:
                if len(count) > DIGITS:
                    raise _malformed(f"it announces a number of {len(count)} digits")
                if not count.isdecimal():
                    raise _malformed(f"its number of {name[:40]} is {count!r}")
                elements[name] = _Element(int(count))
            case ["property", *kinds, name] if elements:
                listed = kinds[:1] == ["list"]
                types = tuple(TYPES.get(kind, "") for kind in kinds[listed:])
                if not all(types) or len(types) != 1 + listed:
                    raise _malformed(
                        f"property {name[:100]!r} is of the type {' '.join(kinds)[:100]}, which is not known"
                    )
                elements[tuple(elements)[-1]].kinds[name] = types
            case ["ply" | "comment" | "obj_info", *_] | []:
                pass
            case _:
                raise _malformed(f"its header has the line {line.strip()[:100]!r}")
    return form, elements


FIRST_ROWS = 16
"""of a binary file that are looked at together; more of them while their lists are alike"""
Columns = dict[str, Any]
"""values of the properties of an element by name, of each row a number or a list"""


def _read_text(elements: dict[str, _Element], body: bytes, first_line: int) -> dict[str, Columns]:
    """A line for each row."""
    lines = [(first_line + row, line.split()) for row, line in enumerate(body.split(b"\n")) if line.strip()]
    total = sum(element.count for element in elements.values())
    if len(lines) != total:
        words = " and ".join(counted(element.count, name) for name, element in elements.items())
        raise _malformed(f"it announces {words}, a line each, and has {counted(len(lines), 'line')}")
    found, waiting = dict[str, Columns](), iter(lines)
    for name, element in elements.items():
        rows = [_row_of_text(element, *next(waiting)) for _ in range(element.count)]
        found[name] = {
            each: [row[place] for row in rows] if len(types) == 2 else np.array([row[place] for row in rows], types[0])
            for place, (each, types) in enumerate(element.kinds.items())
        }
    return found


def _row_of_text(element: _Element, number: int, fields: list[bytes]) -> list[Any]:
    """Numbers and lists of a line."""
    values: list[Any] = []
    at, others = 0, len(element.kinds) - 1
    try:
        for types in element.kinds.values():
            read = float if types[-1].startswith("f") else int
            if len(types) == 1:
                values.append(read(fields[at]))
                at += 1
                continue
            length = int(fields[at]) if len(fields[at]) <= DIGITS else len(fields)
            if length < 0 or length > len(fields) - 1 - others:
                told = fields[at].decode(errors="replace")[:20]
                raise _malformed(f"line {number} announces {told} corners and has {len(fields) - 1 - others}")
            values.append([read(each) for each in fields[at + 1 : at + 1 + length]])
            at += 1 + length
    except (ValueError, IndexError, OverflowError) as error:
        raise _malformed(f"line {number} cannot be read: {error}") from error
    if at != len(fields):
        raise _malformed(f"line {number} has {counted(len(fields) - at, 'number')} too many")
    return values


def _read_binary(elements: dict[str, _Element], body: bytes, order: str) -> dict[str, Columns]:
    """Numbers one after the other; as many rows are read as there is room for."""
    found, at = dict[str, Columns](), 0
    for name, element in elements.items():
        found[name], at = _columns(element, body, at, order)
    if at != len(body):
        raise _malformed(f"what its header announces takes {at} bytes, it has {len(body)}")
    return found


def _columns(element: _Element, body: bytes, at: int, order: str) -> tuple[Columns, int]:
    """The rows of an element from byte ``at`` on, and where they end; rows of alike lists are read together."""
    values: dict[str, list[Any]] = {name: [] for name in element.kinds}
    left, together = element.count if element.kinds else 0, FIRST_ROWS
    while left:
        record = _record(element, body, at, order)
        most = min(left, (len(body) - at) // record.itemsize, together)
        rows = np.frombuffer(body, record, most, at)
        alike = np.ones(most, dtype=bool)
        for name, types in element.kinds.items():
            if len(types) == 2:
                alike &= rows[f"length of {name}"] == record[name].shape[0]
        count = most if alike.all() else int(np.argmin(alike))
        together = 2 * together if count == most else FIRST_ROWS
        if not count:
            raise _malformed("it ends before all that its header announces")
        for name in element.kinds:
            values[name] += rows[name][:count].tolist()
        at, left = at + count * record.itemsize, left - count
    return dict(values), at


def _record(element: _Element, body: bytes, at: int, order: str) -> np.dtype[Any]:
    """Type of the row that begins at a byte, with the lengths that its lists have there."""
    fields: list[Any] = []
    for name, types in element.kinds.items():
        if len(types) == 2:
            length = np.dtype(order + types[0])
            place = at + np.dtype(fields).itemsize
            number = int(np.frombuffer(body[place : place + length.itemsize].ljust(length.itemsize, b"\0"), length)[0])
            if not 0 <= number <= len(body):
                raise _malformed(f"a list of its has a length of {number}")
            fields += [(f"length of {name}", length), (name, order + types[1], (number,))]
        else:
            fields.append((name, order + types[0]))
    return np.dtype(fields)


def _points(vertices: Columns) -> FloatArray:
    if not set("xyz") <= set(vertices):
        raise _malformed("x, y or z is not among the properties of its vertices")
    return np.stack([np.asarray(vertices[axis], dtype=np.float64) for axis in "xyz"], axis=1)


def _faces(faces: Columns | None) -> list[list[int]]:
    """Corners of each face."""
    if faces is None:
        return []
    corners = next((faces[name] for name in CORNERS if name in faces), None)
    if corners is None:
        raise _malformed(f"no list of {CORNERS[0]} is among the properties of its faces")
    return [list(face) for face in corners]
