"""Guards before and behind meshio, which believes what VTU and Gmsh files announce: blocks would be missing or wrong.

The numbers that a file announces are held against what it has and what was read. A cell takes the points of the list
between the offset before it and its own; meshio takes as many as its type needs, counted back from its own offset: one
too few, and the cell begins with a point of its neighbour or with the last of the list.

Source: VTK file formats, https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from mbla.arrays import IntArray
from mbla.model.geometry.geometry import GeometryFileError, malformed
from mbla.model.wording import counted

CELLS = {
    **{1: ("vertex", 1), 3: ("line", 2), 5: ("triangle", 3), 7: ("polygon", 3), 8: ("pixel", 4), 9: ("quad", 4)},
    **{10: ("tetra", 4), 11: ("voxel", 8), 12: ("hexahedron", 8), 13: ("wedge", 6), 14: ("pyramid", 5)},
    **{15: ("penta_prism", 10), 16: ("hexa_prism", 12), 21: ("line3", 3), 22: ("triangle6", 6), 23: ("quad8", 8)},
    **{24: ("tetra10", 10), 25: ("hexahedron20", 20), 26: ("wedge15", 15), 27: ("pyramid13", 13), 28: ("quad9", 9)},
    **{29: ("hexahedron27", 27), 30: ("quad6", 6), 31: ("wedge12", 12), 32: ("wedge18", 18)},
    **{33: ("hexahedron24", 24), 34: ("triangle7", 7), 35: ("line4", 4)},
    **{68: ("VTK_LAGRANGE_CURVE", 2), 69: ("VTK_LAGRANGE_TRIANGLE", 3), 70: ("VTK_LAGRANGE_QUADRILATERAL", 4)},
    **{71: ("VTK_LAGRANGE_TETRAHEDRON", 4), 72: ("VTK_LAGRANGE_HEXAHEDRON", 8), 73: ("VTK_LAGRANGE_WEDGE", 6)},
    **{74: ("VTK_LAGRANGE_PYRAMID", 5)},
}
"""meshio's name and number of points of each type of VTK that is read"""
VARIABLE = {7, 68, 69, 70, 71, 72, 73, 74}
"""types of which that number is the least"""
BY_AXES = {8: (9, (0, 1, 3, 2)), 11: (12, (0, 1, 3, 2, 4, 5, 7, 6))}
"""pixels and voxels, whose points come along the axes: the type that they are, and its points in order around it"""


def checked_cells(points: IntArray, offsets: IntArray, types: IntArray) -> tuple[IntArray, IntArray, IntArray]:
    """The same, pixels turned into quadrilaterals and voxels into hexahedra.

    points  : rows of points of all cells, one after the other
    offsets : (n_cells,) where the points of each cell end
    types   : (n_cells,) numbers of VTK

    Raises
    ------
    GeometryFileError
        for a type that is not read, and for a cell of more or fewer points than its type needs
    """
    points, offsets, types = (np.array(each, dtype=np.int64) for each in (points, offsets, types))
    sizes = np.diff(offsets, prepend=0)
    for kind in np.unique(types).tolist():
        rows = np.flatnonzero(types == kind)
        if kind not in CELLS:
            words = f"cell {rows[0]} (from 0) cannot be read: it is of VTK type {kind}"
            raise GeometryFileError("geometry-file", f"{words}; export the mesh without such cells")
        name, needed = CELLS[kind]
        wrong = rows[sizes[rows] < needed if kind in VARIABLE else sizes[rows] != needed]
        if len(wrong):
            words = (
                f"is not a well-formed VTU file: cell {wrong[0]} (from 0), a {name}, has "
                f"{counted(int(sizes[wrong[0]]), 'point')} and needs {'at least ' if kind in VARIABLE else ''}{needed}"
            )
            raise GeometryFileError("geometry-file", words)
    if sizes.sum() != len(points):
        words = f"its cells have {counted(int(sizes.sum()), 'point')} by their offsets and {len(points)} in their list"
        raise malformed("VTU", words)
    for kind, (other, order) in BY_AXES.items():
        rows = np.flatnonzero(types == kind)
        first = offsets[rows, None] - len(order)
        points[first + np.arange(len(order))] = points[first + np.array(order)]
        types[rows] = other
    return points, offsets, types


def refuse_other_faces(faces: IntArray, ends: IntArray) -> None:
    """Raises GeometryFileError where the faces of a polyhedron do not end where its offset says.

    faces : (n,) of each polyhedron their number, and of each of them the number of its points and these
    ends  : (n_polyhedra,) where the faces of each polyhedron end
    """
    numbers, begin = faces.tolist(), 0
    for row, end in enumerate(ends.tolist()):
        at, left = begin + 1, numbers[begin] if 0 <= begin < len(numbers) else 0
        while left > 0 and at < len(numbers) and numbers[at] > 0:
            at, left = at + numbers[at] + 1, left - 1
        if left or at != end or end > len(numbers):
            words = f"the faces of polyhedron {row} (from 0) have more or fewer points than they announce"
            raise malformed("VTU", words)
        begin = end


SECTIONS = {b"Nodes": "node", b"Elements": "element"}
"""sections of a Gmsh file of version 2 that begin with their number of lines"""
DIGITS = 18
"""most of a number that is looked at: Python itself reads none of more than 4,300"""


def announced_in_vtu(path: Path) -> tuple[int, int]:
    """Numbers of points and of cells that all pieces of a VTU file announce."""
    pieces = re.findall(rb"<Piece\b[^>]*>", path.read_bytes())
    points, cells = (
        sum(_number(text, "VTU") for piece in pieces for text in re.findall(name + rb"\s*=\s*[\"'](-?\d+)", piece))
        for name in (b"NumberOfPoints", b"NumberOfCells")
    )
    return points, cells


def _number(text: bytes, words: str) -> int:
    """What a file announces; GeometryFileError where that has more digits than anything in a file could need."""
    if len(text) > DIGITS:
        raise malformed(words, f"it announces a number of {len(text)} digits")
    return int(text)


def refuse_other_count(words: str, noun: str, announced: int, read: int) -> None:
    """Raises GeometryFileError where not all was read that is announced."""
    if announced != read:
        raise malformed(words, f"it announces {counted(announced, noun)}, {read} can be read")


def refuse_other_sections(path: Path) -> None:
    """Raises GeometryFileError where a section of a Gmsh file of text, version 2, has other lines than it announces."""
    content = path.read_bytes()
    if not re.match(rb"\s*\$MeshFormat\s+2\S*\s+0\s", content):
        return
    for name, noun in SECTIONS.items():
        for section in re.findall(rb"^\$" + name + rb"\s*$(.*?)(?=^\$|\Z)", content, re.DOTALL | re.MULTILINE):
            number, *lines = [line for line in section.splitlines() if line.strip()] or [b""]
            if number.strip() != str(len(lines)).encode():
                raise malformed(
                    "Gmsh .msh",
                    f"it announces {number.strip().decode(errors='replace')[:20]} "
                    f"{noun}s and has {counted(len(lines), noun)}",
                )
