"""Measures of polyhedra: planes of faces, edges and orientation, volumes and centroids, convexity.

The area vector of a closed polygon p_0 ... p_{n-1} about any point c is (Newell)

    A = 1/2 sum (p_i - c) x (p_{i+1} - c),

exact for planar polygons, convex or not, and the best-fitting orientation for others.

In a closed polyhedron with consistently oriented faces, the two faces at each edge pass it in opposite directions.
All edges of all polyhedra are compared at once; only where that fails are single polyhedra examined again.

A closed polyhedron with outward faces is the sum of signed tetrahedra from an origin o of its own to the triangles
(c_f, p_i, p_{i+1}) of each face f, with c_f the mean of its corners:

    V = 1/6 sum c_f . (p_i x p_{i+1}),      x = o + 1/(4 V) sum V_i (c_f + p_i + p_{i+1}),

exact for planar faces. Fans about the face's own centre do not depend on which corner is listed first, so that faces
that are not quite planar have one volume, too.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import chunks, next_item, numbered, ranges, row_maxima, row_means, row_sums


@dataclass(frozen=True)
class FaceGeometry:
    """Planes of the faces of polyhedra.

    centres    : (n_faces, 3) mean of the corners, about the local origin of the polyhedron
    areas      : (n_faces,)   of the projection onto the fitted plane
    normals    : (n_faces, 3) unit, by the order of the corners; zero where the area is zero
    deviations : (n_faces,)   greatest distance of a corner from the plane through the centre
    perimeters : (n_faces,)
    """

    centres: FloatArray
    areas: FloatArray
    normals: FloatArray
    deviations: FloatArray
    perimeters: FloatArray


def face_geometry(polyhedra: Polyhedra) -> FaceGeometry:
    """Planes of all faces."""
    start, face = polyhedra.loop_start, polyhedra.face_of_corner
    corners = polyhedra.local_vertices[polyhedra.loops]
    centres = row_means(corners, start)
    arms = corners - centres[face]
    next_arms = arms[next_item(start)]
    area_vectors = 0.5 * row_sums(np.cross(arms, next_arms), start)
    areas = np.sqrt(np.einsum("ij,ij->i", area_vectors, area_vectors))
    normals = np.divide(area_vectors, areas[:, None], out=np.zeros_like(area_vectors), where=areas[:, None] > 0)
    deviations = row_maxima(np.abs(np.einsum("ij,ij->i", arms, normals[face])), start)
    perimeters = row_sums(np.sqrt(((next_arms - arms) ** 2).sum(axis=1)), start)
    return FaceGeometry(centres, areas, normals, deviations, perimeters)


@dataclass(frozen=True)
class Edges:
    """Edges of polyhedra, and the faces at them.

    ends         : (n_edges, 2) rows of ``vertices``, lesser first
    block        : (n_edges,)
    face_count   : (n_edges,)   faces that pass the edge
    any_face     : (n_edges,)   one of them
    pairs        : (n_pairs, 2) the faces at each edge that has exactly two
    pair_edge    : (n_pairs,)   its edge
    opposed      : (n_pairs,)   true where the two pass it in opposite directions, as they should
    """

    ends: IntArray
    block: IntArray
    face_count: IntArray
    any_face: IntArray
    pairs: IntArray
    pair_edge: IntArray
    opposed: BoolArray


def find_edges(polyhedra: Polyhedra) -> Edges:
    """Edges of all polyhedra; vertices are shared inside a polyhedron only."""
    keys, tails = polyhedra.edge_keys, polyhedra.loops
    order = np.argsort(keys, kind="stable")
    first = np.flatnonzero(np.diff(keys[order], prepend=-1))
    face_count = np.diff(first, append=len(keys))
    corner = order[first]
    low, high = divmod(keys[corner], max(len(polyhedra.vertices), 1))
    faces = polyhedra.face_of_corner
    pair_edge = np.flatnonzero(face_count == 2)
    one, other = order[first[pair_edge]], order[first[pair_edge] + 1]
    return Edges(
        ends=np.stack([low, high], axis=1),
        block=polyhedra.block_of_vertex[low],
        face_count=face_count,
        any_face=faces[corner],
        pairs=np.stack([faces[one], faces[other]], axis=1),
        pair_edge=pair_edge,
        opposed=tails[one] != tails[other],
    )


def count_pieces(polyhedra: Polyhedra, edges: Edges) -> IntArray:
    """Parts of each polyhedron's surface that no edge joins, (n,); one for a sound polyhedron."""
    labels = connected_labels(edges.pairs, len(polyhedra.block_of_face))
    block_of_piece = np.zeros(labels.max() + 1, dtype=np.int64)
    block_of_piece[labels] = polyhedra.block_of_face
    return np.bincount(block_of_piece, minlength=len(polyhedra))


