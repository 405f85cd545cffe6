"""What a geometry file holds, made into blocks: repaired where that cannot change their shape, and split.

Every repair is reported in a notice. What could be repaired in two ways (holes, faces that cross, surfaces inside each
other) is left as it is, to be refused by block when the blocks are built. So are objects with coordinates that cannot
be computed with, and those of which a repair would leave nothing.

Tolerances are relative to the shortest edge at a vertex: a file of many blocks has no size of its own, and its blocks
are not known before its faces are joined. So no repair makes two corners of a face one, unless the deck gives a
distance within which it wants that (``weld``).

Vertices in the middle of another face's edge become corners of it. They are sought only at edges that one face
alone has, among the vertices of such edges: a closed surface has none.

Flat faces have no area although no two of their corners coincide: all lie on one line, as where a modeller split an
edge and filled the gap with a triangle of no width. The surface closes without them once the vertices on the longest
edge are taken into the face beyond it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from itertools import chain

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.errors import Notice
from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.repeated_faces import face_codes, repeated_faces
from mbla.model.geometry.surfaces import split_surfaces
from mbla.model.geometry.welding import Welded, take_faces, weld, weld_near, with_faces
from mbla.model.solids.defects import Defects, coordinate_defects
from mbla.model.solids.measures import face_geometry
from mbla.model.solids.polyhedra import Polyhedra, join_polyhedra, take_polyhedra
from mbla.model.solids.ragged import row_maxima
from mbla.model.wording import counted, with_count


@dataclass
class _Work:
    """Polyhedra in work, the row of the file that each is of, and what was done to them.

    pooled : all objects of the file were made one
    """

    polyhedra: Polyhedra
    source: IntArray
    notices: list[Notice] = field(default_factory=list)
    pooled: bool = False

    def put(self, polyhedra: Polyhedra) -> None:
        """Take these instead; those without a face left go."""
        rows = with_faces(polyhedra)
        every = len(rows) == len(polyhedra)
        self.polyhedra = polyhedra if every else take_polyhedra(polyhedra, rows)
        self.source = self.source[rows]

    def note(self, identifier: str, count: int, noun: str, words: str) -> None:
        """A notice of what was done to ``count`` things; none for 0."""
        if count:
            self.notices.append(Notice("notice", identifier, with_count(count, noun, words)))

    def take_welded(self, welded: Welded, identifier: str, words: str, *, count_merged: bool = True) -> None:
        """Take what welding made."""
        self.put(welded.polyhedra)
        self.note(identifier, welded.merged if count_merged else 0, "vertex", f"merged with another {words}")
        self.note("faces-collapsed", welded.collapsed, "face", "left out, without area: corners at the same place")


def repair(geometry: Geometry, tolerance: float, weld_distance: float | None = None) -> Geometry:
    """Blocks of a file: its volume cells, or the closed parts of its surfaces; ``names`` are those of their objects.

    tolerance     : relative to the shortest edge, for gaps inside a block
    weld_distance : distance within which corners of an object are one
    """
    defects = Defects(len(geometry.polyhedra))
    defects.add(coordinate_defects(geometry.polyhedra))
    fit = defects.sound
    work = _Work(take_polyhedra(geometry.polyhedra, np.flatnonzero(fit)), np.flatnonzero(fit))
    work.put(work.polyhedra)
    if len(work.polyhedra):
        words = "of their block at the same place"
        work.take_welded(weld(work.polyhedra), "vertices-merged", words, count_merged=geometry.indexed)
    if weld_distance is not None:
        everything = np.arange(len(work.polyhedra.vertices))
        _weld_near(work, everything, np.full(len(everything), weld_distance))
    if not geometry.cells and len(work.polyhedra):
        _pool_open_objects(work)
        _drop(work, flat_faces, "faces-flat", "without area: all corners on one line", geometry)
        _drop(work, repeated_faces, "faces-repeated", "listed twice", geometry)
        _close_gaps(work, tolerance)
        _split(work, geometry)
    if not work.pooled:
        _put_back(work, geometry)
    names = tuple("" if work.pooled else geometry.names[row] for row in work.source) if geometry.names else ()
    return replace(
        geometry,
        polyhedra=work.polyhedra,
        notices=(*geometry.notices, *work.notices),
        names=names,
        sets=None,
        cells=True,
    )


def _put_back(work: _Work, geometry: Geometry) -> None:
    """Objects of which nothing is left, as they are in the file: none of them goes without a word."""
    gone = np.setdiff1d(with_faces(geometry.polyhedra), work.source)
    if not len(gone):
        return
    polyhedra = join_polyhedra([work.polyhedra, take_polyhedra(geometry.polyhedra, gone)])
    source = np.concatenate([work.source, gone])
    order = np.argsort(source, kind="stable")
    work.polyhedra, work.source = take_polyhedra(polyhedra, order), source[order]


def _weld_near(work: _Work, vertices: IntArray, reach: FloatArray) -> None:
    if len(vertices):
        work.take_welded(weld_near(work.polyhedra, vertices, reach), "vertices-welded", f"up to {reach.max():.2g} away")


def _pool_open_objects(work: _Work) -> None:
    """Objects of which none is closed by itself, but all together, are parts of surfaces, one of each face for example.

    Where any of them is closed, an open one is a fault, and stays apart to be refused by its name.
    """
    surfaces = work.polyhedra
    open_ones = np.unique(surfaces.block_of_face[surfaces.face_of_corner[lone_edge_corners(surfaces)]])
    if len(open_ones) < max(len(surfaces), 2):
        return
    ends = np.array([0, len(surfaces.vertices)]), np.array([0, len(surfaces.block_of_face)])
    together = weld(replace(surfaces, vertex_start=ends[0], face_start=ends[1])).polyhedra
    codes = face_codes(together, oriented=True)
    if len(lone_edge_corners(together)) or len(np.unique(codes)) < len(codes):
        return
    words = f"none of its {len(surfaces)} objects is closed by itself: their faces are taken together as one surface"
    work.notices.append(Notice("warning", "objects-joined", words))
    work.polyhedra, work.source, work.pooled = together, work.source[:1], True


def _drop(work: _Work, find: Callable[[Polyhedra], BoolArray], identifier: str, what: str, geometry: Geometry) -> None:
    """Leave out the faces that ``find`` finds, and say of which objects they were."""
    if (dropped := find(work.polyhedra)).any():
        objects = np.unique(work.source[work.polyhedra.block_of_face[dropped]])
        work.put(take_faces(work.polyhedra, ~dropped))
        where = ""
        if geometry.names and not work.pooled:
            first = geometry.names[objects[0]] or "without a name"
            where = (
                f"; in {counted(len(objects), 'object')}, first {first}" if len(objects) > 1 else f"; object {first}"
            )
        work.note(identifier, int(dropped.sum()), "face", f"left out, {what}{where}")


def _close_gaps(work: _Work, tolerance: float) -> None:
    """Where a face has an edge to itself: corners that nearly coincide are welded, corners on edges inserted."""
    corners = lone_edge_corners(work.polyhedra)
    if not len(corners):
        return
    ends = np.unique(np.concatenate([work.polyhedra.loops[corners], work.polyhedra.next_loops[corners]]))
    _weld_near(work, ends, tolerance * shortest_edges(work.polyhedra)[ends])
    polyhedra, count = insert_t_junctions(work.polyhedra, tolerance * shortest_edges(work.polyhedra))
    if count:
        work.put(polyhedra)
    work.note("t-junctions", count, "vertex", "made corners of the face in the middle of whose edge they lie")


def _split(work: _Work, geometry: Geometry) -> None:
    """Objects into their closed parts; a file without objects is one surface, of which that is expected."""
    before = len(work.polyhedra)
    split = split_surfaces(work.polyhedra)
    counts = np.bincount(split.source, minlength=before)
    work.note("surfaces-repeated", split.twins, "closed surface", "left out: the faces of another once more")
    several = np.flatnonzero(counts > 1)
    if geometry.names and not work.pooled and len(several):
        first = geometry.names[work.source[several[0]]] or "without a name"
        words = f"split into {counts[several].sum()} closed surfaces, a block each; first {first}"
        work.note("objects-split", len(several), "object", words)
    work.polyhedra, work.source = split.polyhedra, work.source[split.source]


def shortest_edges(polyhedra: Polyhedra) -> FloatArray:
    """Length of the shortest edge at each vertex, (n_vertices,); infinite at vertices that no face uses."""
    tails, heads = polyhedra.loops, polyhedra.next_loops
    lengths = np.linalg.norm(polyhedra.local_vertices[heads] - polyhedra.local_vertices[tails], axis=1)
    shortest = np.full(len(polyhedra.vertices), np.inf)
    np.minimum.at(shortest, tails, lengths)
    np.minimum.at(shortest, heads, lengths)
    return shortest


def lone_edge_corners(polyhedra: Polyhedra) -> IntArray:
    """Corners (n,) from which an edge starts that no other face has; none where every surface is closed."""
    return np.flatnonzero(polyhedra.faces_at_edge == 1)


def insert_t_junctions(polyhedra: Polyhedra, reach: FloatArray) -> tuple[Polyhedra, int]:
    """The polyhedra with vertices on lone edges made corners of their faces, and how many were.

    reach : (n_vertices,) distance from an edge at which a vertex lies on it
    """
    from scipy.spatial import cKDTree

    corners = lone_edge_corners(polyhedra)
    if not len(corners):
        return polyhedra, 0
    tails, heads = polyhedra.loops[corners], polyhedra.next_loops[corners]
    candidates = np.unique(np.concatenate([tails, heads]))
    points = polyhedra.vertices
    along = points[heads] - points[tails]
    lengths = np.linalg.norm(along, axis=1)
    middles = points[tails] + 0.5 * along
    found = cKDTree(points[candidates]).query_ball_point(middles, 0.5 * lengths, return_sorted=True)
    edge = np.repeat(np.arange(len(corners)), [len(each) for each in found])
    vertex = candidates[np.fromiter(chain.from_iterable(found), dtype=np.int64, count=len(edge))]
    arms = points[vertex] - points[tails[edge]]
    share = np.einsum("ij,ij->i", arms, along[edge]) / lengths[edge] ** 2
    off = np.linalg.norm(arms - share[:, None] * along[edge], axis=1)
    inner = (share * lengths[edge] > reach[vertex]) & ((1 - share) * lengths[edge] > reach[vertex])
    inner &= (off <= reach[vertex]) & (polyhedra.block_of_vertex[vertex] == polyhedra.block_of_vertex[tails[edge]])
    inner &= ~_in_face(polyhedra, polyhedra.face_of_corner[corners[edge]], vertex)
    rows = np.flatnonzero(inner)
    rows = rows[np.lexsort((share[rows], corners[edge[rows]]))]
    return _with_corners(polyhedra, corners[edge[rows]], vertex[rows]), len(rows)


def _in_face(polyhedra: Polyhedra, face: IntArray, vertex: IntArray) -> BoolArray:
    """Whether each vertex is a corner of the face paired with it already, (n,)."""
    n = len(polyhedra.vertices)
    return np.isin(face * n + vertex, polyhedra.face_of_corner * n + polyhedra.loops)


def _with_corners(polyhedra: Polyhedra, after: IntArray, vertices: IntArray) -> Polyhedra:
    """The polyhedra with vertices inserted behind some corners, in the order given."""
    if not len(after):
        return polyhedra
    extra = np.bincount(polyhedra.face_of_corner[after], minlength=len(polyhedra.block_of_face))
    return Polyhedra(
        polyhedra.vertices,
        polyhedra.vertex_start,
        np.insert(polyhedra.loops, after + 1, vertices),
        starts(np.diff(polyhedra.loop_start) + extra),
        polyhedra.face_start,
    )


FLAT = 1e-6
"""width over the longest edge up to which a face is a line; coordinates in single precision leave some 1e-7"""


def flat_faces(polyhedra: Polyhedra) -> BoolArray:
    """Faces of no width, (n_faces,)."""
    local = polyhedra.local_vertices
    lengths = np.linalg.norm(local[polyhedra.next_loops] - local[polyhedra.loops], axis=1)
    longest = row_maxima(lengths, polyhedra.loop_start)
    return np.asarray(face_geometry(polyhedra).areas <= 0.5 * FLAT * longest**2)
