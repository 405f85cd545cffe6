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

for the divergence of a y h²/2 is y h + a h²/2, and that of a h³/6 is h²/2. Of each face
counts what lies above the level l; in a fan of triangles over it the rest is a cubic on each of them, which the
rule of seven points (corners, middles of edges, centroid) integrates exactly.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, summed
from mbla.deck.sections.loads import HeightPattern, Load
from mbla.deck.text.tree import KeyPath
from mbla.deck.units import Units
from mbla.errors import Finding
from mbla.model.loads.load_kind import AppliedLoad, Entry, LoadSite
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.plane import cut, unit
from mbla.model.solids.ragged import items_of_rows
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


def gravity_of(dead: Iterable[Entry]) -> FloatArray:
    """The sum of gravity among dead loads, (3,) in the deck's unit of length per s2."""
    found = [entry.factor * np.array(vector_of(entry.load)) for entry in dead if entry.load.gravity is not None]
    return np.asarray(sum(found, np.zeros(3)))


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
    """F = m a about the centroids of the blocks; ``acceleration`` (3,) in length per s2; the result (n, 15).

    An added mass acts where it is, and so brings a moment. With a ``pattern`` the masses count with its factors, which
    are not the same all over a block: its own mass brings a moment, too.
    """
    bodies, unit = site.blocks, site.units.force_per_mass_acceleration
    own = (bodies.volumes * bodies.densities)[blocks]
    if pattern is None:
        added = bodies.added_masses[blocks]
        arms = bodies.added_mass_points[blocks] - bodies.centroids[blocks]
        mass, first_moments = own + added, added[:, None] * arms
    else:
        mass, first_moments = own * pattern.means + pattern.carried, own[:, None] * pattern.levers + pattern.moments
    force = acceleration * unit
    levers = (first_moments[:, :, None] * force).reshape(-1, 9)
    return np.hstack([mass[:, None] * force, np.cross(first_moments, force), levers])


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
