"""Geometry files of every format that announce more than they hold, unpack to more than fits, or lead elsewhere."""

from __future__ import annotations

import base64
import struct
import zlib
from pathlib import Path
from typing import Any

from tests.trust.hostile.case import Case, deck
from tests.trust.hostile.samples import MESHES, NAMED_DECK

MEGABYTE = 1024 * 1024


def mesh(name: str, extension: str, content: bytes | str, **files: bytes | str) -> Case:
    """A deck that names a hostile geometry file."""
    more = ", extrude: 1" if extension == "dxf" else ""
    text = NAMED_DECK.format(file=f"mesh.{extension}", more=more)
    written: dict[str, Any] = {f"mesh__{extension}": content, **files}
    return deck(f"{extension}: {name}", text, **written)


def _packed_vtu() -> bytes:
    """A file whose coordinates are zeros, 2 GB of them, packed into 2 MB."""
    block, count = 2**24, 128
    packed = zlib.compress(bytes(block), 9)
    header = struct.pack("<3I", count, block, 0) + struct.pack("<I", len(packed)) * count
    data = base64.b64encode(header) + base64.b64encode(packed * count)
    points = count * block // 24
    return (
        b'<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian" compressor="vtkZLibDataCompressor">'
        b'<UnstructuredGrid><Piece NumberOfPoints="%d" NumberOfCells="1"><Points>'
        b'<DataArray type="Float64" NumberOfComponents="3" format="binary">%s</DataArray></Points><Cells>'
        b'<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>'
        b'<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>'
        b'<DataArray type="Int64" Name="types" format="ascii">10</DataArray></Cells></Piece>'
        b"</UnstructuredGrid></VTKFile>" % (points, data)
    )


ENTITIES = (
    '<!DOCTYPE d [<!ENTITY a "0 0 0 0 0 0 0 0 0 0">'
    + "".join(f"<!ENTITY {b} '{f'&{a};' * 10}'>" for a, b in zip("abcdefghi", "bcdefghij", strict=True))
    + ']><VTKFile type="UnstructuredGrid" version="0.1">&j;</VTKFile>'
)
OUTSIDE = (
    '<!DOCTYPE d [<!ENTITY a SYSTEM "file:///etc/passwd">]><VTKFile type="UnstructuredGrid" version="0.1">&a;</VTKFile>'
)
NODE = "*NODE\n1, 0, 0, 0\n"
DOUBLED = NODE + "*ELEMENT, TYPE=C3D4\n1, 1, 1, 1, 1\n*ELSET, ELSET=a\n1\n" + "*ELSET, ELSET=a\na, a\n" * 200
PLY = "ply\nformat {} 1.0\nelement vertex {}\nproperty {} x\nproperty {} y\nproperty {} z\n{}end_header\n"
FACES = "element face 1000000000\nproperty list uchar int vertex_indices\n"


def _dxf(entities: str, blocks: str = "") -> str:
    sections = (("BLOCKS", blocks), ("ENTITIES", entities))
    return "".join(f"0\nSECTION\n2\n{name}\n{text}0\nENDSEC\n" for name, text in sections) + "0\nEOF\n"


def _insert(block: str, columns: int = 1, rows: int = 1) -> str:
    return f"0\nINSERT\n8\n0\n2\n{block}\n10\n0\n20\n0\n30\n0\n70\n{columns}\n71\n{rows}\n44\n2\n45\n2\n"


def _block(name: str, content: str) -> str:
    return f"0\nBLOCK\n8\n0\n2\n{name}\n70\n0\n10\n0\n20\n0\n30\n0\n3\n{name}\n1\n\n{content}0\nENDBLK\n8\n0\n"


SQUARE = "0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n10\n0\n20\n0\n10\n1\n20\n0\n10\n1\n20\n1\n10\n0\n20\n1\n"
LEVELS = "".join(_block(f"b{n}", _insert(f"b{n + 1}") * 10) for n in range(12)) + _block("b12", SQUARE)
LINES = "".join(
    f"0\nLINE\n8\n0\n10\n{x0}\n20\n{y0}\n30\n0\n11\n{x1}\n21\n{y1}\n31\n0\n"
    for n in range(1500)
    for x0, y0, x1, y1 in ((n, 0, n, 1500), (0, n, 1500, n))
)
"""3,000 lines enclose more than two million fields"""


