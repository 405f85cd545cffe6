"""Facets: the plane pieces of the surface of each block, with their outlines as polygons in their own plane.

Faces of a block that the model put on one facet are united.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.outlines.overlay import frames_from_normals, unit
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polygons import Polygons, convex_polygons, map_polygons, polygons_from_loops, union_by_row
from mbla.model.solids.ragged import next_item, row_means, row_sums

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
    facet_of_face, corner_start = blocks.facet_of_face, blocks.loop_start
    corners = blocks.vertices[blocks.loops]
    centres = row_means(corners, corner_start)
    facet_of_corner = facet_of_face[blocks.face_of_corner]
    _, first_face = np.unique(facet_of_face, return_index=True)
    block_of_facet = blocks.block_of_face[first_face]
    arms = corners - centres[blocks.face_of_corner]
    area_vectors = row_sums(np.cross(arms, arms[next_item(corner_start)]), corner_start) / 2
    face_areas = np.einsum("fi,fi->f", area_vectors, blocks.face_normals)
    origins, frames = _fitted_planes(facet_of_face, centres, blocks.face_normals, face_areas)
    local = np.einsum("kij,kj->ki", frames[facet_of_corner], corners - origins[facet_of_corner])
    polygons = _outlines(local[:, 1:], corner_start, facet_of_face, blocks.sizes[block_of_facet])
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


def with_surfaces(facets: Facets, grounds: Sequence[Ground], n_blocks: int) -> Facets:
    """The facets, and behind them the ground surfaces that end somewhere, each a facet of its body."""
    numbers = [number for number, ground in enumerate(grounds) if ground.outline is not None]
    if not numbers:
        return facets
    outlines = [outline for ground in grounds if (outline := ground.outline) is not None]
    origins = np.array([outline.mean(axis=0) for outline in outlines])
    frames = frames_from_normals(np.array([grounds[number].normal for number in numbers]))
    arms = [outline - origin for outline, origin in zip(outlines, origins, strict=True)]
    local = [arm @ frame[1:].T for arm, frame in zip(arms, frames, strict=True)]
    loops = starts(np.array([len(outline) for outline in outlines], dtype=np.int64))
    polygons = polygons_from_loops(np.concatenate(local), loops)
    radii = [np.linalg.norm(arm, axis=1).max() for arm in arms]
    return replace(
        facets,
        blocks=np.append(facets.blocks, n_blocks + np.array(numbers)),
        origins=np.vstack([facets.origins, origins]),
        frames=np.concatenate([facets.frames, frames]),
        polygons=np.append(facets.polygons, polygons),
        lower=np.vstack([facets.lower, [outline.min(axis=0) for outline in outlines]]),
        upper=np.vstack([facets.upper, [outline.max(axis=0) for outline in outlines]]),
        radii=np.append(facets.radii, radii),
        convex=np.append(facets.convex, convex_polygons(polygons)),
    )


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


def _outlines(corners: FloatArray, corner_start: IntArray, facet_of_face: IntArray, sizes: FloatArray) -> Polygons:
    """Outlines of facets, (n_facets,), united from the loops of their faces.

    corners : (n_corners, 2) m, in the frame of the facet, in order of faces
    sizes   : (n_facets,) m   block sizes
    """
    order = np.argsort(facet_of_face, kind="stable")
    facet = facet_of_face[order]
    faces = _scaled(polygons_from_loops(corners, corner_start)[order], 1 / sizes[facet])
    outlines = union_by_row(faces, facet, len(sizes))
    areas = shapely.area(outlines)
    lost = np.abs(areas - np.bincount(facet, weights=shapely.area(faces))) > _LOST * areas
    if lost.any():
        members = lost[facet]
        outlines[lost] = union_by_row(faces[members], (np.cumsum(lost) - 1)[facet[members]], int(lost.sum()), _GRID)
    return _scaled(outlines, sizes)


def _scaled(polygons: Polygons, factors: FloatArray) -> Polygons:
    """Polygons times their own factor."""
    return map_polygons(polygons, factors[:, None, None] * np.eye(2), np.zeros((len(polygons), 2)))
