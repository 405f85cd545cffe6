"""Share of the interface area that each contact point stands for.

A third of a triangle goes to each of its corners: the shares of any triangulation add up to the area and have their
first moment about its centroid. A convex polygon is triangulated by the fan from every corner in turn and the shares
are averaged, so that no diagonal is preferred: a rectangle gives a quarter to each corner. Other polygons, and those
with holes, take their constrained Delaunay triangulation. All shares are positive.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.contacts.corners import Corners
from mbla.contacts.loops import convex_loops
from mbla.contacts.polygons import polygons_from_rings, triangles


def point_areas(corners: Corners, n_polygons: int) -> FloatArray:
    """Area shares of the corners of polygons, (n_corners,), in the square of their unit."""
    shares = np.zeros(len(corners.points))
    n_rings = np.bincount(corners.polygon_of_ring, minlength=n_polygons)
    convex_ring = convex_loops(corners.points, corners.ring_start)
    fan = convex_ring & (n_rings[corners.polygon_of_ring] == 1)
    counts = np.diff(corners.ring_start)
    for count in np.unique(counts[fan]):
        first = corners.ring_start[:-1][fan & (counts == count)]
        rows = first[:, None] + np.arange(count)
        shares[rows] = _fan_shares(corners.points[rows])
    rest = ~fan[corners.ring_of_corner]
    if rest.any():
        shares[rest] = _triangle_shares(corners, rest)
    return shares


def _fan_shares(points: FloatArray) -> FloatArray:
    """Shares (k, m) of the corners of k convex polygons, averaged over the fans from every corner.

    points : (k, m, 2) counter-clockwise
    """
    k, m, _ = points.shape
    shares = np.zeros((k, m))
    following = np.roll(points, -1, axis=1)
    for apex in range(m):
        first, second = points - points[:, apex, None], following - points[:, apex, None]
        third = (first[..., 0] * second[..., 1] - first[..., 1] * second[..., 0]) / 6
        shares[:, apex] += third.sum(axis=1)
        shares += third + np.roll(third, 1, axis=1)
    shares /= m
    return shares


def _triangle_shares(corners: Corners, chosen: BoolArray) -> FloatArray:
    """Shares of the corners chosen (whole polygons), in order, from constrained Delaunay triangles."""
    part = corners.take(chosen)
    _, dense = np.unique(part.polygon_of_ring, return_inverse=True)
    polygon_of_ring = dense.astype(np.int64)
    corner_polygon = polygon_of_ring[part.ring_of_corner]
    spots, row = triangles(polygons_from_rings(part.points, part.ring_start, polygon_of_ring))
    edge1, edge2 = spots[:, 1] - spots[:, 0], spots[:, 2] - spots[:, 0]
    third = np.abs(edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]) / 6
    key = places(
        np.concatenate([corner_polygon, np.repeat(row, 3)]), np.concatenate([part.points, spots.reshape(-1, 2)])
    )
    own, used = key[: len(corner_polygon)], key[len(corner_polygon) :]
    at_place = np.bincount(used, weights=np.repeat(third, 3), minlength=int(key.max()) + 1)
    # Where a hole touches the outline two corners share one place, and its area.
    shares: FloatArray = at_place[own] / np.bincount(own, minlength=len(at_place))[own]
    return shares


def places(polygon: IntArray, points: FloatArray) -> IntArray:
    """Number of each distinct (polygon, x, y), (n,); triangles repeat the corners exactly, bit by bit."""
    order = np.lexsort((points[:, 1], points[:, 0], polygon))
    step = (np.diff(polygon[order]) != 0) | (np.diff(points[order], axis=0) != 0).any(axis=1)
    number = np.empty(len(order), dtype=np.int64)
    number[order] = np.concatenate([[0], np.cumsum(step)])
    return number
