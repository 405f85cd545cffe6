"""Triangles that fill a region of the plane: Delaunay's, with every corner and edge of its outline among theirs.

Points stand along the outline about the size of the cells apart, and inside on lattices of equilateral triangles, each
with half of the sides of the one before: near what bears on part of a side, as a footing does, cells are smaller. An
edge between points of the outline that Delaunay's triangles do not have is halved until they have it, so that the mesh
conforms to the outline.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely
from scipy.spatial import Delaunay, KDTree

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane_mesh import PlaneMesh

INSIDE = 0.55
"""least distance of points of the lattice to the outline, over the size of the cells"""
HALVINGS = 20
"""greatest number of times that edges of the outline are halved until Delaunay's triangles have them"""
FLAT = 1e-9
"""area over the square of the size of the cells up to which three points in a row are none"""
ALONG = 4
"""cells along what bears on part of a side"""
GROWTH = 0.4
"""of the size of cells away from that, over the distance"""
AREA = np.sqrt(3.0) / 4.0
"""of an equilateral triangle with sides of 1"""


LATTICES = 4
"""of equilateral triangles, each with half of the sides of the one before"""
APART = 0.7
"""least distance of points of a lattice to those of larger ones, over the size of the cells there"""


@dataclass(frozen=True)
class CellSize:
    """How large cells are to be.

    most  : size of their sides
    sides : (n, 2, 2) ends of segments, near which cells are smaller, and grow by GROWTH away from them
    sizes : (n,) along these
    """

    most: float
    sides: FloatArray = field(default_factory=lambda: np.empty((0, 2, 2)))
    sizes: FloatArray = field(default_factory=lambda: np.empty(0))

    def at(self, points: FloatArray) -> FloatArray:
        """At points (n, 2), (n,)."""
        sizes = np.full(len(points), self.most)
        for side, size in zip(self.sides, self.sizes.tolist(), strict=True):
            away = shapely.distance(shapely.LineString(side), shapely.points(points))
            sizes = np.minimum(sizes, size + GROWTH * away)
        return np.asarray(np.maximum(sizes, self.most / 2.0 ** (LATTICES - 1)))


class NotConformingError(Exception):
    """Edges of an outline are not among the triangles, however short: two of them meet at nearly no angle."""


def triangulate(polygons: Sequence[shapely.Polygon], size: CellSize) -> PlaneMesh:
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


def _triangulated(region: shapely.Polygon, size: CellSize) -> PlaneMesh:
    """Triangles of a polygon whose outer corners are counter-clockwise."""
    origin = np.array(region.bounds[:2])  # near zero coordinates cost no digits
    loops = [shapely.get_coordinates(ring)[:-1] - origin for ring in (region.exterior, *region.interiors)]
    outline, edges, along = _outline(loops, replace(size, sides=size.sides - origin))
    lattice = _lattices(region, size) - origin
    points, triangles, along = _conforming(outline, edges, along, lattice)
    mesh = PlaneMesh(
        points + origin,
        triangles,
        np.concatenate([along, np.zeros((len(lattice), 2))]),
        np.arange(len(points)) >= len(points) - len(lattice),
    )
    areas, middles = mesh.areas(points), mesh.points[triangles].mean(axis=1)
    kept = (np.abs(areas) > FLAT * size.most**2) & shapely.contains_xy(region, middles[:, 0], middles[:, 1])
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


SAMPLES = 16
"""places along a side at which sizes of cells are looked at"""


def _outline(loops: Sequence[FloatArray], size: CellSize) -> tuple[FloatArray, IntArray, FloatArray]:
    """Points along the outline, its edges between them, and directions of its edges at points between corners."""
    points, edges, along = [], [], []
    first = 0
    for loop in loops:
        sides = np.roll(loop, -1, axis=0) - loop
        lengths = np.linalg.norm(sides, axis=1)
        shares = [_shares(start, side, size) for start, side in zip(loop, sides, strict=True)]
        row = np.repeat(np.arange(len(loop)), [len(own) for own in shares])
        share = np.concatenate(shares)
        points.append(loop[row] + sides[row] * share[:, None])
        along.append(np.where(share[:, None] > 0.0, sides[row] / lengths[row, None], 0.0))
        own = first + np.arange(len(row))
        edges.append(np.stack([own, np.roll(own, -1)], axis=1))
        first += len(row)
    return np.concatenate(points), np.concatenate(edges), np.concatenate(along)


def _shares(start: FloatArray, side: FloatArray, size: CellSize) -> FloatArray:
    """Where edges along a side begin, as shares of it, from 0: about the size of cells there apart."""
    at = (np.arange(SAMPLES) + 0.5) / SAMPLES
    per_sample = float(np.linalg.norm(side)) / SAMPLES / size.at(start + at[:, None] * side)
    sums = np.append(0.0, np.cumsum(per_sample))
    parts = max(1, int(np.rint(sums[-1])))
    return np.asarray(np.interp(sums[-1] * np.arange(parts) / parts, sums, np.linspace(0.0, 1.0, SAMPLES + 1)))


def _lattices(region: shapely.Polygon, size: CellSize) -> FloatArray:
    """Points of lattices well inside a region, (n, 2), each where cells are about the size of its triangles."""
    found = np.empty((0, 2))
    for number in range(LATTICES):
        side = size.most / 2.0**number
        points = _lattice(region, side)
        there = size.at(points)
        kept = (there <= side * np.sqrt(2.0)) | (number == 0)
        kept &= (there > side / np.sqrt(2.0)) | (number == LATTICES - 1)
        kept &= shapely.distance(region.boundary, shapely.points(points)) >= INSIDE * there
        if len(found) and kept.any():
            kept[kept] = KDTree(found).query(points[kept])[0] >= APART * there[kept]
        found = np.concatenate([found, points[kept]])
        if not len(size.sides):
            break
    return found


def _lattice(region: shapely.Polygon, size: float) -> FloatArray:
    """Points of equilateral triangles inside a region, (n, 2)."""
    left, low, right, high = region.bounds
    height = size * np.sqrt(3.0) / 2.0
    rows = np.arange(low + height / 2.0, high, height)
    columns = np.arange(left, right + size, size)
    x = columns[None, :] + np.where(np.arange(len(rows)) % 2, 0.0, size / 2.0)[:, None]
    points = np.stack([x.ravel(), np.repeat(rows, len(columns))], axis=1)
    return np.asarray(points[shapely.contains_xy(region, points[:, 0], points[:, 1])])


def _sides(triangles: IntArray) -> IntArray:
    """Pairs of points, (3 m, 2)."""
    return np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])


def _keys(pairs: IntArray, count: int) -> IntArray:
    """A number for each pair of points, whatever their order, (n,)."""
    return np.asarray(pairs.min(axis=1) * count + pairs.max(axis=1))
