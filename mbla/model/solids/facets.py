"""Faces that lie on one plane joined to facets, and faces that lie on none split into triangles.

Facets are faces of one block that share edges and lie on one plane, within the tolerance: meshes split planar surfaces
into triangles or quadrilaterals, and contacts are found between complete facets.

Bent faces have corners that leave their plane by more than the tolerance. Outlines of free faces (a rubble face, a
doubly curved extrados) decide volume and mass only, and two triangles in place of a bent quadrilateral are as good.
Common surfaces need planes. Two bent faces with the same corners are split alike, so that their triangles touch, and
what one block loses the other gains. Where another bent face turns out to touch something, the search for contacts
refuses it (:mod:`mbla.contacts.findings`).

A quadrilateral is folded along its shorter diagonal. Where both are equally long, as in a ruled surface on a rectangle,
and with more corners, triangles lead from each edge to the centre: nothing depends on axes or on the order of corners.

The triangles of a face take its number and numbers behind those of all other faces of its block, which keep theirs.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.solids.measures import Edges, FaceGeometry, connected_labels
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import items_of_rows, ranges, row_maxima
from mbla.model.solids.shared_faces import face_corners, matched_corners

STEEPEST = 0.99
"""cosine of the greatest angle between neighbouring faces of one facet, about 8 degrees"""
LADDER = (1.0, 0.1, 0.01, 0.001)
"""parts of the tolerance tried in turn: a surface with many small faces, each nearly in line with the next, may be
curved in total; then only faces that lie closer to each other's planes are joined"""


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
        facet[chosen] = np.unique(parts, return_index=True)[1][parts][chosen]
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


EVEN = 1e-3
"""relative difference of two diagonals that are equally long up to what files round"""

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
    twins      : (m,) block that has a face with the same corners, split alike; -1 for none
    """

    blocks: IntArray
    faces: IntArray
    deviations: FloatArray
    triangles: FloatArray
    row: IntArray
    items: IntArray
    twins: IntArray

    def __len__(self) -> int:
        return len(self.blocks)


NO_BENT_FACES = BentFaces(
    _NO_NUMBERS, _NO_NUMBERS, np.zeros(0), np.zeros((0, 3, 3)), _NO_NUMBERS, _NO_NUMBERS, _NO_NUMBERS
)


def can_be_split(polyhedra: Polyhedra, faces: FaceGeometry, chosen: IntArray) -> BoolArray:
    """Whether faces are convex as seen along their normals: then any fan of triangles is as good, (n_chosen,)."""
    convex = np.zeros(len(chosen), dtype=bool)
    for number, face in enumerate(chosen.tolist()):
        corners = polyhedra.local_vertices[polyhedra.loop(face)]
        arms = np.diff(corners, axis=0, append=corners[:1])
        turns = np.cross(arms, np.roll(arms, -1, axis=0)) @ faces.normals[face]
        convex[number] = (turns > 0).all()
    return convex


def split_faces(
    polyhedra: Polyhedra, faces: FaceGeometry, chosen: IntArray, twins: IntArray
) -> tuple[Polyhedra, BentFaces]:
    """The same polyhedra with triangles in place of the chosen faces, (n,) ascending, and these.

    twins : (n,) face of another polyhedron with the same corners, -1 for none
    """
    about = np.array(
        [_about(polyhedra, face, twin) for face, twin in zip(chosen.tolist(), twins.tolist(), strict=True)]
    )
    hubs = chosen[about < 0]
    polyhedra, hub = _with_hubs(polyhedra, faces, hubs)
    of_face = dict(zip(hubs.tolist(), hub.tolist(), strict=True))
    fans = [
        _fan(polyhedra.loop(face), first) if first >= 0 else _star(polyhedra.loop(face), of_face[face])
        for face, first in zip(chosen.tolist(), about.tolist(), strict=True)
    ]
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
        twins=np.where(twins < 0, -1, polyhedra.block_of_face[twins]),
    )
    split = Polyhedra(polyhedra.vertices, polyhedra.vertex_start, loops, starts(length[order]), face_start)
    return split, bent


def _about(polyhedra: Polyhedra, face: int, twin: int) -> int:
    """Corner about which a fan of triangles takes the place of a convex face; -1 for a star about its centre.

    A quadrilateral is folded along its shorter diagonal. Where neither is shorter, nothing but the axes of coordinates
    could tell one from the other; so it is with more corners. Of two faces with the same corners the mean decides.
    """
    corners = face_corners(polyhedra, face)
    if twin >= 0:
        corners = (corners + face_corners(polyhedra, twin)[matched_corners(polyhedra, face, twin)]) / 2
    if len(corners) != 4:
        return -1
    diagonals = np.linalg.norm(corners[:2] - corners[2:], axis=1)
    uneven = abs(diagonals[0] - diagonals[1]) > EVEN * diagonals.max()
    return int(np.argmin(diagonals)) if uneven else -1


def _with_hubs(polyhedra: Polyhedra, faces: FaceGeometry, chosen: IntArray) -> tuple[Polyhedra, IntArray]:
    """The polyhedra with the centres of the chosen faces, (n,), as vertices behind their own, and their rows, (n,)."""
    if not len(chosen):
        return polyhedra, np.zeros(0, dtype=np.int64)
    block = polyhedra.block_of_face[chosen]
    order = np.argsort(block, kind="stable")
    centres = polyhedra.origins[block] + faces.centres[chosen]
    more = np.bincount(block, minlength=len(polyhedra))
    before = starts(more.astype(np.int64))
    moved = np.arange(len(polyhedra.vertices)) + before[polyhedra.block_of_vertex]
    vertices = np.insert(polyhedra.vertices, polyhedra.vertex_start[1:][block[order]], centres[order], axis=0)
    hub = np.empty(len(chosen), dtype=np.int64)
    hub[order] = polyhedra.vertex_start[1:][block[order]] + np.arange(len(chosen))
    extended = replace(
        polyhedra, vertices=vertices, vertex_start=polyhedra.vertex_start + before, loops=moved[polyhedra.loops]
    )
    return extended, hub


def _star(loop: IntArray, hub: int) -> IntArray:
    """Triangles from each edge of a face, corners (n,), to its centre, (n, 3) rows of vertices."""
    return np.stack([loop, np.roll(loop, -1), np.full(len(loop), hub)], axis=1)


def _fan(loop: IntArray, about: int) -> IntArray:
    """Triangles of a convex face, corners (n,), about one of them, (n - 2, 3) rows of vertices."""
    fan = np.roll(loop, -about)
    return np.stack([np.broadcast_to(fan[0], len(fan) - 2), fan[1:-1], fan[2:]], axis=1)
