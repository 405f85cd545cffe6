"""Polygons in the plane, in bulk, by shapely.

An array of polygons is a numpy array of shapely geometries (polygons or multipolygons, with or without holes).
"""

from __future__ import annotations

from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item, starts
from mbla.model.solids.convex import clip_convex, convex_loops, signed_areas
from mbla.process.late import shapely

Polygons: TypeAlias = NDArray[np.object_]

_POLYGON, _MULTIPOLYGON, _COLLECTION = 3, 6, 7

# Grid that overlays are snapped to, for coordinates of order one.
GRID = 1e-11


def polygons_from_loops(points: FloatArray, loop_start: IntArray) -> Polygons:
    """One polygon without holes per loop of corners; invalid ones (a bridge to a hole, a crossing) are repaired.

    points     : (n_corners, 2)
    loop_start : (n_loops + 1,)
    """
    polygons = polygons_from_rings(points, loop_start, np.arange(len(loop_start) - 1))
    suspects = np.flatnonzero(~convex_loops(points, loop_start))
    suspects = suspects[~shapely.is_valid(polygons[suspects])]
    if len(suspects):
        polygons[suspects] = _polygonal(shapely.make_valid(polygons[suspects]))
    return polygons


def convex_polygons(polygons: Polygons) -> BoolArray:
    """True for polygons in one part, without holes, that are convex, (n,)."""
    single = (shapely.get_type_id(polygons) == _POLYGON) & (shapely.get_num_interior_rings(polygons) == 0)
    single &= ~shapely.is_empty(polygons)
    convex: BoolArray = single.copy()
    if single.any():
        convex[single] = convex_loops(*_open_loops(polygons[single]))
    return convex


def polygons_from_rings(points: FloatArray, ring_start: IntArray, polygon_of_ring: IntArray) -> Polygons:
    """Polygons with holes; the first ring of each polygon is its outer boundary, the rest are its holes.

    points          : (n_corners, 2)
    ring_start      : (n_rings + 1,)
    polygon_of_ring : (n_rings,) ascending, every polygon from 0 has at least one ring
    """
    rings = shapely.linearrings(points, indices=np.repeat(np.arange(len(ring_start) - 1), np.diff(ring_start)))
    return np.atleast_1d(shapely.polygons(rings, indices=polygon_of_ring))


def convex_hulls(points: FloatArray, loop_start: IntArray) -> tuple[FloatArray, IntArray]:
    """Corners of the convex hulls of loops, counter-clockwise, (n_corners, 2), and their starts, (n_loops + 1,).

    points     : (n_points, 2)
    loop_start : (n_loops + 1,) no loop has its points all on a line
    """
    row = np.repeat(np.arange(len(loop_start) - 1), np.diff(loop_start))
    hulls = shapely.convex_hull(np.atleast_1d(shapely.multipoints(points, indices=row)))
    corners_of_hulls, start, _ = rings(hulls)
    return corners_of_hulls, start


def union_by_row(polygons: Polygons, row: IntArray, n_rows: int, grid: float | None = None) -> Polygons:
    """Union of the polygons of each row, (n_rows,).

    polygons : (n,)
    row      : (n,) ascending; every row from 0 to n_rows - 1 occurs
    grid     : coordinates are snapped to multiples of it, so that edges that differ by rounding merge
    """
    start = starts(np.bincount(row, minlength=n_rows).astype(np.int64))
    counts = np.diff(start)
    result: Polygons = polygons[start[:-1]].copy()
    # Padded tables of rows with alike counts: one call each, and no table wider than twice what is in it.
    width = 2
    while (counts >= width).any():
        rows = np.flatnonzero((counts >= width) & (counts < 2 * width))
        if len(rows):
            column = np.arange(2 * width - 1)
            inside = column < counts[rows, None]
            table = np.full(inside.shape, None, dtype=object)
            table[inside] = polygons[(start[rows, None] + column)[inside]]
            result[rows] = shapely.union_all(table, axis=1, grid_size=grid)
        width *= 2
    return result


def map_polygons(polygons: Polygons, matrices: FloatArray, offsets: FloatArray) -> Polygons:
    """Each polygon under its own affine map x -> matrix x + offset.

    matrices : (n, 2, 2)
    offsets  : (n, 2)
    """
    points, row = shapely.get_coordinates(polygons, return_index=True)
    mapped = (matrices[row] * points[:, None]).sum(axis=2) + offsets[row]
    result: Polygons = shapely.set_coordinates(polygons.copy(), mapped)
    return result


def intersect(first: Polygons, second: Polygons, convex: BoolArray) -> Polygons:
    """Common part of each pair, (n,); may be empty or of lower dimension.

    convex : (n,) both polygons are convex and without holes
    """
    common: Polygons = np.full(len(first), shapely.Polygon(), dtype=object)
    rows = np.flatnonzero(convex)
    if len(rows):
        common[rows] = _intersect_convex(first[rows], second[rows])
    rows = np.flatnonzero(~convex)
    if len(rows):
        # Snapped to a grid the overlay is robust; in floating arithmetic it may lose parts whose edges nearly coincide.
        common[rows] = shapely.intersection(first[rows], second[rows], grid_size=GRID)
    return common


