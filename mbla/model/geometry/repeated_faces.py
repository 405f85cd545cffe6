"""Faces that a surface lists more than once.

A face that has the corners of another may be that of a neighbour that touches there, so copies go only where the
surface closes without them. Faces that hang together by edges are judged together, where they have an edge with an odd
number of faces, or two faces with the same corners in the same order: two blocks have a common face the opposite way
round. Of these there are left, whatever closes first:

- all but the copies in the same order, where every edge then has an even number of faces;
- each face once, where every edge then has two faces. No wall between blocks goes: walls that can go without a trace
  have an even number of faces at every edge, so they are all faces of the surface, and what goes is a twin of it;
- all but the copies of which every edge has an odd number of faces;
- all but the copies of which an edge has an odd number of faces: the surface may be open elsewhere.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import ranges


def repeated_faces(surfaces: Polyhedra) -> BoolArray:
    """Faces that are copies of another and not needed to close the surface, (n_faces,)."""
    copies = _copies(face_codes(surfaces, oriented=False))
    if not copies.any():
        return copies
    same_order = _copies(face_codes(surfaces, oriented=True))
    face = surfaces.face_of_corner
    edge, part = _edges_and_parts(surfaces)
    n_odd = np.bincount(face[surfaces.faces_at_edge % 2 == 1], minlength=len(copies))
    waiting = np.isin(part, part[same_order | (n_odd > 0)])
    dropped = np.zeros(len(copies), dtype=bool)
    all_odd = n_odd == np.diff(surfaces.loop_start)
    for candidates, exactly_two in ((same_order, False), (copies, True), (copies & all_odd, False)):
        left = np.bincount(edge[~candidates[face]], minlength=int(edge.max()) + 1)[edge]
        fits = left == 2 if exactly_two else left % 2 == 0
        closed = waiting & ~np.isin(part, part[face[~fits]])
        dropped |= closed & candidates
        waiting &= ~closed
    return np.asarray(dropped | waiting & copies & (n_odd > 0))


def _copies(codes: IntArray) -> BoolArray:
    """All but the first of each code, (n,)."""
    copies = np.ones(len(codes), dtype=bool)
    copies[np.unique(codes, return_index=True)[1]] = False
    return copies


def _edges_and_parts(surfaces: Polyhedra) -> tuple[IntArray, IntArray]:
    """Number of the edge that leaves each corner, (n_corners,), and of the part that each face is of, (n_faces,).

    Faces of a part hang together by edges.
    """
    edge = np.unique(surfaces.edge_keys, return_inverse=True)[1].reshape(-1)
    order = np.argsort(edge, kind="stable")
    same = np.flatnonzero(edge[order[1:]] == edge[order[:-1]])
    face = surfaces.face_of_corner
    pairs = np.stack([face[order[same]], face[order[same + 1]]], axis=1)
    return edge, connected_labels(pairs, len(surfaces.block_of_face))


def face_codes(polyhedra: Polyhedra, *, oriented: bool) -> IntArray:
    """Number that faces with the same corners share, in the same order if ``oriented``, (n_faces,)."""
    counts = np.diff(polyhedra.loop_start)
    codes = np.zeros(len(counts), dtype=np.int64)
    used = 0
    for n in np.unique(counts):
        rows = np.flatnonzero(counts == n)
        corners = polyhedra.loops[ranges(polyhedra.loop_start[rows], counts[rows])].reshape(-1, n)
        if oriented:  # every face from its least corner on
            turn = (np.argmin(corners, axis=1)[:, None] + np.arange(n)) % n
            corners = np.take_along_axis(corners, turn, axis=1)
        else:
            corners = np.sort(corners, axis=1)
        unique, inverse = np.unique(corners, axis=0, return_inverse=True)
        codes[rows] = used + inverse.reshape(-1)
        used += len(unique)
    return codes
