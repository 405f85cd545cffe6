"""Edges of blocks as engineers draw them: those between two planes, not those that divide one plane."""

from __future__ import annotations

import numpy as np

from mbla.arrays import BoolArray, FloatArray, IntArray, row_of_item
from mbla.model.blocks import Blocks


def block_edges(blocks: Blocks) -> IntArray:
    """Edges as pairs of vertices, (n_edges, 2), each once; those inside a facet are left out."""
    following = np.empty_like(blocks.loops)
    following[:-1] = blocks.loops[1:]
    following[blocks.loop_start[1:] - 1] = blocks.loops[blocks.loop_start[:-1]]
    facets = blocks.facet_of_face[row_of_item(blocks.loop_start)]
    low, high = np.minimum(blocks.loops, following), np.maximum(blocks.loops, following)
    sides, times = np.unique(np.column_stack([facets, low, high]), axis=0, return_counts=True)
    return np.unique(sides[times == 1][:, 1:], axis=0)


def edges_of_blocks(blocks: Blocks, edges: IntArray, chosen: BoolArray) -> IntArray:
    """Edges of the chosen blocks only."""
    return edges[chosen[blocks.block_of_vertex[edges[:, 0]]]]


def as_vtk_rows(start: IntArray, items: IntArray) -> IntArray:
    """Ragged rows in the form that VTK wants: each row preceded by its length."""
    counts = np.diff(start)
    return np.insert(items, start[:-1], counts)


def box_of(points: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Least and greatest coordinates, (3,) each."""
    return points.min(axis=0), points.max(axis=0)
