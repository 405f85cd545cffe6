"""Stones written as geometry files, faces as they come, right or wrong."""

from __future__ import annotations

import json
import struct
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from tests.trust.geometry.stones import Stone, triangles

Files = dict[str, bytes]
"""contents by name"""


@dataclass(frozen=True)
class Format:
    """A kind of file.

    item      : the deck's item that reads it
    write     : the files of stones; the first is the one that mutations of text fall upon
    shapes    : takes any faces; else a corner may be elsewhere, and no more
    polygons  : keeps faces of more than three corners
    apart     : keeps stones apart; else all are one surface
    by_number : corners go by numbers that may be wrong
    names     : a diagnosis can name the stone
    binary    : is no text
    flat      : an elevation; stones are prisms whose outline are their corners 4 to 7
    single    : numbers in single precision
    mended    : what can be mended without a guess is
    """

    name: str
    item: str
    write: Callable[[list[Stone]], Files]
    shapes: bool = True
    polygons: bool = True
    apart: bool = True
    by_number: bool = True
    binary: bool = False
    flat: bool = False
    single: bool = False
    mended: bool = True


def _text(lines: list[str]) -> bytes:
    return ("\n".join(lines) + "\n").encode()


def _number(value: float) -> str:
    return f"{value:.15g}"


def _point(place: FloatArray) -> str:
    return " ".join(_number(value) for value in place)


def _one_surface(stones: list[Stone]) -> tuple[FloatArray, list[list[int]]]:
    """All corners and all faces over them."""
    first = np.cumsum([0, *(len(stone.corners) for stone in stones)])
    faces = [[corner + int(first[n]) for corner in face] for n, stone in enumerate(stones) for face in stone.faces]
    return np.concatenate([stone.corners for stone in stones]), faces


def _split(stones: list[Stone]) -> list[Stone]:
    return [Stone(stone.name, stone.corners, triangles(stone)) for stone in stones]


def obj(stones: list[Stone]) -> Files:
    """Objects, corners counted from the first of the file."""
    lines, before = ["# stones"], 1
    for stone in stones:
        lines += [f"o {stone.name}", *(f"v {_point(place)}" for place in stone.corners)]
        lines += ["f " + " ".join(str(corner + before) for corner in face) for face in stone.faces]
        before += len(stone.corners)
    return {"stones.obj": _text(lines)}


def stl_text(stones: list[Stone]) -> Files:
    """Named solids of triangles."""
    lines = []
    for stone in stones:
        lines.append(f"solid {stone.name}")
        for triangle in triangles(stone):
            places = [f"vertex {_point(stone.corners[corner])}" for corner in triangle]
            lines += ["facet normal 0 0 0", "outer loop", *places, "endloop", "endfacet"]
        lines.append(f"endsolid {stone.name}")
    return {"stones.stl": _text(lines)}


def stl_binary(stones: list[Stone]) -> Files:
    """One soup of triangles in single precision."""
    corners = [stone.corners[list(triangle)] for stone in stones for triangle in triangles(stone)]
    with np.errstate(over="ignore"):  # 1e308 is infinite in single precision
        records = [np.concatenate([np.zeros(3), each.ravel()]).astype("<f4").tobytes() + b"\0\0" for each in corners]
    return {"stones.stl": b"stones".ljust(80) + struct.pack("<I", len(records)) + b"".join(records)}


def _ply_header(kind: str, corners: int, faces: int) -> list[str]:
    places = [f"property double {axis}" for axis in "xyz"]
    listed = [f"element face {faces}", "property list uint int vertex_indices", "end_header"]
    return ["ply", f"format {kind} 1.0", f"element vertex {corners}", *places, *listed]


def ply_text(stones: list[Stone]) -> Files:
    """One surface."""
    corners, faces = _one_surface(stones)
    lines = [_point(place) for place in corners]
    lines += [" ".join(map(str, (len(face), *face))) for face in faces]
    return {"stones.ply": _text([*_ply_header("ascii", len(corners), len(faces)), *lines])}


