"""STL, binary or text: triangles without shared vertices; solids of a text file are kept apart under their names.

Read here because the library at hand refuses the text of other writers, and makes one surface of several solids.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.geometry.geometry import Geometry, GeometryFileError, empty_objects, malformed
from mbla.model.geometry.welding import triangle_soup

HEADER, TRIANGLE = 84, 50
"""bytes before the first triangle of a binary file, and of each triangle"""


def read_stl(path: Path) -> Geometry:
    """The solids of a text file, or all triangles of a binary one.

    Raises GeometryFileError for files that are neither, or end amid a triangle.
    """
    content = path.read_bytes()
    n_triangles = int.from_bytes(content[80:HEADER], "little") if len(content) >= HEADER else -1
    if 0 <= n_triangles == (len(content) - HEADER) / TRIANGLE:  # binary headers may begin with "solid", too
        return _geometry([_triangles(content)], [""])
    if content.lstrip()[:5].lower() == b"solid":
        return _solids(content.decode("utf-8", errors="replace"))
    announced = f": {n_triangles} triangles are announced" if n_triangles >= 0 else ""
    raise GeometryFileError("geometry-file", f"is not a well-formed STL file{announced}, it has {len(content)} bytes")


def _triangles(content: bytes) -> FloatArray:
    """Corners of the triangles of a binary file, (n, 3, 3); normals are made anew from them."""
    record = np.dtype([("numbers", "<f4", (4, 3)), ("attribute", "<u2")])
    return np.frombuffer(content, record, offset=HEADER)["numbers"][:, 1:].astype(np.float64)


def _solids(text: str) -> Geometry:
    """Solids of a text file; a line ``vertex x y z`` is all that counts of a facet."""
    names: list[str] = []
    corners: list[list[tuple[float, float, float]]] = []
    complete = True
    for number, line in enumerate(text.splitlines(), start=1):
        fields = line.split(None, 4)
        word = fields[0].lower() if fields else ""
        if word == "solid":
            names.append(" ".join(line.split()[1:]))
            corners.append([])
            complete = False
        elif word == "vertex":
            try:
                corners[-1].append((float(fields[1]), float(fields[2]), float(fields[3])))
            except (ValueError, IndexError) as error:
                raise malformed("STL", f"line {number} is no vertex") from error
        elif word == "endloop" and (not corners or len(corners[-1]) % 3):
            raise malformed("STL", f"the loop that ends in line {number} is no triangle")
        elif word == "endsolid":
            complete = True
    cut = [name for name, each in zip(names, corners, strict=True) if len(each) % 3]
    if cut:
        raise malformed("STL", f"the corners of solid {cut[0]!r} make no complete triangles")
    if not complete:
        raise malformed("STL", "its last solid has no end")
    return _geometry([np.array(each, dtype=np.float64).reshape(-1, 3, 3) for each in corners], names)


def _geometry(solids: list[FloatArray], names: list[str]) -> Geometry:
    """Surfaces of triangles (n, 3, 3) each; one surface of all where none of them has a name."""
    kept = [(triangles, name) for triangles, name in zip(solids, names, strict=True) if len(triangles)]
    empty = empty_objects([name for name, triangles in zip(names, solids, strict=True) if not len(triangles)])
    several = len(kept) > 1 and any(name for _, name in kept)
    parts = [triangles for triangles, _ in kept]
    if parts and not several:
        parts = [np.concatenate(parts)]
    names = [name for _, name in kept] if several else []
    return Geometry(triangle_soup(parts), empty, tuple(names), indexed=False)
