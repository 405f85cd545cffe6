"""Triangles that fill a region of the plane: Delaunay's, with every corner and edge of its outline among theirs.

Points stand along the outline about the size of the cells apart, and inside on a lattice of equilateral triangles. An
edge between points of the outline that Delaunay's triangles do not have is halved until they have it, so that the mesh
conforms to the outline.
"""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import shapely
from scipy.spatial import Delaunay

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import PlaneMesh

INSIDE = 0.55
"""least distance of points of the lattice to the outline, over the size of the cells"""
HALVINGS = 20
"""greatest number of times that edges of the outline are halved until Delaunay's triangles have them"""
FLAT = 1e-9
"""area over the square of the size of the cells up to which three points in a row are none"""
AREA = np.sqrt(3.0) / 4.0
"""of an equilateral triangle with sides of 1"""


class NotConformingError(Exception):
    """Edges of an outline are not among the triangles, however short: two of them meet at nearly no angle."""


def triangulate(polygons: Sequence[shapely.Polygon], size: float) -> PlaneMesh:
    """Triangles of about a size that fill polygons, which have in common a corner at most.

    polygons : with all corners that are to stay

    Raises NotConformingError where edges of the outline do not become edges of triangles.
    """
    meshes = [_triangulated(shapely.orient_polygons(polygon), size) for polygon in polygons]
    first = np.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    return PlaneMesh(
        np.concatenate([mesh.points for mesh in meshes]),
        np.concatenate([mesh.triangles + start for mesh, start in zip(meshes, first, strict=False)]),
        np.concatenate([mesh.along for mesh in meshes]),
        np.concatenate([mesh.inside for mesh in meshes]),
    )


def _triangulated(region: shapely.Polygon, size: float) -> PlaneMesh:
    """Triangles of a polygon whose outer corners are counter-clockwise."""
    origin = np.array(region.bounds[:2])  # near zero coordinates cost no digits
    loops = [shapely.get_coordinates(ring)[:-1] - origin for ring in (region.exterior, *region.interiors)]
    outline, edges, along = _outline(loops, size)
    lattice = _lattice(region, size) - origin
    points, triangles, along = _conforming(outline, edges, along, lattice)
    mesh = PlaneMesh(
        points + origin,
        triangles,
        np.concatenate([along, np.zeros((len(lattice), 2))]),
        np.arange(len(points)) >= len(points) - len(lattice),
    )
    areas, middles = mesh.areas(points), mesh.points[triangles].mean(axis=1)
    kept = (np.abs(areas) > FLAT * size**2) & shapely.contains_xy(region, middles[:, 0], middles[:, 1])
    oriented = np.where((areas > 0)[:, None], triangles, triangles[:, ::-1])[kept]
    return PlaneMesh(mesh.points, oriented, mesh.along, mesh.inside)


def _conforming(
    outline: FloatArray, edges: IntArray, along: FloatArray, lattice: FloatArray
) -> tuple[FloatArray, IntArray, FloatArray]:
    """All points, those of the outline first, their triangles, and the directions of points of the outline."""
    for _ in range(HALVINGS):
        points = np.concatenate([outline, lattice])
        triangles = Delaunay(points).simplices.astype(np.int64)
        missing = ~np.isin(_keys(edges, len(points)), _keys(_sides(triangles), len(points)))
        if not missing.any():
            return points, triangles, along
        split = edges[missing]
        new = len(outline) + np.arange(len(split))
        direction = outline[split[:, 1]] - outline[split[:, 0]]
        outline = np.concatenate([outline, outline[split].mean(axis=1)])
        along = np.concatenate([along, direction / np.linalg.norm(direction, axis=1)[:, None]])
        halves = np.stack([split[:, 0], new], axis=1), np.stack([new, split[:, 1]], axis=1)
        edges = np.concatenate([edges[~missing], *halves])
    raise NotConformingError


def _outline(loops: Sequence[FloatArray], size: float) -> tuple[FloatArray, IntArray, FloatArray]:
    """Points along the outline, its edges between them, and directions of its edges at points between corners."""
    points, edges, along = [], [], []
    first = 0
    for loop in loops:
        sides = np.roll(loop, -1, axis=0) - loop
        lengths = np.linalg.norm(sides, axis=1)
        parts = np.maximum(1, np.rint(lengths / size)).astype(np.int64)
        row = np.repeat(np.arange(len(loop)), parts)
        step = np.arange(len(row)) - np.repeat(np.cumsum(parts) - parts, parts)
        points.append(loop[row] + sides[row] * (step / parts[row])[:, None])
        along.append(np.where(step[:, None] > 0, sides[row] / lengths[row, None], 0.0))
        own = first + np.arange(len(row))
        edges.append(np.stack([own, np.roll(own, -1)], axis=1))
        first += len(row)
    return np.concatenate(points), np.concatenate(edges), np.concatenate(along)


def _lattice(region: shapely.Polygon, size: float) -> FloatArray:
    """Points of equilateral triangles well inside a region, (n, 2)."""
    left, low, right, high = region.bounds
    height = size * np.sqrt(3.0) / 2.0
    rows = np.arange(low + height / 2.0, high, height)
    columns = np.arange(left, right + size, size)
    x = columns[None, :] + np.where(np.arange(len(rows)) % 2, 0.0, size / 2.0)[:, None]
    points = np.stack([x.ravel(), np.repeat(rows, len(columns))], axis=1)
    inner = shapely.buffer(region, -INSIDE * size)
    return np.asarray(points[shapely.contains_xy(inner, points[:, 0], points[:, 1])])


def _sides(triangles: IntArray) -> IntArray:
    """Pairs of points, (3 m, 2)."""
    return np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])


def _keys(pairs: IntArray, count: int) -> IntArray:
    """A number for each pair of points, whatever their order, (n,)."""
    return np.asarray(pairs.min(axis=1) * count + pairs.max(axis=1))
