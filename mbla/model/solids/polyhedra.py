"""Raw polyhedra: what kinds of items and geometry files deliver, before anything about them is checked.

Among them blocks swept through a chain of polygons: prisms, frusta, and blocks bent along a curve. Between two of the
polygons lies one face for each of their edges, planar where the edge and its image lie in a plane: parallel edges
(prisms and frusta), or edges that meet in a point.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import chain

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.model.solids.ragged import items_of_rows, next_item, ranges

HEXAHEDRON = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
"""Outward faces of a hexahedron: corners 0-3 counter-clockwise seen from 4-7, which lie above them in turn."""


@dataclass(frozen=True)
class Polyhedra:
    """Polyhedra by vertices and faces, faces in any orientation; the layout is that of ``Blocks``.

    vertices     : (n_vertices, 3) length
    vertex_start : (n + 1,)         vertices of polyhedron b
    loops        : (n_corners,)     row of ``vertices`` at each corner of each face; at least three per face
    loop_start   : (n_faces + 1,)   corners of face f
    face_start   : (n + 1,)         faces of polyhedron b; at least one each
    """

    vertices: FloatArray
    vertex_start: IntArray
    loops: IntArray
    loop_start: IntArray
    face_start: IntArray

    def __len__(self) -> int:
        return len(self.face_start) - 1

    @cached_property
    def block_of_vertex(self) -> IntArray:
        """(n_vertices,)."""
        return row_of_item(self.vertex_start)

    @cached_property
    def block_of_face(self) -> IntArray:
        """(n_faces,)."""
        return row_of_item(self.face_start)

    @cached_property
    def face_of_corner(self) -> IntArray:
        """(n_corners,)."""
        return row_of_item(self.loop_start)

    def loop(self, face: int) -> IntArray:
        """Rows of ``vertices`` at the corners of a face, (n,)."""
        return self.loops[self.loop_start[face] : self.loop_start[face + 1]]

    @cached_property
    def next_loops(self) -> IntArray:
        """Row of ``vertices`` at the next corner of the same face, (n_corners,)."""
        return self.loops[next_item(self.loop_start)]

    @cached_property
    def edge_keys(self) -> IntArray:
        """Number of the edge that leaves each corner, (n_corners,): lesser vertex times n_vertices, plus greater."""
        tails, heads = self.loops, self.next_loops
        return np.asarray(np.minimum(tails, heads) * len(self.vertices) + np.maximum(tails, heads))

    @cached_property
    def faces_at_edge(self) -> IntArray:
        """How many faces pass the edge that leaves each corner, (n_corners,)."""
        _, inverse, counts = np.unique(self.edge_keys, return_inverse=True, return_counts=True)
        return counts[inverse.reshape(-1)]

    @cached_property
    def origins(self) -> FloatArray:
        """First vertex of each polyhedron, (n, 3): local origins, so that distance from the origin costs no digits."""
        return self.vertices[self.vertex_start[:-1]]

    @cached_property
    def local_vertices(self) -> FloatArray:
        """Vertices about the local origin of their polyhedron, (n_vertices, 3)."""
        return self.vertices - self.origins[self.block_of_vertex]


def polyhedra_from_lists(
    vertex_lists: Sequence[Sequence[Sequence[float]] | FloatArray], face_lists: Sequence[Sequence[Sequence[int]]]
) -> Polyhedra:
    """Polyhedra from a list of points, (n, 3) m, and a list of faces (corners as indices from 0) for each."""
    vertex_counts = np.array([len(vertices) for vertices in vertex_lists], dtype=np.int64)
    face_counts = np.array([len(faces) for faces in face_lists], dtype=np.int64)
    faces = list(chain.from_iterable(face_lists))
    corner_counts = np.fromiter(map(len, faces), dtype=np.int64, count=len(faces))
    corners = np.fromiter(chain.from_iterable(faces), dtype=np.int64, count=int(corner_counts.sum()))
    coordinates = chain.from_iterable(chain.from_iterable(vertex_lists))
    vertices = np.fromiter(coordinates, dtype=np.float64, count=3 * int(vertex_counts.sum())).reshape(-1, 3)
    vertex_start, face_start, loop_start = starts(vertex_counts), starts(face_counts), starts(corner_counts)
    block_of_corner = np.repeat(row_of_item(face_start), corner_counts)
    return Polyhedra(vertices, vertex_start, corners + vertex_start[block_of_corner], loop_start, face_start)


def polyhedra_from_cells(corners: FloatArray, faces: Sequence[Sequence[int]]) -> Polyhedra:
    """Polyhedra of one shape: corners (n, n_corners, 3), faces by corner numbers, the same for all."""
    n_cells, n_corners = corners.shape[:2]
    flat = np.array(list(chain.from_iterable(faces)), dtype=np.int64)
    sizes = np.array([len(face) for face in faces], dtype=np.int64)
    vertex_start = n_corners * np.arange(n_cells + 1)
    return Polyhedra(
        vertices=np.ascontiguousarray(corners, dtype=np.float64).reshape(-1, 3),
        vertex_start=vertex_start,
        loops=(flat + vertex_start[:-1, None]).reshape(-1),
        loop_start=starts(np.tile(sizes, n_cells)),
        face_start=len(faces) * np.arange(n_cells + 1),
    )


def cuboids(least: FloatArray, greatest: FloatArray) -> Polyhedra:
    """Cuboids along the axes from their extreme corners, (n, 3) each."""
    pick = np.array(
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], dtype=bool
    )
    return polyhedra_from_cells(np.where(pick, greatest[:, None, :], least[:, None, :]), HEXAHEDRON)


def join_polyhedra(parts: Sequence[Polyhedra]) -> Polyhedra:
    """All polyhedra of several records, in order."""
    vertex_offsets = starts(np.array([len(part.vertices) for part in parts], dtype=np.int64))
    return Polyhedra(
        vertices=np.concatenate([part.vertices for part in parts]) if parts else np.empty((0, 3)),
        vertex_start=_join_starts([part.vertex_start for part in parts]),
        loops=np.concatenate(
            [
                np.empty(0, dtype=np.int64),
                *(part.loops + offset for part, offset in zip(parts, vertex_offsets, strict=False)),
            ]
        ),
        loop_start=_join_starts([part.loop_start for part in parts]),
        face_start=_join_starts([part.face_start for part in parts]),
    )


def _join_starts(parts: Sequence[IntArray]) -> IntArray:
    return starts(np.concatenate([np.empty(0, dtype=np.int64), *(np.diff(part) for part in parts)]))


def take_polyhedra(polyhedra: Polyhedra, blocks: IntArray) -> Polyhedra:
    """Some of the polyhedra, (n,), in the order given."""
    vertex_rows = items_of_rows(polyhedra.vertex_start, blocks)
    face_rows = items_of_rows(polyhedra.face_start, blocks)
    vertex_start = starts(np.diff(polyhedra.vertex_start)[blocks])
    loops = polyhedra.loops[items_of_rows(polyhedra.loop_start, face_rows)]
    corner_counts = np.diff(polyhedra.loop_start)[face_rows]
    face_counts = np.diff(polyhedra.face_start)[blocks]
    shift = vertex_start[:-1] - polyhedra.vertex_start[blocks]
    return Polyhedra(
        vertices=polyhedra.vertices[vertex_rows],
        vertex_start=vertex_start,
        loops=loops + np.repeat(np.repeat(shift, face_counts), corner_counts),
        loop_start=starts(corner_counts),
        face_start=starts(face_counts),
    )


def turn_faces(polyhedra: Polyhedra, turned: BoolArray) -> Polyhedra:
    """The same polyhedra with the corners of some faces in reverse order; turned (n_faces,)."""
    if not turned.any():
        return polyhedra
    faces = np.flatnonzero(turned)
    first, last = polyhedra.loop_start[faces], polyhedra.loop_start[faces + 1]
    corners = ranges(first, last - first)
    loops = polyhedra.loops.copy()
    loops[corners] = polyhedra.loops[np.repeat(first + last - 1, last - first) - corners]
    return replace(polyhedra, loops=loops)


def drop_unused_vertices(polyhedra: Polyhedra) -> tuple[Polyhedra, IntArray]:
    """The same polyhedra without vertices that no face uses, and how many each lost, (n,)."""
    used = np.zeros(len(polyhedra.vertices), dtype=bool)
    used[polyhedra.loops] = True
    if used.all():
        return polyhedra, np.zeros(len(polyhedra), dtype=np.int64)
    lost = np.bincount(polyhedra.block_of_vertex[~used], minlength=len(polyhedra))
    return replace(
        polyhedra,
        vertices=polyhedra.vertices[used],
        vertex_start=starts(np.diff(polyhedra.vertex_start) - lost),
        loops=(np.cumsum(used) - 1)[polyhedra.loops],
    ), lost


def chains(stations: FloatArray) -> Polyhedra:
    """One block for each chain of polygons; stations (n, n_polygons, n_corners, 3).

    Corners are counter-clockwise as seen from the far end of the chain, looking back.
    """
    count, n_polygons, n_corners = stations.shape[:3]
    return polyhedra_from_cells(stations.reshape(count, n_polygons * n_corners, 3), _faces(n_polygons, n_corners))


def _faces(n_polygons: int, n_corners: int) -> list[list[int]]:
    """Outward faces by corner numbers: both ends, then the sides from polygon to polygon."""
    last = (n_polygons - 1) * n_corners
    faces = [[0, *range(n_corners - 1, 0, -1)], list(range(last, last + n_corners))]
    for first in range(0, last, n_corners):
        for corner in range(n_corners):
            here, after = first + corner, first + (corner + 1) % n_corners
            faces.append([here, after, after + n_corners, here + n_corners])
    return faces


def prisms(polygons: Sequence[FloatArray], across: FloatArray, shear: float = 0.0) -> Polyhedra:
    """A prism from each polygon, (k, 2), between the planes y = across[i, 0] and y = across[i, 1]; across (n, 2).

    Corners counter-clockwise as seen in the x-z plane (x to the right, z up), which is from -y.
    shear : x grows by this times y [-]
    """
    counts = np.array([len(polygon) for polygon in polygons], dtype=np.int64)
    parts, order = [], []
    for count in np.unique(counts):
        chosen = np.flatnonzero(counts == count)
        section = np.stack([polygons[i] for i in chosen.tolist()])
        # seen from the far side the order is clockwise, so that the near face is the end of the chain
        stations = np.stack([in_space(section, across[chosen, side, None]) for side in (1, 0)], axis=1)
        stations[..., 0] += shear * stations[..., 1]
        parts.append(chains(stations))
        order.append(chosen)
    if len(parts) == 1:
        return parts[0]
    return take_polyhedra(join_polyhedra(parts), np.argsort(np.concatenate(order)))


def in_space(points: FloatArray, y: FloatArray | float = 0.0) -> FloatArray:
    """Points (..., 2) of the x-z plane in space, (..., 3)."""
    return np.stack([points[..., 0], np.broadcast_to(y, points.shape[:-1]), points[..., 1]], axis=-1)
