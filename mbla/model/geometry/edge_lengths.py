"""The local measure of a surface: the shortest edge at each vertex, to which the tolerances of repairs are relative.

A file of many blocks has no size of its own, and its blocks are not known before its faces are joined. A tolerance
below the shortest edge at a vertex, however, can never make two corners of one face one.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.solids.polyhedra import Polyhedra


def shortest_edges(polyhedra: Polyhedra) -> FloatArray:
    """Length of the shortest edge at each vertex, (n_vertices,); infinite at vertices that no face uses."""
    tails, heads = polyhedra.loops, polyhedra.next_loops
    lengths = np.linalg.norm(polyhedra.local_vertices[heads] - polyhedra.local_vertices[tails], axis=1)
    shortest = np.full(len(polyhedra.vertices), np.inf)
    np.minimum.at(shortest, tails, lengths)
    np.minimum.at(shortest, heads, lengths)
    return shortest


def lone_edge_corners(polyhedra: Polyhedra) -> np.typing.NDArray[np.int64]:
    """Corners from which an edge starts that no other face has; none where every surface is closed."""
    tails, heads = polyhedra.loops, polyhedra.next_loops
    keys = np.minimum(tails, heads) * len(polyhedra.vertices) + np.maximum(tails, heads)
    _, inverse, counts = np.unique(keys, return_inverse=True, return_counts=True)
    return np.flatnonzero(counts[inverse.reshape(-1)] == 1)
