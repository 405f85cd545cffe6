"""Loads `gravity` and `acceleration`: the mass m of blocks, own and added, times an acceleration there, F = m a.

Gravity acts in every load case: where its dead loads have none, as 9.81 m/s2 along -z. Accelerations are in units of
standard gravity; a `pattern` multiplies them by a factor that depends on height.

A pattern is a broken line f over the height s = x · a along a direction a. Every part of a block is accelerated by the
factor of its own height, so that dividing or gluing blocks does not change the load: a block takes the force
a ∫ ρ f dV, with a moment about its centroid, an added mass the factor where it is. On its heights f is its value at the
lowest of them and a ramp for each change of slope above.

Integrals of a ramp h(x) = max(x . a - l, 0) over blocks, by Gauss's theorem over their faces.

With y = x - c from the centroid c of the block and the outward normal n of its faces

    ∫ h dV = ∮ h²/2 (n . a) dA,        ∫ y h dV = ∮ (y h²/2 - a h³/6) (n . a) dA,

for the divergence of a y h²/2 is y h + a h²/2, and that of a h³/6 is h²/2. Faces are fans of triangles. Of a triangle
that the level l cuts counts what lies above: the triangle at the corner that is alone on its side, or all but that.
What is left is a cubic on each triangle, which the rule of seven points (corners, middles of edges, centroid)
integrates exactly.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.deck.sections.loads import HeightPattern, Load
from mbla.deck.tree import KeyPath
from mbla.deck.units import Units
from mbla.errors import Finding
from mbla.model.loads.load_kind import AppliedLoad, Entry, LoadSite
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import unit
from mbla.model.solids.ragged import items_of_rows, next_item, row_means
from mbla.model.wording import counted, vector


def gravity_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad:
    """Weights of all blocks, (n_blocks,)."""
    everywhere = np.arange(len(site.blocks))
    words = "no gravity" if load.gravity == "none" else f"gravity {vector(vector_of(load))} {site.units.length}/s2"
    return AppliedLoad(everywhere, mass_forces(everywhere, np.array(vector_of(load)), site), words)


def vector_of(load: Load) -> tuple[float, float, float]:
    """The acceleration of a load `gravity`, in the deck's unit of length per s2."""
    assert load.gravity is not None  # what makes it this kind
    return (0.0, 0.0, 0.0) if load.gravity == "none" else load.gravity


def with_gravity(dead: Iterable[Entry], path: KeyPath, units: Units) -> list[Entry]:
    """The dead loads of a case, before them 9.81 m/s2 along -z where none of them is gravity."""
    entries = list(dead)
    if any(entry.load.gravity is not None for entry in entries):
        return entries
    usual = Load.model_construct(gravity=(0.0, 0.0, -units.standard_gravity))
    return [Entry(usual, path, 1.0), *entries]


def mass_forces(
    blocks: IntArray, acceleration: FloatArray, site: LoadSite, pattern: PatternFactors | None = None
) -> FloatArray:
    """F = m a about the centroids of the blocks; ``acceleration`` (3,) in length per s2; the result (n, 6).

    An added mass acts where it is, and so brings a moment. With a ``pattern`` the masses count with its factors, which
    are not the same all over a block: its own mass brings a moment, too.
    """
    bodies, unit = site.blocks, site.units.force_per_mass_acceleration
    own = (bodies.volumes * bodies.densities)[blocks]
    added = bodies.added_masses[blocks]
    arms = bodies.added_mass_points[blocks] - bodies.centroids[blocks]
    if pattern is None:
        mass, first_moments = own + added, added[:, None] * arms
    else:
        carried = added * pattern.at_mass
        mass, first_moments = own * pattern.means + carried, own[:, None] * pattern.levers + carried[:, None] * arms
    force = acceleration * unit
    return np.hstack([mass[:, None] * force, np.cross(first_moments, force)])


def acceleration_load(load: Load, blocks: IntArray | None, path: KeyPath, site: LoadSite) -> AppliedLoad | None:
    """Mass forces on the blocks selected, (n,), on all unless some are."""
    assert load.acceleration is not None  # what makes it this kind
    chosen = np.arange(len(site.blocks)) if blocks is None else blocks
    where = "" if len(chosen) == len(site.blocks) else f" on {counted(len(chosen), 'block')}"
    acceleration = np.array(load.acceleration) * site.units.standard_gravity
    words = f"acceleration {vector(load.acceleration)} g{where}"
    pattern = None
    if load.pattern is not None:
        pattern = pattern_factors(load.pattern, chosen, (*path, "pattern"), site)
        if pattern is None:
            return None
        least, most = pattern.means.min(), pattern.means.max()
        words += f" times {least:.6g} to {most:.6g}, by height along {vector(load.pattern.along)}"
    return AppliedLoad(chosen, mass_forces(chosen, acceleration, site, pattern), words)


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


