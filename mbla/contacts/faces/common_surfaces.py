"""What facets that face each other within reach share, as built or where blocks have moved to.

As built the plane of a common surface is the mean of both facets. Facets of moved blocks are at an angle: there it is
the plane of the face on which an edge of the other block stands, and the mean where both have an edge there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.faces.broad_phase import Faces, find_facet_pairs
from mbla.contacts.faces.facets import Facets, with_surfaces
from mbla.contacts.outlines.overlay import Overlays, Planes, build_overlays, concatenate, gap_at, local_maps
from mbla.model.model import Ground
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polygons import Polygons, boxes_overlap, intersect, map_polygons

ON_EDGE = 1e-3
"""Distance from the edge of a facet, over block size, within which a point is on it: edges that have slipped by less
against each other hinge as if they had not."""

FLAT = 1e-9
"""Angle between two facets, rad, up to which they are parallel."""


@dataclass(frozen=True)
class FacetSearch:
    """Which facets are compared, and how.

    reach  : gap or overlap of two facets, over the size of the smaller block
    faces  : whether two may be in contact
    narrow : extent over block size, up to which a common surface is none
    moved  : facets are those of moved blocks
    """

    reach: float
    faces: Faces
    narrow: float = 0.0
    moved: bool = False


def find_common_surfaces(
    blocks: Blocks, facets: Facets, grounds: Sequence[Ground], search: FacetSearch
) -> tuple[Overlays, Polygons, Facets]:
    """Overlays, what each pair shares, which may be nothing, and the facets by whose rows pairs are numbered.

    These are the facets given, and behind them the ground surfaces that end somewhere; −1 stands for ground planes.
    """
    sheets = with_surfaces(facets, grounds, len(blocks))
    pairs = find_facet_pairs(blocks, sheets, grounds, search.reach, search.faces)
    overlays, common = _between(blocks, sheets, pairs, search)
    found, shapes = [overlays], [common]
    for number, ground in enumerate(grounds):
        if ground.outline is None:
            on_ground = _on_ground(blocks, facets, ground, len(blocks) + number, search)
            found.append(on_ground)
            shapes.append(_outlines(on_ground, facets, 1))
    return concatenate(found), np.concatenate(shapes), sheets


def _between(blocks: Blocks, facets: Facets, pairs: IntArray, search: FacetSearch) -> tuple[Overlays, Polygons]:
    """Overlays of pairs of facets, (n, 2), those of ground surfaces among them, and what they share."""
    sizes = np.append(blocks.sizes, np.full(max(int(facets.blocks.max(initial=0)) + 1 - len(blocks), 0), np.inf))

    def laid(pairs: IntArray, host: FloatArray | float) -> tuple[Overlays, Polygons, Polygons]:
        a, b = pairs.T
        # Amid what the two bounding boxes share: near the common surface, however large one of the facets is.
        shared = (np.maximum(facets.lower[a], facets.lower[b]) + np.minimum(facets.upper[a], facets.upper[b])) / 2
        first, second = (Planes(facets.origins[each], facets.normals[each]) for each in (a, b))
        bodies = facets.blocks[pairs]
        overlays = build_overlays(bodies, pairs, first, second, shared, sizes[bodies].min(axis=1), host)
        return overlays, _outlines(overlays, facets, 0), _outlines(overlays, facets, 1)

    def common(pairs: IntArray, first: Polygons, second: Polygons) -> Polygons:
        return intersect(first, second, facets.convex[pairs[:, 0]] & facets.convex[pairs[:, 1]])

    overlays, first, second = laid(pairs, 0.0)
    keep = np.flatnonzero(boxes_overlap(first, second, search.narrow))
    overlays, pairs, first, second = overlays.take(keep), pairs[keep], first[keep], second[keep]
    shapes = common(pairs, first, second)
    host = _faces_stood_on(overlays, shapes, first, second) if search.moved else np.zeros(len(pairs))
    tilted = np.flatnonzero(host)
    if len(tilted):
        turned, *both = laid(pairs[tilted], host[tilted])
        shapes[tilted] = common(pairs[tilted], *both)
        order = np.arange(len(pairs), dtype=np.int64)
        order[tilted] = len(pairs) + np.arange(len(tilted))
        overlays = concatenate([overlays, turned]).take(order)
    return overlays, shapes


def _on_ground(blocks: Blocks, facets: Facets, ground: Ground, body: int, search: FacetSearch) -> Overlays:
    """Facets that face a ground plane and come within reach of it somewhere."""
    normals = np.broadcast_to(ground.normal, (len(facets), 3))
    bodies = np.stack([np.full(len(facets), body), facets.blocks], axis=1)
    pairs = np.stack([np.full(len(facets), -1), np.arange(len(facets))], axis=1)
    sizes = blocks.sizes[facets.blocks]
    height = np.abs((facets.origins - ground.point) @ ground.normal)
    cosine = facets.normals @ ground.normal
    near = height <= search.reach * sizes + np.sqrt(np.maximum(1 - cosine**2, 0.0)) * facets.radii
    carried = np.ones(len(facets), dtype=bool) if ground.blocks is None else np.isin(facets.blocks, ground.blocks)
    chosen = np.flatnonzero(near & carried & search.faces(bodies, pairs, normals, facets.normals))
    return build_overlays(
        bodies=bodies[chosen],
        facets=pairs[chosen],
        a=Planes(np.broadcast_to(ground.point, (len(chosen), 3)), normals[chosen]),
        b=Planes(facets.origins[chosen], facets.normals[chosen]),
        near=facets.origins[chosen],
        sizes=sizes[chosen],
        host=1.0 if search.moved else 0.0,
    )


def _outlines(overlays: Overlays, facets: Facets, side: int) -> Polygons:
    """Outlines of the facets of body a (side 0) or b (side 1) in local coordinates."""
    facet = overlays.facets[:, side]
    matrices, offsets = local_maps(overlays, facets.origins[facet], facets.frames[facet])
    return map_polygons(facets.polygons[facet], matrices, offsets)


def _faces_stood_on(overlays: Overlays, common: Polygons, first: Polygons, second: Polygons) -> FloatArray:
    """Whose plane is that of the contact, as ``build_overlays`` takes it, (n,).

    Where two facets at an angle touch, along the part of their common surface of the least gap, an edge of one stands
    on the face of the other: the normal is that of the face. Where both have an edge there it is the mean.
    """
    host = np.zeros(len(common))
    rows = np.flatnonzero((np.hypot(overlays.gaps[:, 1], overlays.gaps[:, 2]) > FLAT) & ~shapely.is_empty(common))
    points, row = shapely.get_coordinates(common[rows], return_index=True)
    if not len(row):
        return host
    gaps, start = gap_at(overlays, rows[row], points), np.flatnonzero(np.diff(row, prepend=-1))
    least, most = np.minimum.reduceat(gaps, start), np.maximum.reduceat(gaps, start)
    closed = (gaps <= (least + 1e-6 * (most - least))[row]).astype(float)
    touch = np.add.reduceat(closed[:, None] * points, start) / np.add.reduceat(closed, start)[:, None]
    on_first, on_second = (
        shapely.distance(shapely.points(touch), shapely.boundary(each[rows])) < ON_EDGE for each in (first, second)
    )
    host[rows] = np.where(on_first & ~on_second, -1.0, np.where(on_second & ~on_first, 1.0, 0.0))
    return host
