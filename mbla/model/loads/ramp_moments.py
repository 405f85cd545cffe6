"""Integrals of a ramp h(x) = max(x . a - l, 0) over blocks, by Gauss's theorem over their faces.

With y = x - c from the centroid c of the block and the outward normal n of its faces

    ∫ h dV = ∮ h²/2 (n . a) dA,        ∫ y h dV = ∮ (y h²/2 - a h³/6) (n . a) dA,

for the divergence of a y h²/2 is y h + a h²/2, and that of a h³/6 is h²/2. Faces are fans of triangles. Of a triangle
that the level l cuts counts what lies above: the triangle at the corner that is alone on its side, or all but that.
What is left is a cubic on each triangle, which the rule of seven points (corners, middles of edges, centroid)
integrates exactly.
"""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.blocks import Blocks
from mbla.model.ragged import items_of_rows, next_item, row_means

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
