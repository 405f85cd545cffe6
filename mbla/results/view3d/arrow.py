"""The arrow of a live load, above the structure; that of a settlement beside its support, with which it moves."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from mbla.arrays import FloatArray, IntArray
from mbla.model.model import LoadCase, Model, Settlement
from mbla.results.pictures.geometry import live_load_arrow
from mbla.results.view3d.marks import BARBS, arrows

BESIDE = 0.35
"""distance of the arrow of a settlement from its support over the length of the arrow"""
CENTRAL = 0.05
"""distance from the middle of the structure over its extent up to which a support has no outer side"""
FRONT = np.array([0.0, -1.0, 0.0])
"""side on which the arrow of a central support stands, or of one that turns about its middle"""


@dataclass(frozen=True)
class LoadArrow:
    """Segments of an arrow; none where the load has no direction.

    points : (n, 3) m
    pairs  : (k, 2) segments as rows of ``points``
    block  : that it moves with, -1 for none
    """

    name: str
    points: FloatArray
    pairs: IntArray
    block: int


def load_arrow(model: Model, load_case: LoadCase, low: FloatArray, high: FloatArray, length: float) -> LoadArrow:
    """The arrow of a load case; the box from ``low`` to ``high``, (3,) m, is around what is drawn."""
    settlement = load_case.settlement
    if settlement is None:
        start, tip = live_load_arrow(model, load_case, low, high, length)
        return _arrow("live load", start, tip - start, -1)
    start, step = _beside(model, settlement, length)
    return _arrow("settlement", start, step, int(settlement.blocks[0]))


def _beside(model: Model, settlement: Settlement, length: float) -> tuple[FloatArray, FloatArray]:
    """Start and step at the outer side of the support, so that its blocks do not hide it; no step where it spins."""
    blocks = model.blocks
    way = settlement.motions[:, :3].mean(axis=0)
    size = float(np.linalg.norm(way))
    if size == 0.0:
        return blocks.centroids[settlement.blocks].mean(axis=0), np.zeros(3)
    corners = blocks.vertices[np.isin(blocks.block_of_vertex, settlement.blocks)]
    middle = (corners.min(axis=0) + corners.max(axis=0)) / 2
    away = middle - (blocks.vertices.min(axis=0) + blocks.vertices.max(axis=0)) / 2
    away[2] = 0.0
    axis = int(np.argmax(np.abs(away)))
    outwards = np.sign(away[axis]) * np.eye(3)[axis]
    if abs(away[axis]) <= CENTRAL * float(np.ptp(blocks.vertices[:, :2], axis=0).max()):
        outwards = FRONT
    reach = float(((corners - middle) @ outwards).max())
    step = length * way / size
    return middle + (reach + BESIDE * length) * outwards - step / 2 + max(step @ -outwards, 0.0) * outwards, step


def _arrow(name: str, start: FloatArray, step: FloatArray, block: int) -> LoadArrow:
    if not step.any():
        return LoadArrow(name, np.array([start, start]), np.zeros((0, 2), dtype=np.int64), -1)
    return LoadArrow(
        name, arrows(start[None], step[None])[0], np.array([*BARBS, (2, 4), (4, 3), (3, 5), (5, 2)]), block
    )
