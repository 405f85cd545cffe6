"""Common surfaces of facets at an angle, along the normal of their contact: that of the face on which an edge stands.

Where both facets have an edge there it is the mean of both, as it is where they are parallel.
"""

from __future__ import annotations

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.facets import Facets
from mbla.contacts.outlines.overlay import Overlays, Planes, build_overlays, concatenate, gap_at, local_maps
from mbla.model.solids.polygons import Polygons, intersect, map_polygons

ON_EDGE = 1e-3
"""Distance from the edge of a facet, over block size, within which a point is on it: edges that have slipped by less
against each other hinge as if they had not."""

FLAT = 1e-9
"""Angle between two facets, rad, up to which they are parallel."""


def along_contact_normals(
    facets: Facets, bodies: IntArray, pairs: IntArray, sizes: FloatArray
) -> tuple[Overlays, Polygons]:
    """Overlays of pairs of facets, (n, 2), and what each pair shares, (n,), which may be nothing.

    bodies : (n, 2)
    sizes  : (n_blocks,) of the second facet's block, and of the first's unless that is ground
    """
    a, b = pairs.T
    size = sizes[bodies[:, 1]]
    block = np.flatnonzero(bodies[:, 0] < len(sizes))
    size[block] = np.minimum(size[block], sizes[bodies[block, 0]])
    near = (np.maximum(facets.lower[a], facets.lower[b]) + np.minimum(facets.upper[a], facets.upper[b])) / 2

    def laid(rows: IntArray, host: FloatArray | float) -> tuple[Overlays, Polygons, tuple[Polygons, Polygons]]:
        one, two = a[rows], b[rows]
        first, second = (Planes(facets.origins[each], facets.normals[each]) for each in (one, two))
        overlays = build_overlays(bodies[rows], pairs[rows], first, second, near[rows], size[rows], host)
        both = outlines(overlays, facets, 0), outlines(overlays, facets, 1)
        return overlays, intersect(*both, facets.convex[one] & facets.convex[two]), both

    between, common, both = laid(np.arange(len(a)), 0.0)
    host = _faces_stood_on(between, common, *both)
    tilted = np.flatnonzero(host)
    if len(tilted):
        turned, common[tilted], _ = laid(tilted, host[tilted])
        order = np.arange(len(a), dtype=np.int64)
        order[tilted] = len(a) + np.arange(len(tilted))
        between = concatenate([between, turned]).take(order)
    return between, common


def outlines(overlays: Overlays, facets: Facets, side: int) -> Polygons:
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
