"""Facets: faces of one block that share edges and lie on one plane, within the tolerance.

Meshes split planar surfaces into triangles or quadrilaterals; contacts are found between whole facets.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.face_geometry import FaceGeometry
from mbla.model.orientation import Edges, connected_labels
from mbla.model.polyhedra import Polyhedra
from mbla.model.ragged import items_of_rows, row_maxima

STEEPEST = 0.99
"""cosine of the greatest angle between neighbouring faces of one facet, about 8 degrees"""
LADDER = (1.0, 0.1, 0.01, 0.001)
"""parts of the tolerance tried in turn: a surface with many small faces, each nearly in line with the next, may be
curved as a whole; then only faces that lie closer to each other's planes are joined"""


def find_facets(polyhedra: Polyhedra, edges: Edges, faces: FaceGeometry, allowed: FloatArray) -> IntArray:
    """Number of the facet of each face, (n_faces,), from 0 in order of blocks and faces.

    allowed : (n,) greatest distance of a corner from the plane of its facet, for each polyhedron
    """
    n_faces = len(polyhedra.block_of_face)
    facet = np.arange(n_faces)
    left, right = edges.pairs[:, 0], edges.pairs[:, 1]
    aligned = np.einsum("ij,ij->i", faces.normals[left], faces.normals[right]) > STEEPEST
    pairs = edges.pairs[aligned]
    limit = allowed[polyhedra.block_of_face[pairs[:, 0]]]
    departure = np.maximum(_departures(polyhedra, faces, pairs), _departures(polyhedra, faces, pairs[:, ::-1]))
    settled = np.zeros(n_faces, dtype=bool)
    for share in LADDER:
        joined = (departure <= share * limit) & ~settled[pairs].any(axis=1)
        if not joined.any():
            break
        parts = connected_labels(pairs[joined], n_faces)
        planar = _planar_parts(polyhedra, faces, parts, allowed)
        chosen = planar[parts]
        facet[chosen] = _first_faces(parts)[chosen]
        settled |= chosen
    return np.unique(facet, return_inverse=True)[1].astype(np.int64)


def _departures(polyhedra: Polyhedra, faces: FaceGeometry, pairs: IntArray) -> FloatArray:
    """Greatest distance of a corner of the second face of each pair from the plane of the first, (n_pairs,)."""
    plane, other = pairs[:, 0], pairs[:, 1]
    counts = np.diff(polyhedra.loop_start)[other]
    corners = polyhedra.local_vertices[polyhedra.loops[items_of_rows(polyhedra.loop_start, other)]]
    each = np.repeat(plane, counts)
    distances = np.abs(np.einsum("ij,ij->i", corners - faces.centres[each], faces.normals[each]))
    return row_maxima(distances, starts(counts))


def _planar_parts(polyhedra: Polyhedra, faces: FaceGeometry, parts: IntArray, allowed: FloatArray) -> BoolArray:
    """True for each part whose corners all lie within ``allowed`` of the plane fitted to it, (n_parts,)."""
    n_parts = int(parts.max()) + 1
    weights = faces.areas
    area = np.bincount(parts, weights, n_parts)
    normals, centres = np.empty((n_parts, 3)), np.empty((n_parts, 3))
    for axis in range(3):
        normals[:, axis] = np.bincount(parts, weights * faces.normals[:, axis], n_parts) / area
        centres[:, axis] = np.bincount(parts, weights * faces.centres[:, axis], n_parts) / area
    lengths = np.linalg.norm(normals, axis=1)
    closes = lengths < STEEPEST  # the faces go round a curve, all the way round they cancel each other
    normals /= np.where(closes, 1.0, lengths)[:, None]
    part = parts[polyhedra.face_of_corner]
    arms = polyhedra.local_vertices[polyhedra.loops] - centres[part]
    distances = np.abs(np.einsum("ij,ij->i", arms, normals[part]))
    outside = distances > allowed[polyhedra.block_of_face[polyhedra.face_of_corner]]
    planar: BoolArray = ~closes
    planar[part[outside]] = False
    return planar


def _first_faces(parts: IntArray) -> IntArray:
    """For each face the first face of its part, (n_faces,)."""
    first = np.unique(parts, return_index=True)[1]
    return np.asarray(first[parts], dtype=np.int64)
