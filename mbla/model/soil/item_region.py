"""The region of an item `soil`: a polygon of the deck, with the corners of blocks beside it."""

from __future__ import annotations

import numpy as np
import shapely

from mbla.arrays import IntArray
from mbla.errors import Finding
from mbla.model.blocks.generated import ItemRefused
from mbla.model.blocks.soil import SoilItem
from mbla.model.soil.names import named_with_soil
from mbla.model.soil.region import Region, beside, overlapping, with_bearings, with_corners
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.polyhedra import in_space
from mbla.model.transform import IDENTITY, build_transform

REPEATED = 1e-9
"""distance over the extent of an outline up to which two corners in a row are one"""
NO_BLOCKS: IntArray = np.empty(0, dtype=np.int64)


def item_region(item: SoilItem, blocks: Blocks, tolerance: float) -> Region:
    """The region of an item beside blocks.

    tolerance : of contacts, relative to block size

    Raises ItemRefused with what is wrong below the item.
    """
    outline = np.array(item.outline)
    drawn = shapely.Polygon(outline)
    if not drawn.is_valid or drawn.area <= 0.0:
        reason = shapely.is_valid_reason(drawn).partition("[")[0].lower()
        words = f"is no outline of a region ({reason}): list its corners in order, as they come round it"
        raise ItemRefused(Finding("soil-region", words, "outline"))
    transform = build_transform(item.transform) or IDENTITY
    level, up = transform.directions(np.array([[1.0, 0.0, 0.0], [0.0, 0.0, 1.0]]))
    axes = np.stack([level, up, np.cross(up, level)])
    near, far = (transform.points(in_space(outline, y)) @ axes.T for y in (0.0, item.width))
    extent = np.sort([near[0, 2], far[0, 2]])
    drawn = shapely.remove_repeated_points(shapely.Polygon(near[:, :2]), REPEATED * np.ptp(near[:, :2], axis=0).max())
    polygon = shapely.orient_polygons(drawn)
    region = Region(axes, extent, (polygon,))
    others = beside(region, blocks, NO_BLOCKS, tolerance)
    rows = overlapping(region, others, tolerance)
    if len(rows):
        which = named_with_soil(np.unique(others.blocks[rows]), blocks)
        words = f"overlaps {which}: soil ends where blocks and other soil begin"
        raise ItemRefused(Finding("soil-region", words, "outline"))
    return with_bearings(with_corners(region, blocks, others.blocks, tolerance), others, tolerance)
