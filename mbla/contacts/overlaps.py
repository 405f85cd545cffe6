"""Blocks that share volume.

Two blocks are apart if the plane of some facet has all of one on its inner side and all of the other on its outer side,
up to the tolerance. Pairs without such a plane are intersected as solids: with V the volume and S the surface of what
they share, they overlap if the thickness 2 V / S exceeds the tolerance times the block size. The measure sees identical
and nested blocks too, which no comparison of faces does.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray, starts
from mbla.contacts.broad_phase import BlockPairs
from mbla.contacts.facets import Facets
from mbla.contacts.ragged import rows_and_items
from mbla.contacts.solids import Solid, triangulate_blocks
from mbla.errors import MOST_FAULTS
from mbla.model.blocks import Blocks
from mbla.model.ragged import chunks, ranges

# Heights of vertices over facets computed together: bounds memory to some 100 MB.
_BATCH = 1_000_000
# Products of facets and vertices above which a pair is taken by itself, with a matrix product.
_LARGE = 20_000


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


def find_overlaps(blocks: Blocks, facets: Facets, pairs: BlockPairs, tolerance: float) -> Overlaps:
    """Overlaps deeper than the tolerance (relative to block size)."""
    rows = np.flatnonzero(pairs.box_depths > tolerance * pairs.sizes)
    for one, other in ((0, 1), (1, 0)):
        clearance = _clearances(blocks, facets, pairs.blocks[rows, one], pairs.blocks[rows, other])
        rows = rows[clearance < -tolerance * pairs.sizes[rows]]
    return _by_solids(blocks, pairs, rows, tolerance)


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
    products = n_facets * n_vertices
    small = np.flatnonzero(products <= _LARGE)
    for part in chunks(products[small], _BATCH):
        rows = small[part]
        pair, facet = rows_and_items(facets.facet_start[one[rows]], n_facets[rows])
        row, vertex = rows_and_items(blocks.vertex_start[other[rows]][pair], n_vertices[rows][pair])
        arms = blocks.vertices[vertex] - facets.origins[facet][row]
        height = sign * np.einsum("ki,ki->k", arms, facets.normals[facet][row])
        least[ranges(start[rows], n_facets[rows])] = np.minimum.reduceat(height, starts(n_vertices[rows][pair])[:-1])
    for large in np.flatnonzero(products > _LARGE):
        of_facets = slice(facets.facet_start[one[large]], facets.facet_start[one[large] + 1])
        vertices = blocks.vertices[blocks.vertex_start[other[large]] : blocks.vertex_start[other[large] + 1]]
        least[start[large] : start[large + 1]] = _least_of_large(
            vertices, sign * facets.normals[of_facets], facets.origins[of_facets]
        )
    return least


def _least_of_large(vertices: FloatArray, normals: FloatArray, origins: FloatArray) -> FloatArray:
    """Least height of vertices (n, 3) over each of many planes, (m,), in slabs of a matrix product."""
    about = vertices[0]  # differences first: far from the origin the products would lose digits
    arms, offsets = vertices - about, np.einsum("ki,ki->k", origins - about, normals)
    slab = max(_BATCH // len(vertices), 1)
    least = [(arms @ normals[i : i + slab].T).min(axis=0) for i in range(0, len(normals), slab)]
    heights: FloatArray = np.concatenate(least) - offsets
    return heights


def _by_solids(blocks: Blocks, pairs: BlockPairs, rows: IntArray, tolerance: float) -> Overlaps:
    """Judge the pairs left over one by one, until there are more overlaps than are told."""
    found, depths, unchecked = [], [], []
    triangles = triangulate_blocks(blocks, np.unique(pairs.blocks[rows]))
    for row in rows:
        a, b = (int(block) for block in pairs.blocks[row])
        size = float(pairs.sizes[row])
        origin = blocks.centroids[a if blocks.sizes[a] <= blocks.sizes[b] else b]
        solids = [Solid(blocks.vertices, triangles[block], origin, size) for block in (a, b)]
        if not all(solid.sound for solid in solids):
            unchecked.append((a, b))
            continue
        thickness = solids[0].shared_thickness(solids[1])
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
