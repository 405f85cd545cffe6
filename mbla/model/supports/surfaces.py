"""Surfaces that support: flat outlines with an end, each rigid ground on the side where blocks lie on it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.contacts import ContactsSection
from mbla.errors import Finding, KeyPath
from mbla.model.geometry.sheets import fitted_plane, flattened
from mbla.model.model import Ground
from mbla.model.selectors import BlockSelection
from mbla.model.soil.names import is_cell, named_with_soil
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import plane_axes
from mbla.model.solids.polygons import polygons_from_loops, widths
from mbla.model.solids.ragged import row_maxima
from mbla.model.solids.surface import GroundSurface

FACING = 0.99
"""cosine of the greatest angle between a face and the ground it lies on"""
NEAR = 10.0
"""tolerances up to which a face that misses a surface is told as a near miss of it"""
THIN = 1e-6
"""extent of corners over the greatest at which they lie on one line"""


def surface_of_polygon(points: Sequence[Sequence[float]], path: KeyPath, tolerance: float) -> GroundSurface | Finding:
    """The surface within corners that the deck gives, or what is wrong with them.

    tolerance : distance from their plane over the root of the area
    """
    corners = np.array(points, dtype=np.float64)
    middle, normal, breadth = fitted_plane(corners)
    if breadth <= THIN:
        return Finding("surface-unfit", "has no area: its corners lie on one line", *path)
    polygon = shapely.Polygon((corners - middle) @ plane_axes(normal[None])[0].T)
    heights = np.abs((corners - middle) @ normal)
    if heights.max() > tolerance * np.sqrt(max(float(shapely.MultiPoint(polygon.exterior.coords).convex_hull.area), 0)):
        worst = int(np.flatnonzero(heights >= heights.max() * (1.0 - 1e-6))[0])  # of equal ones the first
        words = f"is not planar: corner {worst} leaves the plane fitted to all by {heights[worst]:.4g}"
        return Finding("surface-unfit", f"{words}; divide it into triangles", *path)
    if not polygon.is_valid:
        words = f"crosses or touches itself ({shapely.is_valid_reason(polygon).partition('[')[0].lower()})"
        return Finding("surface-unfit", f"{words}: list its corners in order, as they come round it", *path)
    return GroundSurface(flattened(corners))


@dataclass(frozen=True)
class Carried:
    """What a surface may carry.

    allowed  : (n_blocks,) blocks
    contacts : with the tolerances
    """

    blocks: Blocks
    allowed: BoolArray
    contacts: ContactsSection

    def sides(self, surface: GroundSurface) -> tuple[list[int], bool]:
        """Sides of a surface, ±1 along its normal, on which faces lie or nearly lie; and whether any does lie on it."""
        blocks, normal, middle = self.blocks, surface.normal, surface.outline.mean(axis=0)
        heights = ((blocks.vertices - middle) @ normal)[blocks.loops]
        cosine = blocks.face_normals @ normal
        sizes = blocks.sizes[blocks.block_of_face]
        side = -np.sign(cosine)
        gap, depth = (row_maxima(sign * side[blocks.face_of_corner] * heights, blocks.loop_start) for sign in (1, -1))
        reach = NEAR * max(self.contacts.tolerance, self.contacts.depth_allowed / NEAR)
        near = (np.maximum(gap, depth) <= reach * sizes) & (np.abs(cosine) > FACING)
        near &= self.allowed[blocks.block_of_face]
        touches = (gap <= self.contacts.tolerance * sizes) & (depth <= self.contacts.depth_allowed * sizes)
        rows = np.flatnonzero(near)
        if not len(rows):
            return [], False
        rows = rows[self._share_area(surface, rows)]
        return [int(each) for each in np.unique(side[rows])[::-1]], bool(touches[rows].any())

    def _share_area(self, surface: GroundSurface, faces: IntArray) -> BoolArray:
        """Whether faces (n,) cover part of the surface as seen along its normal, (n,), by more than a strip."""
        blocks, middle = self.blocks, surface.outline.mean(axis=0)
        axes = plane_axes(surface.normal[None])[0]
        outline = shapely.Polygon((surface.outline - middle) @ axes.T)
        corners, start = blocks.corners_of(faces)
        polygons = polygons_from_loops((corners - middle) @ axes.T, start)
        common = shapely.intersection(polygons, outline)
        return np.asarray(widths(common) > 0.5 * self.contacts.tolerance * blocks.sizes[blocks.block_of_face[faces]])


def grounds_of_surfaces(
    surfaces: Sequence[GroundSurface],
    path: KeyPath,
    joint: str,
    chosen: IntArray | None,
    carried: Carried,
    selection: BlockSelection,
) -> list[Ground]:
    """Surfaces as ground, once for each side on which faces lie; those of a sheet without any go.

    chosen : blocks that they may carry, None for all

    Refuses sheets on which nothing lies, each by its label.
    """
    grounds: list[Ground] = []
    touched: dict[str, bool] = {}
    for surface in surfaces:
        sides, touches = carried.sides(surface)
        touched[surface.label] = touched.get(surface.label, False) or touches
        for number, side in enumerate(sides):
            outline = surface.outline if side > 0 else surface.outline[::-1].copy()
            label = f"{surface.label} from its other side" if number else surface.label
            grounds.append(Ground(outline.mean(axis=0), side * surface.normal, joint, chosen, label, outline))
    if not selection.partial:
        for label in (label for label, touches in touched.items() if not touches):
            own = [surface for surface in surfaces if surface.label == label]
            words = f"no face of a block that can move lies on {label}{how_it_misses(own, carried)}"
            selection.refuse(Finding("ground-misplaced", words, *path))
    return grounds


def how_it_misses(surfaces: Sequence[GroundSurface], carried: Carried) -> str:
    """What is nearest to surfaces that carry nothing, to end a sentence; nothing where all is far from them."""
    words = [touching_only(surface.outline.mean(axis=0), surface.normal, carried, surface) for surface in surfaces]
    return next((text for text in words if text), "; move it, or leave it out")


def touching_only(point: FloatArray, normal: FloatArray, carried: Carried, surface: GroundSurface | None = None) -> str:
    """What touches a plane, or a surface, by an edge or corner alone, and the remedy, to end a sentence."""
    blocks = carried.blocks
    reach = carried.contacts.tolerance * blocks.sizes[blocks.block_of_vertex]
    ground = Ground(point, normal, "", None, "", None if surface is None else surface.outline)
    on = np.flatnonzero(lies_on(blocks.vertices, ground, reach) & carried.allowed[blocks.block_of_vertex])
    if not len(on):
        return ""
    owners, count = np.unique(blocks.block_of_vertex[on], return_counts=True)
    which = (
        f"{named_with_soil(owners[:1], blocks)} touches it {'at a corner' if count[0] == 1 else 'along an edge'} only"
    )
    others = int((~is_cell(blocks)[owners[1:]]).sum())
    more = f" (and {others} more)" if others else ""
    return f"; {which}{more}: contacts need a face, so cut a flat there, or fix the block"


def lies_on(points: FloatArray, ground: Ground, reach: FloatArray | float) -> BoolArray:
    """Which points (n, 3) lie on a ground, within a distance, (n,) m."""
    reaches = np.broadcast_to(reach, len(points))
    found = np.asarray(np.abs((points - ground.point) @ ground.normal) <= reaches)
    rows = np.flatnonzero(found)
    if ground.outline is not None and len(rows):
        axes = plane_axes(ground.normal[None])[0]
        outline = shapely.Polygon((ground.outline - ground.point) @ axes.T)
        places = shapely.points((points[rows] - ground.point) @ axes.T)
        found[rows] = shapely.dwithin(places, outline, reaches[rows])
    return found


def allowed_blocks(selection: BlockSelection, fixed: BoolArray, chosen: IntArray | None) -> BoolArray:
    """Blocks that a ground may carry, (n_blocks,): what cannot be built need not lie right, either.

    fixed  : (n_blocks,) blocks that cannot move
    chosen : those that it is for, None for all
    """
    allowed = ~fixed & ~np.isin(np.array(selection.blocks.groups), list(selection.partial))
    if chosen is not None:
        allowed &= np.isin(np.arange(len(fixed)), chosen)
    return np.asarray(allowed)
