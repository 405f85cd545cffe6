"""What makes a polyhedron unfit to be a block, and the checks that need no orientation.

Every limit is relative to the block: to the diagonal of its bounding box, and to the digits that its distance from
the origin leaves. Thin blocks are blocks: a plate or a needle of slenderness 1e-4 passes.

Blocks may be so far from the origin that their coordinates are too coarse for their shape. A coordinate has sixteen
digits, of which the distance from the origin takes its part: at 1e8 m corners lie on a grid of 1.5e-8 m. What is
computed here takes differences first, so that nothing else is lost; but the corners themselves are rounded before the
program sees them. Measured on a wall of blocks of 0.4 m: the load factor changes by about ten times the grid over the
block, 1e-6 of itself where that is 1e-7.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.errors import Message, Notice
from mbla.model.solids.measures import Edges, FaceGeometry
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import row_maxima, row_ranges, row_sums
from mbla.model.wording import counted

LARGEST_COORDINATE = 1e50
"""beyond it volumes overflow"""
SMALLEST_BLOCK = 1e-50
"""extent of a block below which its volume, and what is computed with that, underflows"""
SAME_POINT = 1e-9
"""distance of two vertices, relative to the diagonal, at which they are one"""
NO_AREA, NO_VOLUME = 1e-12, 1e-12
"""area over diagonal squared, volume over diagonal cubed"""


@dataclass(frozen=True)
class Defect:
    """One reason why a block is refused; ``face`` is the number of the face in its block, where it is about one."""

    block: int
    message: Message
    face: int | None = None


class Defects:
    """What is found wrong with blocks in one check after the other; what failed one is left out of the next.

    found : so far
    sound : (n_blocks,) blocks without any
    """

    def __init__(self, n_blocks: int) -> None:
        self.found: list[Defect] = []
        self.sound = np.ones(n_blocks, dtype=bool)

    def add(self, defects: Iterable[Defect]) -> None:
        """Those of one check, of blocks that passed all before it."""
        new = [defect for defect in defects if self.sound[defect.block]]
        self.found += new
        self.sound[[defect.block for defect in new]] = False


@dataclass(frozen=True)
class Extents:
    """Measures of each polyhedron, (n,) length: ``diagonals`` of bounding boxes, ``rounding`` of the coordinates."""

    diagonals: FloatArray
    rounding: FloatArray


def find_extents(polyhedra: Polyhedra) -> Extents:
    """Bounding-box diagonals and rounding errors."""
    start = polyhedra.vertex_start
    local = polyhedra.local_vertices
    spans = -np.subtract(*row_ranges(local, start))
    greatest = row_maxima(np.abs(polyhedra.vertices).max(axis=1), start)
    return Extents(np.linalg.norm(spans, axis=1), np.finfo(float).eps * greatest)


def wild_vertices(polyhedra: Polyhedra) -> BoolArray:
    """Vertices with a coordinate that is not finite, or too large to compute with, (n_vertices,)."""
    with np.errstate(invalid="ignore"):
        return np.asarray(~(np.abs(polyhedra.vertices) <= LARGEST_COORDINATE).all(axis=1))


def coordinate_defects(polyhedra: Polyhedra) -> Iterator[Defect]:
    """Coordinates that are not finite, or too large to compute with; and blocks that are too small for that.

    A block whose vertices all lie at one place is reported as such.
    """
    bad, start = wild_vertices(polyhedra), polyhedra.vertex_start
    if not len(bad):
        return
    local = np.where(bad[:, None], 0.0, polyhedra.vertices)
    spans = np.max(-np.subtract(*row_ranges(local, start)), axis=1)
    spans[polyhedra.block_of_vertex[bad]] = np.inf
    for block in np.flatnonzero((spans > 0) & (spans < SMALLEST_BLOCK)).tolist():
        words = (
            f"measures {spans[block]:.1e} only: blocks of less than {SMALLEST_BLOCK:.0e} cannot be computed with, "
            "look at the units"
        )
        yield Defect(block, Message("coordinate-out-of-range", words))
    blocks, first = np.unique(polyhedra.block_of_vertex[bad], return_index=True)
    for block, row in zip(blocks.tolist(), np.flatnonzero(bad)[first], strict=True):
        words = f"vertex {row - start[block]} has a coordinate that is not finite or exceeds {LARGEST_COORDINATE:.0e}"
        yield Defect(block, Message("coordinate-out-of-range", words))


def corner_defects(polyhedra: Polyhedra, extents: Extents) -> list[Defect]:
    """Faces that pass a vertex twice, and vertices at the same place."""
    defects = []
    face, loops = polyhedra.face_of_corner, polyhedra.loops
    keys = np.sort(face * len(polyhedra.vertices) + loops)
    twice = keys[1:][keys[1:] == keys[:-1]]
    _, first_of_block = np.unique(polyhedra.block_of_face[twice // len(polyhedra.vertices)], return_index=True)
    for key in twice[first_of_block]:
        number, vertex = divmod(int(key), len(polyhedra.vertices))
        block = int(polyhedra.block_of_face[number])
        local = vertex - int(polyhedra.vertex_start[block])
        at = number - int(polyhedra.face_start[block])
        defects.append(Defect(block, Message("bad-polyhedron", f"face {at} passes vertex {local} twice"), at))
    for one, other in _coincident_vertices(polyhedra, extents):
        block = int(polyhedra.block_of_vertex[one])
        first = int(polyhedra.vertex_start[block])
        words = f"vertices {one - first} and {other - first} lie at the same place"
        defects.append(Defect(block, Message("bad-polyhedron", words)))
    return defects


def _coincident_vertices(polyhedra: Polyhedra, extents: Extents) -> list[tuple[int, int]]:
    """One pair of vertices at the same place for each polyhedron that has any.

    Vertices are compared on a grid of the width at which two are one, through a hash of its indices.
    """
    width = np.maximum(SAME_POINT * extents.diagonals, 4 * extents.rounding)
    width = np.where(width > 0, width, 1.0)
    block = polyhedra.block_of_vertex
    cells = np.rint(polyhedra.local_vertices / width[block, None]).astype(np.int64)
    cells = np.concatenate([cells, block[:, None]], axis=1)
    multipliers = np.array([73856093, 19349663, 83492791, 2654435761], dtype=np.int64)
    hashes = (cells * multipliers).sum(axis=1)
    order = np.argsort(hashes, kind="stable")
    equal = np.flatnonzero((cells[order[1:]] == cells[order[:-1]]).all(axis=1))
    chosen = equal[np.unique(block[order[equal]], return_index=True)[1]]
    return [(int(order[i]), int(order[i + 1])) for i in chosen]


def edge_defects(polyhedra: Polyhedra, edges: Edges) -> Iterator[Defect]:
    """Polyhedra with edges that have one face, or more than two."""
    for block in np.unique(edges.block[edges.face_count != 2]).tolist():
        rows = np.flatnonzero(edges.block == block)
        crowded, lone = rows[edges.face_count[rows] > 2], rows[edges.face_count[rows] == 1]
        found = crowded if len(crowded) else lone
        tail, head = edges.ends[found[0]] - polyhedra.vertex_start[block]
        edge, first = counted(len(found), "edge"), f"first that between vertices {tail} and {head}"
        if len(crowded):
            twice = _face_twice(polyhedra, block)
            yield Defect(block, Message("bad-polyhedron", f"has {edge} with more than two faces, {first}{twice}"))
        else:
            face = int(edges.any_face[lone[0]] - polyhedra.face_start[block])
            words = f"is not closed: {edge} with one face only, {first}, of face {face}"
            yield Defect(block, Message("open-polyhedron", words))


def _face_twice(polyhedra: Polyhedra, block: int) -> str:
    """The first two faces of a block that have the same corners, in words; empty where there are none."""
    first: dict[frozenset[int], int] = {}
    for number, face in enumerate(range(*polyhedra.face_start[block : block + 2].tolist())):
        corners = frozenset(polyhedra.loop(face).tolist())
        if first.setdefault(corners, number) != number:
            return f"; faces {first[corners]} and {number} have the same corners: is one listed twice?"
    return ""


def size_defects(polyhedra: Polyhedra, faces: FaceGeometry, volumes: FloatArray, extents: Extents) -> list[Defect]:
    """Faces without area and polyhedra (n,) without volume, beyond what rounding could make of them."""
    defects = []
    block = polyhedra.block_of_face
    least = np.maximum(NO_AREA * extents.diagonals[block] ** 2, 2 * extents.rounding[block] * faces.perimeters)
    flat = np.flatnonzero(faces.areas <= least)
    blocks, first = np.unique(block[flat], return_index=True)
    for number, face in zip(blocks.tolist(), (flat[first] - polyhedra.face_start[blocks]).tolist(), strict=True):
        defects.append(Defect(number, Message("bad-polyhedron", f"face {face} has no area"), face))
    surfaces = row_sums(faces.areas, polyhedra.face_start)
    least = np.maximum(NO_VOLUME * extents.diagonals**3, 2 * extents.rounding * surfaces)
    empty = (np.abs(volumes) <= least) & ~np.isin(np.arange(len(polyhedra)), blocks)
    return defects + [
        Defect(int(number), Message("bad-polyhedron", "has no volume")) for number in np.flatnonzero(empty)
    ]


def not_planar(polyhedra: Polyhedra, faces: FaceGeometry, sizes: FloatArray, tolerance: float) -> IntArray:
    """Faces whose corners leave their plane by more than the tolerance, ascending.

    sizes : (n,) cube roots of the volumes; tolerance : relative to them
    """
    size = sizes[polyhedra.block_of_face]
    return np.flatnonzero((faces.deviations > tolerance * size) & (size > 0))  # what has no volume is reported as such


def planarity_defects(
    blocks: IntArray, faces: IntArray, deviations: FloatArray, sizes: FloatArray, tolerance: float
) -> list[Defect]:
    """A defect for each block with faces that are not planar, (n,) blocks, numbers in them and deviations."""
    defects = []
    for block in np.unique(blocks).tolist():
        rows = np.flatnonzero(blocks == block)
        worst = rows[np.argmax(deviations[rows])]
        face, deviation = int(faces[worst]), deviations[worst]
        which = f"face {face} is" if len(rows) == 1 else f"{len(rows)} faces, most of all face {face}, are"
        message = (
            f"{which} not planar: corners leave the plane by {deviation:.3g}, {deviation / sizes[block]:.2%} of the "
            f"block size; contacts.tolerance allows {tolerance:.2%}"
        )
        defects.append(Defect(block, Message("face-not-planar", message), face))
    return defects


COARSE = 1e-8
"""Rounding of a coordinate, over the diagonal of the block's bounding box, from which load factors may lose digits."""


def far_away(polyhedra: Polyhedra, name: Callable[[int], str], tolerance: float) -> Message | Notice | None:
    """Words on blocks so far from the origin that their coordinates are coarse; None where they are not.

    A fault where they are rounded by more than ``contacts.tolerance``, a warning where the load factor may lose digits.
    """
    if not len(polyhedra.vertices) or wild_vertices(polyhedra).any():
        return None  # reported on its own
    extents = find_extents(polyhedra)
    rounding, diagonals = extents.rounding, extents.diagonals
    shares = np.divide(rounding, diagonals, out=(rounding > 0).astype(np.float64), where=diagonals > 0)
    worst = int(np.argmax(shares))
    share = float(shares[worst])
    if share > tolerance:
        words = (
            f"so far from the origin coordinates are rounded by {share:.2g} of the size of a block, more than "
            f"contacts.tolerance = {tolerance:g}: move the structure to the origin"
        )
        return Message("coordinate-out-of-range", words)
    if share > COARSE:
        words = (
            f"{name(worst)} lies so far from the origin that its coordinates are rounded by {share:.1e} of its size: "
            f"the load factor may be off by ten times that share; move the structure to the origin"
        )
        return Notice("warning", "coordinates-coarse", words)
    return None
