"""Closedness and orientation of polyhedra, from their edges.

In a closed polyhedron with consistently oriented faces, the two faces at each edge pass it in opposite directions.
All edges of all polyhedra are compared at once; only where that fails are single polyhedra looked at again.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.model.polyhedra import Polyhedra


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
    tails, heads = polyhedra.loops, polyhedra.next_loops
    low, high = np.minimum(tails, heads), np.maximum(tails, heads)
    keys = low * len(polyhedra.vertices) + high
    order = np.argsort(keys, kind="stable")
    first = np.flatnonzero(np.diff(keys[order], prepend=-1))
    face_count = np.diff(first, append=len(keys))
    corner = order[first]
    faces = polyhedra.face_of_corner
    pair_edge = np.flatnonzero(face_count == 2)
    one, other = order[first[pair_edge]], order[first[pair_edge] + 1]
    return Edges(
        ends=np.stack([low[corner], high[corner]], axis=1),
        block=polyhedra.block_of_vertex[low[corner]],
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
    """Label of the connected part of each node, (n_nodes,), from (n, 2) pairs of joined nodes."""
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    ones = np.ones(len(pairs), dtype=np.int8)
    graph = coo_array((ones, (pairs[:, 0], pairs[:, 1])), shape=(n_nodes, n_nodes)).tocsr()
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)
