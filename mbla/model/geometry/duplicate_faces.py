"""Faces that a surface lists twice.

A face with the corners of another may be that of a neighbour that touches there. It is a second copy where the surface
closes without it: an odd number of faces meets at an edge of it. So it is where all the faces of a closed surface are
listed again in the same order. Surfaces with a copy of every face the other way round (both sides of each face
exported) come apart into twins, see ``surfaces``.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, IntArray
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import ranges


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


def repeated_faces(surfaces: Polyhedra) -> BoolArray:
    """Faces that are copies of another and not needed to close the surface, (n_faces,)."""
    codes = face_codes(surfaces, oriented=False)
    _, first, inverse, counts = np.unique(codes, return_index=True, return_inverse=True, return_counts=True)
    inverse = inverse.reshape(-1)
    listed_again = counts[inverse] > 1
    copies = np.ones(len(codes), dtype=bool)
    copies[first] = False
    if not copies.any():
        return copies
    ordered = face_codes(surfaces, oriented=True)
    turned = ordered != ordered[first[inverse]]
    edge = _edges(surfaces)
    patch = _patches(surfaces, edge, listed_again)
    superfluous = _at_odd_edges(surfaces, edge, patch, listed_again)
    closed = ~_at_odd_edges(surfaces, edge, patch, listed_again & ~copies, only=listed_again & ~copies)
    closed[patch[copies & turned]] = False
    return np.asarray(copies & (superfluous | closed)[patch])


def _edges(surfaces: Polyhedra) -> IntArray:
    """Number of the edge that starts at each corner, (n_corners,)."""
    tails, heads = surfaces.loops, surfaces.next_loops
    keys = np.minimum(tails, heads) * len(surfaces.vertices) + np.maximum(tails, heads)
    return np.unique(keys, return_inverse=True)[1].reshape(-1).astype(np.int64)


def _patches(surfaces: Polyhedra, edge: IntArray, chosen: BoolArray) -> IntArray:
    """Label of the patch of each face, (n_faces,): of the chosen faces those that share edges lie in one."""
    face = surfaces.face_of_corner
    corners = np.flatnonzero(chosen[face])
    order = corners[np.argsort(edge[corners], kind="stable")]
    same = edge[order[1:]] == edge[order[:-1]]
    pairs = np.stack([face[order[:-1]][same], face[order[1:]][same]], axis=1)
    return connected_labels(pairs, len(chosen))


def _at_odd_edges(
    surfaces: Polyhedra, edge: IntArray, patch: IntArray, chosen: BoolArray, only: BoolArray | None = None
) -> BoolArray:
    """Patches that have an edge where an odd number of faces meets, of all or of ``only`` some, (n_faces,)."""
    face = surfaces.face_of_corner
    counted = edge if only is None else edge[only[face]]
    odd = np.bincount(counted, minlength=int(edge.max()) + 1) % 2 == 1
    found = np.zeros(len(chosen), dtype=bool)
    found[patch[face[chosen[face] & odd[edge]]]] = True
    return found
