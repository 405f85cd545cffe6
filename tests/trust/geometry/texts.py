"""What is done to a file once it is written."""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from tests.trust.geometry.formats import Files, Format
from tests.trust.geometry.shapes import EITHER, REFUSED, SAME, TOLD, Expect, Generator
from tests.trust.geometry.stones import Stone

Damage = Callable[[bytes, Generator], bytes]

CHECKED = ("obj", "stl", "ply", "vtu", "vtu cells", "msh", "compas", "gltf", "table of vertices", "table of faces")
"""formats in which a line less or more is noticed; an element less of a CalculiX file is not"""


def text(kind: Format) -> bool:
    """Formats that are text."""
    return not kind.binary


def anything(_: Format) -> bool:
    """Every format."""
    return True


def checked(kind: Format) -> bool:
    """Formats that notice a line less or more."""
    return kind.name in CHECKED


@dataclass(frozen=True)
class TextFault:
    """One thing that is done to the first file of stones; ``times`` it is done, each with another seed."""

    name: str
    damage: Damage
    expect: Expect
    suits: Callable[[Format], bool] = text
    times: int = 1
    told: frozenset[str] = frozenset()


def _as(change: Callable[[bytes], bytes]) -> Damage:
    """The same for every seed."""
    return lambda content, random: change(content)


def cut(content: bytes, random: Generator) -> bytes:
    return content[: int(random.uniform(0.02, 0.97) * len(content))]


def cut_short(content: bytes, random: Generator) -> bytes:
    """The last figures are missing."""
    return content.rstrip()[: -int(random.integers(2, 12))]


def cut_at_the_start(content: bytes, random: Generator) -> bytes:
    return content[int(random.uniform(0.05, 0.9) * len(content)) :]


def _line_ends(*kinds: bytes) -> Damage:
    """Each line with one of these at its end."""

    def damage(content: bytes, random: Generator) -> bytes:
        lines = content.split(b"\n")
        ends = [kinds[int(random.integers(len(kinds)))] for _ in lines]
        return b"".join(line + end for line, end in zip(lines, ends, strict=True))

    return damage


def _amid(more: bytes) -> Damage:
    """Some bytes more."""

    def damage(content: bytes, random: Generator) -> bytes:
        at = int(random.integers(len(content)))
        return content[:at] + more + content[at:]

    return damage


def line_missing(content: bytes, random: Generator) -> bytes:
    lines = content.split(b"\n")
    del lines[int(random.integers(len(lines) - 1))]
    return b"\n".join(lines)


def line_twice(content: bytes, random: Generator) -> bytes:
    lines = content.split(b"\n")
    row = int(random.integers(len(lines) - 1))
    return b"\n".join([*lines[: row + 1], *lines[row:]])


def rubbish_at_the_end(content: bytes, random: Generator) -> bytes:
    return content + bytes(random.integers(0, 256, 100, dtype=np.uint8))


def random_bytes(content: bytes, random: Generator) -> bytes:
    return bytes(random.integers(0, 256, len(content), dtype=np.uint8))


UNUSED = frozenset({"file-vertices-unused"})

TEXT_FAULTS = (
    TextFault("empty file", _as(lambda _: b""), REFUSED, anything),
    TextFault("blank file", _as(lambda _: b" \n\t\n\n"), REFUSED, anything),
    TextFault("first line only", _as(lambda content: content.split(b"\n")[0] + b"\n"), REFUSED, anything),
    TextFault("random bytes", random_bytes, REFUSED, anything),
    TextFault("cut off", cut, TOLD, anything, times=4, told=UNUSED),
    TextFault("last figures missing", cut_short, EITHER, anything),
    TextFault("begins in the middle", cut_at_the_start, REFUSED, anything),
    TextFault("line ends of Windows", _as(lambda content: content.replace(b"\n", b"\r\n")), SAME),
    TextFault("mixed line ends", _line_ends(b"\n", b"\r\n"), SAME),
    TextFault("line ends of old Macs", _as(lambda content: content.replace(b"\n", b"\r")), EITHER),
    TextFault("line ends of three kinds", _line_ends(b"\n", b"\r\n", b"\r"), EITHER),
    TextFault("byte order mark", _as(lambda content: b"\xef\xbb\xbf" + content), EITHER),
    TextFault("UTF-16", _as(lambda content: content.decode("latin-1").encode("utf-16")), EITHER),
    TextFault("NUL amid the text", _amid(b"\0"), EITHER),
    TextFault("bytes that are no UTF-8", _amid(b"\xff\xfe"), EITHER),
    TextFault("line missing", line_missing, EITHER, checked, times=4),
    TextFault("line twice", line_twice, EITHER, checked, times=4),
    TextFault("rubbish at the end", rubbish_at_the_end, EITHER, anything),
)