def faces_to_turn(polyhedra: Polyhedra, edges: Edges) -> tuple[BoolArray, BoolArray]:
    """Faces to turn so that all agree with the first face of their polyhedron, and which polyhedra cannot agree.

    Returns
    -------
    turned : (n_faces,)
    one_sided : (n,) surfaces on which no orientation agrees, such as a Klein bottle

    Each inconsistent polyhedron is walked over its shared edges, on a graph with two nodes per face: as it is, and
    turned. Opposed neighbours join equal nodes, others join unequal ones.
    """
    turned = np.zeros(len(polyhedra.block_of_face), dtype=bool)
    one_sided = np.zeros(len(polyhedra), dtype=bool)
    astray = np.zeros(len(polyhedra), dtype=bool)
    astray[edges.block[edges.pair_edge[~edges.opposed]]] = True
    if not astray.any():
        return turned, one_sided
    chosen = astray[edges.block[edges.pair_edge]]
    pairs, opposed = edges.pairs[chosen], edges.opposed[chosen]
    n_faces = len(turned)
    left, right = pairs[:, 0], pairs[:, 1]
    crossed = np.where(opposed, 0, n_faces)
    graph = np.concatenate(
        [np.stack([left, right + crossed], axis=1), np.stack([left + n_faces, right + n_faces - crossed], axis=1)]
    )
    labels = connected_labels(graph, 2 * n_faces)
    leader = polyhedra.face_start[:-1][polyhedra.block_of_face]
    faces = np.arange(n_faces)
    turned = astray[polyhedra.block_of_face] & (labels[faces + n_faces] == labels[leader])
    one_sided[polyhedra.block_of_face[labels[faces] == labels[faces + n_faces]]] = True
    return turned & ~one_sided[polyhedra.block_of_face], one_sided


def connected_labels(pairs: IntArray, n_nodes: int) -> IntArray:
    """Connected part of each node, (n_nodes,), in the order of first nodes, from (n, 2) pairs of joined nodes."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ones = np.ones(len(pairs), dtype=np.int8)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(n_nodes, n_nodes)).tocsr()
    return numbered(connected_components(graph, directed=False)[1].astype(np.int64))[0]


def volumes_and_centroids(polyhedra: Polyhedra) -> tuple[FloatArray, FloatArray]:
    """Signed volumes (n,), positive where faces point outwards, and centroids (n, 3) in global coordinates.

    Faces must be oriented consistently. Where the volume is zero the centroid is the mean of the vertices.
    """
    local = polyhedra.local_vertices
    tails, heads = local[polyhedra.loops], local[polyhedra.next_loops]
    centres = row_means(tails, polyhedra.loop_start)[polyhedra.face_of_corner]
    tetrahedra = np.einsum("ij,ij->i", centres, np.cross(tails, heads)) / 6
    moments = tetrahedra[:, None] * (centres + tails + heads) / 4
    corner_start = polyhedra.loop_start[polyhedra.face_start]
    volumes = row_sums(tetrahedra, corner_start)
    means = row_means(local, polyhedra.vertex_start)
    centroids = np.divide(row_sums(moments, corner_start), volumes[:, None], out=means, where=volumes[:, None] != 0)
    return volumes, polyhedra.origins + centroids


LARGE = 2_000_000
"""products faces x vertices of a polyhedron above which it is not asked whether it is convex: no surveyed stone is, and
of a million triangles that would take hours"""
AT_ONCE = 2_000_000
"""products held in memory together"""


def find_convex(polyhedra: Polyhedra, faces: FaceGeometry, allowed: FloatArray) -> BoolArray:
    """True where every vertex lies behind the plane of every face, or ahead of it by at most ``allowed``, (n,).

    Large polyhedra count as not convex, which only takes longer.

    allowed : (n,) length, for each polyhedron
    """
    vertex_counts, face_counts = np.diff(polyhedra.vertex_start), np.diff(polyhedra.face_start)
    products = vertex_counts * face_counts
    convex = np.zeros(len(polyhedra), dtype=bool)
    small = np.flatnonzero(products <= LARGE)
    for part in chunks(products[small], AT_ONCE):
        blocks = small[part]
        convex[blocks] = _greatest_lead(polyhedra, faces, blocks) <= allowed[blocks]
    return convex


def _greatest_lead(polyhedra: Polyhedra, faces: FaceGeometry, blocks: IntArray) -> FloatArray:
    """Greatest distance of a vertex ahead of a face of its polyhedron, for some of them, (n_chosen,)."""
    vertex_counts, face_counts = np.diff(polyhedra.vertex_start)[blocks], np.diff(polyhedra.face_start)[blocks]
    face = ranges(polyhedra.face_start[blocks], face_counts)
    per_face = np.repeat(vertex_counts, face_counts)
    vertex = ranges(np.repeat(polyhedra.vertex_start[blocks], face_counts), per_face)
    offsets = np.einsum("ij,ij->i", faces.centres[face], faces.normals[face])
    leads = np.einsum("ij,ij->i", polyhedra.local_vertices[vertex], np.repeat(faces.normals[face], per_face, axis=0))
    leads -= np.repeat(offsets, per_face)
    products = vertex_counts * face_counts
    return np.asarray(np.maximum.reduceat(leads, np.cumsum(products) - products), dtype=np.float64)
