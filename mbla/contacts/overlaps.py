"""Blocks that share volume.

Two blocks are apart if the plane of some facet has all of one on its inner side and all of the other on its outer side,
up to the tolerance. Pairs without such a plane are intersected as solids: with V the volume and S the surface of what
they share, they overlap if the thickness 2 V / S exceeds the tolerance times the block size. The measure sees identical
and nested blocks too, which no comparison of faces does. Only this module imports manifold3d (when it is needed).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.facets import Facets
from mbla.contacts.outlines.overlay import frames_from_normals
from mbla.errors import MOST_FAULTS
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.ragged import chunks, ranges, rows_and_items

# Heights of vertices over facets computed together: bounds memory to some 100 MB.
_BATCH = 1_000_000
# Products of facets and vertices above which a pair is intersected at once: for surveyed stones that is the faster way.
_LARGE = 1_000_000


@dataclass(frozen=True)
class Overlaps:
    """Pairs of blocks that share volume.

    pairs     : (n, 2) blocks; only the first of more than ``MOST_FAULTS``, for which the deck is refused anyway
    depths    : (n,)   thickness of the shared volume relative to block size
    unchecked : (m, 2) pairs that could not be judged, because one of the blocks is not a closed solid
    """

    pairs: IntArray
    depths: FloatArray
    unchecked: IntArray


def find_overlaps(blocks: Blocks, facets: Facets, pairs: IntArray, tolerance: float) -> Overlaps:
    """Overlaps of pairs of blocks, (n, 2), deeper than the tolerance (relative to block size)."""
    for one, other in ((0, 1), (1, 0)):
        n_facets, n_vertices = np.diff(facets.facet_start), np.diff(blocks.vertex_start)
        first, second, sizes = pairs[:, one], pairs[:, other], blocks.sizes[pairs].min(axis=1)
        small = n_facets[first] * np.maximum(n_vertices[first], n_vertices[second]) <= _LARGE
        together = ~small
        together[small] = _clearances(blocks, facets, first[small], second[small]) < -tolerance * sizes[small]
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
    """Judge the pairs left over one by one, until there are more overlaps than are reported."""
    found, depths, unchecked = [], [], []
    triangles = triangulate_blocks(blocks, np.unique(pairs))
    for a, b in pairs.tolist():
        smaller = a if blocks.sizes[a] <= blocks.sizes[b] else b
        size, origin = float(blocks.sizes[smaller]), blocks.centroids[smaller]
        one, other = (_solid(blocks.vertices, triangles[block], origin, size) for block in (a, b))
        if one is None or other is None:
            unchecked.append((a, b))
            continue
        common = one ^ other
        thickness = 2 * abs(common.volume()) / (common.surface_area() or 1.0)
        if thickness > tolerance:
            found.append((a, b))
            depths.append(thickness)
            if len(found) > MOST_FAULTS:
                break
    return Overlaps(
        np.array(found, dtype=np.int64).reshape(-1, 2),
        np.array(depths, dtype=np.float64),
        np.array(unchecked, dtype=np.int64).reshape(-1, 2),
    )


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
