"""A structure cut by an upright plane along the path of a travelling load: outlines of its blocks, fill and soil.

Places are (s, z): s the distance along the path, as travelling loads measure it, z the height.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, row_of_item
from mbla.model.fill.fill import FillBody
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import next_item
from mbla.process.late import shapely
from mbla.questions.travel_position import TravelPosition

STRAIGHT = 0.02
"""share of its length by which a path may leave the straight and level line between its ends and still be cut along"""
ASIDE = 1e-6
"""share of the extent of the structure by which the plane passes beside the path, which may run along a joint"""


@dataclass(frozen=True)
class SectionPlane:
    """The upright plane along a path.

    origin : (3,) where s is 0; along, across : (3,) unit, horizontal
    """

    origin: FloatArray
    along: FloatArray
    across: FloatArray

    def places(self, points: FloatArray) -> FloatArray:
        """(s, z) of points: (..., 2) from (..., 3)."""
        return np.stack([(points - self.origin) @ self.along, points[..., 2]], axis=-1)

    def crossings(self, one: FloatArray, other: FloatArray, aside: float) -> FloatArray:
        """Where lines between points on its two sides, (n, 3) each, cross it, (n, 3)."""
        a, b = ((each - self.origin) @ self.across - aside for each in (one, other))
        return np.asarray(one + (a / (a - b))[:, None] * (other - one))


def plane_along(positions: Sequence[TravelPosition]) -> SectionPlane | None:
    """The plane along the path of the first axle; None where it is bent, steep or stands still."""
    points = np.array([each.point for each in positions])
    distances = np.array([each.distance for each in positions])
    run = points[-1] - points[0]
    length = float(np.hypot(run[0], run[1]))
    if len(points) < 2 or length == 0.0:
        return None
    along = np.array([run[0], run[1], 0.0]) / length
    plane = SectionPlane(points[0] - distances[0] * along, along, np.array([-along[1], along[0], 0.0]))
    off = np.abs(plane.places(points)[:, 0] - distances).max()
    off = max(off, np.abs((points - plane.origin) @ plane.across).max())
    return plane if off <= STRAIGHT * length else None


def cut_blocks(blocks: Blocks, plane: SectionPlane) -> list[tuple[int, FloatArray]]:
    """Block and outline, (n, 2), of all that the plane cuts; of a block several where it falls into parts."""
    heights, aside = _heights(blocks.vertices, plane)
    after = blocks.loops[next_item(blocks.loop_start)]
    low, high = np.minimum(blocks.loops, after), np.maximum(blocks.loops, after)
    corners = np.flatnonzero((heights[low] >= 0.0) != (heights[high] >= 0.0))
    points = plane.crossings(blocks.vertices[low[corners]], blocks.vertices[high[corners]], aside)
    faces = row_of_item(blocks.loop_start)[corners]
    lines = np.cross(plane.across, blocks.face_normals[faces])
    order = np.lexsort((np.einsum("ij,ij->i", points, lines), faces))  # in and out of a face by turns
    ends = plane.places(points[order]).reshape(-1, 2, 2)
    owner = blocks.block_of_face[faces[order][::2]]
    found = []
    for block in np.unique(owner).tolist():
        parts = shapely.polygonize(shapely.linestrings(ends[owner == block]))
        found += [(block, np.array(part.exterior.coords)) for part in shapely.get_parts(parts)]
    return found


def cut_fill(body: FillBody, plane: SectionPlane) -> list[FloatArray]:
    """Outlines of a fill, (n, 2), between the faces that carry it and its top."""
    loops = body.triangles[(body.depths(body.triangles) > 0.0).any(axis=1)]
    heights, aside = _heights(loops.reshape(-1, 3), plane)
    side = heights.reshape(-1, 3) >= 0.0
    rows, corners = np.nonzero(side != np.roll(side, -1, axis=1))  # two of each triangle that is cut
    points = plane.crossings(loops[rows, corners], loops[rows, (corners + 1) % 3], aside).reshape(-1, 2, 3)
    tops = points.copy()
    tops[..., 2] = np.maximum(points[..., 2], body.tops(points))
    columns = shapely.polygons(plane.places(np.concatenate([points, tops[:, ::-1]], axis=1)))
    together = shapely.union_all(shapely.set_precision(columns, aside))  # no seams between them
    return [np.array(part.exterior.coords) for part in shapely.get_parts(together) if part.geom_type == "Polygon"]


def rings_around(outlines: Sequence[FloatArray], size: float) -> list[FloatArray]:
    """Rings, (n, 2), around what cells cover together, and around holes in it; corners closer than a hair are one."""
    cells = shapely.set_precision(shapely.polygons([*outlines]), ASIDE * size)
    parts = shapely.get_parts(shapely.union_all(cells))
    return [np.array(ring.coords) for part in parts for ring in (part.exterior, *part.interiors)]


def lines_along(points: FloatArray, plane: SectionPlane) -> FloatArray:
    """Lines between points (n, 2, 3) that run along the plane, whatever their distance from it, (k, 2, 2)."""
    steps = points[:, 1] - points[:, 0]
    away = np.abs(steps @ plane.across) <= STRAIGHT * np.linalg.norm(steps, axis=1)
    return plane.places(points[away])


def _heights(points: FloatArray, plane: SectionPlane) -> tuple[FloatArray, float]:
    """Distances of points (n, 3) to one side of the plane, a hair aside of the path; and this hair."""
    aside = ASIDE * float(np.ptp(points, axis=0).max(initial=0.0)) if len(points) else 0.0
    return (points - plane.origin) @ plane.across - aside, aside
