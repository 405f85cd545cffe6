"""Faces that two blocks share corner by corner, as stereotomy makes them."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.measures import FaceGeometry
from mbla.model.solids.polyhedra import Polyhedra


def face_corners(polyhedra: Polyhedra, face: int) -> FloatArray:
    """Corners of a face, (n, 3)."""
    return np.asarray(polyhedra.vertices[polyhedra.loop(face)])


def shared_faces(polyhedra: Polyhedra, faces: FaceGeometry, chosen: IntArray, reach: FloatArray) -> IntArray:
    """The face of another polyhedron that has the same corners as each of the chosen faces, (n,); -1 for none.

    reach : (n,) distance up to which two corners are the same
    """
    from scipy.spatial import cKDTree

    found = np.full(len(chosen), -1, dtype=np.int64)
    if not len(chosen):
        return found
    block, counts = polyhedra.block_of_face, np.diff(polyhedra.loop_start)
    centres = polyhedra.origins[block] + faces.centres
    near = cKDTree(centres).query_ball_point(centres[chosen], reach, return_sorted=True)
    for row, (face, others) in enumerate(zip(chosen.tolist(), near, strict=True)):
        for other in others:
            if block[other] == block[face] or counts[other] != counts[face]:
                continue
            pairs = matched_corners(polyhedra, face, other)
            away = np.linalg.norm(face_corners(polyhedra, face) - face_corners(polyhedra, other)[pairs], axis=1)
            if len(np.unique(pairs)) == len(pairs) and away.max() <= reach[row]:
                found[row] = other
                break
    return found


def matched_corners(polyhedra: Polyhedra, face: int, other: int) -> IntArray:
    """For each corner of a face the nearest one of another, (n,)."""
    arms = face_corners(polyhedra, face)[:, None] - face_corners(polyhedra, other)[None]
    return np.asarray(np.linalg.norm(arms, axis=2).argmin(axis=1))
