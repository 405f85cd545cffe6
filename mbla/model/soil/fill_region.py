"""The region of fill: between the upper outline of blocks that are prisms across a plane, and the top of the fill.

Beyond the ends of the blocks it stands on level ground at the foot of the outermost one, and upright ground holds it
where it ends. Blocks that stand in it along a face of the structure are spandrel walls, whether the deck names them
among those that carry it or not: it lies between them, and they may rise above its top.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np
import shapely

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.deck.sections.fill import Fill
from mbla.errors import Finding
from mbla.model.blocks.generated import ItemRefused
from mbla.model.soil.names import is_cell, named_with_soil
from mbla.model.soil.plane import SQUARE, Sections, plane_of_prisms, sections_of
from mbla.model.soil.region import HeldEdge, Region, beside, overlapping, polygons_of, with_bearings, with_corners
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.wording import named

ROUNDING = 1e-3
"""share of the tolerance to which overlays of outlines are rounded"""
SPANDREL = 0.5
"""least share of the region over the blocks, seen from the side, that walls along a face of it take up"""
ONE_SOIL = "leave one of them out, or lay them on other blocks"
ON = "name under `on` all that it lies on and that bounds it; what stands on it begins at its top"


@dataclass(frozen=True)
class _Top:
    """The line of the top in the plane: a point (2,) on it, and its slope; and the key that gives it."""

    point: FloatArray
    slope: float
    key: str

    def heights(self, level: FloatArray) -> FloatArray:
        """At level coordinates, (...)."""
        return np.asarray(self.point[1] + self.slope * (level - self.point[0]))


def fill_region(fill: Fill, blocks: Blocks, chosen: IntArray, levels: FloatArray, tolerance: float) -> Region:
    """The region of soil on the chosen blocks.

    levels    : (n,) heights of level ground of the deck, which carries the soil that stands on it
    tolerance : of contacts, relative to block size

    Raises ItemRefused with what is wrong below the fill.
    """
    assert fill.cells is not None
    axes = plane_of_prisms(blocks, chosen)
    top = _top(fill, axes)
    under = _carriers(sections_of(blocks, chosen, axes), tolerance)
    _refuse_below_blocks(top, under, blocks, tolerance)
    reach = tolerance * float(under.sizes.min())
    ends = _ends(under, fill.cells.beyond, tolerance)
    shape = shapely.difference(_below(top, ends), _solid(under, ends, reach), grid_size=ROUNDING * reach)
    extent = np.array([under.extents[:, 0].min(), under.extents[:, 1].max()])
    region = Region(axes, extent, polygons_of(shape, reach))
    if not region.polygons:
        raise ItemRefused(Finding("soil-region", "leaves nothing to fill: the top lies on the blocks", top.key))
    between = _between_walls(region, blocks, under.blocks, ends, tolerance)
    _refuse_changing(between, under, ends, reach, blocks)
    others = beside(between, blocks, under.blocks, tolerance)
    held = _held(top, ends, others, levels, reach, tolerance)
    near = np.concatenate([under.blocks, others.blocks])
    upper = np.stack([ends.soil, top.heights(ends.soil)], axis=1)
    own = np.concatenate([upper, np.stack([ends.soil, ends.feet], axis=1), np.stack([ends.blocks, ends.feet], axis=1)])
    region = with_corners(replace(between, held=held), blocks, near, tolerance, own)
    return with_bearings(region, others, tolerance)


def _top(fill: Fill, axes: FloatArray) -> _Top:
    if fill.surface is None:
        return _Top(np.array([0.0, fill.level]), 0.0, "level")
    normal = axes @ unit(fill.surface.normal)
    if abs(normal[2]) > SQUARE:
        words = "must not slope along the width of the soil of cells"
        raise ItemRefused(Finding("soil-not-prismatic", words, "surface", "normal"))
    return _Top(axes[:2] @ np.array(fill.surface.point), -float(normal[0] / normal[1]), "surface")


def _refuse_below_blocks(top: _Top, under: Sections, blocks: Blocks, tolerance: float) -> None:
    """Refuse a top above which blocks rise."""
    corners, row = shapely.get_coordinates(under.outlines, return_index=True)
    high = corners[:, 1] - top.heights(corners[:, 0])
    above = high > tolerance * under.sizes[row]
    if above.any():
        which = named(np.unique(under.blocks[row[above]]), blocks.name)
        words = f"lies up to {high.max():.4g} below the highest corners of {which}: raise it"
        raise ItemRefused(Finding("soil-region", words, top.key))


def _carriers(under: Sections, tolerance: float) -> Sections:
    """The blocks without the walls among them: what stands along one face only and rises over what lies between."""
    reach = tolerance * float(under.sizes.min())
    low, high = under.extents.T
    near, far = low <= low.min() + reach, high >= high.max() - reach
    aside = near != far
    room = low[aside & far].min(initial=high.max()) - high[aside & near].max(initial=low.min())
    if not aside.any() or aside.all() or room <= reach:
        return under
    carriers = under.take(np.flatnonzero(~aside))
    solid = _solid(carriers, _ends(carriers, 0.0, tolerance), reach)
    rises = ~shapely.is_empty(shapely.buffer(shapely.difference(under.outlines, solid), -reach / 2.0))
    return under.take(np.flatnonzero(~(aside & rises)))


@dataclass(frozen=True)
class _Ends:
    """Both ends, left and right: where the blocks end, the foot and brow of the outermost one there, and where the soil
    does; (2,) each.
    """

    blocks: FloatArray
    feet: FloatArray
    brows: FloatArray
    soil: FloatArray


def _ends(under: Sections, beyond: float, tolerance: float) -> _Ends:
    corners = shapely.get_coordinates(under.outlines)
    reach = tolerance * under.sizes.min()
    ends = np.array([corners[:, 0].min(), corners[:, 0].max()])
    at = [corners[np.abs(corners[:, 0] - end) <= reach, 1] for end in ends]
    feet, brows = np.array([[each.min(), each.max()] for each in at]).T
    return _Ends(ends, feet, brows, ends + np.array([-beyond, beyond]))


def _below(top: _Top, ends: _Ends) -> shapely.Polygon:
    """All below the top between the ends of the soil, down to the lower foot; beyond the blocks down to their feet."""
    (left, right), (start, end) = ends.blocks, ends.soil
    low = ends.feet.min() - (right - left)
    outline = [(start, ends.feet[0]), (left, ends.feet[0]), (left, low), (right, low)]
    outline += [(right, ends.feet[1]), (end, ends.feet[1])]
    outline += [(x, float(top.heights(np.asarray(x)))) for x in (end, start)]
    return shapely.Polygon([corner for n, corner in enumerate(outline) if corner != outline[n - 1]]).buffer(0)


def _solid(under: Sections, ends: _Ends, reach: float) -> shapely.Geometry:
    """What lies in the blocks or under them."""
    low = min(ends.feet.min(), shapely.bounds(under.outlines)[:, 1].min()) - 2.0 * (ends.blocks[1] - ends.blocks[0])
    shadows = []
    for outline in under.outlines:
        for ring in shapely.get_rings(outline):
            points = shapely.get_coordinates(ring)
            for one, other in pairwise(points):
                if abs(one[0] - other[0]) > ROUNDING * reach:
                    shadows.append(shapely.Polygon([one, other, (other[0], low), (one[0], low)]))
    shapes = shapely.orient_polygons(np.array([*under.outlines, *shadows], dtype=object))
    return shapely.union_all(shapes, grid_size=ROUNDING * reach)


def _between_walls(region: Region, blocks: Blocks, chosen: IntArray, ends: _Ends, tolerance: float) -> Region:
    """The region between walls that stand in it along its faces; what else stands in it is refused."""
    others = beside(region, blocks, chosen, tolerance)
    walls = others.take(overlapping(region, others, tolerance))
    if not len(walls.blocks):
        return region
    reach = tolerance * walls.sizes
    near = walls.extents[:, 0] <= region.extent[0] + reach
    far = walls.extents[:, 1] >= region.extent[1] - reach
    over = _over_blocks(region, ends)
    extent, strange = region.extent.copy(), near == far
    if not strange.any():
        for side, at in enumerate((near, far)):
            common = shapely.intersection(shapely.union_all(walls.outlines[at]), over)
            if at.any() and common.area < SPANDREL * over.area:
                strange |= at
            elif at.any():
                extent[side] = _inner_face(walls, at, side, reach, blocks)
    if strange.any() or extent[1] - extent[0] <= reach.min():
        which = np.unique(walls.blocks[strange] if strange.any() else walls.blocks)
        remedy = ONE_SOIL if is_cell(blocks)[which].all() else ON
        raise ItemRefused(Finding("soil-region", f"overlaps {named_with_soil(which, blocks)}: {remedy}", "on"))
    return replace(region, extent=extent)


def _over_blocks(region: Region, ends: _Ends) -> shapely.Geometry:
    """What of the region lies between the ends of the blocks; all of it where nothing does."""
    whole = shapely.union_all(region.polygons)
    _, low, _, high = shapely.bounds(whole)
    inside = shapely.intersection(whole, shapely.box(ends.blocks[0], low, ends.blocks[1], high))
    return inside if inside.area > 0.0 else whole


def _inner_face(walls: Sections, at: BoolArray, side: int, reach: FloatArray, blocks: Blocks) -> float:
    """Where walls along one face, rows of ``at``, end towards the other one, across the plane; all at the same place.

    side : 0 for the face with the lesser coordinate, 1 for the other
    """
    faces = walls.extents[at, 1 - side]
    inner = float(faces.max() if side == 0 else faces.min())
    thinner = np.abs(faces - inner) > reach[at]
    if thinner.any():
        which = named(np.unique(walls.blocks[at][thinner]), blocks.name)
        words = (
            f"walls along a face of the soil must be as thick as each other up to its top: {which} thinner; lower its "
            "top, or make them alike"
        )
        raise ItemRefused(Finding("soil-not-prismatic", words, "on"))
    return inner


def _refuse_changing(region: Region, under: Sections, ends: _Ends, reach: float, blocks: Blocks) -> None:
    """Refuse blocks whose upper outline changes across the plane within the extent of the region."""
    cuts = np.clip(under.extents, *region.extent).ravel()
    cuts = np.unique(np.append(cuts, region.extent))
    whole = _solid(under, ends, reach)
    for low, high in pairwise(cuts):
        if high - low <= reach:
            continue
        there = (under.extents[:, 0] < high - reach / 2) & (under.extents[:, 1] > low + reach / 2)
        if there.all():
            continue
        own = _solid(under.take(np.flatnonzero(there)), ends, reach) if there.any() else shapely.Polygon()
        if not shapely.buffer(shapely.difference(whole, own), -reach).is_empty:
            which = named(np.unique(under.blocks[~there]), blocks.name)
            words = (
                f"the upper outline of the blocks must be the same all along the width of the soil: {which} ends in it"
            )
            raise ItemRefused(Finding("soil-not-prismatic", words, "on"))


def _held(
    top: _Top, ends: _Ends, others: Sections, levels: FloatArray, reach: float, tolerance: float
) -> tuple[HeldEdge, ...]:
    """Edges at ground: upright ones where the soil ends, and level ones beyond the blocks, where no block is there."""
    taken = shapely.union_all(shapely.buffer(others.outlines, 2.0 * tolerance * others.sizes))
    edges = []
    for side, (inwards, name) in enumerate(((1.0, "left"), (-1.0, "right"))):
        outer, inner, foot = ends.soil[side], ends.blocks[side], ends.feet[side]
        low = foot if outer != inner else ends.brows[side]
        upright = [(outer, low), (outer, float(top.heights(np.asarray(outer))))]
        edges += [(upright, (inwards, 0.0), f"at the {name} end of")]
        if outer != inner and not (np.abs(levels - foot) <= reach).any():
            edges += [([(outer, foot), (inner, foot)], (0.0, 1.0), f"under the {name} end of")]
    held = []
    for line, normal, label in edges:
        for part in shapely.get_parts(shapely.difference(shapely.LineString(line), taken)):
            if part.length > reach:
                held.append(HeldEdge(shapely.get_coordinates(part), np.array(normal), label))
    return tuple(held)
