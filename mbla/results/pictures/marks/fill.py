"""Fill in the picture of a model: the space between the blocks that it lies on and its top, pale."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.model.fill.fill import FillBody
from mbla.results.pictures.marks.marks import Mark, outer_rows
from mbla.results.pictures.page import FILL
from mbla.results.pictures.scene import PictureScene


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
    none, bodies = np.zeros((0, 2), dtype=np.int64), np.repeat(blocks, 7)
    texts = (text,) * len(flat)
    both = np.column_stack([bodies, bodies])
    return Mark(text, FILL, flat, both, none, np.zeros(0), texts, faces, covered=True, pale=True)