def ply_binary(stones: list[Stone]) -> Files:
    """One surface."""
    corners, faces = _one_surface(stones)
    body = corners.astype("<f8").tobytes() + b"".join(struct.pack(f"<I{len(f)}i", len(f), *f) for f in faces)
    return {"stones.ply": _text(_ply_header("binary_little_endian", len(corners), len(faces))) + body}


def _vtu(points: FloatArray, rows: list[list[int]], kind: int) -> Files:
    ends = np.cumsum([len(row) for row in rows])
    arrays = {
        "connectivity": " ".join(str(each) for row in rows for each in row),
        "offsets": " ".join(map(str, ends)),
        "types": " ".join([str(kind)] * len(rows)),
    }
    cells = [f'<DataArray type="Int64" Name="{n}" format="ascii">\n{t}\n</DataArray>' for n, t in arrays.items()]
    lines = [
        '<?xml version="1.0"?>',
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>',
        f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(rows)}">',
        '<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">',
        *(_point(place) for place in points),
        "</DataArray></Points>",
        *("<Cells>", *cells, "</Cells>"),
        "</Piece></UnstructuredGrid></VTKFile>",
    ]
    return {"stones.vtu": _text(lines)}


def vtu_surface(stones: list[Stone]) -> Files:
    """Polygons of one surface."""
    return _vtu(*_one_surface(stones), kind=7)


def vtu_cells(stones: list[Stone]) -> Files:
    """A hexahedron for each stone."""
    corners = np.concatenate([stone.corners for stone in stones])
    return _vtu(corners, np.arange(len(corners)).reshape(-1, 8).tolist(), kind=12)


def _msh(points: FloatArray, rows: list[list[int]], owners: list[int], names: list[str], kind: int) -> Files:
    dimension = {2: 2, 3: 2, 5: 3}[kind]
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dimension} {n + 1} "{name}"' for n, name in enumerate(names)]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{row + 1} {_point(place)}" for row, place in enumerate(points)]
    lines += ["$EndNodes", "$Elements", str(len(rows))]
    for number, (row, owner) in enumerate(zip(rows, owners, strict=True)):
        lines.append(f"{number + 1} {kind} 2 {owner + 1} {owner + 1} {' '.join(str(each + 1) for each in row)}")
    return {"stones.msh": _text([*lines, "$EndElements"])}


def msh_surface(stones: list[Stone]) -> Files:
    """Triangles, a physical group for each stone."""
    points, rows = _one_surface(_split(stones))
    owners = [n for n, stone in enumerate(_split(stones)) for _ in stone.faces]
    return _msh(points, rows, owners, [stone.name for stone in stones], kind=2)


def msh_cells(stones: list[Stone]) -> Files:
    """A hexahedron for each stone."""
    corners = np.concatenate([stone.corners for stone in stones])
    rows = np.arange(len(corners)).reshape(-1, 8).tolist()
    return _msh(corners, rows, list(range(len(stones))), [stone.name for stone in stones], kind=5)


def _inp(points: FloatArray, cards: list[str]) -> Files:
    nodes = [f"{row + 1}, {', '.join(_number(value) for value in place)}" for row, place in enumerate(points)]
    return {"stones.inp": _text(["** stones", "*NODE, NSET=Nall", *nodes, *cards])}


def inp_surface(stones: list[Stone]) -> Files:
    """Shells of three nodes, an element set for each stone."""
    split = _split(stones)
    points, rows = _one_surface(split)
    cards, number = [], 0
    for n, stone in enumerate(split):
        cards.append(f"*ELEMENT, TYPE=S3, ELSET=V{n}")
        for _ in stone.faces:
            cards.append(f"{number + 1}, {', '.join(str(each + 1) for each in rows[number])}")
            number += 1
    return _inp(points, cards)


def inp_cells(stones: list[Stone]) -> Files:
    """A brick for each stone."""
    cards = []
    for n in range(len(stones)):
        row = ", ".join(str(8 * n + corner + 1) for corner in range(8))
        cards += [f"*ELEMENT, TYPE=C3D8, ELSET=V{n}", f"{n + 1}, {row}"]
    return _inp(np.concatenate([stone.corners for stone in stones]), cards)


