"""Facets: the plane pieces of the surface of each block, with their outlines as polygons in their own plane.

Faces of a block that the model put on one facet are united; so are facets of one block that lie on the same plane
without sharing edges (a quadrilateral beside triangles that end in the middle of its edge), for they touch a
neighbour in one common surface.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.frames import frames_from_normals, unit
from mbla.contacts.polygons import Polygons, convex_polygons, map_polygons, polygons_from_loops, union_by_row
from mbla.contacts.ragged import rows_and_items
from mbla.model.blocks import Blocks
from mbla.model.ragged import next_item

# Facets of a block whose normals and heights differ by less than this (relative to block size) are one plane.
_SAME_PLANE = 1e-6
# Snapping grid, relative to block size, for outlines that are united across edges they do not share.
_GRID = 1e-10
# Unlike any direction of a building, so that two different normals hardly ever look alike along it.
_ODD_DIRECTION = np.array([0.5403023, 0.2919266, 0.7892347])


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
    face_of_corner = np.repeat(np.arange(len(blocks.face_normals)), np.diff(corner_start))
    corners = blocks.vertices[blocks.loops]
    centres = np.add.reduceat(corners, corner_start[:-1]) / np.diff(corner_start)[:, None]
    areas = _face_areas(corners - centres[face_of_corner], corner_start, blocks.face_normals)

    facet_of_face, crossing = _facets_on_one_plane(blocks, centres)
    order = np.argsort(facet_of_face, kind="stable")
    facet_of_sorted = facet_of_face[order]
    face_start = starts(np.bincount(facet_of_face).astype(np.int64))
    weights = areas[order]
    total = np.add.reduceat(weights, face_start[:-1])
    frames = frames_from_normals(unit(np.add.reduceat(weights[:, None] * blocks.face_normals[order], face_start[:-1])))
    # Differences first: far from the origin the weighted sum of absolute coordinates would lose digits.
    anchor = centres[order[face_start[:-1]]]
    shift = np.add.reduceat(weights[:, None] * (centres[order] - anchor[facet_of_sorted]), face_start[:-1])
    origins = anchor + shift / total[:, None]

    facet_of_corner = facet_of_face[face_of_corner]
    local = np.einsum("kij,kj->ki", frames[facet_of_corner], corners - origins[facet_of_corner])
    by_facet = np.argsort(facet_of_corner, kind="stable")
    first = starts(np.bincount(facet_of_corner).astype(np.int64))[:-1]
    block_of_facet = blocks.block_of_face[order[face_start[:-1]]]
    polygons = _outlines(local[:, 1:], corner_start, order, facet_of_sorted, crossing, blocks.sizes[block_of_facet])
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
    following = relative_corners[next_item(corner_start)]
    vectors = np.add.reduceat(np.cross(relative_corners, following), corner_start[:-1]) / 2
    extents = np.maximum.reduceat((relative_corners**2).sum(axis=1), corner_start[:-1])
    areas: FloatArray = np.maximum(np.einsum("fi,fi->f", vectors, normals), 1e-12 * extents)
    return areas


def _facets_on_one_plane(blocks: Blocks, centres: FloatArray) -> tuple[IntArray, BoolArray]:
    """Facet of each face after joining facets of one block on one plane, and which facets were joined from several."""
    facet_of_face = blocks.facet_of_face
    _, first_face = np.unique(facet_of_face, return_index=True)
    n = len(first_face)
    block = blocks.block_of_face[first_face]
    normals, points = blocks.face_normals[first_face], centres[first_face]
    # Facets with the same normal are neighbours when sorted along an odd direction: pairs only within such runs.
    along = normals @ _ODD_DIRECTION
    order = np.lexsort((along, block))
    same_run = (block[order][1:] == block[order][:-1]) & (np.diff(along[order]) < _SAME_PLANE)
    run_start = np.concatenate([[True], ~same_run]).nonzero()[0]
    run_end = np.concatenate([run_start[1:], [n]])
    run_of = np.repeat(np.arange(len(run_start)), run_end - run_start)
    row, position = rows_and_items(np.arange(1, n + 1), run_end[run_of] - np.arange(n) - 1)
    i, j = order[row], order[position]
    height = np.abs(np.einsum("ki,ki->k", points[j] - points[i], normals[i]))
    alike = np.abs(normals[i] - normals[j]).max(axis=1, initial=0.0) < _SAME_PLANE
    alike &= height < _SAME_PLANE * blocks.sizes[block[i]]
    i, j = i[alike], j[alike]
    if not len(i):
        return facet_of_face, np.zeros(n, dtype=bool)
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    _, label = connected_components(coo_array((np.ones(len(i)), (i, j)), shape=(n, n)), directed=False)
    _, first, dense = np.unique(label, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))  # numbered by first occurrence, to stay in order of blocks
    joined = rank[dense]
    return joined[facet_of_face].astype(np.int64), np.bincount(joined) > 1


def _outlines(
    corners: FloatArray,
    corner_start: IntArray,
    order: IntArray,
    facet_of_sorted: IntArray,
    crossing: BoolArray,
    sizes: FloatArray,
) -> Polygons:
    """Outlines of facets from the loops of their faces.

    corners         : (n_corners, 2) m, in the frame of the facet, in order of faces
    order           : faces sorted by facet; facet_of_sorted is the facet of each
    crossing        : (n_facets,) facets whose faces need not share edges
    sizes           : (n_facets,) block sizes
    """
    faces = polygons_from_loops(corners, corner_start)[order]
    n_facets = len(crossing)
    counts = np.bincount(facet_of_sorted, minlength=n_facets)
    first = starts(counts.astype(np.int64))[:-1]
    outlines: Polygons = faces[first].copy()
    for snapped in (False, True):
        chosen = (counts > 1) & (crossing == snapped)
        if not chosen.any():
            continue
        rows = np.flatnonzero(chosen)
        dense = np.cumsum(chosen) - 1
        members = chosen[facet_of_sorted]
        facet = facet_of_sorted[members]
        scaled = _scaled(faces[members], 1 / sizes[facet])
        united = union_by_row(scaled, dense[facet], len(rows), grid=_GRID if snapped else None)
        outlines[rows] = _scaled(united, sizes[rows])
    return outlines


def _scaled(polygons: Polygons, factors: FloatArray) -> Polygons:
    """Polygons times their own factor."""
    return map_polygons(polygons, factors[:, None, None] * np.eye(2), np.zeros((len(polygons), 2)))
