"""Fill in the picture of a model: the space between the blocks that it lies on and its top, pale."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.fill.fill import FillBody
from mbla.results.pictures.marks.marks import SAME_PLACE, Mark, outer_rows
from mbla.results.pictures.page import FILL
from mbla.results.pictures.scene import PictureScene

EDGE = 0.25
"""width of edges over that of hinges"""
TURNS = 0.02
"""sine of the angle between two sides from which an edge is between them"""


def fill_marks(scene: PictureScene) -> list[Mark]:
    """The fills of a model; none without fill."""
    fill = scene.model.fill
    if fill is None:
        return []
    found = zip(fill.words, fill.bodies.values(), strict=True)
    return [_mark(f"fill: {words}", body, scene.size) for words, body in found]


def _mark(text: str, body: FillBody, size: float) -> Mark:
    """Of one fill its top and the sides around it: prisms from pieces of faces upwards, where they face no other."""
    low = body.triangles[(body.depths(body.triangles) > 0.0).any(axis=1)]
    blocks = body.blocks[(body.depths(body.triangles) > 0.0).any(axis=1)]
    low = low.copy()
    high = low.copy()
    high[..., 2] = np.maximum(low[..., 2], body.tops(low))
    middle = (high[:, 0] + high[:, 2]) / 2
    points = np.concatenate([low, high, middle[:, None]], axis=1)  # 7 of each piece
    first = 7 * np.arange(len(low))[:, None]
    sides = np.concatenate([first + np.array([[i, (i + 1) % 3]]) for i in range(3)])
    flat: FloatArray = points.reshape(-1, 3)
    sides = sides[outer_rows(flat[sides], size)]
    faces = np.vstack([first + np.array([[3, 4, 5, 6]]), np.column_stack([sides, sides[:, ::-1] + 3])])
    edges, texts = _edges(sides, flat, size), (text,) * len(flat)
    both = np.column_stack([np.repeat(blocks, 7)] * 2)
    widths = np.full(len(edges), EDGE)
    return Mark(text, FILL, flat, both, edges, widths, texts, faces, covered=True, pale=True, outlined=True)


def _edges(sides: IntArray, points: FloatArray, size: float) -> IntArray:
    """Edges of the top around it, (n, 2) rows of points, and upright ones where sides meet at an angle."""
    sides = sides[outer_rows(points[sides + 3], size)]
    tops = sides + 3
    ways = points[tops[:, 1], :2] - points[tops[:, 0], :2]
    ways = ways / np.linalg.norm(ways, axis=1, keepdims=True)
    ends, owner = sides.ravel(), np.repeat(np.arange(len(sides)), 2)
    places = np.rint(points[ends, :2] / (SAME_PLACE * size)).astype(np.int64)
    _, first, row, times = np.unique(places, axis=0, return_index=True, return_inverse=True, return_counts=True)
    order = np.argsort(row.ravel(), kind="stable")
    starts, last = np.cumsum(times) - times, np.cumsum(times) - 1
    one, other = ways[owner[order[starts]]], ways[owner[order[last]]]
    bent = np.abs(one[:, 0] * other[:, 1] - one[:, 1] * other[:, 0]) > TURNS
    upright = ends[first[bent]]
    return np.vstack([tops, np.column_stack([upright, upright + 3])])
