"""Whether blocks lie in each other at a pose, contact points or not: corners of one inside another that is convex.

No contact point stands for an overlap that the search for contacts has missed: only vertices and faces count here.
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import Model
from mbla.solution.verification.in_time.bodies import MovedSolids

ROWS = 1000
"""Blocks whose boxes are held against all others at a time."""


def deepest_corner(moved: MovedSolids) -> float:
    """Depth of a corner in a block of another body, or below ground, beyond what it is as built; over the size of the
    smaller body. Of blocks that are not convex only corners count, of ground only planes without end that carry all.
    """
    model, solids = moved.solids.model, moved.solids
    blocks = model.blocks
    of_vertex = blocks.block_of_vertex
    arms = blocks.vertices - blocks.centroids[of_vertex]
    rotations = moved.rotations[solids.label]
    corners = moved.block_centroids[of_vertex] + np.einsum("vij,vj->vi", rotations[of_vertex], arms)
    normals = np.einsum("fij,fj->fi", rotations[blocks.block_of_face], blocks.face_normals)
    pairs = _near(moved, corners)
    depth = _depths(model, corners, normals, pairs) - _depths(model, blocks.vertices, blocks.face_normals, pairs)
    sizes = solids.sizes[solids.label]
    greatest = float((depth / sizes[pairs].min(axis=1)).max(initial=0.0)) if len(pairs) else 0.0
    for ground in model.grounds:
        if ground.outline is None and ground.blocks is None:
            below = (blocks.vertices - corners) @ ground.normal  # lower than as built
            below = np.minimum(below, (ground.point - corners) @ ground.normal)
            greatest = max(greatest, float((below / sizes[of_vertex])[~model.fixed[of_vertex]].max(initial=0.0)))
    return greatest


def _near(moved: MovedSolids, corners: FloatArray) -> IntArray:
    """Pairs of blocks of two bodies whose boxes overlap, of which the second is convex, (n, 2)."""
    blocks, label = moved.solids.model.blocks, moved.solids.label
    first = blocks.vertex_start[:-1]
    low, high = np.minimum.reduceat(corners, first), np.maximum.reduceat(corners, first)
    found = [np.zeros((0, 2), dtype=np.int64)]
    for begin, end in pairwise([*range(0, len(blocks), ROWS), len(blocks)]):
        meet = (low[begin:end, None] <= high).all(axis=2) & (low <= high[begin:end, None]).all(axis=2)
        meet &= (label[begin:end, None] != label) & blocks.convex
        found.append(np.argwhere(meet) + np.array([begin, 0]))
    return np.concatenate(found)


def _depths(model: Model, corners: FloatArray, normals: FloatArray, pairs: IntArray) -> FloatArray:
    """Of the deepest corner of the first block of each pair inside the second, 0 where none is, (n_pairs,)."""
    blocks = model.blocks
    greatest = np.zeros(len(pairs))
    origins = corners[blocks.loops[blocks.loop_start[:-1]]]
    for number, (one, other) in enumerate(pairs.tolist()):
        own = corners[blocks.vertex_start[one] : blocks.vertex_start[one + 1]]
        faces = slice(int(blocks.face_start[other]), int(blocks.face_start[other + 1]))
        inside = ((origins[faces] - own[:, None]) * normals[faces]).sum(axis=2).min(axis=1)
        greatest[number] = max(float(inside.max()), 0.0)
    return greatest
