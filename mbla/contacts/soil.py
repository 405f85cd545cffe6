"""Soil of cells that nothing holds, and gaps beside it that its cells are too large to be meant to leave."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import shapely

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.contacts import Contacts
from mbla.deck.content import soils_of
from mbla.deck.deck import Deck
from mbla.errors import KeyPath, Message, Notice
from mbla.model.model import Model
from mbla.model.soil.names import named_with_soil, soil_name
from mbla.model.soil.plane import Sections, sections_of
from mbla.model.soil.soil_mesh import SoilMesh
from mbla.model.solids.ragged import row_ranges

REACH = 0.5
"""of an edge of a cell: what lies opposite it and nearer is meant to touch it"""
SLOPE = 0.1
"""greatest tangent of the angle between the two across a gap"""
AT = np.array([0.25, 0.75])
"""places along an edge at which its distance is measured"""


def soil_findings(deck: Deck, model: Model, contacts: Contacts) -> Iterator[tuple[KeyPath, Message]]:
    """Soil that touches nothing but itself."""
    for (path, _), soil in zip(soils_of(deck.content), model.soils, strict=True):
        own = (contacts.bodies >= soil.first) & (contacts.bodies < soil.first + len(soil.triangles))
        if not (own.sum(axis=1) == 1).any():
            words = "touches neither blocks nor ground: end it at blocks, or give ground along its outline"
            yield path, Message("soil-region", words)


def soil_notices(model: Model, tolerance: float) -> Iterator[Notice]:
    """A warning for each soil that ends a small way beside blocks, other soil or ground without touching them."""
    for soil in model.soils:
        starts, ends = outline_of(soil)
        sides = ends - starts
        outwards = np.stack([sides[:, 1], -sides[:, 0]], axis=1)
        points = starts[:, None] + AT[:, None] * sides[:, None]
        near = _sections_near(soil, model, float(REACH * np.linalg.norm(sides, axis=1).max()))
        gap, beside = _gap_to_blocks(points, outwards, near, tolerance)
        words = named_with_soil(np.unique(near.blocks[beside]), model.blocks) if len(beside) else ""
        on_ground, ground = _gap_to_ground(points, outwards, soil, model, tolerance)
        if on_ground > gap:
            gap, words = on_ground, ground
        if words:
            text = (
                f"{soil_name(soil.name)} ends up to {gap:.3g} {model.units.length} beside {words}, less than half a "
                "cell: they do not touch. Draw its outline up to there if they should"
            )
            yield Notice("warning", "soil-beside", text)


def outline_of(soil: SoilMesh) -> tuple[FloatArray, FloatArray]:
    """From and to of each edge of the outline of a mesh, (n, 2) each, the soil on the left."""
    triangles = soil.triangles
    edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    _, first, counts = np.unique(np.sort(edges, axis=1), axis=0, return_index=True, return_counts=True)
    outer = edges[first[counts == 1]]
    return soil.points[outer[:, 0]], soil.points[outer[:, 1]]


def _sections_near(soil: SoilMesh, model: Model, reach: float) -> Sections:
    """Blocks beside a soil, cells of others among them, as they are seen across its plane."""
    blocks = model.blocks
    low, high = row_ranges(blocks.vertices @ soil.axes.T, blocks.vertex_start)
    least, greatest = soil.points.min(axis=0) - reach, soil.points.max(axis=0) + reach
    inside = (low[:, :2] <= greatest).all(axis=1) & (high[:, :2] >= least).all(axis=1)
    inside &= (low[:, 2] < soil.extent[1]) & (high[:, 2] > soil.extent[0])
    inside[soil.blocks] = False
    return sections_of(blocks, np.flatnonzero(inside), soil.axes)


def _gap_to_blocks(
    points: FloatArray, outwards: FloatArray, near: Sections, tolerance: float
) -> tuple[float, IntArray]:
    """The widest gap to sections, and the rows of those across one.

    points   : (n, 2, 2) on edges
    outwards : (n, 2) as long as these
    """
    if not len(near.blocks):
        return 0.0, np.empty(0, np.int64)
    lengths = np.linalg.norm(outwards, axis=1)
    rays = shapely.linestrings(np.stack([points, points + REACH * outwards[:, None]], axis=2).reshape(-1, 2, 2))
    ray, row = shapely.STRtree(near.outlines).query(rays, predicate="intersects")
    origins = shapely.points(points.reshape(-1, 2))
    away = shapely.distance(origins[ray], shapely.intersection(rays[ray], near.outlines[row]))
    least = np.full(len(rays), np.inf)
    np.minimum.at(least, ray, away)
    touching = np.zeros(len(rays), dtype=bool)
    np.logical_or.at(touching, ray, away <= tolerance * near.sizes[row])
    pairs = least.reshape(-1, 2)
    found = np.isfinite(pairs).all(axis=1) & ~touching.reshape(-1, 2).any(axis=1)
    found[found] = np.abs(pairs[found, 1] - pairs[found, 0]) <= SLOPE * np.ptp(AT) * lengths[found]
    across = found[ray // 2] & (away <= least[ray])
    return float(pairs[found].max(initial=0.0)), np.unique(row[across])


def _gap_to_ground(
    points: FloatArray, outwards: FloatArray, soil: SoilMesh, model: Model, tolerance: float
) -> tuple[float, str]:
    """The widest gap to a plane of ground that carries the soil, and its name."""
    widest, label = 0.0, ""
    lengths = np.linalg.norm(outwards, axis=1)
    size = float(model.blocks.sizes[soil.blocks].max())
    for ground in model.grounds:
        if ground.outline is not None or (ground.blocks is not None and not np.isin(soil.blocks, ground.blocks).any()):
            continue
        normal = soil.axes @ ground.normal
        heights = points @ normal[:2] - ground.point @ ground.normal
        opposite = outwards @ normal[:2] < -lengths / np.hypot(1.0, SLOPE)
        near = opposite & (heights.min(axis=1) > tolerance * size) & (heights.max(axis=1) <= REACH * lengths)
        if near.any() and heights[near].max() > widest:
            widest, label = float(heights[near].max()), ground.label
    return widest, label