def _intersect_convex(first: Polygons, second: Polygons) -> Polygons:
    points, start = clip_convex(*_open_loops(first), *_open_loops(second))
    counts = np.diff(start)
    solid = counts >= 3
    common: Polygons = np.full(len(first), shapely.Polygon(), dtype=object)
    if solid.any():
        corners = points[np.repeat(solid, counts)]
        common[solid] = polygons_from_rings(corners, starts(counts[solid]), np.arange(int(solid.sum())))
    return common


def _open_loops(loops: Polygons) -> tuple[FloatArray, IntArray]:
    """Corners of rings, or of polygons without holes, the closing one left out, and their starts."""
    points, row = shapely.get_coordinates(loops, return_index=True)
    kept = np.append(row[1:] == row[:-1], False)[: len(row)]
    return points[kept], starts(np.bincount(row[kept], minlength=len(loops)).astype(np.int64))


def boxes_overlap(first: Polygons, second: Polygons, margin: float) -> BoolArray:
    """True where the bounding rectangles of a pair share more than ``margin`` along both axes, (n,)."""
    a, b = shapely.bounds(first), shapely.bounds(second)
    shared = np.minimum(a[:, 2:], b[:, 2:]) - np.maximum(a[:, :2], b[:, :2])
    return np.asarray((shared > margin).all(axis=1))


def connected_parts(shapes: Polygons) -> tuple[Polygons, IntArray]:
    """The polygons that shapes consist of, points and lines left out, and the row of the shape each comes from."""
    parts, row = shapely.get_parts(shapes, return_index=True)
    if (shapely.get_type_id(parts) >= _MULTIPOLYGON).any():
        parts, inner = shapely.get_parts(parts, return_index=True)
        row = row[inner]
    keep = (shapely.get_type_id(parts) == _POLYGON) & ~shapely.is_empty(parts)
    return parts[keep], row[keep].astype(np.int64)


def widths(polygons: Polygons) -> FloatArray:
    """Width of the rectangle with the same area A and perimeter P, (n,); close to 2 A / P for slivers.

    Shapes rounder than a square have no such rectangle; they get 4 A / P.
    """
    area = shapely.area(polygons)
    half = shapely.length(polygons) / 2
    root = np.sqrt(np.maximum(half**2 - 4 * area, 0.0))
    return np.asarray(2 * area / np.where(half + root > 0, half + root, 1.0))


def rings(polygons: Polygons) -> tuple[FloatArray, IntArray, IntArray]:
    """Corners of all rings without the closing one; outer rings counter-clockwise, holes clockwise.

    Returns
    -------
    points          : (n_corners, 2)
    ring_start      : (n_rings + 1,)
    polygon_of_ring : (n_rings,)     the outer ring of each polygon comes first
    """
    loops, polygon = shapely.get_rings(polygons, return_index=True)
    points, start = _open_loops(loops)
    ring = row_of_item(start)
    outer = np.ones(len(loops), dtype=bool)
    outer[1:] = polygon[1:] != polygon[:-1]
    wrong = (signed_areas(points, start) > 0) != outer
    position = np.arange(len(points))
    mirrored = start[ring] + start[ring + 1] - 1 - position
    return points[np.where(wrong[ring], mirrored, position)], start, polygon.astype(np.int64)


def triangles(polygons: Polygons) -> tuple[FloatArray, IntArray]:
    """Constrained Delaunay triangles of polygons with corners of theirs only, holes respected.

    Returns
    -------
    points : (n_triangles, 3, 2) counter-clockwise
    row    : (n_triangles,)  polygon that each triangle belongs to
    """
    parts, row = shapely.get_parts(shapely.constrained_delaunay_triangles(polygons), return_index=True)
    points = shapely.get_coordinates(parts).reshape(len(parts), 4, 2)[:, :3]
    (a, b), (c, d) = (points[:, 1] - points[:, 0]).T, (points[:, 2] - points[:, 0]).T
    return np.where((a * d < b * c)[:, None, None], points[:, ::-1], points), row.astype(np.int64)


def _polygonal(shapes: Polygons) -> Polygons:
    """Shapes with their points and lines left out, as one (multi)polygon each."""
    parts, row = connected_parts(shapes)
    result: Polygons = np.full(len(shapes), shapely.Polygon(), dtype=object)
    if len(parts):
        # Every row must be named once for union_by_row: rows that lost everything keep the empty polygon.
        present, dense = np.unique(row, return_inverse=True)
        result[present] = union_by_row(parts, dense.astype(np.int64), len(present))
    return result
