"""Faces whose corners leave their plane by more than the tolerance, split into triangles.

Outlines of free faces (a rubble face, a doubly curved extrados) decide volume and mass only, and two triangles in
place of a bent quadrilateral are as good. Common surfaces need planes: where a bent face turns out to touch something,
the search for contacts refuses it (:mod:`mbla.contacts.findings`). Two bent faces with the same corners are split
along the same diagonal, so that they are found to touch.

The triangles of a face take its number and numbers behind those of all other faces of its block, which keep theirs.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.face_geometry import FaceGeometry
from mbla.model.polyhedra import Polyhedra
from mbla.model.ragged import ranges

EVEN = 1e-3
"""relative difference of two diagonals that are equally long up to what files round"""
_ODD_DIRECTION = np.array([0.5403023, 0.2919266, 0.7892347])
"""no building is likely to be square to it: of equal diagonals the one that reaches farthest along it is taken"""


_NO_NUMBERS = np.zeros(0, dtype=np.int64)


@dataclass(frozen=True)
class BentFaces:
    """Faces that were split, m of them, into n triangles.

    blocks     : (m,)
    faces      : (m,) number of each in its block
    deviations : (m,) greatest distance of a corner from the plane fitted to the face, length
    triangles  : (n, 3, 3) corners, counter-clockwise seen from outside
    row        : (n,) face of each triangle, ascending
    items      : (m,) item of the deck that each block comes from, 0 where there is no deck
    """

    blocks: IntArray
    faces: IntArray
    deviations: FloatArray
    triangles: FloatArray
    row: IntArray
    items: IntArray

    def __len__(self) -> int:
        return len(self.blocks)


NO_BENT_FACES = BentFaces(_NO_NUMBERS, _NO_NUMBERS, np.zeros(0), np.zeros((0, 3, 3)), _NO_NUMBERS, _NO_NUMBERS)


def can_be_split(polyhedra: Polyhedra, faces: FaceGeometry, chosen: IntArray) -> BoolArray:
    """Whether faces are convex as seen along their normals: then any fan of triangles is as good, (n_chosen,)."""
    convex = np.zeros(len(chosen), dtype=bool)
    for number, face in enumerate(chosen.tolist()):
        arms = np.diff(_corners(polyhedra, face), axis=0, append=_corners(polyhedra, face)[:1])
        turns = np.cross(arms, np.roll(arms, -1, axis=0)) @ faces.normals[face]
        convex[number] = (turns > 0).all()
    return convex


def split_faces(polyhedra: Polyhedra, faces: FaceGeometry, chosen: IntArray) -> tuple[Polyhedra, BentFaces]:
    """The same polyhedra with triangles in place of the chosen faces, ascending, and these."""
    fans = [_fan(polyhedra, face) for face in chosen.tolist()]
    counts = np.array([len(fan) for fan in fans], dtype=np.int64)
    triangles, row = np.concatenate(fans), np.repeat(np.arange(len(chosen)), counts)
    others = np.setdiff1d(np.arange(len(polyhedra.block_of_face)), chosen)
    block = polyhedra.block_of_face[np.concatenate([others, chosen[row]])]
    # the first triangle takes the place of its face, the others come behind all faces
    number = np.concatenate([others, chosen[row]])
    number[len(others) :][np.diff(row, prepend=-1) == 0] += len(polyhedra.block_of_face)
    order = np.lexsort((number, block))
    length = np.concatenate([np.diff(polyhedra.loop_start)[others], np.full(len(triangles), 3)])
    first = np.concatenate([polyhedra.loop_start[others], len(polyhedra.loops) + 3 * np.arange(len(triangles))])
    loops = np.concatenate([polyhedra.loops, triangles.ravel()])[ranges(first[order], length[order])]
    face_start = starts(np.bincount(block, minlength=len(polyhedra)).astype(np.int64))
    bent = BentFaces(
        blocks=polyhedra.block_of_face[chosen],
        faces=chosen - polyhedra.face_start[polyhedra.block_of_face[chosen]],
        deviations=faces.deviations[chosen],
        triangles=polyhedra.vertices[triangles],
        row=row,
        items=np.zeros(len(chosen), dtype=np.int64),
    )
    split = Polyhedra(polyhedra.vertices, polyhedra.vertex_start, loops, starts(length[order]), face_start)
    return split, bent


def _corners(polyhedra: Polyhedra, face: int) -> FloatArray:
    """Corners of a face about the origin of its polyhedron, (n, 3)."""
    loop = polyhedra.loops[polyhedra.loop_start[face] : polyhedra.loop_start[face + 1]]
    return np.asarray(polyhedra.local_vertices[loop])


def _fan(polyhedra: Polyhedra, face: int) -> IntArray:
    """Triangles of a convex face about one of its corners, (n - 2, 3) rows of vertices.

    That of a quadrilateral lies on its shorter diagonal, of equal ones on that which reaches farther along an odd
    direction; that of any other face lies farthest along it.
    """
    loop = polyhedra.loops[polyhedra.loop_start[face] : polyhedra.loop_start[face + 1]]
    corners = _corners(polyhedra, face)
    along = corners @ _ODD_DIRECTION
    about = int(np.argmax(along))
    if len(loop) == 4:
        diagonals = np.linalg.norm(corners[:2] - corners[2:], axis=1)
        uneven = abs(diagonals[0] - diagonals[1]) > EVEN * diagonals.max()
        about = int(np.argmin(diagonals)) if uneven else about
    fan = np.roll(loop, -about)
    return np.stack([np.broadcast_to(fan[0], len(fan) - 2), fan[1:-1], fan[2:]], axis=1)
