"""Polyhedra whose surface passes through itself.

Two planar faces that cross do so along a segment, and each end of it is a place where an edge of one goes through the
other; so it is enough to test edges against faces. Edges in the plane of a face are tested against its outline.
Convex polyhedra need no test.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.errors import Message
from mbla.model.solids.defects import Defect, Extents
from mbla.model.solids.measures import Edges, FaceGeometry
from mbla.model.solids.plane import plane_axes
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import chunks, items_of_rows, next_item, ranges, row_maxima

AT_ONCE = 500_000
"""edge-face pairs held in memory together"""
TOUCH = 1e-9
"""distance, relative to the diagonal, below which a point lies on a plane or an outline"""


@dataclass(frozen=True)
class _Boxes:
    """Bounding boxes of edges or faces about the local origin, (n, 3) each."""

    least: FloatArray
    greatest: FloatArray


def intersection_defects(polyhedra: Polyhedra, edges: Edges, faces: FaceGeometry, extents: Extents) -> list[Defect]:
    """One defect for each polyhedron that has an edge going through, or touching, a face it does not belong to."""
    edge, face = _near_pairs(polyhedra, edges, extents)
    hits = []
    counts = np.diff(polyhedra.loop_start)[face]
    for part in chunks(counts, AT_ONCE):
        hit = _edge_meets_face(polyhedra, edges, faces, extents, edge[part], face[part])
        hits.append(np.stack([edge[part][hit], face[part][hit]], axis=1))
    found = np.concatenate(hits) if hits else np.empty((0, 2), dtype=np.int64)
    blocks, first = np.unique(edges.block[found[:, 0]], return_index=True)
    defects = []
    for block, (one, other) in zip(blocks.tolist(), found[first].tolist(), strict=True):
        tail, head = edges.ends[one] - polyhedra.vertex_start[block]
        number = other - int(polyhedra.face_start[block])
        message = f"intersects itself: the edge between vertices {tail} and {head} meets face {number}"
        defects.append(Defect(block, Message("bad-polyhedron", message), number))
    return defects


def _near_pairs(polyhedra: Polyhedra, edges: Edges, extents: Extents) -> tuple[IntArray, IntArray]:
    """Edges and faces of one polyhedron whose bounding boxes overlap; with the face's own, for outlines that cross.

    A sweep along x: faces are sorted by their least x inside each polyhedron, so that the candidates of an edge are
    a run of that order; the other two axes are compared pair by pair.
    """
    edge_boxes, face_boxes = _edge_boxes(polyhedra, edges), _face_boxes(polyhedra)
    scale = 1 / np.where(extents.diagonals > 0, extents.diagonals, 1.0)
    of_face, of_edge = polyhedra.block_of_face, edges.block
    # polyhedra are laid out beside each other, three diagonals apart, for one sort and one search
    face_low = face_boxes.least[:, 0] * scale[of_face] + 3.0 * of_face
    face_high = face_boxes.greatest[:, 0] * scale[of_face] + 3.0 * of_face
    width = row_maxima(face_high - face_low, polyhedra.face_start)
    order = np.argsort(face_low, kind="stable")
    margin = 1e-6
    low = edge_boxes.least[:, 0] * scale[of_edge] + 3.0 * of_edge - width[of_edge] - margin
    high = edge_boxes.greatest[:, 0] * scale[of_edge] + 3.0 * of_edge + margin
    first = np.searchsorted(face_low[order], low)
    counts = np.searchsorted(face_low[order], high, side="right") - first
    kept: list[tuple[IntArray, IntArray]] = []
    for part in chunks(counts, 4 * AT_ONCE):
        edge = np.repeat(np.arange(len(counts))[part], counts[part])
        face = order[ranges(first[part], counts[part])]
        near = _boxes_overlap(edge_boxes, edge, face_boxes, face, TOUCH * extents.diagonals[of_edge[edge]])
        near &= of_edge[edge] == of_face[face]
        kept.append((edge[near], face[near]))
    edge = np.concatenate([pair[0] for pair in kept]) if kept else np.empty(0, dtype=np.int64)
    face = np.concatenate([pair[1] for pair in kept]) if kept else np.empty(0, dtype=np.int64)
    return edge, face


def _edge_boxes(polyhedra: Polyhedra, edges: Edges) -> _Boxes:
    ends = polyhedra.local_vertices[edges.ends]
    return _Boxes(ends.min(axis=1), ends.max(axis=1))


def _face_boxes(polyhedra: Polyhedra) -> _Boxes:
    corners = polyhedra.local_vertices[polyhedra.loops]
    return _Boxes(-row_maxima(-corners, polyhedra.loop_start), row_maxima(corners, polyhedra.loop_start))


def _boxes_overlap(one: _Boxes, rows: IntArray, other: _Boxes, columns: IntArray, margin: FloatArray) -> BoolArray:
    apart = (one.least[rows] > other.greatest[columns] + margin[:, None]).any(axis=1)
    apart |= (other.least[columns] > one.greatest[rows] + margin[:, None]).any(axis=1)
    return np.asarray(~apart)


def _edge_meets_face(
    polyhedra: Polyhedra, edges: Edges, faces: FaceGeometry, extents: Extents, edge: IntArray, face: IntArray
) -> BoolArray:
    """True where an edge passes through or touches a face away from the vertices they share, (n_pairs,)."""
    ends = edges.ends[edge]
    eps = np.maximum(TOUCH * extents.diagonals, 4 * extents.rounding)[edges.block[edge]]
    points = polyhedra.local_vertices[ends]
    normals = faces.normals[face]
    distance = np.einsum("ijk,ik->ij", points - faces.centres[face][:, None, :], normals)
    # a corner that leaves a face within the tolerance must not count as going through it
    slack = np.maximum(eps, 2 * faces.deviations[face])
    near, far = distance.min(axis=1), distance.max(axis=1)
    through = (near < -slack) & (far > slack)
    corner = _corner_of_face(polyhedra, ends, face)
    touching = (np.abs(distance) <= eps[:, None]) & ~corner
    in_plane = (touching | corner).all(axis=1)
    share = np.divide(distance[:, 0], distance[:, 0] - distance[:, 1], out=np.zeros(len(edge)), where=through)
    crossing = points[:, 0] + share[:, None] * (points[:, 1] - points[:, 0])
    middle = points.mean(axis=1)
    meets = np.zeros(len(edge), dtype=bool)
    for chosen, place in ((through, crossing), (touching[:, 0], points[:, 0]), (touching[:, 1], points[:, 1])):
        rows = np.flatnonzero(chosen)
        meets[rows] |= _inside(polyhedra, faces, face[rows], place[rows], eps[rows], outline_counts=True)
    rows = np.flatnonzero(in_plane)
    # the middle of a face's own edge is on its outline
    meets[rows] |= _inside(polyhedra, faces, face[rows], middle[rows], eps[rows], outline_counts=False)
    meets[rows] |= _crosses_outline(polyhedra, faces, face[rows], points[rows], eps[rows])
    return meets


def _corner_of_face(polyhedra: Polyhedra, ends: IntArray, face: IntArray) -> BoolArray:
    """True where an end of an edge is a corner of the face, (n_pairs, 2)."""
    counts = np.diff(polyhedra.loop_start)[face]
    corners = polyhedra.loops[items_of_rows(polyhedra.loop_start, face)]
    same = np.repeat(ends, counts, axis=0) == corners[:, None]
    return np.asarray(np.logical_or.reduceat(same, starts(counts)[:-1], axis=0))


def _plane_outlines(
    polyhedra: Polyhedra, faces: FaceGeometry, face: IntArray
) -> tuple[FloatArray, FloatArray, IntArray, FloatArray]:
    """Outlines of faces in coordinates of their planes: tails and heads (n, 2), start, and the axes (n_faces, 2, 3)."""
    normals = faces.normals[face]
    axes = plane_axes(normals)
    counts = np.diff(polyhedra.loop_start)[face]
    start = starts(counts)
    corners = polyhedra.local_vertices[polyhedra.loops[items_of_rows(polyhedra.loop_start, face)]]
    corners = corners - np.repeat(faces.centres[face], counts, axis=0)
    tails = np.einsum("ijk,ik->ij", np.repeat(axes, counts, axis=0), corners)
    return tails, tails[next_item(start)], start, axes


def _inside(
    polyhedra: Polyhedra,
    faces: FaceGeometry,
    face: IntArray,
    points: FloatArray,
    eps: FloatArray,
    outline_counts: bool,
) -> BoolArray:
    """True where a point in the plane of a face lies inside its outline, and on it if that counts, (n_pairs,)."""
    tails, heads, start, axes = _plane_outlines(polyhedra, faces, face)
    counts = np.diff(start)
    place = np.repeat(np.einsum("ijk,ik->ij", axes, points - faces.centres[face]), counts, axis=0)
    along, arms = heads - tails, place - tails
    rises = (tails[:, 1] > place[:, 1]) != (heads[:, 1] > place[:, 1])
    slope = np.divide(along[:, 0], along[:, 1], out=np.zeros(len(along)), where=rises)
    right = rises & (arms[:, 0] < slope * arms[:, 1])
    share = np.clip(np.einsum("ij,ij->i", arms, along) / np.einsum("ij,ij->i", along, along), 0, 1)
    clear = np.linalg.norm(arms - share[:, None] * along, axis=1) > np.repeat(eps, counts)
    odd = np.add.reduceat(right.astype(np.int64), start[:-1]) % 2 == 1
    off_outline = np.logical_and.reduceat(clear, start[:-1])
    return np.asarray(odd | ~off_outline if outline_counts else odd & off_outline)


def _crosses_outline(
    polyhedra: Polyhedra, faces: FaceGeometry, face: IntArray, points: FloatArray, eps: FloatArray
) -> BoolArray:
    """True where an edge in the plane of a face crosses a side of its outline at an inner point of both, (n_pairs,)."""
    tails, heads, start, axes = _plane_outlines(polyhedra, faces, face)
    counts = np.diff(start)
    flat = np.einsum("ijk,imk->imj", axes, points - faces.centres[face][:, None, :])
    one, other = np.repeat(flat[:, 0], counts, axis=0), np.repeat(flat[:, 1], counts, axis=0)
    margin = np.repeat(eps, counts)
    proper = _strictly_apart(one, other, tails, heads, margin) & _strictly_apart(tails, heads, one, other, margin)
    return np.asarray(np.logical_or.reduceat(proper, start[:-1]))


def _strictly_apart(
    tails: FloatArray, heads: FloatArray, one: FloatArray, other: FloatArray, margin: FloatArray
) -> BoolArray:
    """True where two points lie on different sides of the line through tail and head, off it by more than a margin."""
    along = heads - tails
    length = np.linalg.norm(along, axis=1)
    left = (along[:, 0] * (one - tails)[:, 1] - along[:, 1] * (one - tails)[:, 0]) / length
    right = (along[:, 0] * (other - tails)[:, 1] - along[:, 1] * (other - tails)[:, 0]) / length
    return np.asarray((left * right < 0) & (np.minimum(np.abs(left), np.abs(right)) > margin))
