"""One arch as files of every kind that is read; ``python -m tests.decks.arch_files`` writes them again.

Nine voussoirs, those of the item ``arch`` of ``decks/benchmarks/formats/arch_from_generator.yaml``. Each file has
what is usual in files of its kind: other units and axes, triangles, transforms, vertices that faces do not share.
"""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Callable, Iterator

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import HEXAHEDRON
from tests.decks.folder import DECKS

FOLDER = DECKS / "benchmarks" / "formats" / "data"
SPAN, THICKNESS, WIDTH, VOUSSOIRS = 4.0, 0.6, 1.0, 9
REMARK = "Arch of nine voussoirs. Generated: tests/decks/arch_files.py"
TRIANGLES = [triangle for a, b, c, d in HEXAHEDRON for triangle in ((a, b, c), (a, c, d))]
TETRAHEDRA = ((0, 1, 3, 4), (1, 2, 3, 6), (1, 5, 6, 4), (3, 4, 6, 7), (1, 3, 4, 6))
"""of the corners of a hexahedron: one at every other corner, and what they leave"""


def voussoirs() -> FloatArray:
    """Corners in the order of ``HEXAHEDRON``: four at y = width, the same at y = 0; (9, 8, 3) m."""
    angles = np.pi * np.arange(VOUSSOIRS + 1) / VOUSSOIRS
    rays = np.stack([-np.cos(angles), 0 * angles, np.sin(angles)], axis=1)
    rays[-1, 2] = 0.0
    inner, outer = (rays * radius + [SPAN / 2, 0, 0] for radius in (SPAN / 2, SPAN / 2 + THICKNESS))
    front = np.stack([inner[:-1], inner[1:], outer[1:], outer[:-1]], axis=1)
    return np.asarray(np.concatenate([front + np.array([0, WIDTH, 0]), front], axis=1))


def obj() -> str:
    """Centimetres, y upwards, quadrilaterals: an object for each voussoir."""
    lines = [f"# {REMARK}", "mtllib arch.mtl"]
    for number, corners in enumerate(voussoirs() * 100):
        lines += [f"o voussoir {number}", *(f"v {x:.9f} {z:.9f} {-y:.9f}" for x, y, z in corners), "s off"]
        lines += ["f " + " ".join(f"{corner - 8}" for corner in face) for face in HEXAHEDRON]
    return "\n".join(lines) + "\n"


def stl() -> bytes:
    """Millimetres in single precision: triangles without names or common vertices."""
    triangles = (voussoirs() * 1000)[:, np.array(TRIANGLES)].reshape(-1, 9)
    records = b"".join(struct.pack("<12fH", 0, 0, 0, *each, 0) for each in triangles)
    return REMARK.encode().ljust(80) + struct.pack("<I", len(triangles)) + records


def ply() -> str:
    """Metres, quadrilaterals; voussoirs share the vertices at their joints."""
    points, rows = np.unique(voussoirs().reshape(-1, 3).round(12), axis=0, return_inverse=True)
    faces = rows.reshape(-1, 8)[:, np.array(HEXAHEDRON)].reshape(-1, 4)
    lines = ["ply", "format ascii 1.0", f"comment {REMARK}", f"element vertex {len(points)}"]
    lines += [f"property double {axis}" for axis in "xyz"]
    lines += [f"element face {len(faces)}", "property list uchar int vertex_indices", "end_header"]
    lines += [f"{x:.12g} {y:.12g} {z:.12g}" for x, y, z in points]
    return "\n".join([*lines, *("4 " + " ".join(map(str, face)) for face in faces)]) + "\n"


