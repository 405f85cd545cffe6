"""Blocks that share volume.

Two blocks are apart if the plane of some facet has all of one on its inner side and all of the other on its outer side,
up to the tolerance. Pairs without such a plane are intersected as solids: with V the volume and S the surface of what
they share, they overlap if the thickness 2 V / S exceeds the tolerance times the block size. The measure sees identical
and nested blocks too, which no comparison of faces does. Where it is exceeded, what is told is how far the two must be
moved apart (:mod:`mbla.contacts.penetration`), which is no less.

A pair that overlaps by less is accepted, and the weight of what it shares counts twice. It is not where one of the two
is so thin that the other reaches through half of it: then no faces of the two touch midway.

Only this module imports manifold3d (when it is needed).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, starts
from mbla.contacts.faces.facets import Facets
from mbla.contacts.outlines.overlay import frames_from_normals
from mbla.contacts.penetration import convex_penetration, deepest_point
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import chunks, ranges, rows_and_items

# Heights of vertices over facets computed together: bounds memory to some 100 MB.
_BATCH = 1_000_000
# Products of facets and vertices above which a pair is intersected at once: for surveyed stones that is the faster way.
_LARGE = 1_000_000
MOST_OVERLAPS = 20_000
"""pairs of blocks that overlap, after which no more are looked at: the deck is refused anyway"""
SLIGHT = 1e-3
"""overlap relative to block size that is rounding, and not remarked on where it is accepted"""
HALF = 0.5
"""share of the thickness of a block by which another may reach into it and still touch the face it came through"""


@dataclass(frozen=True)
class Overlaps:
    """Pairs of blocks that share volume.

    pairs     : (n, 2) blocks that overlap by more than the tolerance; those that swallow one of the two included
    depths    : (n,)   how far they reach into each other, relative to block size
    unchecked : (m, 2) pairs that could not be judged, because one of the blocks is not a closed solid
    accepted  : (k, 2) pairs that overlap by no more than the tolerance, but by more than rounding
    accepted_depths : (k,) relative to block size
    common    : (k,) m3 that each of them shares
    swallows  : (n,) pairs of which one reaches through half of the other: no tolerance accepts these
    """

    pairs: IntArray
    depths: FloatArray
    unchecked: IntArray
    accepted: IntArray
    accepted_depths: FloatArray
    common: FloatArray
    swallows: BoolArray


def find_overlaps(blocks: Blocks, facets: Facets, pairs: IntArray, tolerance: float) -> Overlaps:
    """Overlaps of pairs of blocks, (n, 2), deeper than the tolerance (relative to block size), and those accepted."""
    for one, other in ((0, 1), (1, 0)):
        n_facets, n_vertices = np.diff(facets.facet_start), np.diff(blocks.vertex_start)
        first, second, sizes = pairs[:, one], pairs[:, other], blocks.sizes[pairs].min(axis=1)
        small = n_facets[first] * np.maximum(n_vertices[first], n_vertices[second]) <= _LARGE
        together = ~small
        least = min(tolerance, SLIGHT)
        together[small] = _clearances(blocks, facets, first[small], second[small]) < -least * sizes[small]
        pairs = pairs[together]
    return _by_solids(blocks, pairs, tolerance)


def _clearances(blocks: Blocks, facets: Facets, one: IntArray, other: IntArray) -> FloatArray:
    """Greatest clearance of the blocks of each pair along a facet normal of the first, (n,) m; negative if none."""
    if not len(one):
        return np.zeros(0)
    # How far each of the first blocks reaches beyond the planes of its own facets: 0 where it is convex.
    own = np.unique(one)
    extents = np.zeros(len(facets))
    counts = np.diff(facets.facet_start)
    extents[ranges(facets.facet_start[own], counts[own])] = -_least_heights(blocks, facets, own, own, sign=-1.0)
    lowest = _least_heights(blocks, facets, one, other, sign=1.0)
    clearance = lowest - extents[ranges(facets.facet_start[one], counts[one])]
    greatest: FloatArray = np.maximum.reduceat(clearance, starts(counts[one])[:-1])
    return greatest


def _least_heights(blocks: Blocks, facets: Facets, one: IntArray, other: IntArray, sign: float) -> FloatArray:
    """Least of sign × height over the vertices of ``other``, above every facet of ``one``: flat, row by row, m."""
    n_facets = np.diff(facets.facet_start)[one]
    n_vertices = np.diff(blocks.vertex_start)[other]
    start = starts(n_facets)
    least = np.empty(start[-1])
    for rows in chunks(n_facets * n_vertices, _BATCH):
        pair, facet = rows_and_items(facets.facet_start[one[rows]], n_facets[rows])
        row, vertex = rows_and_items(blocks.vertex_start[other[rows]][pair], n_vertices[rows][pair])
        arms = blocks.vertices[vertex] - facets.origins[facet][row]
        height = sign * np.einsum("ki,ki->k", arms, facets.normals[facet][row])
        least[start[rows.start] : start[rows.stop]] = np.minimum.reduceat(height, starts(n_vertices[rows][pair])[:-1])
    return least


def _by_solids(blocks: Blocks, pairs: IntArray, tolerance: float) -> Overlaps:
    """Judge the pairs left over one by one."""
    found: list[tuple[tuple[int, int], float, bool]] = []
    accepted: list[tuple[tuple[int, int], float, float]] = []
    unchecked = []
    triangles = triangulate_blocks(blocks, np.unique(pairs))
    for a, b in pairs.tolist():
        smaller = a if blocks.sizes[a] <= blocks.sizes[b] else b
        size, origin = float(blocks.sizes[smaller]), blocks.centroids[smaller]
        one, other = (_solid(blocks.vertices, triangles[block], origin, size) for block in (a, b))
        if one is None or other is None:
            unchecked.append((a, b))
            continue
        common = one ^ other
        volume = abs(common.volume())
        thickness = 2 * volume / (common.surface_area() or 1.0)
        if thickness <= min(tolerance, SLIGHT):
            continue
        depth, swallows = _depth(blocks, (a, b), common, triangles)
        depth = max(depth, thickness)
        if thickness > tolerance or swallows:
            found.append(((a, b), depth, swallows))
            if len(found) > MOST_OVERLAPS:
                break
        else:
            accepted.append(((a, b), depth, volume * size**3))
    return Overlaps(
        pairs=_pairs([pair for pair, *_ in found]),
        depths=np.array([depth for _, depth, _ in found], dtype=np.float64),
        unchecked=_pairs(unchecked),
        accepted=_pairs([pair for pair, *_ in accepted]),
        accepted_depths=np.array([depth for _, depth, _ in accepted], dtype=np.float64),
        common=np.array([volume for *_, volume in accepted], dtype=np.float64),
        swallows=np.array([swallows for *_, swallows in found], dtype=bool),
    )


def _pairs(found: list[tuple[int, int]]) -> IntArray:
    return np.array(found, dtype=np.int64).reshape(-1, 2)


def _depth(blocks: Blocks, pair: tuple[int, int], common: Any, triangles: dict[int, IntArray]) -> tuple[float, bool]:
    """How far two blocks reach into each other, relative to block size, and whether through half of one of them."""
    sizes = blocks.sizes[list(pair)]
    size, origin = float(sizes.min()), blocks.centroids[pair[int(np.argmin(sizes))]]
    if blocks.convex[list(pair)].all() and (out := convex_penetration(blocks, *pair)) is not None:
        distance, way = out
        extents = [_extent(blocks, block, way) for block in pair]
        return distance / size, distance > HALF * min(extents)
    one, other = ((blocks.vertices[triangles[block]] - origin) / size for block in pair)
    return deepest_point(common, one, other) or 0.0, False


def _extent(blocks: Blocks, block: int, direction: FloatArray) -> float:
    """Of a block along a direction, m."""
    return float(np.ptp(blocks.vertices[blocks.vertex_start[block] : blocks.vertex_start[block + 1]] @ direction))


def triangulate_blocks(blocks: Blocks, chosen: IntArray) -> dict[int, IntArray]:
    """Triangles (m, 3) of each block, outwards, as rows of ``blocks.vertices``."""
    faces = ranges(blocks.face_start[chosen], np.diff(blocks.face_start)[chosen])
    first, count = blocks.loop_start[faces], np.diff(blocks.loop_start)[faces]
    row, corner = rows_and_items(first, count)
    # all corners in the planes of their faces at once; one by one this takes longer than the solids
    arms = blocks.vertices[blocks.loops[corner]] - blocks.vertices[blocks.loops[first]][row]
    tangents = frames_from_normals(blocks.face_normals[faces])[:, 1:]
    flat = np.einsum("ki,kai->ka", arms, tangents[row])
    of_face = starts(count)
    triangles: dict[int, list[IntArray]] = {}
    for number, block in enumerate(blocks.block_of_face[faces].tolist()):
        loop = blocks.loops[first[number] : first[number] + count[number]]
        triangles.setdefault(block, []).append(_triangles(loop, flat[of_face[number] : of_face[number + 1]]))
    return {block: np.concatenate(found) for block, found in triangles.items()}


def _triangles(loop: IntArray, flat: FloatArray) -> IntArray:
    """A face, (n,) vertices at (n, 2) in its plane, as triangles."""
    from manifold3d import triangulate

    return loop[None] if len(loop) == 3 else loop[np.asarray(triangulate([flat]))]


def _solid(vertices: FloatArray, triangles: IntArray, origin: FloatArray, size: float) -> Any | None:
    """A closed surface of triangles relative to ``origin`` over ``size``; None where it closes no solid."""
    from manifold3d import Error, Manifold, Mesh64

    first, last = triangles.min(), triangles.max()
    corners = (vertices[first : last + 1] - origin) / size
    mesh = Mesh64(vert_properties=corners, tri_verts=(triangles - first).astype(np.uint64))
    solid = Manifold(mesh)
    if solid.status() != Error.NoError:
        mesh.merge()  # vertices listed twice at one place
        solid = Manifold(mesh)
    return solid if solid.status() == Error.NoError and not solid.is_empty() else None
