"""Wavefront OBJ: each object (``o``), or else each group (``g``), is kept apart under its name.

Without either the file is one surface. Read here because the libraries at hand either merge objects or split them by
rules of their own.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry, GeometryFileError, empty_objects, malformed, unused_points
from mbla.model.geometry.welding import surfaces_by_label
from mbla.model.wording import counted, with_count

SILENT = frozenset(
    {"vn", "vt", "vp", "vw", "s", "usemtl", "mtllib", "usemap", "maplib", "shadow_obj", "trace_obj", "bevel"}
    | {"c_interp", "d_interp", "lod", "mg", "con", "cstype", "deg", "bmat", "step", "parm", "trim", "hole", "scrv"}
    | {"sp", "end", "ctech", "stech", "bsp", "bzp", "cdc", "cdp", "res"}
)
"""keywords without effect on the shape of polygons"""
LEFT_OUT = {"l": "line", "p": "point", "curv": "curve", "curv2": "curve", "surf": "free-form surface"}
"""elements that carry geometry but no block"""


@dataclass
class _ObjMesh:
    """The file as read: vertices, faces as rows of them, and the row of the object and group name at each face.

    names      : of objects (``o``) and groups (``g``); what precedes the first of them is row 0
    labels     : (n_faces) rows of names of objects and groups
    beginnings : number of vertices before each object, the first of which is what precedes the first
    after      : vertices since the last face, line or point begin here
    """

    vertices: list[tuple[float, ...]] = field(default_factory=list)
    faces: list[list[int]] = field(default_factory=list)
    names: dict[str, list[str]] = field(default_factory=lambda: {"o": [""], "g": [""]})
    labels: dict[str, list[int]] = field(default_factory=lambda: {"o": [], "g": []})
    left_out: Counter[str] = field(default_factory=Counter)
    beginnings: list[int] = field(default_factory=lambda: [0])
    after: int = 0


def read_obj(path: Path) -> Geometry:
    """Objects or groups of an OBJ file, in file order.

    Raises GeometryFileError for malformed lines, with their number.
    """
    content = _ObjMesh()
    for number, line in _lines(path):
        keyword, _, rest = line.partition(" ")
        try:
            _read_line(content, keyword, rest)
        except (ValueError, IndexError) as error:
            raise GeometryFileError("geometry-file", f"line {number} cannot be read: {error}") from error
    notices = tuple(
        Notice("warning", "mesh-cells-left-out", with_count(count, noun, "left out: no block"))
        for noun, count in content.left_out.items()
    )
    if not content.left_out:
        notices += _unused(content)
    by = "o" if len(content.names["o"]) > 1 else "g"
    points = np.array(content.vertices, dtype=np.float64).reshape(-1, 3)
    polyhedra, present = surfaces_by_label(points, content.faces, content.labels[by])
    names = content.names[by]
    return Geometry(polyhedra, notices, tuple(names[row] for row in present) if len(names) > 1 else ())


def _unused(content: _ObjMesh) -> tuple[Notice, ...]:
    """Vertices without faces and objects with vertices of their own and without a face.

    Vertices come before the faces that use them: a file that ends with vertices lacks faces, and is refused.
    """
    used = np.array([corner for face in content.faces for corner in face], dtype=np.int64)
    after = np.setdiff1d(np.arange(content.after, len(content.vertices)), used)
    if content.faces and len(after):
        words = f"it ends with {counted(len(after), 'vertex')} that no face uses, it seems to be cut off"
        raise malformed("OBJ", words)
    counts, with_faces = np.diff([*content.beginnings, len(content.vertices)]), set(content.labels["o"])
    bare = [row for row, count in enumerate(counts) if row and count and row not in with_faces]
    empty = empty_objects([content.names["o"][row] for row in bare])
    return unused_points(len(content.vertices), used) + empty


def _lines(path: Path) -> Iterator[tuple[int, str]]:
    """Lines with their numbers, without comments; lines that end in a backslash are joined to the next."""
    joined = ""
    for number, raw in enumerate([*path.read_text(encoding="utf-8", errors="replace").splitlines(), ""], start=1):
        part = raw.split("#", 1)[0].strip().replace("\t", " ")
        joined += part.removesuffix("\\") + " "
        if not part.endswith("\\"):
            if line := joined.strip():
                yield number, line
            joined = ""


def _read_line(content: _ObjMesh, keyword: str, rest: str) -> None:
    if keyword == "v":
        fields = rest.split()
        if len(fields) < 3:
            raise ValueError("a vertex has three coordinates")
        content.vertices.append(tuple(float(each) for each in fields[:3]))
    elif keyword == "f":
        corners = [_vertex(token, len(content.vertices)) for token in rest.split()]
        if len(corners) < 3:
            raise ValueError("a face has at least three corners")
        content.faces.append(corners)
        content.after = len(content.vertices)
        for each, names in content.names.items():
            content.labels[each].append(len(names) - 1)
    elif keyword in content.names:
        content.names[keyword].append(rest.strip())
        if keyword == "o":
            content.beginnings.append(len(content.vertices))
    elif keyword in LEFT_OUT:
        content.left_out[LEFT_OUT[keyword]] += 1
    elif keyword not in SILENT:
        raise ValueError(f"{keyword[:40]!r} is no keyword of OBJ")


def _vertex(token: str, count: int) -> int:
    """Row of the vertex that ``7``, ``7/1``, ``7//3`` or ``-1`` names; negative numbers count back from the last."""
    number = int(token.split("/", 1)[0])
    if number == 0 or not -count <= number <= count:
        raise ValueError(f"there is no vertex {number}, {count} precede this line")
    return number - 1 if number > 0 else count + number
