"""Vertices at the same place made one, inside each polyhedron, and what collapses with them."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from itertools import chain
from typing import TypeVar

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.polyhedra import Polyhedra, drop_unused_vertices
from mbla.model.solids.ragged import next_item

Label = TypeVar("Label", bound=Hashable)


@dataclass(frozen=True)
class Welded:
    """Polyhedra after welding, how many vertices were merged, and how many faces collapsed to a line or point."""

    polyhedra: Polyhedra
    merged: int
    collapsed: int


def weld(polyhedra: Polyhedra) -> Welded:
    """Merge vertices with equal coordinates; faces lose corners that repeat, and go when fewer than three are left.

    A collapsed face takes both sides of its edges with it, so that a closed surface stays closed. Faces of volume
    cells that collapse (a hexahedron given as a wedge) go the same way.
    """
    x, y, z = (polyhedra.vertices + 0.0).T  # -0.0 becomes 0.0
    block = polyhedra.block_of_vertex
    order = np.lexsort((x, y, z, block))
    keys = np.stack([block[order].astype(np.float64), x[order], y[order], z[order]])
    new = np.any(keys[:, 1:] != keys[:, :-1], axis=0)
    if new.all():
        return Welded(polyhedra, 0, 0)
    leader = order[np.concatenate([[0], np.flatnonzero(new) + 1])]
    target = np.empty(len(order), dtype=np.int64)
    target[order] = leader[np.concatenate([[0], np.cumsum(new)])]
    return _merged(polyhedra, target)


def weld_near(polyhedra: Polyhedra, vertices: IntArray, reach: FloatArray) -> Welded:
    """Merge vertices of one polyhedron that lie closer to each other than either of them reaches.

    vertices : those that may be merged
    reach    : (n,) distance within which each takes others
    """
    from scipy.spatial import cKDTree

    points = polyhedra.vertices[vertices]
    neighbours = cKDTree(points).query_ball_point(points, reach, return_sorted=True)
    one = np.repeat(np.arange(len(vertices)), [len(each) for each in neighbours])
    other = np.fromiter(chain.from_iterable(neighbours), dtype=np.int64, count=len(one))
    apart = np.linalg.norm(points[one] - points[other], axis=1)
    block = polyhedra.block_of_vertex[vertices]
    near = (one < other) & (apart <= reach[other]) & (block[one] == block[other])
    if not near.any():
        return Welded(polyhedra, 0, 0)
    labels = connected_labels(np.stack([one[near], other[near]], axis=1), len(vertices))
    first = np.unique(labels, return_index=True)[1]
    target = np.arange(len(polyhedra.vertices))
    target[vertices] = vertices[first[labels]]
    return _merged(polyhedra, target)


def _merged(polyhedra: Polyhedra, target: IntArray) -> Welded:
    """Every vertex replaced by its target, (n_vertices,) rows of vertices of the same polyhedron."""
    loops = target[polyhedra.loops]
    kept = loops != loops[next_item(polyhedra.loop_start)]
    corners = np.bincount(polyhedra.face_of_corner[kept], minlength=len(polyhedra.block_of_face))
    valid = corners >= 3
    kept &= valid[polyhedra.face_of_corner]
    merged = int((target != np.arange(len(target))).sum())
    return Welded(_with_faces(polyhedra, loops[kept], corners[valid], valid), merged, int((~valid).sum()))


def take_faces(polyhedra: Polyhedra, kept: BoolArray) -> Polyhedra:
    """The same polyhedra with some of their faces only, (n_faces,); vertices that no face uses go with the others."""
    loops = polyhedra.loops[kept[polyhedra.face_of_corner]]
    return _with_faces(polyhedra, loops, np.diff(polyhedra.loop_start)[kept], kept)


def _with_faces(polyhedra: Polyhedra, loops: IntArray, corners: IntArray, kept: BoolArray) -> Polyhedra:
    """The same polyhedra with those faces that are kept, (n_faces,), and other corners of these, so many of each."""
    counts = np.bincount(polyhedra.block_of_face[kept], minlength=len(polyhedra))
    taken = Polyhedra(polyhedra.vertices, polyhedra.vertex_start, loops, starts(corners), starts(counts))
    return drop_unused_vertices(taken)[0]


def with_faces(polyhedra: Polyhedra) -> IntArray:
    """Polyhedra that have a face left, (n,)."""
    return np.flatnonzero(np.diff(polyhedra.face_start))


def surfaces_by_label(
    points: FloatArray, faces: Sequence[Sequence[int]], labels: Sequence[Label]
) -> tuple[Polyhedra, list[Label]]:
    """One surface of the faces of each label, in order of first appearance, and these labels.

    points : (n, 3); faces : rows of points at the corners of each; labels : of each face
    """
    present = list(dict.fromkeys(labels))
    number = {label: row for row, label in enumerate(present)}
    block = np.array([number[label] for label in labels], dtype=np.int64)
    order = np.argsort(block, kind="stable")
    sorted_faces = [faces[row] for row in order]
    counts = np.array([len(face) for face in sorted_faces], dtype=np.int64)
    corners = np.fromiter(chain.from_iterable(sorted_faces), dtype=np.int64, count=int(counts.sum()))
    return own_vertices(points, corners, starts(counts), block[order]), present


def own_vertices(points: FloatArray, corners: IntArray, loop_start: IntArray, block: IntArray) -> Polyhedra:
    """Polyhedra from faces over shared points, each with its own copy of those it uses.

    corners : (n_corners,) rows of points; block : (n_faces,) polyhedron of each face, ascending from 0 without gaps
    """
    if not len(block):
        none = np.zeros(1, dtype=np.int64)
        return Polyhedra(np.empty((0, 3)), none, np.empty(0, dtype=np.int64), none, none)
    keys = block[row_of_item(loop_start)] * len(points) + corners
    used, loops = np.unique(keys, return_inverse=True)
    n_blocks = int(block[-1]) + 1
    return Polyhedra(
        vertices=points[used % len(points)],
        vertex_start=starts(np.bincount(used // len(points), minlength=n_blocks)),
        loops=loops.reshape(-1).astype(np.int64),
        loop_start=loop_start,
        face_start=starts(np.bincount(block, minlength=n_blocks)),
    )


def triangle_soup(surfaces: Sequence[FloatArray]) -> Polyhedra:
    """Surfaces of triangles, (n, 3, 3) each, that share no vertices."""
    count = starts(np.array([len(triangles) for triangles in surfaces], dtype=np.int64))
    corners = 3 * int(count[-1])
    vertices = np.concatenate([np.empty((0, 3, 3)), *surfaces]).reshape(-1, 3)
    return Polyhedra(vertices, 3 * count, np.arange(corners), np.arange(0, corners + 1, 3), count)
