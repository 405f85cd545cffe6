"""Contact points: the corners of a common surface that are needed to describe it.

Clipping leaves duplicates, corners in the middle of an edge and, where outlines miss each other by rounding, tiny
steps. What lies within the tolerance of the outline without it goes (Douglas and Peucker 1973,
doi:10.3138/FM57-6770-U75U-7727, without making an outline cross itself). Corners that stay are not moved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.outlines.polygons import Polygons, polygons_from_rings, rings, widths
from mbla.model.solids.ragged import next_item

# Corners this close to each other, or to the line through their neighbours, are one, or none.
_COLLINEAR = 1e-9
_SHARE_OF_WIDTH = 0.1
# The first corner of an outline is the least one along a direction that no edge of a building is likely to follow.
_ODD_DIRECTION = np.array([0.8253356, 0.5646425])
PARALLEL = 1e-9
"""Difference of the two diagonals' middles, over their lengths, up to which four corners make a parallelogram."""


@dataclass(frozen=True)
class Corners:
    """Corners of polygons in local coordinates, flat.

    points          : (n_corners, 2)  outer boundary counter-clockwise, then holes clockwise
    ring_start      : (n_rings + 1,)
    polygon_of_ring : (n_rings,)      the outer ring of each polygon comes first
    """

    points: FloatArray
    ring_start: IntArray
    polygon_of_ring: IntArray

    @property
    def ring_of_corner(self) -> IntArray:
        """(n_corners,)."""
        return np.repeat(np.arange(len(self.ring_start) - 1), np.diff(self.ring_start))

    @property
    def polygon_of_corner(self) -> IntArray:
        """(n_corners,)."""
        return self.polygon_of_ring[self.ring_of_corner]

    def take(self, keep: BoolArray) -> Corners:
        """Only the corners marked, (n_corners,), rings that lose all of them left out."""
        counts = np.bincount(self.ring_of_corner[keep], minlength=len(self.polygon_of_ring))
        left = counts > 0
        return Corners(self.points[keep], starts(counts[left].astype(np.int64)), self.polygon_of_ring[left])


def needed_corners(polygons: Polygons, tolerance: float) -> Corners:
    """Corners of polygons with the needless ones dropped and holes narrower than the tolerance filled.

    A narrow polygon is described more finely: to a tenth of its width at most.
    Outer rings and holes keep at least three corners; each ring starts at its least corner along an odd direction.
    """
    found = _from_least_corner(_without_narrow_holes(Corners(*rings(polygons)), tolerance))
    outlines = polygons_from_rings(found.points, found.ring_start, found.polygon_of_ring)
    outlines = shapely.remove_repeated_points(outlines, _COLLINEAR)
    found = Corners(*rings(shapely.simplify(outlines, np.minimum(tolerance, _SHARE_OF_WIDTH * widths(outlines)))))
    # where a chord is parallel to an edge a corner amid that may stay, as far off as its ends
    return _from_least_corner(found.take(_off_chord(found) > _COLLINEAR))


def _off_chord(corners: Corners) -> FloatArray:
    """Distance of each corner from the line through its neighbours, (n_corners,)."""
    following = next_item(corners.ring_start)
    before, here, after = corners.points, corners.points[following], corners.points[following[following]]
    chord, arm = after - before, here - before
    distance = np.empty(len(here))
    distance[following] = np.abs(chord[:, 0] * arm[:, 1] - chord[:, 1] * arm[:, 0]) / np.maximum(
        np.hypot(*chord.T), 1e-300
    )
    return distance


def areas_and_centroids(corners: Corners) -> tuple[FloatArray, FloatArray]:
    """Area (n_polygons,) and centroid (n_polygons, 2) of each polygon, holes taken off; every polygon has corners."""
    polygon = corners.polygon_of_corner
    n = int(polygon.max(initial=-1)) + 1
    anchor = corners.points[np.searchsorted(polygon, np.arange(n))]
    p = corners.points - anchor[polygon]
    q = p[next_item(corners.ring_start)]
    cross = p[:, 0] * q[:, 1] - p[:, 1] * q[:, 0]
    moments = [np.bincount(polygon, weights, n) / 6 for weights in ((p + q) * cross[:, None]).T]
    area = np.bincount(polygon, cross, n) / 2
    return area, anchor + np.stack(moments, axis=1) / area[:, None]


def parallelograms(corners: Corners, n: int) -> BoolArray:
    """Polygons with four corners and parallel edges, (n,)."""
    found = np.zeros(n, dtype=bool)
    one_ring = np.bincount(corners.polygon_of_ring, minlength=n) == 1
    rings = np.flatnonzero((np.diff(corners.ring_start) == 4) & one_ring[corners.polygon_of_ring])
    spots = corners.points[corners.ring_start[rings][:, None] + np.arange(4)]
    first, second = spots[:, 2] - spots[:, 0], spots[:, 3] - spots[:, 1]
    off = np.linalg.norm(spots[:, 0] + spots[:, 2] - spots[:, 1] - spots[:, 3], axis=1)
    found[corners.polygon_of_ring[rings]] = off <= PARALLEL * (
        np.linalg.norm(first, axis=1) + np.linalg.norm(second, axis=1)
    )
    return found


def _without_narrow_holes(corners: Corners, tolerance: float) -> Corners:
    hole = np.zeros(len(corners.polygon_of_ring), dtype=bool)
    hole[1:] = corners.polygon_of_ring[1:] == corners.polygon_of_ring[:-1]
    if not hole.any():
        return corners
    alone = polygons_from_rings(corners.points, corners.ring_start, np.arange(len(hole)))
    narrow = hole & (widths(alone) < tolerance)
    return corners.take(~narrow[corners.ring_of_corner])


def _from_least_corner(corners: Corners) -> Corners:
    """Rings turned so that each starts at its least corner along an odd direction."""
    ring = corners.ring_of_corner
    order = np.lexsort((corners.points @ _ODD_DIRECTION, ring))
    first = corners.ring_start[:-1]
    shift = order[first] - first
    counts = np.diff(corners.ring_start)
    position = first[ring] + (np.arange(len(ring)) - first[ring] + shift[ring]) % counts[ring]
    return Corners(corners.points[position], corners.ring_start, corners.polygon_of_ring)
