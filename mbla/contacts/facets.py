"""Facets: the plane pieces of the surface of each block, with their outlines as polygons in their own plane.

Faces of a block that the model put on one facet are united, and so are facets of one block that lie on one plane
without sharing an edge (a quadrilateral beside triangles that end amid its edge): they touch a neighbour in one plane.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.outlines.overlay import frames_from_normals, unit
from mbla.contacts.outlines.polygons import Polygons, convex_polygons, map_polygons, polygons_from_loops, union_by_row
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.measures import connected_labels
from mbla.model.solids.ragged import next_item, row_maxima, row_means, row_sums, rows_and_items

# Snapping grid, relative to block size, for uniting outlines whose edges may differ by rounding: an order of magnitude
# slower than floating arithmetic, which is enough where faces share their edges, and checked by the area.
_GRID = 1e-10
_LOST = 1e-9


@dataclass(frozen=True)
class Facets:
    """Plane pieces of block surfaces, in order of blocks.

    blocks       : (n_facets,)        block of each facet
    facet_start  : (n_blocks + 1,)    facets of block b are facet_start[b] ... facet_start[b + 1] - 1
    origins      : (n_facets, 3) m    a point on the plane, amid the facet
    frames       : (n_facets, 3, 3)   rows: outward normal, two tangents
    polygons     : (n_facets,)        outline in tangent coordinates about the origin [m]; may have several
                   parts, and holes
    lower, upper : (n_facets, 3) m    corners of the bounding box
    radii        : (n_facets,) m      distance from the origin to the farthest corner
    convex       : (n_facets,)        outlines in one part, without holes, that are convex
    """

    blocks: IntArray
    facet_start: IntArray
    origins: FloatArray
    frames: FloatArray
    polygons: Polygons
    lower: FloatArray
    upper: FloatArray
    radii: FloatArray
    convex: BoolArray

    def __len__(self) -> int:
        return len(self.blocks)

    @property
    def normals(self) -> FloatArray:
        """(n_facets, 3) unit, outward."""
        return self.frames[:, 0]


def build_facets(blocks: Blocks) -> Facets:
    """Facets of all blocks; see :class:`Facets`."""
    corner_start = blocks.loop_start
    corners = blocks.vertices[blocks.loops]
    centres = row_means(corners, corner_start)
    facet_of_face = facets_on_one_plane(blocks, centres)
    facet_of_corner = facet_of_face[blocks.face_of_corner]
    _, first_face = np.unique(facet_of_face, return_index=True)
    block_of_facet = blocks.block_of_face[first_face]
    joined = (blocks.facet_of_face != blocks.facet_of_face[first_face][facet_of_face]).nonzero()[0]
    joined = np.isin(np.arange(len(first_face)), facet_of_face[joined])

    face_areas = _face_areas(corners - centres[blocks.face_of_corner], corner_start, blocks.face_normals)
    origins, frames = _fitted_planes(facet_of_face, centres, blocks.face_normals, face_areas)
    local = np.einsum("kij,kj->ki", frames[facet_of_corner], corners - origins[facet_of_corner])
    polygons = _outlines(local[:, 1:], corner_start, facet_of_face, joined, blocks.sizes[block_of_facet])
    by_facet = np.argsort(facet_of_corner, kind="stable")
    first = starts(np.bincount(facet_of_corner).astype(np.int64))[:-1]
    return Facets(
        blocks=block_of_facet,
        facet_start=starts(np.bincount(block_of_facet, minlength=len(blocks)).astype(np.int64)),
        origins=origins,
        frames=frames,
        polygons=polygons,
        lower=np.minimum.reduceat(corners[by_facet], first),
        upper=np.maximum.reduceat(corners[by_facet], first),
        radii=np.maximum.reduceat(np.sqrt((local**2).sum(axis=1))[by_facet], first),
        convex=convex_polygons(polygons),
    )


def _face_areas(relative_corners: FloatArray, corner_start: IntArray, normals: FloatArray) -> FloatArray:
    """Areas (n_faces,) from corners relative to a point near each face; never zero, for they serve as weights."""
    vectors = row_sums(np.cross(relative_corners, relative_corners[next_item(corner_start)]), corner_start) / 2
    extents = row_maxima((relative_corners**2).sum(axis=1), corner_start)
    return np.asarray(np.maximum(np.einsum("fi,fi->f", vectors, normals), 1e-12 * extents))


def _fitted_planes(
    facet_of_face: IntArray, centres: FloatArray, normals: FloatArray, face_areas: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Origins (n_facets, 3) and frames (n_facets, 3, 3): means over the faces of each facet, weighted by area."""
    order = np.argsort(facet_of_face, kind="stable")
    first = starts(np.bincount(facet_of_face).astype(np.int64))[:-1]
    weights = face_areas[order, None]
    frames = frames_from_normals(unit(np.add.reduceat(weights * normals[order], first)))
    # Differences first: far from the origin the weighted sum of absolute coordinates would lose digits.
    anchor = centres[order[first]]
    shift = np.add.reduceat(weights * (centres[order] - anchor[facet_of_face[order]]), first)
    return anchor + shift / np.add.reduceat(weights, first), frames