def gltf() -> str:
    """Metres, y upwards: a node for each voussoir, below one that moves them all; every face with its own vertices."""
    corners = voussoirs()[..., [0, 2, 1]] * [1, 1, -1]
    own = (corners - corners[:, :1])[:, np.array(TRIANGLES)].astype("<f4").tobytes()
    nodes = [
        {"name": f"voussoir {n}", "mesh": n, "translation": (corners[n, 0] - [5, 0, 0]).tolist()} for n in range(9)
    ]
    document = {
        "asset": {"version": "2.0", "generator": REMARK},
        "scene": 0,
        "scenes": [{"nodes": [9]}],
        "nodes": [*nodes, {"name": "arch", "children": list(range(9)), "translation": [5, 0, 0]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": n}}]} for n in range(9)],
        "accessors": [
            {"bufferView": 0, "byteOffset": 432 * n, "componentType": 5126, "count": 36, "type": "VEC3"}
            for n in range(9)
        ],
        "bufferViews": [{"buffer": 0, "byteLength": len(own)}],
        "buffers": [
            {"byteLength": len(own), "uri": "data:application/octet-stream;base64," + base64.b64encode(own).decode()}
        ],
    }
    return json.dumps(document, indent=1) + "\n"


def compas() -> str:
    """An assembly of blocks as compas_assembly writes it; the outer voussoirs are marked as supports."""

    def block(corners: FloatArray) -> dict[str, object]:
        vertices = {str(row): dict(zip("xyz", point, strict=True)) for row, point in enumerate(corners.tolist())}
        faces = {str(row): list(face) for row, face in enumerate(HEXAHEDRON)}
        mesh = {"attributes": {"name": "Block"}, "vertex": vertices, "face": faces}
        return {"dtype": "compas_assembly.datastructures/Block", "value": mesh}

    nodes = {str(n): {"block": block(corners), "is_support": n in (0, 8)} for n, corners in enumerate(voussoirs())}
    graph = {"node": nodes, "edge": {str(n): {} for n in range(9)}}
    content = {"attributes": {"name": REMARK}, "graph": graph}
    return json.dumps({"dtype": "compas_assembly.datastructures/Assembly", "value": content}, indent=1) + "\n"


def dxf() -> str:
    """Millimetres: a closed polyline for each voussoir, on layer STONES, and the springing line on another."""
    tags: list[tuple[int, object]] = [(999, REMARK), (0, "SECTION"), (2, "ENTITIES")]
    for corners in voussoirs()[:, 4:] * 1000:
        tags += [(0, "POLYLINE"), (8, "STONES"), (66, 1), (10, 0.0), (20, 0.0), (30, 0.0), (70, 1)]
        for x, _, z in corners:
            tags += [(0, "VERTEX"), (8, "STONES"), (10, f"{x:.9f}"), (20, f"{z:.9f}"), (30, 0.0)]
        tags += [(0, "SEQEND"), (8, "STONES")]
    line = [(0, "LINE"), (8, "LEVELS"), (10, -1000.0), (20, 0.0), (30, 0.0), (11, 5000.0), (21, 0.0), (31, 0.0)]
    tags += [*line, (0, "ENDSEC"), (0, "EOF")]
    return "".join(f"{code:3d}\n{value}\n" for code, value in tags)


def inp() -> str:
    """Millimetres: voussoirs of two wedges of second order, each pair an element set."""
    wedges = ((0, 1, 2, 4, 5, 6), (0, 2, 3, 4, 6, 7))
    middles = ((0, 1), (1, 2), (2, 0), (3, 4), (4, 5), (5, 3), (0, 3), (1, 4), (2, 5))
    nodes: dict[tuple[float, ...], int] = {}
    cards = []
    for number, corners in enumerate((voussoirs() * 1000).round(6) + 0.0):
        cards.append(f"*ELEMENT, TYPE=C3D15, ELSET=V{number}")
        for part, wedge in enumerate(wedges):
            points = corners[list(wedge)]
            every = [*points, *((points[a] + points[b]) / 2 for a, b in middles)]
            rows = [str(nodes.setdefault(tuple(point.tolist()), len(nodes) + 1)) for point in every]
            cards += [f"{2 * number + part + 1}, {', '.join(rows[:10])},", f"  {', '.join(rows[10:])}"]
    lines = [f"{row}, {x!r}, {y!r}, {z!r}" for (x, y, z), row in nodes.items()]
    return "\n".join([f"** {REMARK}", "*NODE, NSET=Nall", *lines, *cards]) + "\n"


def msh() -> str:
    """Metres, Gmsh 2.2: voussoirs of five tetrahedra, each a physical group."""
    corners = voussoirs().reshape(-1, 3)
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", "9"]
    lines += [f'3 {n + 1} "voussoir {n}"' for n in range(9)]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(corners))]
    lines += [f"{row + 1} {x:.15g} {y:.15g} {z:.15g}" for row, (x, y, z) in enumerate(corners)]
    lines += ["$EndNodes", "$Elements", "45"]
    for n in range(9):
        for part, cell in enumerate(TETRAHEDRA):
            rows = " ".join(str(8 * n + corner + 1) for corner in cell)
            lines.append(f"{5 * n + part + 1} 4 2 {n + 1} {n + 1} {rows}")
    return "\n".join([*lines, "$EndElements"]) + "\n"


