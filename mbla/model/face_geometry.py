"""Planes of faces: Newell normals and departures from them.

The area vector of a closed polygon p_0 ... p_{n-1} about any point c is (Newell)

    A = 1/2 sum (p_i - c) x (p_{i+1} - c),

exact for planar polygons, convex or not, and the best-fitting orientation for others.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.polyhedra import Polyhedra
from mbla.model.ragged import next_item, row_maxima, row_means, row_sums


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
