"""What a PLY, VTU or Gmsh file announces, held against what it has and what was read.

The library that reads them believes the smaller number without a word: blocks at the end of a file would be missing.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from mbla.model.geometry.geometry import GeometryFileError
from mbla.model.wording import counted

WIDTHS = {"char": 1, "short": 2, "int": 4, "float": 4, "double": 8, "uchar": 1, "ushort": 2, "uint": 4}
WIDTHS |= {f"{kind}{bits}": bits // 8 for kind in ("int", "uint", "float") for bits in (8, 16, 32, 64)}
"""bytes of the types of PLY"""
SECTIONS = {b"Nodes": "node", b"Elements": "element"}
"""sections of a Gmsh file of version 2 that begin with their number of lines"""
DIGITS = 18
"""most of a number that is looked at: Python itself reads none of more than 4,300"""


@dataclass(frozen=True)
class Counts:
    """Numbers of points and cells."""

    points: int
    cells: int


def counts_of(mesh: Any) -> Counts:
    """What meshio has read."""
    return Counts(len(mesh.points), sum(len(block.data) for block in mesh.cells))


def announced_in_ply(header: bytes) -> Counts:
    """What the header of a PLY file announces."""
    points, faces = (re.search(rb"element\s+" + name + rb"\s+(\d+)", header) for name in (b"vertex", b"face"))
    return Counts(*(_number(found[1], "PLY") if found else 0 for found in (points, faces)))


def announced_in_vtu(path: Path) -> Counts:
    """What all pieces of a VTU file announce."""
    pieces = re.findall(rb"<Piece\b[^>]*>", path.read_bytes())
    points, cells = (
        sum(_number(text, "VTU") for piece in pieces for text in re.findall(name + rb"\s*=\s*[\"'](-?\d+)", piece))
        for name in (b"NumberOfPoints", b"NumberOfCells")
    )
    return Counts(points, cells)


def _number(text: bytes, words: str) -> int:
    """What a file announces; GeometryFileError where that has more digits than anything in a file could need."""
    if len(text) > DIGITS:
        raise GeometryFileError(
            "geometry-file", f"is not a well-formed {words} file: it announces a number of {len(text)} digits"
        )
    return int(text)


def refuse_other_counts(words: str, announced: Counts, read: Counts) -> None:
    """GeometryFileError where not all was read that is announced."""
    for noun, one, other in (("point", announced.points, read.points), ("cell", announced.cells, read.cells)):
        if one != other:
            raise GeometryFileError(
                "geometry-file",
                f"is not a well-formed {words} file: it announces {counted(one, noun)}, {other} can be read",
            )


def refuse_other_lines(header: bytes, body: bytes) -> None:
    """GeometryFileError where a PLY file of text has other lines than its header announces, or other corners."""
    announced = announced_in_ply(header)
    first = header.count(b"\n") + 1
    lines = [(first + row, line.split()) for row, line in enumerate(body.split(b"\n")) if line.strip()]
    expected = announced.points + announced.cells
    if len(lines) != expected:
        raise GeometryFileError(
            "geometry-file",
            f"is not a well-formed PLY file: it announces {counted(announced.points, 'vertex')} and "
            f"{counted(announced.cells, 'face')}, a line each, and has {counted(len(lines), 'line')}",
        )
    if not re.search(rb"element\s+face\s+\d+\s+property\s+list", header):
        return  # where the corners stand in a line, the reader knows
    others = _properties(header, b"face").count(b"property") - 1
    for number, fields in lines[announced.points :]:
        corners = int(fields[0]) if fields[0].isdigit() and len(fields[0]) <= DIGITS else None
        if corners is None or len(fields) != corners + 1 + others:
            raise GeometryFileError(
                "geometry-file",
                f"is not a well-formed PLY file: line {number} announces {fields[0].decode(errors='replace')[:20]} "
                f"corners and has {len(fields) - 1 - others}",
            )


def refuse_too_short(header: bytes, body: bytes) -> None:
    """GeometryFileError where a binary PLY file cannot hold what its header announces, before room is made for it."""
    of_vertex, lists = _widths(header)
    announced = announced_in_ply(header)
    least = announced.points * of_vertex + announced.cells * sum(of_count for of_count, _ in lists)
    if least > len(body):
        raise GeometryFileError(
            "geometry-file",
            f"is not a well-formed PLY file: it announces {counted(announced.points, 'vertex')} and "
            f"{counted(announced.cells, 'face')}, which take more than the {_length(body)} bytes that it has",
        )


def refuse_other_length(header: bytes, body: bytes, mesh: Any) -> None:
    """GeometryFileError where a binary PLY file is longer or shorter than what was read of it."""
    of_vertex, lists = _widths(header)
    if len(lists) != 1:
        return
    ((of_count, of_corner),) = lists
    cells = counts_of(mesh).cells
    corners = sum(int(np.size(block.data)) for block in mesh.cells)
    length = len(mesh.points) * of_vertex + cells * of_count + corners * of_corner
    if _length(body) != length:
        raise GeometryFileError(
            "geometry-file",
            f"is not a well-formed PLY file: what its header announces takes {length} bytes, it has {_length(body)}",
        )


def _widths(header: bytes) -> tuple[int, list[tuple[int, int]]]:
    """Bytes of a vertex, and of the number and each corner of a face, of every list of its."""
    vertex, face = _properties(header, b"vertex"), _properties(header, b"face")
    widths = [WIDTHS.get(kind.decode(), 0) for kind in re.findall(rb"property\s+(?!list)(\S+)", vertex)]
    lists = re.findall(rb"property\s+list\s+(\S+)\s+(\S+)", face)
    return sum(widths), [(WIDTHS.get(count.decode(), 0), WIDTHS.get(corner.decode(), 0)) for count, corner in lists]


def _length(body: bytes) -> int:
    """Bytes after the line that ends the header."""
    return len(body) - 1 - body.startswith(b"\r\n")


def _properties(header: bytes, element: bytes) -> bytes:
    """The lines on the properties of an element."""
    found = re.search(rb"element\s+" + element + rb"\b[^\n]*\n(.*?)(?=element\s|\Z)", header, re.DOTALL)
    return found[1] if found else b""


def refuse_other_sections(path: Path) -> None:
    """GeometryFileError where a section of a Gmsh file of text, version 2, has other lines than it announces."""
    content = path.read_bytes()
    if not re.match(rb"\s*\$MeshFormat\s+2\S*\s+0\s", content):
        return
    for name, noun in SECTIONS.items():
        for section in re.findall(rb"^\$" + name + rb"\s*$(.*?)(?=^\$|\Z)", content, re.DOTALL | re.MULTILINE):
            number, *lines = [line for line in section.splitlines() if line.strip()] or [b""]
            if number.strip() != str(len(lines)).encode():
                raise GeometryFileError(
                    "geometry-file",
                    f"is not a well-formed Gmsh .msh file: it announces {number.strip().decode(errors='replace')[:20]} "
                    f"{noun}s and has {counted(len(lines), noun)}",
                )