# --- one number of a file ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class NumberFault:
    """Another text in place of one number of the file: a coordinate, or the number of a corner.

    spelt : the text, with {} where the number was
    """

    spelt: str
    expect: Expect


COORDINATES = (
    *(
        NumberFault(words, REFUSED)
        for words in ("one", "--1", "{}e999", "-{}E+400", "1.2.3", "{},5", "{}m", "0x1p3", "nan", "-inf", "1e308")
    ),
    *(
        NumberFault(words, EITHER)
        for words in ("+{}", "{}e", "{}e0", "{}E+00", "{}d0", "00{}", "", '"{}"', "true", "null", "[{}]")
    ),
)
CORNERS = (
    *(NumberFault(words, REFUSED) for words in ("corner", "{}.5", "{}e40", "99999999", "9" * 25, "-99999", "1e999")),
    *(NumberFault(words, EITHER) for words in ("{}.0", "+{}", "0{}", "", "-0", '"{}"', "true", "null", "{}_0", "-1")),
)


def with_number(files: Files, marked: Files, fault: NumberFault) -> Files | None:
    """The files with another text where the first of them differs from the one with a mark; None where none does.

    marked : the same files, one number of the first being another
    """
    name = next(iter(files))
    token = re.compile(rb"[-+.\w]+")
    for one, other in zip(token.finditer(files[name]), token.finditer(marked[name]), strict=True):
        if one[0] != other[0]:
            spelt = fault.spelt.replace("{}", one[0].decode()).encode()
            return {**files, name: files[name][: one.start()] + spelt + files[name][one.end() :]}
    return None


def mark_coordinate(stones: list[Stone], random: Generator) -> list[Stone]:
    """A coordinate elsewhere, of a corner with a height and a distance along the arch that are not zero."""
    row, corner = int(random.integers(1, len(stones) - 1)), int(random.integers(4, 8))
    x, y, z = stones[row].corners[corner]
    return [stone.with_corner(corner, (x + 0.25, y, z)) if n == row else stone for n, stone in enumerate(stones)]


def mark_corner(stones: list[Stone], random: Generator) -> list[Stone]:
    """The first corner of a face another one; the first, as all triangles of the face have it."""
    row, face = int(random.integers(1, len(stones) - 1)), int(random.integers(6))
    other = next(corner for corner in range(8) if corner not in stones[row].faces[face])
    instead = (other, *stones[row].faces[face][1:])
    return [stone.with_face(face, instead) if n == row else stone for n, stone in enumerate(stones)]


# --- numbers of one format --------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class FormatFault:
    """What is replaced in the first file of one format: all matches of a pattern, or the first ``count``."""

    kind: str
    name: str
    pattern: bytes
    instead: bytes
    expect: Expect = REFUSED
    told: frozenset[str] = frozenset()
    count: int = 1


LEFT_OUT = frozenset({"mesh-cells-left-out"})
OPEN_LINES = frozenset({"drawing-lines-left-out"})


def _counts(kind: str, what: str, before: bytes, number: int, others: tuple[int, ...]) -> list[FormatFault]:
    """Counts that lie."""
    pattern = re.escape(before) + str(number).encode() + rb"\b"
    return [FormatFault(kind, f"{what} {each}, not {number}", pattern, before + str(each).encode()) for each in others]


