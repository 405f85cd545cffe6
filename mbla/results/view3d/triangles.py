"""Faces of blocks as triangles: fans of convex faces in bulk, constrained Delaunay triangles of the others."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.contacts.polygons import triangulate
from mbla.model.solids.blocks import Blocks

ROUNDING = 1e-9
"""of the square of a face's size: turns smaller than this are straight"""


def face_triangles(blocks: Blocks) -> tuple[IntArray, IntArray]:
    """Corners of triangles as rows of ``vertices``, (n, 3), counter-clockwise seen from outside, and their faces, (n,).

    Sorted by faces, and so by blocks. No vertex is added. A face that no triangulation covers, as its outline crosses
    itself, is a fan about its first corner.
    """
    counts = np.diff(blocks.loop_start)
    reentrant = reentrant_faces(blocks)
    faces = np.repeat(np.arange(len(counts)), np.where(reentrant, 0, counts - 2))
    fans = _fans(blocks, faces)
    others = [_of_reentrant(blocks, face) for face in np.flatnonzero(reentrant).tolist()]
    rows = [np.full(len(each), face) for face, each in zip(np.flatnonzero(reentrant).tolist(), others, strict=True)]
    corners, owners = np.concatenate([fans, *others]), np.concatenate([faces, *rows])
    order = np.argsort(owners, kind="stable")
    return corners[order], owners[order]


def _fans(blocks: Blocks, faces: IntArray) -> IntArray:
    """Triangles about the first corner of each face, in order; a face stands there once for each of its triangles."""
    new = np.ones(len(faces), dtype=bool)
    new[1:] = faces[1:] != faces[:-1]
    first = starts(np.diff(np.append(np.flatnonzero(new), len(faces))))
    step = np.arange(len(faces)) - first[row_of_item(first)]
    begin = blocks.loop_start[faces]
    return np.column_stack([blocks.loops[begin], blocks.loops[begin + step + 1], blocks.loops[begin + step + 2]])


def reentrant_faces(blocks: Blocks) -> BoolArray:
    """Faces with a corner that turns inwards, (n_faces,)."""
    corners = blocks.vertices[blocks.loops]
    rows = np.arange(len(blocks.loops))
    following, preceding = rows + 1, rows - 1
    following[blocks.loop_start[1:] - 1] = blocks.loop_start[:-1]
    preceding[blocks.loop_start[:-1]] = blocks.loop_start[1:] - 1
    ahead, behind = corners[following] - corners, corners - corners[preceding]
    face = row_of_item(blocks.loop_start)
    turns = np.einsum("ij,ij->i", np.cross(behind, ahead), blocks.face_normals[face])
    size = np.zeros(len(blocks.face_normals))
    np.maximum.at(size, face, np.square(ahead).sum(axis=1))
    reentrant = np.zeros(len(size), dtype=bool)
    reentrant[face[turns < -ROUNDING * size[face]]] = True
    return reentrant


def _of_reentrant(blocks: Blocks, face: int) -> IntArray:
    loop = blocks.loops[blocks.loop_start[face] : blocks.loop_start[face + 1]]
    normal = blocks.face_normals[face]
    along = np.cross(normal, np.eye(3)[np.argmin(np.abs(normal))])
    points = blocks.vertices[loop] - blocks.vertices[loop[0]]
    flat = np.column_stack([points @ along, points @ np.cross(normal, along)])
    return np.asarray(loop[triangulate(flat)])


def triangle_normals(points: FloatArray, triangles: IntArray) -> FloatArray:
    """Unit normals, (n, 3); zero for triangles without area."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    return np.asarray(normals / np.where(lengths > 0, lengths, 1.0)[:, None])
