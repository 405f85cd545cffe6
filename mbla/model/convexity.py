"""Which polyhedra are convex."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.model.face_geometry import FaceGeometry
from mbla.model.polyhedra import Polyhedra
from mbla.model.ragged import chunks, ranges

LARGE = 20_000
"""products faces x vertices above which a polyhedron is compared by itself, with a matrix product"""
HUGE = 20_000_000
"""products above which not every vertex is compared with every face: of a million triangles that would take hours"""
SHARE = 0.01
"""part of what is allowed by which the comparison of huge polyhedra may miss it"""
AT_ONCE = 2_000_000
"""products held in memory together"""


def find_convex(polyhedra: Polyhedra, faces: FaceGeometry, allowed: FloatArray) -> BoolArray:
    """True where every vertex lies behind the plane of every face, or ahead of it by at most ``allowed``, (n,).

    allowed : (n,) length, for each polyhedron
    """
    vertex_counts, face_counts = np.diff(polyhedra.vertex_start), np.diff(polyhedra.face_start)
    products = vertex_counts * face_counts
    convex = np.zeros(len(polyhedra), dtype=bool)
    small = np.flatnonzero(products <= LARGE)
    for part in chunks(products[small], AT_ONCE):
        blocks = small[part]
        convex[blocks] = _greatest_lead(polyhedra, faces, blocks) <= allowed[blocks]
    for block in np.flatnonzero(products > LARGE):
        vertices = polyhedra.local_vertices[polyhedra.vertex_start[block] : polyhedra.vertex_start[block + 1]]
        rows = slice(polyhedra.face_start[block], polyhedra.face_start[block + 1])
        compare = _all_behind if products[block] <= HUGE else _none_ahead
        convex[block] = compare(vertices, faces.centres[rows], faces.normals[rows], float(allowed[block]))
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


def _all_behind(vertices: FloatArray, centres: FloatArray, normals: FloatArray, allowed: float) -> bool:
    """Same for one large polyhedron; stops at the first slab of faces that a vertex leads."""
    offsets = np.einsum("ij,ij->i", centres, normals)
    slab = max(AT_ONCE // len(vertices), 1)
    for first in range(0, len(normals), slab):
        rows = slice(first, first + slab)
        if ((vertices @ normals[rows].T) - offsets[rows]).max() > allowed:
            return False
    return True


def _none_ahead(vertices: FloatArray, centres: FloatArray, normals: FloatArray, allowed: float) -> bool:
    """Same for one huge polyhedron: no vertex in a great ball that rests on each face, ``allowed`` above it.

    A ball of radius r holds what leads by more than ``allowed`` + L²/2r at a distance L along the face; r makes that
    at most ``SHARE`` of ``allowed`` more across the whole polyhedron.
    """
    from scipy.spatial import cKDTree

    extent = float(np.linalg.norm(np.ptp(vertices, axis=0)))
    if not allowed > 0 or not extent > 0:
        return False
    radius = extent**2 / (2 * SHARE * allowed)
    tree = cKDTree(vertices)
    for first in range(0, len(normals), AT_ONCE // 20):
        rows = slice(first, first + AT_ONCE // 20)
        middles = centres[rows] + (allowed + radius) * normals[rows]
        nearest, _ = tree.query(middles, distance_upper_bound=radius)
        if np.isfinite(nearest).any():
            return False
    return True