FORMAT_FAULTS = (
    *_counts("ply", "faces", b"element face ", 54, (0, 1, 48, 53, 55, 10**12)),
    *_counts("ply binary", "faces", b"element face ", 54, (0, 1, 48, 53, 55, 10**12)),
    *_counts("ply", "corners", b"element vertex ", 72, (0, 64, 71, 73, 10**12)),
    *_counts("ply binary", "corners", b"element vertex ", 72, (0, 64, 71, 73, 10**12)),
    FormatFault("ply", "a count of faces below zero", rb"face 54", b"face -54"),
    FormatFault("ply", "no count of faces", rb"face 54", b"face"),
    FormatFault("ply", "another type of coordinates", rb"double z", b"int z"),
    FormatFault("ply", "a coordinate in whole bytes", rb"double x", b"uchar x"),
    FormatFault("ply", "coordinates under other names", rb"double x", b"double a"),
    FormatFault("ply", "coordinates in another order", rb"double x\nproperty double y", b"double y\nproperty double x"),
    FormatFault("ply", "an unknown type", rb"double x", b"quad x"),
    FormatFault("ply", "an unknown encoding", rb"ascii", b"ebcdic"),
    FormatFault("ply binary", "the other order of bytes", rb"little", b"big"),
    FormatFault("ply binary", "coordinates in single precision", rb"double", b"float", count=3),
    FormatFault("ply", "a face that announces more corners", rb"\n4 0 3 2 1\n", b"\n5 0 3 2 1\n"),
    FormatFault("ply", "a face that announces fewer corners", rb"\n4 0 3 2 1\n", b"\n3 0 3 2 1\n"),
    FormatFault("ply", "a face that announces no corners", rb"\n4 0 3 2 1\n", b"\n0 0 3 2 1\n"),
    FormatFault("ply", "a face that announces corners below zero", rb"\n4 0 3 2 1\n", b"\n-4 0 3 2 1\n"),
    FormatFault("ply", "a header without end", rb"end_header", b"end_haeder"),
    *_counts("vtu cells", "points", b'NumberOfPoints="', 72, (0, 71, 73, -1)),
    *_counts("vtu cells", "cells", b'NumberOfCells="', 9, (0, 8, 10, -1)),
    *_counts("vtu", "cells", b'NumberOfCells="', 54, (0, 48, 55, 10**12)),
    FormatFault("vtu cells", "cells of an unknown type", rb"\b12 12\b", b"12 99", EITHER),
    FormatFault("vtu cells", "cells of another type", rb"\b12 12\b", b"12 10", EITHER),
    FormatFault("vtu cells", "a cell type below zero", rb"\b12 12\b", b"12 -12"),
    FormatFault("vtu cells", "a type less", rb"\b12 12\b", b"12"),
    FormatFault("vtu cells", "ends that go back", rb"\b16 24\b", b"24 16", EITHER),
    FormatFault(
        "vtu cells",
        "an end beyond the corners",
        rb"\b72\n</DataArray>\n<DataArray type=\"Int64\" Name=\"ty",
        b'80\n</DataArray>\n<DataArray type="Int64" Name="ty',
    ),
    FormatFault("vtu cells", "an end less", rb"\b16 24\b", b"24"),
    FormatFault("vtu", "ends that go back", rb"\b8 12\b", b"12 8"),
    FormatFault("vtu", "an end below zero", rb"\b8 12\b", b"-8 12"),
    FormatFault("vtu", "two components", rb'NumberOfComponents="3"', b'NumberOfComponents="2"'),
    FormatFault("vtu", "no components", rb'NumberOfComponents="3"', b'NumberOfComponents="0"'),
    FormatFault("vtu", "points in whole numbers", rb'Float64"', b'Int8"'),
    FormatFault("vtu", "an unknown type of numbers", rb'Float64"', b'Float65"'),
    FormatFault("vtu", "points said to be binary", rb'3" format="ascii"', b'3" format="binary"'),
    FormatFault("vtu", "points said to be appended", rb'3" format="ascii"', b'3" format="appended"'),
    FormatFault("vtu", "another kind of grid", rb"UnstructuredGrid", b"PolyData", count=3),
    FormatFault("vtu", "no points", rb"Points>", b"Pints>", count=2),
    FormatFault("vtu", "no cells", rb"Cells>", b"Sells>", count=2),
    *_counts("msh cells", "nodes", b"$Nodes\n", 72, (0, 64, 71, 73, -1, 10**12)),
    *_counts("msh cells", "elements", b"$Elements\n", 9, (0, 8, 10, -1, 10**12)),
    *_counts("msh", "elements", b"$Elements\n", 108, (0, 96, 107, 109)),
    FormatFault("msh cells", "a node's number twice", rb"\n72 ", b"\n71 "),
    FormatFault("msh cells", "a node's number of another", rb"\n72 ", b"\n99 "),
    FormatFault("msh cells", "a node's number zero", rb"\n1 0 1 0", b"\n0 0 1 0"),
    FormatFault("msh cells", "an unknown element", rb"\n9 5 2 9", b"\n9 55 2 9", EITHER),
    FormatFault("msh cells", "an element of another kind", rb"\n9 5 2 9", b"\n9 4 2 9", EITHER),
    FormatFault("msh cells", "more tags than there are", rb"\n9 5 2 9", b"\n9 5 3 9", EITHER),
    FormatFault("msh cells", "a version of the future", rb"2\.2 0 8", b"9.9 0 8"),
    FormatFault("msh cells", "said to be binary", rb"2\.2 0 8", b"2.2 1 8"),
    FormatFault("msh cells", "nodes without an end", rb"\$EndNodes\n", b""),
    FormatFault("msh cells", "elements without an end", rb"\$EndElements\n", b"", EITHER),
    FormatFault("inp cells", "a node twice at two places", rb"\n72, ", b"\n71, "),
    FormatFault("inp cells", "an element twice", rb"\n9, 65", b"\n8, 65"),
    FormatFault("inp cells", "an element of a node more", rb"\n9, 65", b"\n9, 1, 65"),
    FormatFault("inp cells", "an element of a node less", rb"\n9, 65", b"\n9"),
    FormatFault("inp cells", "an element of another type", rb"C3D8", b"C3D4"),
    FormatFault(
        "inp cells", "an element of an unknown type", rb"C3D8, ELSET=V3", b"C3DX, ELSET=V3", TOLD, told=LEFT_OUT
    ),
    FormatFault("inp cells", "elements without a type", rb"TYPE=C3D8, ELSET=V3", b"ELSET=V3", TOLD, told=LEFT_OUT),
    FormatFault("inp cells", "a node without its heights", rb"\n72, ([^,]*), [^\n]*", rb"\n72, \1"),
    FormatFault("inp cells", "no nodes", rb"\*NODE", b"**NODE"),
    FormatFault(
        "inp cells", "a misspelt card of elements", rb"\*ELEMENT, TYPE=C3D8, ELSET=V3", b"*ELEMNET, TYPE=C3D8, ELSET=V3"
    ),
    FormatFault("obj", "a misspelt vertex", rb"\nv 0 ", b"\nV 0 "),
    FormatFault("obj", "a misspelt face", rb"\nf ", b"\nF "),
    FormatFault("obj", "an unknown keyword", rb"\nf ", b"\nface "),
    FormatFault("obj", "corner zero", rb"\nf 1 ", b"\nf 0 "),
    FormatFault("obj", "corners with slashes and nothing between", rb"\nf 1 ", b"\nf /1 "),
    FormatFault("obj", "corners with a normal that does not exist", rb"\nf 1 ", b"\nf 1//99 ", EITHER),
    FormatFault("obj", "a vertex of two numbers", rb"\nv [^ ]+ ", b"\nv "),
    FormatFault("obj", "a backslash at the end of a line", rb"voussoir 0\n", b"voussoir 0 \\\\\n"),
    FormatFault("stl", "a misspelt vertex", rb"\nvertex ", b"\nvertx "),
    FormatFault("stl", "a facet of four corners", rb"(\nvertex [^\n]*)", rb"\1\1"),
    FormatFault("stl", "solids without an end", rb"endsolid [^\n]*\n", b"", EITHER, count=0),
    FormatFault("stl", "a first solid without its keyword", rb"^solid ", b"solidly "),
    FormatFault("gltf", "a count below zero", rb'"count": 8', b'"count": -8'),
    FormatFault("gltf", "a count of a thousand million", rb'"count": 8', b'"count": 1000000000'),
    FormatFault("gltf", "a count as a text", rb'"count": 8', b'"count": "8"'),
    FormatFault("gltf", "a count that is not whole", rb'"count": 36', b'"count": 36.5'),
    FormatFault("gltf", "a corner less", rb'"count": 36', b'"count": 35'),
    FormatFault("gltf", "a triangle less", rb'"count": 36', b'"count": 33'),
    FormatFault("gltf", "places fewer than corners name", rb'"count": 8', b'"count": 7'),
    FormatFault("gltf", "corners in bytes with a sign", rb'"componentType": 5125', b'"componentType": 5120', EITHER),
    FormatFault("gltf", "corners as fractions", rb'"componentType": 5125', b'"componentType": 5126'),
    FormatFault("gltf", "an unknown kind of numbers", rb'"componentType": 5125', b'"componentType": 5127'),
    FormatFault("gltf", "places of two coordinates", rb'"VEC3"', b'"VEC2"'),
    FormatFault("gltf", "a view below zero", rb'"bufferView": 0', b'"bufferView": -1'),
    FormatFault("gltf", "a view that does not exist", rb'"bufferView": 0', b'"bufferView": 99'),
    FormatFault("gltf", "places without a view", rb'"bufferView": 0,', b""),
    FormatFault(
        "gltf",
        "thousands of millions of places without a view",
        rb'"bufferView": 0,([^}]*)"count": 8',
        rb'\1"count": 2147483647',
    ),
    FormatFault("gltf", "a mesh below zero", rb'"mesh": 0', b'"mesh": -1'),
    FormatFault("gltf", "the mesh of another node", rb'"mesh": 0', b'"mesh": 1'),
    FormatFault("gltf", "places below zero", rb'"POSITION": 0', b'"POSITION": -2'),
    FormatFault("gltf", "indices below zero", rb'"indices": 1\b', b'"indices": -1'),
    FormatFault("gltf", "indices and places exchanged", rb'"POSITION": 0', b'"POSITION": 1'),
    FormatFault("gltf", "an offset below zero", rb'"byteOffset": 240', b'"byteOffset": -240'),
    FormatFault("gltf", "an offset beyond the end", rb'"byteOffset": 240', b'"byteOffset": 99999999'),
    FormatFault("gltf", "an offset that is shifted", rb'"byteOffset": 240', b'"byteOffset": 241'),
    FormatFault("gltf", "a buffer that does not exist", rb"stones\.bin", b"other.bin"),
    FormatFault("gltf", "a buffer elsewhere", rb"stones\.bin", b"../stones.bin"),
    FormatFault("gltf", "a node that does not exist", rb'"nodes": \[\s+0', b'"nodes": [99'),
    FormatFault("gltf", "a node in itself", rb'"mesh": 0', b'"mesh": 0, "children": [0]'),
    FormatFault("gltf", "a node in two places", rb'"mesh": 0', b'"mesh": 0, "children": [1]'),
    FormatFault("gltf", "a turn by nothing", rb'"mesh": 0', b'"mesh": 0, "rotation": [0, 0, 0, 0]'),
    FormatFault("gltf", "a turn by what is no number", rb'"mesh": 0', b'"mesh": 0, "rotation": [NaN, 0, 0, 1]'),
    FormatFault("gltf", "a size of zero", rb'"mesh": 0', b'"mesh": 0, "scale": [0, 1, 1]'),
    FormatFault("gltf", "a size of 1e308", rb'"mesh": 0', b'"mesh": 0, "scale": [1e308, 1e308, 1e308]'),
    FormatFault("gltf", "a matrix of nine numbers", rb'"mesh": 0', b'"mesh": 0, "matrix": [1, 0, 0, 0, 1, 0, 0, 0, 1]'),
    FormatFault("gltf", "a shift of two numbers", rb'"mesh": 0', b'"mesh": 0, "translation": [0, 0]'),
    FormatFault("gltf", "a shift of one number", rb'"mesh": 0', b'"mesh": 0, "translation": 5'),
    FormatFault("gltf", "a key twice", rb'"mesh": 0', b'"mesh": 0, "mesh": 1'),
    FormatFault(
        "gltf", "lines in place of triangles", rb'"indices": 1\b', b'"indices": 1, "mode": 1', TOLD, told=LEFT_OUT
    ),
    FormatFault("gltf", "a strip in place of triangles", rb'"indices": 1\b', b'"indices": 1, "mode": 5'),
    FormatFault("gltf", "version 1", rb'"version": "2.0"', b'"version": "1.0"'),
    FormatFault("compas", "a coordinate less", rb'"x": 0\.12061475842818314,', b""),
    FormatFault("compas", "a corner's key twice", rb'"7": \{', b'"6": {'),
    FormatFault("compas", "a face's key twice", rb'"5": \[', b'"4": ['),
    FormatFault("compas", "faces that are no list", rb'"0": \[\s+0,\s+3,\s+2,\s+1\s+\]', b'"0": "0321"', EITHER),
    FormatFault("compas", "no faces", rb'"face"', b'"fase"', TOLD, told=frozenset({"objects-empty"})),
    FormatFault("compas", "no corners", rb'"vertex"', b'"vortex"', TOLD, told=frozenset({"objects-empty"})),
    FormatFault("dxf", "an outline that is open", rb"\n 70\n1\n", b"\n 70\n0\n", TOLD, told=OPEN_LINES),
    FormatFault("dxf", "an outline out of the plane", rb"\n 30\n0\.0\n  0\nSEQEND", b"\n 30\n5.0\n  0\nSEQEND", EITHER),
    FormatFault("dxf", "a group code that is no number", rb"\n 10\n", b"\n ten\n"),
    FormatFault("dxf", "a line of a tag less", rb"\n 10\n", b"\n"),
    FormatFault("dxf", "no end of the file", rb"  0\nEOF\n", b""),
    FormatFault("dxf", "no end of an outline", rb"  0\nSEQEND\n", b""),
    FormatFault("dxf", "another kind of entity", rb"POLYLINE", b"POLYLYNE", TOLD, told=LEFT_OUT),
    FormatFault("table of vertices", "a column less", rb",z\n", b"\n"),
    FormatFault("table of vertices", "a column of another name", rb",z\n", b",w\n"),
    FormatFault("table of vertices", "columns in another order", rb",x,y,z\n", b",z,y,x\n", EITHER),
    FormatFault("table of vertices", "a block of another name", rb"\nV3,3,", b"\nV99,3,"),
    FormatFault("table of faces", "a block of another name", rb"\nV3,3,", b"\nV99,3,"),
    FormatFault("table of faces", "a corner of another name", rb"\nV3,0,0,", b"\nV3,0,zero,"),
    FormatFault("table of faces", "a quote that does not end", rb"\nV3,0,0,", b'\nV3,0,"0,'),
)


def replaced(files: Files, fault: FormatFault) -> Files:
    """The files with the fault in the first of them; AssertionError where the pattern is not found."""
    name = next(iter(files))
    content, times = re.subn(fault.pattern, fault.instead, files[name], count=fault.count)
    assert times, f"{fault.kind}: {fault.name}: nothing to replace"
    return {**files, name: content}


def set_stl_count(content: bytes, count: int) -> bytes:
    """A binary STL file that announces another number of triangles."""
    return content[:80] + count.to_bytes(4, "little") + content[84:]
