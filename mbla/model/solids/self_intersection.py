"""Polyhedra whose surface passes through itself.

Two planar faces that cross do so along a segment, and each end of it is a place where an edge of one goes through the
other; so it is enough to test edges against faces. Edges in the plane of a face are tested against its outline.
Convex polyhedra need no test.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.errors import Message
from mbla.model.solids.defects import Defect, Extents
from mbla.model.solids.measures import Edges, FaceGeometry
from mbla.model.solids.plane import meeting_boxes, plane_axes
from mbla.model.solids.polyhedra import Polyhedra
from mbla.model.solids.ragged import chunks, items_of_rows, row_ranges

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

    Polyhedra are laid out next to each other along x, three diagonals apart, for one search among all of them.
    """
    scale = 1 / np.where(extents.diagonals > 0, extents.diagonals, 1.0)
    of_vertex = polyhedra.block_of_vertex
    places = polyhedra.local_vertices * scale[of_vertex, None]
    places[:, 0] += 3.0 * of_vertex
    ends, corners = places[edges.ends], places[polyhedra.loops]
    start = polyhedra.loop_start
    return meeting_boxes(ends.min(axis=1) - MARGIN, ends.max(axis=1) + MARGIN, *row_ranges(corners, start))


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
    through = (distance.min(axis=1) < -slack) & (distance.max(axis=1) > slack)
    corner = _corner_of_face(polyhedra, ends, face)
    touching = (np.abs(distance) <= eps[:, None]) & ~corner
    share = np.divide(distance[:, 0], distance[:, 0] - distance[:, 1], out=np.zeros(len(edge)), where=through)
    crossing = points[:, 0] + share[:, None] * (points[:, 1] - points[:, 0])
    meets = np.zeros(len(edge), dtype=bool)
    for chosen, place in ((through, crossing), (touching[:, 0], points[:, 0]), (touching[:, 1], points[:, 1])):
        rows = np.flatnonzero(chosen)
        outlines, places = _in_planes(polyhedra, faces, face[rows], place[rows][:, None])
        meets[rows] |= shapely.dwithin(outlines, shapely.points(places[:, 0]), eps[rows])
    in_plane = np.flatnonzero((touching | corner).all(axis=1) & ~meets)
    outlines, places = _in_planes(polyhedra, faces, face[in_plane], points[in_plane])
    lines = shapely.linestrings(places)
    # an edge of the face itself runs along its outline; one that crosses it makes that outline cross itself
    meets[in_plane] = ~shapely.is_valid(outlines)
    sound = in_plane[~meets[in_plane]]
    within = shapely.buffer(outlines[~meets[in_plane]], -eps[sound])
    meets[sound] = shapely.intersects(within, lines[~meets[in_plane]])
    return meets


def _corner_of_face(polyhedra: Polyhedra, ends: IntArray, face: IntArray) -> BoolArray:
    """True where an end of an edge is a corner of the face, (n_pairs, 2)."""
    counts = np.diff(polyhedra.loop_start)[face]
    corners = polyhedra.loops[items_of_rows(polyhedra.loop_start, face)]
    same = np.repeat(ends, counts, axis=0) == corners[:, None]
    return np.asarray(np.logical_or.reduceat(same, starts(counts)[:-1], axis=0))


def _in_planes(polyhedra: Polyhedra, faces: FaceGeometry, face: IntArray, points: FloatArray) -> tuple[Any, FloatArray]:
    """Outlines of faces, (n,), and points for each, (n, k, 3), in coordinates of their planes, (n, k, 2)."""
    axes, counts = plane_axes(faces.normals[face]), np.diff(polyhedra.loop_start)[face]
    ring = np.repeat(np.arange(len(face)), counts)
    corners = polyhedra.local_vertices[polyhedra.loops[items_of_rows(polyhedra.loop_start, face)]]
    flat = np.einsum("nj,nij->ni", corners - faces.centres[face][ring], axes[ring])
    places = np.einsum("nkj,nij->nki", points - faces.centres[face][:, None], axes)
    if not len(face):
        return np.empty(0, dtype=object), places
    return np.atleast_1d(shapely.polygons(shapely.linearrings(flat, indices=ring))), places
