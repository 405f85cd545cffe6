"""Vertices of one face in the middle of another's edge: that edge gets them as corners.

Looked for only at edges that one face alone has, among the vertices of such edges: a closed surface has none.
"""

from __future__ import annotations

from itertools import chain

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.model.geometry.edge_lengths import lone_edge_corners
from mbla.model.solids.polyhedra import Polyhedra


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
