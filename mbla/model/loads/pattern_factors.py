"""Factors by which the `pattern` of an acceleration multiplies the masses of blocks.

A pattern is a broken line f over the height s = x · a along a direction a. Every part of a block is accelerated by the
factor of its own height, so that dividing or gluing blocks does not change the load: a block takes the force
a ∫ ρ f dV, with a moment about its centroid, an added mass the factor where it is. On its heights f is its value at the
lowest of them and a ramp for each change of slope above.

Integrals of a ramp h(x) = max(x . a - l, 0) over blocks, by Gauss's theorem over their faces.

With y = x - c from the centroid c of the block and the outward normal n of its faces

    ∫ h dV = ∮ h²/2 (n . a) dA,        ∫ y h dV = ∮ (y h²/2 - a h³/6) (n . a) dA,

for the divergence of a y h²/2 is y h + a h²/2, and that of a h³/6 is h²/2. Of each face
counts what lies above the level l; in a fan of triangles over it the rest is a cubic on each of them, which the
rule of seven points (corners, middles of edges, centroid) integrates exactly.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed
from mbla.deck.sections.any_load import HeightPattern
from mbla.errors import Finding, KeyPath
from mbla.model.loads.load_kind import LoadSite
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import cut, unit
from mbla.model.solids.ragged import items_of_rows


@dataclass(frozen=True)
class PatternFactors:
    """What a pattern makes of the masses of n blocks.

    means   : (n,) mean factor over the volume of each block
    levers  : (n, 3) mean of factor times distance from the centroid of the block, in units of length
    carried : (n,) sum of masses on each block, times the factor where each is
    moments : (n, 3) sum of that times their distances from the centroid of the block
    """

    means: FloatArray
    levers: FloatArray
    carried: FloatArray
    moments: FloatArray


def pattern_factors(pattern: HeightPattern, blocks: IntArray, path: KeyPath, site: LoadSite) -> PatternFactors | None:
    """Factors on blocks (n,); base and top are the ends of the blocks unless the deck gives them.

    None, with a fault at ``path``, where the base it was given is not below the top found, or the reverse.
    """
    along = unit(pattern.along)
    heights_of_vertices = site.blocks.vertices[items_of_rows(site.blocks.vertex_start, blocks)] @ along
    if pattern.points is not None:
        heights, factors = np.array(pattern.points).T
    else:
        base = heights_of_vertices.min() if pattern.base is None else pattern.base
        top = heights_of_vertices.max() if pattern.top is None else pattern.top
        if not base < top:
            site.refuse(Finding("out-of-bounds", f"its base, {base:g}, must be below its top, {top:g}", *path))
            return None
        heights, factors = np.array([base, top]), np.array([0.0, 1.0])
    means, levers = _over_volumes(heights, factors, along, heights_of_vertices, blocks, site)
    masses, n_blocks = site.masses, len(site.blocks)
    shares = masses.masses * np.interp(masses.points @ along, heights, factors)
    arms = masses.points - site.blocks.centroids[masses.blocks]
    carried = summed(masses.blocks, shares, n_blocks)[blocks]
    return PatternFactors(means, levers, carried, summed(masses.blocks, shares[:, None] * arms, n_blocks)[blocks])


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


CORNERS = np.vstack([np.eye(3), (1 - np.eye(3)) / 2, np.full((1, 3), 1 / 3)])
WEIGHTS = np.array([1 / 20] * 3 + [2 / 15] * 3 + [9 / 20])
"""barycentric coordinates of the seven points and their weights; exact to the third degree"""


def ramp_moments(
    blocks: Blocks, rows: IntArray, along: FloatArray, levels: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrals of h, (n,), and of y h, (n, 3), over the blocks ``rows``, each with a level of its own.

    along : (3,) unit vector a; levels : (n,) heights l above which the ramp rises
    """
    place = np.full(len(blocks), -1)
    place[rows] = np.arange(len(rows))
    faces = items_of_rows(blocks.face_start, rows)
    owner, first = place[blocks.block_of_face[faces]], blocks.loop_start[faces]
    column = np.arange(np.diff(blocks.loop_start)[faces].max(initial=3))
    corners = np.minimum(first[:, None] + column, blocks.loop_start[faces + 1][:, None] - 1)
    loops = blocks.vertices[blocks.loops[corners]] - blocks.centroids[rows][owner][:, None]
    above = (blocks.centroids[rows] @ along - levels)[owner]
    loops = cut(loops, loops @ along + above[:, None])
    fan = np.stack(np.broadcast_arrays(loops[:, :1], loops[:, 1:-1], loops[:, 2:]), axis=2).reshape(-1, 3, 3)
    face = np.repeat(np.arange(len(faces)), loops.shape[1] - 2)
    facing = np.cross(fan[:, 1] - fan[:, 0], fan[:, 2] - fan[:, 0]) @ along / 2
    values = facing[:, None] * _cubic(fan, fan @ along + above[face, None], along)
    sums = np.zeros((len(rows), 4))
    np.add.at(sums, owner[face], values)
    return sums[:, 0], sums[:, 1:]


def _cubic(triangles: FloatArray, heights: FloatArray, along: FloatArray) -> FloatArray:
    """Means over triangles of h²/2 and of y h²/2 - a h³/6, (n, 4)."""
    y = np.einsum("pc,tcx->tpx", CORNERS, triangles)
    h = heights @ CORNERS.T
    half_square = h**2 / 2
    vectors = y * half_square[:, :, None] - along * (h**3 / 6)[:, :, None]
    return np.hstack([(half_square @ WEIGHTS)[:, None], np.einsum("tpx,p->tx", vectors, WEIGHTS)])
