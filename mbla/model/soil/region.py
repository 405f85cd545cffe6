"""What soil fills: polygons of a plane, through an extent across it.

A region ends at blocks, at ground, and at its top. Every corner of a block on its outline is a corner of it, so that
cells conform to blocks as to each other.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace

import numpy as np
import shapely
from scipy.spatial import KDTree

from mbla.arrays import FloatArray, IntArray
from mbla.model.soil.plane import NO_SECTIONS, Sections, sections_of
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import items_of_rows, row_ranges

STRAIGHT = 1e-6
"""sine of the angle up to which an outline goes straight on"""


@dataclass(frozen=True)
class HeldEdge:
    """An edge of a region that ground holds: its ends (2, 2), the unit normal (2,) into the soil, and what it is."""

    ends: FloatArray
    normal: FloatArray
    label: str


@dataclass(frozen=True)
class Region:
    """What soil fills.

    axes     : (3, 3) of the plane and across it, as of ``SoilMesh``
    extent   : (2,) across
    polygons : counter-clockwise, apart but for corners
    held     : edges at ground that the soil brings along
    bearings : (n, 2, 2) ends of what bears on part of a straight side of the outline, as a footing does
    """

    axes: FloatArray
    extent: FloatArray
    polygons: tuple[shapely.Polygon, ...]
    held: tuple[HeldEdge, ...] = ()
    bearings: FloatArray = field(default_factory=lambda: np.empty((0, 2, 2)))

    @property
    def area(self) -> float:
        """Of the polygons together."""
        return float(sum(polygon.area for polygon in self.polygons))


def beside(region: Region, blocks: Blocks, but: IntArray, tolerance: float) -> Sections:
    """Blocks within the extent of a region that are near it, but for some, as they are seen across its plane."""
    if not len(blocks):
        return NO_SECTIONS
    low, high = row_ranges(blocks.vertices @ region.axes[2], blocks.vertex_start)
    reach = tolerance * blocks.sizes
    within = (low < region.extent[1] - reach) & (high > region.extent[0] + reach)
    within[but] = False
    found = sections_of(blocks, np.flatnonzero(within), region.axes)
    whole = shapely.union_all(region.polygons)
    return found.take(np.flatnonzero(shapely.dwithin(found.outlines, whole, tolerance * found.sizes)))


def overlapping(region: Region, others: Sections, tolerance: float) -> IntArray:
    """Rows of the sections that lie within a region by more than the tolerance."""
    common = shapely.intersection(others.outlines, shapely.union_all(region.polygons))
    return np.flatnonzero(~shapely.is_empty(shapely.buffer(common, -tolerance * others.sizes / 2.0)))


def with_bearings(region: Region, others: Sections, tolerance: float) -> Region:
    """The region with what of other blocks bears on part of a straight side of its outline."""
    if not len(others.blocks):
        return region
    reach = tolerance * float(others.sizes.min())
    blocks = shapely.buffer(shapely.union_all(shapely.buffer(others.outlines, reach, join_style="mitre")), 0.0)
    found = []
    for polygon in region.polygons:
        for ring in (polygon.exterior, *polygon.interiors):
            corners = shapely.get_coordinates(shapely.remove_repeated_points(ring))[:-1]
            for side in _straight_sides(corners):
                length = float(np.linalg.norm(side[1] - side[0]))
                common = shapely.line_merge(shapely.intersection(shapely.LineString(side), blocks))
                parts = [shapely.get_coordinates(part)[[0, -1]] for part in shapely.get_parts(common)]
                lengths = [float(np.linalg.norm(part[1] - part[0])) for part in parts]
                found += [
                    part for part, own in zip(parts, lengths, strict=True) if 4.0 * reach < own < length - 4.0 * reach
                ]
    return replace(region, bearings=np.array(found).reshape(-1, 2, 2))


def tops_of(region: Region) -> FloatArray:
    """Sides of the outline above which there is no soil, steeper ones than 45 degrees left out, (n, 2, 2)."""
    found = [np.empty((0, 2, 2))]
    for polygon in region.polygons:
        for ring in (polygon.exterior, *polygon.interiors):
            corners = shapely.get_coordinates(ring)
            sides = np.stack([corners[:-1], corners[1:]], axis=1)
            steps = corners[1:] - corners[:-1]
            found.append(sides[steps[:, 0] < -np.abs(steps[:, 1])])
    return np.concatenate(found)


def _straight_sides(corners: FloatArray) -> list[FloatArray]:
    """Sides (2, 2) of a ring of corners (n, 2), those that go straight on joined."""
    before = corners - np.roll(corners, 1, axis=0)
    after = np.roll(corners, -1, axis=0) - corners
    sines = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    turns = np.flatnonzero(np.abs(sines) > STRAIGHT * np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1))
    ends = np.roll(turns, -1)
    return [corners[[start, end]] for start, end in zip(turns.tolist(), ends.tolist(), strict=True)]


def with_corners(
    region: Region, blocks: Blocks, near: IntArray, tolerance: float, own: FloatArray | None = None
) -> Region:
    """The region with corners of blocks (n,) on its outline as corners, and its own within the tolerance moved to
    them.

    own : (m, 2) further corners
    """
    rows = items_of_rows(blocks.vertex_start, near)
    own = np.empty((0, 2)) if own is None else own
    corners = np.concatenate([own, blocks.vertices[rows] @ region.axes[:2].T])
    sizes = np.append(
        np.full(len(own), blocks.sizes[near].min(initial=np.inf)), blocks.sizes[blocks.block_of_vertex[rows]]
    )
    reach = tolerance * sizes
    outline = shapely.union_all([polygon.boundary for polygon in region.polygons])
    on = shapely.dwithin(shapely.points(corners), outline, reach)
    corners, reach = corners[on], reach[on]
    if not len(corners):
        return region
    polygons = []
    for polygon in region.polygons:
        rings = (polygon.exterior, *polygon.interiors)
        outer, *holes = (_ring(shapely.get_coordinates(ring)[:-1], corners, reach) for ring in rings)
        polygons.append(shapely.Polygon(outer, holes))
    return replace(region, polygons=tuple(polygons))


def _ring(ring: FloatArray, corners: FloatArray, reach: FloatArray) -> FloatArray:
    """A ring of points (n, 2) through corners (m, 2) that are within reach of it, (m,)."""
    away, nearest = KDTree(corners).query(ring)
    ring = np.where((away <= reach[nearest])[:, None], corners[nearest], ring)
    ring = ring[np.linalg.norm(ring - np.roll(ring, 1, axis=0), axis=1) > 0.0]
    sides = np.roll(ring, -1, axis=0) - ring
    lengths = np.linalg.norm(sides, axis=1)
    result = []
    for start, side, length in zip(ring, sides, lengths, strict=True):
        along = (corners - start) @ side / length
        off = np.abs((corners[:, 0] - start[0]) * side[1] - (corners[:, 1] - start[1]) * side[0]) / length
        rows = np.flatnonzero((off <= reach) & (along > reach) & (along < length - reach))
        rows = rows[np.argsort(along[rows])]
        result.append(start[None])
        at = 0.0
        for row in rows:
            if along[row] - at > reach[row]:
                at = along[row]
                result.append((start + side * (at / length))[None])
    return np.concatenate(result)


def polygons_of(shape: shapely.Geometry, least: float) -> tuple[shapely.Polygon, ...]:
    """The polygons that a shape is made of, counter-clockwise, but for those of less width than that."""
    parts: Sequence[shapely.Geometry] = shapely.get_parts(shape)
    kept = [part for part in parts if part.geom_type == "Polygon" and not shapely.buffer(part, -least / 2.0).is_empty]
    return tuple(shapely.orient_polygons(np.array(kept, dtype=object)).tolist()) if kept else ()