def _outlines(
    corners: FloatArray, corner_start: IntArray, facet_of_face: IntArray, joined: BoolArray, sizes: FloatArray
) -> Polygons:
    """Outlines of facets, (n_facets,), united from the loops of their faces.

    corners : (n_corners, 2) m, in the frame of the facet, in order of faces
    joined  : (n_facets,)     facets whose faces need not share edges
    sizes   : (n_facets,) m   block sizes
    """
    order = np.argsort(facet_of_face, kind="stable")
    facet = facet_of_face[order]
    faces = polygons_from_loops(corners, corner_start)[order]
    faces = _scaled(faces, 1 / sizes[facet])
    counts = np.bincount(facet)
    outlines: Polygons = faces[starts(counts.astype(np.int64))[:-1]].copy()
    _unite(outlines, faces, facet, (counts > 1) & ~joined, None)
    areas = shapely.area(outlines)
    lost = np.abs(areas - np.bincount(facet, weights=shapely.area(faces))) > _LOST * areas
    _unite(outlines, faces, facet, joined | lost, _GRID)
    return _scaled(outlines, sizes)


def _unite(outlines: Polygons, faces: Polygons, facet: IntArray, chosen: BoolArray, grid: float | None) -> None:
    """Put the union of the faces of the facets chosen in place of their outlines; facet (n_faces,) ascending."""
    if chosen.any():
        dense, members = np.cumsum(chosen) - 1, chosen[facet]
        outlines[chosen] = union_by_row(faces[members], dense[facet[members]], int(chosen.sum()), grid=grid)


def _scaled(polygons: Polygons, factors: FloatArray) -> Polygons:
    """Polygons times their own factor."""
    return map_polygons(polygons, factors[:, None, None] * np.eye(2), np.zeros((len(polygons), 2)))


# Facets of a block whose normals and heights differ by less than this (relative to block size) are one plane.
_SAME_PLANE = 1e-6
# Unlike any direction of a building, so that two different normals hardly ever look alike along it.
_ODD_DIRECTION = np.array([0.5403023, 0.2919266, 0.7892347])


def facets_on_one_plane(blocks: Blocks, centres: FloatArray) -> IntArray:
    """Facet of each face after joining facets of one block that lie on one plane, (n_faces,), in order of blocks.

    centres : (n_faces, 3) m  a point on each face
    """
    facet_of_face = blocks.facet_of_face
    _, first_face = np.unique(facet_of_face, return_index=True)
    n = len(first_face)
    block = blocks.block_of_face[first_face]
    normals, points = blocks.face_normals[first_face], centres[first_face]
    i, j = _same_normal(block, normals)
    height = np.abs(np.einsum("ki,ki->k", points[j] - points[i], normals[i]))
    alike = np.abs(normals[i] - normals[j]).max(axis=1, initial=0.0) < _SAME_PLANE
    alike &= height < _SAME_PLANE * blocks.sizes[block[i]]
    i, j = i[alike], j[alike]
    if not len(i):
        return facet_of_face
    joined = connected_labels(np.stack([i, j], axis=1), n)  # in order of blocks still
    return joined[facet_of_face]


def _same_normal(block: IntArray, normals: FloatArray) -> tuple[IntArray, IntArray]:
    """Pairs of facets of one block that may have the same normal.

    Sorted along an odd direction they are neighbours, so that only facets within a run of close values are paired.
    """
    n = len(block)
    along = normals @ _ODD_DIRECTION
    order = np.lexsort((along, block))
    same_run = (block[order][1:] == block[order][:-1]) & (np.diff(along[order]) < _SAME_PLANE)
    run_start = np.concatenate([[True], ~same_run]).nonzero()[0]
    run_end = np.concatenate([run_start[1:], [n]])
    run_of = np.repeat(np.arange(len(run_start)), run_end - run_start)
    row, position = rows_and_items(np.arange(1, n + 1), run_end[run_of] - np.arange(n) - 1)
    return order[row], order[position]
