"""Shapes with known measures, and small decks around them."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
from scipy.spatial import ConvexHull

from mbla.arrays import FloatArray
from mbla.deck import Deck, read_deck
from mbla.model.solids.blocks import labels_of
from mbla.model.solids.build import BuiltBlocks, Labels, build_blocks
from mbla.model.solids.polyhedra import Polyhedra, polyhedra_from_lists

Shape = tuple[Sequence[Sequence[float]], Sequence[Sequence[int]]]

BOX_FACES = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7]]
L_OUTLINE = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
TETRAHEDRON: Shape = (
    [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]],
    [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
)


def box(least: Sequence[float] = (0, 0, 0), greatest: Sequence[float] = (1, 1, 1)) -> Shape:
    x, y, z = zip(least, greatest, strict=True)
    corners = [(0, 0), (1, 0), (1, 1), (0, 1)]
    return [[x[i], y[j], z[k]] for k in (0, 1) for i, j in corners], [list(face) for face in BOX_FACES]


def prism(outline: Sequence[Sequence[float]], height: float = 1.0) -> Shape:
    """Prism along z over an outline given counter-clockwise."""
    n = len(outline)
    vertices = [[float(x), float(y), z] for z in (0.0, height) for x, y in outline]
    sides = [[i, (i + 1) % n, (i + 1) % n + n, i + n] for i in range(n)]
    return vertices, [list(range(n))[::-1], list(range(n, 2 * n)), *sides]


def hull(seed: int, n_points: int = 20) -> tuple[Shape, float]:
    """A random convex polyhedron with triangular faces in random orientation, and its volume by another program."""
    generator = np.random.default_rng(seed)
    points = generator.normal(size=(n_points, 3))
    found = ConvexHull(points)
    faces = [list(map(int, generator.permutation(simplex))) for simplex in found.simplices]
    return (points.tolist(), faces), float(found.volume)


def raw(*shapes: Shape) -> Polyhedra:
    return polyhedra_from_lists([vertices for vertices, _ in shapes], [faces for _, faces in shapes])


def build(*shapes: Shape, tolerance: float = 1e-3) -> BuiltBlocks:
    return build_raw(raw(*shapes), tolerance)


def build_raw(polyhedra: Polyhedra, tolerance: float = 1e-3) -> BuiltBlocks:
    n = len(polyhedra)
    return build_blocks(polyhedra, Labels(("b",) * n, np.ones(n), labels_of(n)), tolerance)


def moved(shape: Shape, matrix: FloatArray, offset: Sequence[float] = (0, 0, 0)) -> Shape:
    vertices = np.array(shape[0]) @ matrix.T + np.array(offset)
    return vertices.tolist(), shape[1]


def rotation(seed: int) -> FloatArray:
    matrix = np.linalg.qr(np.random.default_rng(seed).normal(size=(3, 3)))[0]
    return np.asarray(matrix * np.sign(np.linalg.det(matrix)), dtype=np.float64)


DECK = """mbla: 1
units: {{{units}}}
materials:
  stone: {{density: 2000}}
joints:
  dry: {{friction: 0.6}}
  rough: {{friction_angle: 45, dilatancy: 30, cohesion: 5}}
blocks:
{blocks}
contacts: {{joint: dry, tolerance: {tolerance}}}
supports: {supports}
load_cases: {{push: {{{loads}}}}}
"""
PUSH = "live: [{acceleration: [1, 0, 0]}]"


def write_deck(
    folder: Path,
    blocks: Sequence[str],
    supports: str = "[{ground: {z: 0}}]",
    loads: str = PUSH,
    units: str = "",
    tolerance: float = 1e-3,
) -> Path:
    lines = "\n".join(f"  - {line}" for line in blocks)
    path = folder / "deck.yaml"
    path.write_text(DECK.format(blocks=lines, supports=supports, loads=loads, units=units, tolerance=tolerance))
    return path


def deck(
    folder: Path,
    blocks: Sequence[str],
    supports: str = "[{ground: {z: 0}}]",
    loads: str = PUSH,
    units: str = "",
    tolerance: float = 1e-3,
) -> Deck:
    return read_deck(write_deck(folder, blocks, supports, loads, units, tolerance))
