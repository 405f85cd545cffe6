"""Polyhedra whose surface passes through itself.

Two planar faces that cross do so along a segment, and each end of it is a place where an edge of one goes through the
other; so it is enough to test edges against faces. Edges in the plane of a face are tested against its outline.
Convex polyhedra need no test.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.errors import Message
from mbla.model.solids.defects import Defect, Extents
from mbla.model.solids.measures import Edges, FaceGeometry
from mbla.model.solids.plane import meeting_boxes, plane_axes
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import chunks, items_of_rows, next_item, row_maxima

AT_ONCE = 500_000
"""edge-face pairs held in memory together"""
MARGIN = 1e-6
"""by which boxes are larger than edges, relative to the diagonal"""
TOUCH = 1e-9
"""distance, relative to the diagonal, below which a point lies on a plane or an outline"""


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
    """Edges and faces of one polyhedron whose bounding boxes meet; with the face's own, for outlines that cross.

    Polyhedra are laid out beside each other along x, three diagonals apart, for one search among all of them.
    """
    scale = 1 / np.where(extents.diagonals > 0, extents.diagonals, 1.0)
    of_vertex = polyhedra.block_of_vertex
    places = polyhedra.local_vertices * scale[of_vertex, None]
    places[:, 0] += 3.0 * of_vertex
    ends, corners = places[edges.ends], places[polyhedra.loops]
    start = polyhedra.loop_start
    edge, face = meeting_boxes(
        ends.min(axis=1) - MARGIN, ends.max(axis=1) + MARGIN, -row_maxima(-corners, start), row_maxima(corners, start)
    )
    return edge, face


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
