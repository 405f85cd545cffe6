"""How an acceleration grows with height: s = x · a along a direction a, the factor a broken line f over s.

Every part of a block is accelerated by the factor of its own height, so that dividing or gluing blocks does not change
the load: a block takes the force a ∫ ρ f dV, with a moment about its centroid, an added mass the factor where it is. On
its heights f is its value at the lowest of them and a ramp for each change of slope above (``ramp_moments``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.tree import KeyPath
from mbla.deck.types import HeightPattern
from mbla.errors import Message
from mbla.model.loads.load_kind import LoadSite
from mbla.model.loads.ramp_moments import ramp_moments
from mbla.model.ragged import items_of_rows


@dataclass(frozen=True)
class PatternFactors:
    """What a pattern makes of the masses of n blocks.

    means   : (n,) mean factor over the volume of each block
    levers  : (n, 3) mean of factor times distance from the centroid of the block, in units of length
    at_mass : (n,) factor at the added mass
    """

    means: FloatArray
    levers: FloatArray
    at_mass: FloatArray


def pattern_factors(pattern: HeightPattern, blocks: IntArray, path: KeyPath, site: LoadSite) -> PatternFactors | None:
    """Factors on blocks; base and top are the ends of the blocks unless the deck gives them.

    None, with a fault at ``path``, where the base it was given is not below the top found, or the reverse.
    """
    along = np.array(pattern.along) / np.abs(pattern.along).max()  # so that squares neither overflow nor vanish
    along /= np.linalg.norm(along)
    heights_of_vertices = site.blocks.vertices[items_of_rows(site.blocks.vertex_start, blocks)] @ along
    if pattern.points is not None:
        heights, factors = np.array(pattern.points).T
    else:
        base = heights_of_vertices.min() if pattern.base is None else pattern.base
        top = heights_of_vertices.max() if pattern.top is None else pattern.top
        if not base < top:
            site.refuse(path, Message("out-of-bounds", f"its base, {base:g}, must be below its top, {top:g}"))
            return None
        heights, factors = np.array([base, top]), np.array([0.0, 1.0])
    means, levers = _over_volumes(heights, factors, along, heights_of_vertices, blocks, site)
    at_mass = np.interp(site.blocks.added_mass_points[blocks] @ along, heights, factors)
    return PatternFactors(means, levers, at_mass)


def _over_volumes(
    heights: FloatArray, factors: FloatArray, along: FloatArray, reach: FloatArray, blocks: IntArray, site: LoadSite
) -> tuple[FloatArray, FloatArray]:
    """Means of f and of f (x - c) over the blocks, (n,) and (n, 3); ``reach``: heights of their vertices in turn."""
    counts = np.diff(site.blocks.vertex_start)[blocks]
    first = np.cumsum(counts) - counts
    low, high = np.minimum.reduceat(reach, first), np.maximum.reduceat(reach, first)
    slopes = np.concatenate([[0.0], np.diff(factors) / np.diff(heights), [0.0]])
    means, levers = np.interp(low, heights, factors), np.zeros((len(blocks), 3))
    starts = [(low, slopes[np.searchsorted(heights, low, side="right")], np.ones(len(blocks), dtype=bool))]
    for height, change in zip(heights, np.diff(slopes), strict=True):
        starts.append((np.full(len(blocks), height), np.full(len(blocks), change), (low < height) & (height < high)))
    for levels, change, touched in starts:
        rows = np.flatnonzero(touched & (change != 0.0))
        if len(rows):
            ramps, moments = ramp_moments(site.blocks, blocks[rows], along, levels[rows])
            share = change[rows] / site.blocks.volumes[blocks[rows]]
            means[rows] += share * ramps
            levers[rows] += share[:, None] * moments
    return means, levers
