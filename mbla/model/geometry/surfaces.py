"""Surfaces split into their closed parts, each of which is a block.

Faces belong together when they share an edge. Where blocks touch along an edge, as in a wall exported as one surface,
more than two faces meet at it; then each face goes with the one that it meets first on turning about the edge through
its own block:

    with t the direction in which a face passes the edge and n its outward normal, the face lies along n x t, and its
    block on the side of turning about -t; its partner passes the edge along -t.

A face that has the corners of another may be that of a neighbour that touches there. It is a second copy where the
surface closes without it: an odd number of faces meets at an edge of it. Surfaces with a copy of every face the other
way round (both sides of each face exported) come apart into twins.

Volume cells of mesh files by their faces (types have meshio's names), and the sets of them joined to blocks.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.geometry.geometry import Geometry
from mbla.model.geometry.welding import own_vertices, take_faces, weld
from mbla.model.solids.measures import connected_labels, face_geometry
from mbla.model.solids.plane import plane_axes, unit
from mbla.model.solids.polyhedra import HEXAHEDRON, Polyhedra, take_polyhedra
from mbla.model.solids.ragged import numbered, ranges

SAME_DIRECTION = 0.05
"""angle in radians below which two faces at an edge lie on each other and bound different blocks: where blocks meet
at a face that is not quite planar, each has its own triangles of it. No block is a wedge of 3 degrees there"""


@dataclass(frozen=True)
class Split:
    """Closed parts of surfaces: ``source`` (n,) is the surface that each part is of; ``twins`` were left out."""

    polyhedra: Polyhedra
    source: IntArray
    twins: int


def split_surfaces(surfaces: Polyhedra) -> Split:
    """The closed parts of surfaces without repeated vertices, in the order of their first faces.

    Parts with the very faces of an earlier part of the same surface are left out: files that list both sides of each
    face come apart into such twins.
    """
    if not len(surfaces):
        return Split(surfaces, np.empty(0, dtype=np.int64), 0)
    part, first = numbered(connected_labels(_partners(surfaces), len(surfaces.block_of_face)))
    source = surfaces.block_of_face[first]
    kept = _first_of_twins(face_codes(surfaces, oriented=False), part, len(first))
    number = np.cumsum(kept) - 1
    order = np.argsort(part, kind="stable")
    order = order[kept[part[order]]]
    counts = np.diff(surfaces.loop_start)[order]
    corners = surfaces.loops[ranges(surfaces.loop_start[order], counts)]
    parts = own_vertices(surfaces.vertices, corners, starts(counts), number[part[order]])
    return Split(parts, source[kept], int((~kept).sum()))


def _first_of_twins(codes: IntArray, part: IntArray, n_parts: int) -> BoolArray:
    """Parts that do not have the faces of an earlier one, (n_parts,).

    A part is known by the sum of random numbers that stand for its faces, exact in integers.
    """
    random = np.random.default_rng(0).integers(0, 2**63, size=int(codes.max()) + 1, dtype=np.uint64)
    sums = np.zeros(n_parts, dtype=np.uint64)
    np.add.at(sums, part, random[codes])
    kept = np.zeros(n_parts, dtype=bool)
    kept[np.unique(sums, return_index=True)[1]] = True
    return kept


def _partners(surface: Polyhedra) -> IntArray:
    """Pairs of faces that belong together, (n, 2)."""
    order = np.argsort(surface.edge_keys, kind="stable")
    first = np.flatnonzero(np.diff(surface.edge_keys[order], prepend=-1))
    counts = np.diff(first, append=len(order))
    face, two = surface.face_of_corner, first[counts == 2]
    pairs = [np.stack([face[order[two]], face[order[two + 1]]], axis=1)]
    crowded = [order[first[edge] : first[edge] + counts[edge]] for edge in np.flatnonzero(counts > 2)]
    normals = face_geometry(surface).normals if crowded else np.empty((0, 3))
    pairs += [face[_pair_around(surface, corners, normals[face[corners]])] for corners in crowded]
    return np.concatenate(pairs)


def _pair_around(surface: Polyhedra, corners: IntArray, normals: FloatArray) -> IntArray:
    """Corners (n,) from which one edge leaves paired, (n / 2, 2), by the normals of their faces, (n, 3).

    Where the faces do not pair off (not oriented outwards, or an open sheet among them) all are kept together: the
    block they make is then refused by name.
    """
    together = np.stack([corners[:-1], corners[1:]], axis=1)
    tails, heads = surface.loops[corners], surface.next_loops[corners]
    forward = tails < heads
    ahead, back = np.flatnonzero(forward), np.flatnonzero(~forward)
    if len(ahead) != len(back):
        return together
    axis = unit(surface.local_vertices[max(tails[0], heads[0])] - surface.local_vertices[min(tails[0], heads[0])])
    leaving = np.cross(normals, np.where(forward[:, None], axis, -axis))
    east, north = plane_axes(axis[None])[0]
    angles = np.arctan2(leaving @ north, leaving @ east)
    turn = np.mod(angles[ahead][:, None] - angles[back][None, :], 2 * np.pi)
    turn[turn < SAME_DIRECTION] += 2 * np.pi
    partner = np.argmin(turn, axis=1)
    if len(np.unique(partner)) != len(partner):
        return together
    return np.stack([corners[ahead], corners[back[partner]]], axis=1)


def face_codes(polyhedra: Polyhedra, *, oriented: bool) -> IntArray:
    """Number that faces with the same corners share, in the same order if ``oriented``, (n_faces,)."""
    counts = np.diff(polyhedra.loop_start)
    codes = np.zeros(len(counts), dtype=np.int64)
    used = 0
    for n in np.unique(counts):
        rows = np.flatnonzero(counts == n)
        corners = polyhedra.loops[ranges(polyhedra.loop_start[rows], counts[rows])].reshape(-1, n)
        if oriented:  # every face from its least corner on
            turn = (np.argmin(corners, axis=1)[:, None] + np.arange(n)) % n
            corners = np.take_along_axis(corners, turn, axis=1)
        else:
            corners = np.sort(corners, axis=1)
        unique, inverse = np.unique(corners, axis=0, return_inverse=True)
        codes[rows] = used + inverse.reshape(-1)
        used += len(unique)
    return codes


def repeated_faces(surfaces: Polyhedra) -> BoolArray:
    """Faces that are copies of another and not needed to close the surface, (n_faces,)."""
    codes = face_codes(surfaces, oriented=False)
    copies = np.ones(len(codes), dtype=bool)
    copies[np.unique(codes, return_index=True)[1]] = False
    odd = surfaces.faces_at_edge % 2 == 1
    return np.asarray(copies & (np.bincount(surfaces.face_of_corner[odd], minlength=len(codes)) > 0))


VOLUME_CELLS: dict[str, tuple[int, Sequence[Sequence[int]]]] = {
    "tetra": (4, ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3))),
    "hexahedron": (8, HEXAHEDRON),
    "wedge": (6, ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5))),
    "pyramid": (5, ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4))),
    "penta_prism": (
        10,
        ((4, 3, 2, 1, 0), (5, 6, 7, 8, 9), *((i, (i + 1) % 5, (i + 1) % 5 + 5, i + 5) for i in range(5))),
    ),
    "hexa_prism": (
        12,
        ((5, 4, 3, 2, 1, 0), (6, 7, 8, 9, 10, 11), *((i, (i + 1) % 6, (i + 1) % 6 + 6, i + 6) for i in range(6))),
    ),
}
"""number of corners and faces by corner, of each shape of cell; cells of higher order begin with their corners"""


def join_cells(geometry: Geometry) -> Geometry:
    """The outer faces of the cells of each set as one surface; cells without a set make one together."""
    cells = geometry.polyhedra
    names = geometry.names or ("",) * len(cells)
    present = list(dict.fromkeys(names))
    row_of = {name: row for row, name in enumerate(present)}
    owner = np.array([row_of[name] for name in names], dtype=np.int64)
    order = np.argsort(owner, kind="stable")
    sorted_cells = take_polyhedra(cells, order)
    block = owner[order][sorted_cells.block_of_face]
    merged = own_vertices(sorted_cells.vertices, sorted_cells.loops, sorted_cells.loop_start, block)
    welded = weld(merged).polyhedra
    codes = face_codes(welded, oriented=False)
    return replace(
        geometry,
        polyhedra=take_faces(welded, np.bincount(codes)[codes] == 1),
        names=tuple(present) if any(present) else (),
        cells=False,
        indexed=False,
    )
