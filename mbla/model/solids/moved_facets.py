"""Blocks of which some facets are moved to other planes.

Each corner goes to where the planes of its facets meet, those that are moved and those that are not; one that lies on
fewer than three of them, amid a facet or an edge, by the shortest way. Faces and corners stay what they are.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.solids.blocks import Blocks
from mbla.model.solids.facing_facets import FacetPlanes

ONE_PLANE = 1e-6
"""singular value, relative to the greatest, below which facets at a corner are as good as one"""
TURNED = 0.5
"""cosine of the angle by which an edge may turn: one that shrinks to nothing turns round"""


@dataclass(frozen=True)
class MovedFacets:
    """Vertices (n_vertices, 3), and blocks that cannot follow.

    split     : a corner of more than three facets, which would meet in several points
    swallowed : an edge of nothing or less is left
    """

    vertices: FloatArray
    split: IntArray
    swallowed: IntArray


def moved_facets(
    blocks: Blocks, planes: FacetPlanes, facets: IntArray, targets: FacetPlanes, tolerance: float
) -> MovedFacets:
    """Blocks with facets (n,) moved to planes (n).

    tolerance : relative to block size, by which a corner may leave the plane of one of its facets
    """
    target_of = {int(facet): row for row, facet in enumerate(facets)}
    vertices = blocks.vertices.copy()
    moving = np.isin(blocks.facet_of_face, facets)[blocks.face_of_corner]
    at = np.unique(np.column_stack([blocks.loops, blocks.facet_of_face[blocks.face_of_corner]]), axis=0)
    at = at[np.isin(at[:, 0], blocks.loops[moving])]
    split = set()
    for rows in np.split(np.arange(len(at)), np.flatnonzero(np.diff(at[:, 0])) + 1) if len(at) else ():
        vertex, around = int(at[rows[0], 0]), at[rows, 1].tolist()
        normals, steps = np.empty((len(around), 3)), np.zeros(len(around))
        for row, facet in enumerate(around):
            target = target_of.get(facet)
            normals[row] = planes.normals[facet] if target is None else targets.normals[target]
            if target is not None:
                steps[row] = normals[row] @ (targets.points[target] - vertices[vertex])
        way = np.linalg.lstsq(normals, steps, rcond=ONE_PLANE)[0]
        block = int(blocks.block_of_vertex[vertex])
        if np.abs(normals @ way - steps).max() > tolerance * blocks.sizes[block]:
            split.add(block)
        vertices[vertex] += way
    return MovedFacets(vertices, np.array(sorted(split), dtype=np.int64), _swallowed(blocks, vertices))


def _swallowed(blocks: Blocks, vertices: FloatArray) -> IntArray:
    """Blocks with an edge that turns round."""
    before, after = (points[blocks.next_loops] - points[blocks.loops] for points in (blocks.vertices, vertices))
    lengths = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    turned = np.einsum("ki,ki->k", before, after) <= TURNED * lengths
    return np.unique(blocks.block_of_face[blocks.face_of_corner[turned]])
