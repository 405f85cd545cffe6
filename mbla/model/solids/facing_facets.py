"""Facets of two blocks that face each other across a narrow gap, and facets that face a plane.

The gap is measured over what both facets share, projected along the mean of their normals: the distance of their two
planes at its corners.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, summed
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.convex import convex_loops
from mbla.model.solids.measures import face_geometry
from mbla.model.solids.plane import meeting_boxes, plane_axes
from mbla.model.solids.polygons import Polygons, intersect, polygons_from_loops
from mbla.model.solids.ragged import row_ranges

OPPOSITE = float(np.cos(np.radians(20.0)))
"""cosine of the greatest angle between two facets that face each other: a joint that is drawn as a wedge"""


@dataclass(frozen=True)
class FacetPlanes:
    """Planes fitted to facets: points (n, 3), outward normals (n, 3), and the block of each, (n,)."""

    points: FloatArray
    normals: FloatArray
    blocks: IntArray


@dataclass(frozen=True)
class FacingPairs:
    """Pairs of facets.

    facets  : (n, 2)
    least, greatest : (n,) m  gap over what they share, negative where they overlap
    areas   : (n,) m2         of what they share
    middles : (n, 3) m        amid it
    """

    facets: IntArray
    least: FloatArray
    greatest: FloatArray
    areas: FloatArray
    middles: FloatArray


def facet_planes(blocks: Blocks) -> FacetPlanes:
    """Of all facets: means over their faces, by area."""
    faces, facet = face_geometry(blocks), blocks.facet_of_face
    n = int(facet.max()) + 1
    area = np.bincount(facet, faces.areas, n)[:, None]
    centres = faces.centres + blocks.origins[blocks.block_of_face]
    points = summed(facet, faces.areas[:, None] * centres, n) / area
    normals = summed(facet, faces.areas[:, None] * faces.normals, n)
    owner = np.empty(n, dtype=np.int64)
    owner[facet] = blocks.block_of_face
    return FacetPlanes(points, normals / np.linalg.norm(normals, axis=1)[:, None], owner)


def facing_pairs(blocks: Blocks, planes: FacetPlanes, reach: float, tolerance: float) -> FacingPairs:
    """Pairs of facets of different blocks with gaps up to ``reach``, m, all over what they share.

    tolerance : relative to block size, by which they may overlap, and of the width of what they share
    """
    corners = blocks.vertices[blocks.loops]
    low, high = row_ranges(corners, blocks.loop_start)
    room = reach * (0.5 + 1e-6)  # a gap that is the reach must not be lost by rounding
    one, other = meeting_boxes(low - room, high + room, low - room, high + room)
    facet, owner = blocks.facet_of_face, blocks.block_of_face
    kept = owner[one] < owner[other]
    kept &= np.einsum("ij,ij->i", planes.normals[facet[one]], planes.normals[facet[other]]) < -OPPOSITE
    one, other = one[kept], other[kept]
    a, b = facet[one], facet[other]
    normals = planes.normals[a] - planes.normals[b]
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    parts = _Shared(blocks, one, other, normals)
    gaps = parts.heights(planes, b) - parts.heights(planes, a)
    size = np.minimum(blocks.sizes[owner[one]], blocks.sizes[owner[other]])
    return _by_facets(np.column_stack([a, b]), parts, gaps, (reach, tolerance * size))


class _Shared:
    """What pairs of faces (n,) share as seen along normals (n, 3): its corners in space, and the pair of each."""

    def __init__(self, blocks: Blocks, one: IntArray, other: IntArray, normals: FloatArray) -> None:
        self.normals = normals
        axes = plane_axes(normals)
        origins = blocks.vertices[blocks.loops[blocks.loop_start[one]]]
        first, convex = _outlines(blocks, one, origins, axes)
        second, other_convex = _outlines(blocks, other, origins, axes)
        shapes = intersect(first, second, convex & other_convex)
        self.areas = np.asarray(shapely.area(shapes))
        flat, self.pair = shapely.get_coordinates(shapes, return_index=True)
        self.points = origins[self.pair] + np.einsum("ki,kij->kj", flat, axes[self.pair])
        middles = np.nan_to_num(shapely.get_coordinates(shapely.centroid(shapes[self.areas > 0])))
        self.middles = origins.copy()
        self.middles[self.areas > 0] += np.einsum("ki,kij->kj", middles, axes[self.areas > 0])

    def heights(self, planes: FacetPlanes, facets: IntArray) -> FloatArray:
        """Of the planes of facets (n,) above the corners, along the normals, (m,) m."""
        normal, facet = self.normals[self.pair], facets[self.pair]
        above = np.einsum("ki,ki->k", planes.points[facet] - self.points, planes.normals[facet])
        return np.asarray(above / np.einsum("ki,ki->k", normal, planes.normals[facet]))


def _outlines(blocks: Blocks, faces: IntArray, origins: FloatArray, axes: FloatArray) -> tuple[Polygons, BoolArray]:
    """Faces (n,) as polygons in plane coordinates of their own each, and which of them are convex."""
    corners, start = blocks.corners_of(faces)
    row = row_of_item(start)
    flat = np.einsum("kj,kij->ki", corners - origins[row], axes[row])
    return polygons_from_loops(flat, start), convex_loops(flat, start)


def _by_facets(facets: IntArray, parts: _Shared, gaps: FloatArray, allowed: tuple[float, FloatArray]) -> FacingPairs:
    """Pairs of faces put together to pairs of facets, and those that face each other all over within reach.

    facets : (n, 2) of each pair of faces
    gaps   : at the corners of what they share
    allowed : greatest gap, and greatest overlap (n,), m
    """
    shared = parts.areas > 0.0
    pairs, row = np.unique(facets[shared], axis=0, return_inverse=True)
    number = np.full(len(facets), -1)
    number[shared] = row.ravel()
    of_corner = number[parts.pair]
    known = of_corner >= 0
    least, greatest = np.full(len(pairs), np.inf), np.full(len(pairs), -np.inf)
    np.minimum.at(least, of_corner[known], gaps[known])
    np.maximum.at(greatest, of_corner[known], gaps[known])
    areas = np.asarray(np.bincount(row.ravel(), parts.areas[shared], len(pairs)), dtype=np.float64)
    middles = summed(row.ravel(), parts.areas[shared, None] * parts.middles[shared], len(pairs))
    depth = np.zeros(len(pairs))
    depth[row.ravel()] = allowed[1][shared]
    near = (least >= -depth) & (greatest <= allowed[0] * (1 + 1e-9)) & (areas > depth**2)
    return FacingPairs(pairs[near], least[near], greatest[near], areas[near], (middles / areas[:, None])[near])