def _of_blanks(extension: str, size: int) -> Case:
    def write(folder: Path) -> None:
        more = ", extrude: 1" if extension == "dxf" else ""
        (folder / "deck.yaml").write_text(NAMED_DECK.format(file=f"mesh.{extension}", more=more), encoding="utf-8")
        with (folder / f"mesh.{extension}").open("wb") as file:
            file.truncate(size)

    return Case(f"{extension}: {size:.0e} bytes of zeros", write)


def _nested(depth: int) -> str:
    return '{"a":' * depth + "1" + "}" * depth


CASES = [
    *(mesh("empty", extension, b"") for extension in MESHES),
    *(mesh("all bytes", extension, bytes(range(256)) * 40) for extension in MESHES),
    *(_of_blanks(extension, 2 * 1024**3) for extension in MESHES),
    mesh("a vertex of 5,000 digits", "obj", f"v 0 0 0\nf {'9' * 5000} 1 1\n"),
    mesh("a line of 10 MB", "obj", b"v 0 0 0\nf " + b"1 " * (5 * MEGABYTE)),
    mesh("3,000,000 continued lines", "obj", b"v 0 0 0 \\\n" * 300_000),
    mesh("10^12 triangles announced", "stl", bytes(80) + struct.pack("<I", 2**32 - 1) + bytes(50)),
    mesh("a solid without end", "stl", b"solid x\n" + b"vertex 0 0 0\n" * 100_000),
    mesh("10^12 vertices announced", "ply", PLY.format("ascii", 10**12, *["float"] * 3, FACES)),
    mesh("10^9 binary vertices announced", "ply", PLY.format("binary_little_endian", 10**9, *["double"] * 3, "")),
    mesh(
        "a list of 4 billion corners",
        "ply",
        PLY.format(
            "binary_little_endian", 0, *["float"] * 3, "element face 1\nproperty list uint int vertex_indices\n"
        ).encode()
        + b"\xff" * 8,
    ),
    mesh("2 GB of zeros packed", "vtu", _packed_vtu()),
    mesh("entities of entities", "vtu", ENTITIES),
    mesh("nested elements", "vtu", "<a>" * 200_000),
    mesh(
        "10^12 points announced",
        "vtu",
        MESHES["vtu"]
        .replace(b'NumberOfPoints="8"', b'NumberOfPoints="1000000000000"')
        .replace(b'NumberOfCells="1"', b'NumberOfCells="1000000000000"')
        .replace(b"ascii", b"appended"),
    ),
    mesh("a point tag of 10^10", "msh", MESHES["msh"].replace(b"\n8\n", b"\n9999999999\n")),
    mesh(
        "10^12 nodes announced",
        "msh",
        b"$MeshFormat\n4.1 1 8\n"
        + struct.pack("<i", 1)
        + b"\n$EndMeshFormat\n$Nodes\n"
        + struct.pack("<4Q", 1, 10**12, 1, 10**12)
        + struct.pack("<3iQ", 3, 1, 0, 10**12)
        + b"\n$EndNodes\n",
    ),
    mesh("an inclusion", "inp", "*INCLUDE, INPUT=/etc/passwd\n"),
    mesh("a set of 10^12 elements", "inp", NODE + "*ELSET, ELSET=a, GENERATE\n1, 1000000000000, 1\n"),
    mesh("a set that doubles itself 200 times", "inp", DOUBLED),
    mesh("nested JSON", "json", _nested(100_000)),
    mesh("an integer of 1,000,000 digits", "json", '{"vertex": {"0": {"x": ' + "9" * 1_000_000 + '}}, "face": {}}'),
    mesh(
        "an elements tree in a circle",
        "json",
        '{"elements": {"a": {}, "b": {}}, "tree": {"root": {"children": [{"element": "a", '
        '"children": [{"element": "b", "children": [{"element": "a"}]}]}]}}}',
    ),
    mesh("a block in itself", "dxf", _dxf(_insert("a"), _block("a", _insert("a") + SQUARE))),
    mesh("blocks of ten blocks, twelve levels", "dxf", _dxf(_insert("b0"), LEVELS)),
    mesh("a block inserted 10^9 times", "dxf", _dxf(_insert("a", 32000, 32000), _block("a", SQUARE))),
    mesh("3,000 lines that cross", "dxf", _dxf(LINES)),
]
"""All of them."""
