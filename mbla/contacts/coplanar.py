"""Facets of one block on one plane that share no edge: a quadrilateral beside triangles that end amid its edge.

They touch a neighbour in one plane, and where they join in one common surface.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.contacts.ragged import rows_and_items
from mbla.model.blocks import Blocks

# Facets of a block whose normals and heights differ by less than this (relative to block size) are one plane.
_SAME_PLANE = 1e-6
# Unlike any direction of a building, so that two different normals hardly ever look alike along it.
_ODD_DIRECTION = np.array([0.5403023, 0.2919266, 0.7892347])


def facets_on_one_plane(blocks: Blocks, centres: FloatArray) -> IntArray:
    """Facet of each face after joining facets of one block that lie on one plane, (n_faces,), in order of blocks.

    centres : (n_faces, 3) m  a point on each face
    """
    facet_of_face = blocks.facet_of_face
    _, first_face = np.unique(facet_of_face, return_index=True)
    n = len(first_face)
    block = blocks.block_of_face[first_face]
    normals, points = blocks.face_normals[first_face], centres[first_face]
    i, j = _same_normal(block, normals)
    height = np.abs(np.einsum("ki,ki->k", points[j] - points[i], normals[i]))
    alike = np.abs(normals[i] - normals[j]).max(axis=1, initial=0.0) < _SAME_PLANE
    alike &= height < _SAME_PLANE * blocks.sizes[block[i]]
    i, j = i[alike], j[alike]
    if not len(i):
        return facet_of_face
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    _, label = connected_components(coo_array((np.ones(len(i)), (i, j)), shape=(n, n)), directed=False)
    _, first, dense = np.unique(label, return_index=True, return_inverse=True)
    rank = np.argsort(np.argsort(first))  # numbered by first occurrence, to stay in order of blocks
    joined = rank[dense]
    return joined[facet_of_face].astype(np.int64)


def _same_normal(block: IntArray, normals: FloatArray) -> tuple[IntArray, IntArray]:
    """Pairs of facets of one block that may have the same normal.

    Sorted along an odd direction they are neighbours, so that only facets within a run of close values are paired.
    """
    n = len(block)
    along = normals @ _ODD_DIRECTION
    order = np.lexsort((along, block))
    same_run = (block[order][1:] == block[order][:-1]) & (np.diff(along[order]) < _SAME_PLANE)
    run_start = np.concatenate([[True], ~same_run]).nonzero()[0]
    run_end = np.concatenate([run_start[1:], [n]])
    run_of = np.repeat(np.arange(len(run_start)), run_end - run_start)
    row, position = rows_and_items(np.arange(1, n + 1), run_end[run_of] - np.arange(n) - 1)
    return order[row], order[position]