def compas(stones: list[Stone]) -> Files:
    """A list of meshes as COMPAS 2 writes them."""
    meshes = []
    for stone in stones:
        vertices = {str(n): dict(zip("xyz", place, strict=True)) for n, place in enumerate(stone.corners.tolist())}
        faces = {str(n): list(face) for n, face in enumerate(stone.faces)}
        mesh = {"attributes": {"name": stone.name}, "vertex": vertices, "face": faces}
        meshes.append({"dtype": "compas.datastructures/Mesh", "data": mesh})
    return {"stones.json": (json.dumps(meshes, indent=1) + "\n").encode()}


def dxf(stones: list[Stone]) -> Files:
    """A closed polyline for each stone, on a layer of its own."""
    tags: list[tuple[int, object]] = [(0, "SECTION"), (2, "ENTITIES")]
    for number, stone in enumerate(stones):
        layer = (8, f"V{number}")
        tags += [(0, "POLYLINE"), layer, (66, 1), (10, 0.0), (20, 0.0), (30, 0.0), (70, 1)]
        for x, _, z in stone.corners[4:]:
            tags += [(0, "VERTEX"), layer, (10, _number(x)), (20, _number(z)), (30, 0.0)]
        tags += [(0, "SEQEND"), layer]
    tags += [(0, "ENDSEC"), (0, "EOF")]
    return {"stones.dxf": "".join(f"{code:3d}\n{value}\n" for code, value in tags).encode()}


def _vertices_table(stones: list[Stone]) -> bytes:
    lines = ["block,vertex,x,y,z"]
    for n, stone in enumerate(stones):
        lines += [f"V{n},{row},{','.join(_number(value) for value in at)}" for row, at in enumerate(stone.corners)]
    return _text(lines)


def _faces_table(stones: list[Stone]) -> bytes:
    lines = ["block,face,v1,v2,v3,v4"]
    for n, stone in enumerate(stones):
        lines += [f"V{n},{row},{','.join(map(str, face))}" for row, face in enumerate(stone.faces)]
    return _text(lines)


def vertices_first(stones: list[Stone]) -> Files:
    """Tables of text; what is done to the text falls on the vertices."""
    return {"vertices.csv": _vertices_table(stones), "faces.csv": _faces_table(stones)}


def faces_first(stones: list[Stone]) -> Files:
    """Tables of text; what is done to the text falls on the faces."""
    return {"faces.csv": _faces_table(stones), "vertices.csv": _vertices_table(stones)}


def _mesh(name: str, *more: str) -> str:
    return "mesh: {" + ", ".join(["material: stone", f"file: stones.{name}", *more]) + "}"


TABLE = "table: {material: stone, vertices: vertices.csv, faces: faces.csv}"
FORMATS = {
    each.name: each
    for each in (
        Format("obj", _mesh("obj"), obj),
        Format("stl", _mesh("stl"), stl_text, polygons=False, by_number=False),
        Format(
            "stl binary",
            _mesh("stl"),
            stl_binary,
            polygons=False,
            apart=False,
            by_number=False,
            binary=True,
            single=True,
        ),
        Format("ply", _mesh("ply"), ply_text, apart=False),
        Format("ply binary", _mesh("ply"), ply_binary, apart=False, binary=True),
        Format("vtu", _mesh("vtu"), vtu_surface, apart=False),
        Format("vtu cells", _mesh("vtu"), vtu_cells, shapes=False),
        Format("msh", _mesh("msh"), msh_surface, polygons=False),
        Format("msh cells", _mesh("msh"), msh_cells, shapes=False),
        Format("inp", _mesh("inp"), inp_surface, polygons=False),
        Format("inp cells", _mesh("inp"), inp_cells, shapes=False),
        Format("compas", _mesh("json"), compas),
        Format("dxf", _mesh("dxf", "extrude: 1", "units: m"), dxf, shapes=False, by_number=False, flat=True),
        Format("table of vertices", TABLE, vertices_first, mended=False),
        Format("table of faces", TABLE, faces_first, mended=False),
    )
}
