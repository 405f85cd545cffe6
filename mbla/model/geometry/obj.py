"""Wavefront OBJ: each object (``o``), or else each group (``g``), is kept apart under its name.

Without either the file is one surface. Read here because the libraries at hand either merge objects or split them by
rules of their own.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path

import numpy as np

from mbla.errors import Notice
from mbla.model.geometry.geometry import (
    Geometry,
    GeometryFileError,
    empty_objects,
    malformed,
    refuse_long_line,
    unused_points,
)
from mbla.model.geometry.welding import surfaces_by_label
from mbla.model.wording import counted, was

SILENT = frozenset(
    {"vn", "vt", "vp", "vw", "s", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj", "bevel"}
    | {"c_interp", "d_interp", "lod", "mg", "con", "cstype", "deg", "bmat", "step", "parm", "trim", "hole", "scrv"}
    | {"sp", "end", "ctech", "stech", "bsp", "bzp", "cdc", "cdp", "res"}
)
"""keywords that say nothing of the shape of polygons"""
LEFT_OUT = {"l": "line", "p": "point", "curv": "curve", "curv2": "curve", "surf": "free-form surface"}
"""elements that carry geometry but no block"""


@dataclass
class _Content:
    """The file as read: vertices, faces as rows of them, and the row of the object and group name at each face.

    What precedes the first object or group is row 0.

    beginnings   : number of vertices before each object
    last_element : number of vertices before the last face, line or point
    """

    vertices: list[tuple[float, float, float]] = field(default_factory=list)
    faces: list[list[int]] = field(default_factory=list)
    objects: list[int] = field(default_factory=list)
    groups: list[int] = field(default_factory=list)
    object_names: list[str] = field(default_factory=lambda: [""])
    group_names: list[str] = field(default_factory=lambda: [""])
    left_out: dict[str, int] = field(default_factory=dict)
    beginnings: list[int] = field(default_factory=list)
    last_element: int = 0


def read_obj(path: Path) -> Geometry:
    """Objects or groups of an OBJ file, in file order.

    Raises
    ------
    GeometryFileError
        for malformed lines, with their number
    """
    content = _read(path)
    notices = tuple(
        Notice("warning", "mesh-cells-left-out", f"{counted(count, noun)} {was(count)} left out: no block")
        for noun, count in content.left_out.items()
    )
    used = np.array([corner for face in content.faces for corner in face], dtype=np.int64)
    if not content.left_out:
        notices += unused_points(len(content.vertices), used)
        notices += _empty_objects(content)
        _refuse_cut(content)
    by_object = len(content.object_names) > 1
    rows = content.objects if by_object else content.groups
    names = content.object_names if by_object else content.group_names
    points = np.array(content.vertices, dtype=np.float64).reshape(-1, 3)
    polyhedra, present = surfaces_by_label(points, content.faces, rows)
    return Geometry(polyhedra, notices, tuple(names[row] for row in present) if len(names) > 1 else ())


def _empty_objects(content: _Content) -> tuple[Notice, ...]:
    """Objects with vertices of their own and without a face."""
    bounds = pairwise([*content.beginnings, len(content.vertices)])
    with_faces = set(content.objects)
    return empty_objects(
        [
            content.object_names[row]
            for row, (begin, end) in enumerate(bounds, start=1)
            if end > begin and row not in with_faces
        ]
    )


def _refuse_cut(content: _Content) -> None:
    """Vertices come before the faces that use them: a file that ends with vertices lacks faces."""
    corners = {corner for face in content.faces for corner in face}
    after = [row for row in range(content.last_element, len(content.vertices)) if row not in corners]
    if content.faces and after:
        raise malformed(
            "OBJ", f"it ends with {counted(len(after), 'vertex')} that no face uses, it seems to be cut off"
        )


def _read(path: Path) -> _Content:
    content = _Content()
    for number, line in _lines(path):
        keyword, _, rest = line.partition(" ")
        try:
            _read_line(content, keyword, rest)
        except (ValueError, IndexError) as error:
            raise GeometryFileError("geometry-file", f"line {number} cannot be read: {error}") from error
    return content


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    """Lines with their numbers, without comments; lines that end in a backslash are joined to the next.

    Raises
    ------
    GeometryFileError
        for a line that is too long
    """
    text = path.read_text(encoding="utf-8", errors="replace")
    number = length = 0
    parts: list[str] = []
    for number, raw in enumerate(text.splitlines(), start=1):
        length += len(raw)
        refuse_long_line(number, length)
        part = raw.split("#", 1)[0].strip().replace("\t", " ")
        parts.append(part.removesuffix("\\"))
        if not part.endswith("\\"):
            if line := " ".join(parts).strip():
                yield number, line
            parts, length = [], 0
    if line := " ".join(parts).strip():  # the file ends amid a line that goes on
        yield number, line


def _read_line(content: _Content, keyword: str, rest: str) -> None:
    if keyword == "v":
        fields = rest.split()
        if len(fields) < 3:
            raise ValueError("a vertex has three coordinates")
        content.vertices.append((float(fields[0]), float(fields[1]), float(fields[2])))
    elif keyword == "f":
        corners = [_vertex(token, len(content.vertices)) for token in rest.split()]
        if len(corners) < 3:
            raise ValueError("a face has at least three corners")
        content.faces.append(corners)
        content.objects.append(len(content.object_names) - 1)
        content.groups.append(len(content.group_names) - 1)
        content.last_element = len(content.vertices)
    elif keyword == "o":
        content.object_names.append(rest.strip())
        content.beginnings.append(len(content.vertices))
    elif keyword == "g":
        content.group_names.append(rest.strip())
    elif keyword in LEFT_OUT:
        noun = LEFT_OUT[keyword]
        content.left_out[noun] = content.left_out.get(noun, 0) + 1
    elif keyword not in SILENT:
        raise ValueError(f"{keyword[:40]!r} is no keyword of OBJ")


def _vertex(token: str, count: int) -> int:
    """Row of the vertex that ``7``, ``7/1``, ``7//3`` or ``-1`` names; negative numbers count back from the last."""
    number = int(token.split("/", 1)[0])
    if number == 0 or not -count <= number <= count:
        raise ValueError(f"there is no vertex {number}, {count} precede this line")
    return number - 1 if number > 0 else count + number
