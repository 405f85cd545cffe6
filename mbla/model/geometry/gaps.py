"""Gaps in surfaces: edges that one face alone has, vertices amid the edge of another face, faces of no width.

The tolerances of repairs are relative to the shortest edge at each vertex. A file of many blocks has no size of its
own, and its blocks are not known before its faces are joined. A tolerance below the shortest edge at a vertex, however,
can never make two corners of one face one.

Vertices in the middle of another face's edge become corners of it. They are looked for only at edges that one face
alone has, among the vertices of such edges: a closed surface has none.

Flat faces have no area although no two of their corners coincide: all lie on one line, as where a modeller split an
edge and filled the gap with a triangle of no width. The surface closes without them once the vertices on the longest
edge are taken into the face beyond it.
"""

from __future__ import annotations

from itertools import chain

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.solids.measures import face_geometry
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import row_maxima


def shortest_edges(polyhedra: Polyhedra) -> FloatArray:
    """Length of the shortest edge at each vertex, (n_vertices,); infinite at vertices that no face uses."""
    tails, heads = polyhedra.loops, polyhedra.next_loops
    lengths = np.linalg.norm(polyhedra.local_vertices[heads] - polyhedra.local_vertices[tails], axis=1)
    shortest = np.full(len(polyhedra.vertices), np.inf)
    np.minimum.at(shortest, tails, lengths)
    np.minimum.at(shortest, heads, lengths)
    return shortest


def lone_edge_corners(polyhedra: Polyhedra) -> np.typing.NDArray[np.int64]:
    """Corners (n,) from which an edge starts that no other face has; none where every surface is closed."""
    tails, heads = polyhedra.loops, polyhedra.next_loops
    keys = np.minimum(tails, heads) * len(polyhedra.vertices) + np.maximum(tails, heads)
    _, inverse, counts = np.unique(keys, return_inverse=True, return_counts=True)
    return np.flatnonzero(counts[inverse.reshape(-1)] == 1)


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


def _in_face(polyhedra: Polyhedra, face: IntArray, vertex: IntArray) -> np.typing.NDArray[np.bool_]:
    """Whether each vertex is a corner of the face beside it already, (n,)."""
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