CORNERS = np.vstack([np.eye(3), (1 - np.eye(3)) / 2, np.full((1, 3), 1 / 3)])
WEIGHTS = np.array([1 / 20] * 3 + [2 / 15] * 3 + [9 / 20])
"""barycentric coordinates of the seven points and their weights; exact to the third degree"""


def ramp_moments(
    blocks: Blocks, rows: IntArray, along: FloatArray, levels: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Integrals of h, (n,), and of y h, (n, 3), over the blocks ``rows``, each with a level of its own.

    along : (3,) unit vector a; levels : (n,) heights l above which the ramp rises
    """
    triangles, owner = _triangles(blocks, rows)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]) / 2
    facing = normals @ along
    heights = triangles @ along + (blocks.centroids[rows] @ along - levels)[owner, None]
    above = heights > 0
    count = above.sum(axis=1)
    values = np.zeros((len(triangles), 4))
    whole = count >= 2
    values[whole] = _cubic(triangles[whole], heights[whole], along) * facing[whole, None]
    cut = (count == 1) | (count == 2)
    piece, piece_heights, share = _tips(triangles[cut], heights[cut], above[cut])
    sign = np.where(count[cut] == 1, 1.0, -1.0)
    values[cut] += (sign * share * facing[cut])[:, None] * _cubic(piece, piece_heights, along)
    sums = np.zeros((len(rows), 4))
    np.add.at(sums, owner, values)
    return sums[:, 0], sums[:, 1:]


def _triangles(blocks: Blocks, rows: IntArray) -> tuple[FloatArray, IntArray]:
    """Outward triangles (n, 3, 3) of the faces, about the centroid of their block, and their position in ``rows``."""
    place = np.full(len(blocks), -1)
    place[rows] = np.arange(len(rows))
    faces = items_of_rows(blocks.face_start, rows)
    corners = items_of_rows(blocks.loop_start, faces)
    sizes = np.diff(blocks.loop_start)[faces]
    face_of_corner = np.repeat(np.arange(len(faces)), sizes)
    owner = place[blocks.block_of_face[faces]][face_of_corner]
    centroids = blocks.centroids[rows]
    tails = blocks.vertices[blocks.loops[corners]] - centroids[owner]
    heads = blocks.vertices[blocks.loops[next_item(blocks.loop_start)[corners]]] - centroids[owner]
    centres = row_means(tails, np.append(0, np.cumsum(sizes)))[face_of_corner]
    return np.stack([centres, tails, heads], axis=1), owner


def _cubic(triangles: FloatArray, heights: FloatArray, along: FloatArray) -> FloatArray:
    """Means over triangles of h²/2 and of y h²/2 - a h³/6, (n, 4)."""
    y = np.einsum("pc,tcx->tpx", CORNERS, triangles)
    h = heights @ CORNERS.T
    half_square = h**2 / 2
    vectors = y * half_square[:, :, None] - along * (h**3 / 6)[:, :, None]
    return np.hstack([(half_square @ WEIGHTS)[:, None], np.einsum("tpx,p->tx", vectors, WEIGHTS)])


def _tips(triangles: FloatArray, heights: FloatArray, above: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Triangle between the corner that is alone on its side and the level, its heights, and its share of the area."""
    alone = np.where(above.sum(axis=1) == 1, above.argmax(axis=1), above.argmin(axis=1))
    turn = (alone[:, None] + np.arange(3)) % 3
    triangles = np.take_along_axis(triangles, turn[:, :, None], axis=1)
    heights = np.take_along_axis(heights, turn, axis=1)
    run = heights[:, :1] / (heights[:, :1] - heights[:, 1:])
    ends = triangles[:, :1] + run[:, :, None] * (triangles[:, 1:] - triangles[:, :1])
    tips = np.concatenate([triangles[:, :1], ends], axis=1)
    return tips, np.column_stack([heights[:, 0], np.zeros((len(tips), 2))]), run.prod(axis=1)
