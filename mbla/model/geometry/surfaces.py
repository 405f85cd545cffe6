"""Surfaces split into their closed parts, each of which is a block.

Faces belong together when they share an edge. Where blocks touch along an edge, as in a wall exported as one surface,
more than two faces meet at it; then each face goes with the one that it meets first on turning about the edge through
its own block:

    with t the direction in which a face passes the edge and n its outward normal, the face lies along n x t, and its
    block on the side of turning about -t; its partner passes the edge along -t.

Surfaces with a copy of every face the other way round (both sides of each face exported) come apart into twins.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.geometry.repeated_faces import face_codes
from mbla.model.geometry.welding import own_vertices
from mbla.model.solids.measures import connected_labels, face_geometry
from mbla.model.solids.plane import plane_axes, unit
from mbla.model.solids.polyhedra import Polyhedra
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
