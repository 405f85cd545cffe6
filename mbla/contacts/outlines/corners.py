"""Contact points: the corners of a common surface that are needed to describe it.

Clipping leaves duplicates, corners in the middle of an edge and, where outlines miss each other by rounding, tiny
steps. A corner is needless if it lies within the tolerance of the chord between its neighbours. Corners go one by one,
the least deviating first; each edge remembers how far the corners dropped along it lie from it at most, to the left and
to the right, so that many small steps of a rounded outline do not add up to more than the tolerance. Corners that stay
are not moved.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.model.solids.polygons import Polygons, polygons_from_rings, rings, widths
from mbla.model.solids.ragged import next_item

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
    Where the outline would cross itself with fewer corners, for instance at a neck, all of them stay.
    """
    found = _without_narrow_holes(Corners(*rings(polygons)), tolerance)
    fineness = np.minimum(tolerance, _SHARE_OF_WIDTH * widths(polygons))[found.polygon_of_corner]
    keep = _needed(found, fineness)
    keep |= _crossing_after(found, keep)
    return _from_least_corner(found.take(keep))


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


def _crossing_after(corners: Corners, keep: BoolArray) -> BoolArray:
    """Corners of polygons that lose some and cross themselves without them, (n_corners,)."""
    changed = np.zeros(corners.polygon_of_ring[-1] + 1 if len(keep) else 0, dtype=bool)
    changed[corners.polygon_of_corner[~keep]] = True
    if changed.any():
        thinned = corners.take(keep & changed[corners.polygon_of_corner])
        _, dense = np.unique(thinned.polygon_of_ring, return_inverse=True)
        outlines = polygons_from_rings(thinned.points, thinned.ring_start, dense.astype(np.int64))
        changed[changed] = ~shapely.is_valid(outlines)
    return changed[corners.polygon_of_corner]


def _without_narrow_holes(corners: Corners, tolerance: float) -> Corners:
    hole = np.zeros(len(corners.polygon_of_ring), dtype=bool)
    hole[1:] = corners.polygon_of_ring[1:] == corners.polygon_of_ring[:-1]
    if not hole.any():
        return corners
    alone = polygons_from_rings(corners.points, corners.ring_start, np.arange(len(hole)))
    narrow = hole & (widths(alone) < tolerance)
    return corners.take(~narrow[corners.ring_of_corner])


def _needed(corners: Corners, fineness: FloatArray) -> BoolArray:
    """Corners that stay, (n_corners,), where fineness (n_corners,) is the distance from the chord that is needless."""
    n = len(corners.points)
    ring = corners.ring_of_corner
    following = next_item(corners.ring_start)
    preceding = np.empty(n, dtype=np.int64)
    preceding[following] = np.arange(n)
    counts = np.diff(corners.ring_start)
    dropped = np.zeros((n, 2))  # farthest dropped corners to the right and left of the edge that leaves each corner
    keep = np.ones(n, dtype=bool)
    active = np.arange(n)
    while True:
        active = active[keep[active] & (counts[ring[active]] > 3)]
        before, after = preceding[active], following[active]
        chord = _off_chord(corners.points[active], corners.points[before], corners.points[after])
        spread = np.maximum(dropped[before], dropped[active]) + chord
        off = spread.max(axis=1)
        needless = off <= fineness[active]
        if not needless.any():
            return keep
        # Rings without a needless corner are done; of the others the least deviating corner goes.
        busy = np.unique(ring[active[needless]])
        candidates, off, spread = active[needless], off[needless], spread[needless]
        order = np.lexsort((off, ring[candidates]))
        least = order[np.searchsorted(ring[candidates[order]], busy)]
        gone = candidates[least]
        dropped[preceding[gone]] = spread[least]
        following[preceding[gone]] = following[gone]
        preceding[following[gone]] = preceding[gone]
        keep[gone] = False
        counts[ring[gone]] -= 1
        active = active[np.isin(ring[active], busy)]


def _off_chord(points: FloatArray, start: FloatArray, end: FloatArray) -> FloatArray:
    """Distances of points from the segments start–end, (n, 2): in the first column if to the right, else the second."""
    chord, arm = end - start, points - start
    length = np.einsum("ki,ki->k", chord, chord)
    share = np.einsum("ki,ki->k", arm, chord) / np.where(length > 0, length, 1.0)
    distance = np.hypot(*(arm - np.clip(share, 0.0, 1.0)[:, None] * chord).T)
    left = chord[:, 0] * arm[:, 1] - chord[:, 1] * arm[:, 0] > 0
    return np.stack([np.where(left, 0.0, distance), np.where(left, distance, 0.0)], axis=1)


def _from_least_corner(corners: Corners) -> Corners:
    """Rings turned so that each starts at its least corner along an odd direction."""
    ring = corners.ring_of_corner
    order = np.lexsort((corners.points @ _ODD_DIRECTION, ring))
    first = corners.ring_start[:-1]
    shift = order[first] - first
    counts = np.diff(corners.ring_start)
    position = first[ring] + (np.arange(len(ring)) - first[ring] + shift[ring]) % counts[ring]
    return Corners(corners.points[position], corners.ring_start, corners.polygon_of_ring)