def vtu() -> str:
    """Metres: voussoirs as hexahedra, the vertices at their joints not shared."""
    corners = voussoirs().reshape(-1, 3) + 0.0
    points = " ".join(f"{value:.15g}" for value in corners.ravel())
    arrays = {
        "connectivity": " ".join(map(str, range(len(corners)))),
        "offsets": " ".join(str(8 * n + 8) for n in range(VOUSSOIRS)),
        "types": " ".join(["12"] * VOUSSOIRS),
    }
    cells = [
        f'<DataArray type="Int64" Name="{name}" format="ascii">{text}</DataArray>' for name, text in arrays.items()
    ]
    lines = [
        '<?xml version="1.0"?>',
        f"<!-- {REMARK} -->",
        '<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>',
        f'<Piece NumberOfPoints="{len(corners)}" NumberOfCells="{VOUSSOIRS}">',
        f'<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{points}</DataArray></Points>',
        *("<Cells>", *cells, "</Cells>"),
        "</Piece></UnstructuredGrid></VTKFile>",
    ]
    return "\n".join(lines) + "\n"


def vertices_csv() -> str:
    """Metres; the voussoirs are called V0 ... V8."""
    rows = (
        f"V{number},{row},{x:.15g},{y:.15g},{z:.15g}"
        for number, corners in enumerate(voussoirs())
        for row, (x, y, z) in enumerate(corners)
    )
    return _csv("block,vertex,x,y,z", rows)


def faces_csv() -> str:
    """Corners of the faces of all voussoirs."""
    faces = (f"V{n},{row},{','.join(map(str, face))}" for n in range(9) for row, face in enumerate(HEXAHEDRON))
    return _csv("block,face,v1,v2,v3,v4", faces)


def loads_csv() -> str:
    """The area of each voussoir as a force along x: a push in proportion to mass, for a density of one per area."""
    each = np.pi / VOUSSOIRS
    area = 0.5 * np.sin(each) * ((SPAN / 2 + THICKNESS) ** 2 - (SPAN / 2) ** 2)
    return _csv("group,index,fx,fy,fz", (f"arch,{n},{area:.15g},0,0" for n in range(9)))


def contacts_csv() -> str:
    """The joints between the voussoirs and those on the ground, each by its four corners."""
    joints = [(f"J{n}", "arch", n, "arch", n + 1, voussoirs()[n][[1, 2, 6, 5]]) for n in range(8)]
    joints += [("left", "arch", 0, "ground", 0, voussoirs()[0][[0, 3, 7, 4]])]
    joints += [("right", "arch", 8, "ground", 0, voussoirs()[8][[1, 2, 6, 5]])]
    rows = (
        f"{name},{a},{i},{b},{j},{x:.15g},{y:.15g},{z:.15g}"
        for name, a, i, b, j, corners in joints
        for x, y, z in corners + 0.0
    )
    return _csv("interface,group_a,index_a,group_b,index_b,x,y,z", rows)


def _csv(header: str, rows: Iterator[str]) -> str:
    return "\n".join([f"# {REMARK}", header, *rows]) + "\n"


FILES: dict[str, Callable[[], str | bytes]] = {
    "arch_9.obj": obj,
    "arch_9.stl": stl,
    "arch_9.ply": ply,
    "arch_9.gltf": gltf,
    "arch_9.json": compas,
    "arch_9.dxf": dxf,
    "arch_9.inp": inp,
    "arch_9.msh": msh,
    "arch_9.vtu": vtu,
    "arch_9_vertices.csv": vertices_csv,
    "arch_9_faces.csv": faces_csv,
    "arch_9_loads.csv": loads_csv,
    "arch_9_contacts.csv": contacts_csv,
}


def content(name: str) -> bytes:
    """A file as it should be."""
    text = FILES[name]()
    return text if isinstance(text, bytes) else text.encode()


def main() -> None:
    """Write the files again."""
    for name in FILES:
        (FOLDER / name).write_bytes(content(name))


if __name__ == "__main__":
    main()
