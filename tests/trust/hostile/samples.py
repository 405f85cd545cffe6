"""Small valid files of every kind, from which hostile and random ones are made."""

from __future__ import annotations

import io
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

import ezdxf
import meshio
import numpy as np

from tests.faulty_decks import FOLDER as FAULTY_DECKS
from tests.faulty_sweeps import FOLDER as FAULTY_SWEEPS
from tests.line import BLOCK, WALL
from tests.trust.geometry.formats import Files, compas, inp_surface, obj, ply_text, stl_binary, stl_text
from tests.trust.geometry.stones import Stone

ROOT = Path(__file__).parents[3]

POINTS = [[x, y, z] for z in (0.0, 1.0) for y in (0.0, 1.0) for x in (0.0, 1.0)]
"""corners of a cube"""
QUADS = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
TRIANGLES = [[a, b, c] for p, q, r, s in QUADS for a, b, c in ((p, q, r), (p, r, s))]
HEXAHEDRON = [0, 1, 3, 2, 4, 5, 7, 6]

NAMED_DECK = """\
mbla: 1
materials: {{stone: {{density: 2000}}}}
joints: {{dry: {{friction: 0.6}}}}
blocks: [{{mesh: {{group: stone, material: stone, file: {file}{more}}}}}]
contacts: {{joint: dry}}
supports: [{{ground: {{z: 0}}}}]
load_cases: {{push: {{live: [{{acceleration: [1, 0, 0]}}]}}}}
"""
"""A deck around a geometry file: ``file`` its name, ``more`` keys of its item."""

SWEEP = """\
mbla_sweep: 1
title: friction and length
deck: deck.yaml
set: {analysis.flow_rule: associative}
parameters:
  mu: {key: joints.dry.friction, normal: {mean: 0.65, deviation: 0.08, min: 0.3}}
  n: {key: parameters.n, values: [2, 3]}
design:
  - random: {of: [mu], points: 4, seed: 1}
  - grid: {of: [n]}
results: [status, load_factor]
"""


def written_by_meshio(extension: str, cells: Sequence[tuple[str, list[list[int]]]], **options: object) -> bytes:
    """A file of the cube as meshio writes it."""
    with TemporaryDirectory() as folder:
        path = Path(folder) / f"cube.{extension}"
        meshio.write(path, meshio.Mesh(np.array(POINTS), list(cells)), **options)
        return path.read_bytes()


def _dxf() -> bytes:
    drawing = ezdxf.new()  # type: ignore[attr-defined]
    stone = drawing.blocks.new("stone")
    stone.add_lwpolyline([(0, 0), (1, 0), (1, 1), (0, 1)], close=True)
    space = drawing.modelspace()
    space.add_blockref("stone", (0, 0))
    space.add_circle((3, 1), 1)
    text = io.StringIO()
    drawing.write(text)
    return text.getvalue().encode()


def _of_cube(write: Callable[[list[Stone]], Files]) -> bytes:
    (content,) = write([Stone("stone", np.array(POINTS), tuple(map(tuple, QUADS)))]).values()
    return content


HEXAHEDRA = [("hexahedron", [HEXAHEDRON])]
FACES = [("triangle", TRIANGLES)]
MESHES: dict[str, bytes] = {
    "obj": _of_cube(obj),
    "ply": _of_cube(ply_text),
    "stl": _of_cube(stl_text),
    "vtu": written_by_meshio("vtu", HEXAHEDRA, binary=False),
    "msh": written_by_meshio("msh", HEXAHEDRA, file_format="gmsh", binary=False),
    "inp": _of_cube(inp_surface),
    "json": _of_cube(compas),
    "dxf": _dxf(),
}
"""A valid file of every format that decks can name, by extension."""
BINARY_MESHES: list[tuple[str, bytes]] = [
    ("stl", _of_cube(stl_binary)),
    ("ply", written_by_meshio("ply", FACES, binary=True)),
    ("vtu", written_by_meshio("vtu", HEXAHEDRA, binary=True)),
    ("msh", written_by_meshio("msh", HEXAHEDRA, file_format="gmsh", binary=True)),
]


def small_files(folder: Path, largest: int = 1500) -> list[bytes]:
    """Contents of the YAML files in a folder tree that are small enough to be changed often."""
    return [path.read_bytes() for path in sorted(folder.rglob("*.yaml")) if path.stat().st_size <= largest]


def seeds() -> list[tuple[str, bytes]]:
    """Kind and content of files to begin with: samples, the decks of the program, and those that it refuses."""
    sweeps = [*small_files(ROOT / "decks" / "sweeps"), *small_files(FAULTY_SWEEPS)]
    decks = [*small_files(ROOT / "decks"), *small_files(FAULTY_DECKS)]
    return [
        ("deck", BLOCK.encode()),
        ("deck", WALL.encode()),
        ("sweep", SWEEP.encode()),
        *MESHES.items(),
        *BINARY_MESHES,
        *(("sweep", content) for content in sweeps if b"mbla_sweep" in content),
        *(("deck", content) for content in decks if b"mbla_sweep" not in content),
    ]
