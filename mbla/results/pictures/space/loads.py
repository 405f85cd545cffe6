"""Loads in a spatial picture: one arrow for what acts on all blocks alike, arrows at their points for the rest."""

from __future__ import annotations

import numpy as np

from mbla.arrays import FloatArray
from mbla.results.pictures.palette import DEAD_LOAD, LIVE_LOAD, SETTLEMENT
from mbla.results.pictures.scene import Scene
from mbla.results.pictures.space.shapes import Shape, arrows, rgb

MOST_ARROWS = 80
"""arrows of single forces, the largest; more hide each other"""
NEGLIGIBLE = 1e-6
"""force on a block, over the largest, below which none is drawn: what is left when the uniform part is taken away"""


def live_load_arrows(scene: Scene) -> tuple[list[Shape], list[tuple[str, str]]]:
    """Of the live load, or the settlement in its place, with an entry of the legend."""
    settlement = scene.case.load_case.settlement
    if settlement is not None:
        return _settlement(scene), [("settlement", SETTLEMENT)]
    return _arrows(scene, scene.case.load_case.live_load, "live load", LIVE_LOAD)


def dead_load_arrows(scene: Scene) -> tuple[list[Shape], list[tuple[str, str]]]:
    """Of the dead load; gravity alone straight down goes without saying."""
    load = scene.case.load_case.dead_load
    uniform, rest = split_load(scene, load)
    if not rest.any() and uniform[2] < 0 and np.linalg.norm(uniform[:2]) <= NEGLIGIBLE * -uniform[2]:
        return [], []
    return _arrows(scene, rest if uniform[2] < 0 and not uniform[:2].any() else load, "dead load", DEAD_LOAD)


def split_load(scene: Scene, load: FloatArray) -> tuple[FloatArray, FloatArray]:
    """A load as one acceleration, (3,), the median over free blocks, and the rest, (n_blocks, 6)."""
    free, masses = scene.model.free, scene.model.blocks.masses
    rest = load.copy()
    rest[scene.model.fixed] = 0.0
    solid = free[masses[free] > 0]
    if not len(solid):
        return np.zeros(3), rest
    uniform = np.median(load[solid, :3] / masses[solid, None], axis=0)
    rest[free, :3] -= masses[free, None] * uniform
    sizes = np.linalg.norm(rest[:, :3], axis=1)
    rest[sizes <= NEGLIGIBLE * np.linalg.norm(load[:, :3], axis=1).max(initial=0.0)] = 0.0
    return np.asarray(uniform), rest


def points_of_application(scene: Scene, load: FloatArray) -> FloatArray:
    """Point of the line of action of each block's force that is nearest to its centroid, (n_blocks, 3) m."""
    forces, moments = load[:, :3], load[:, 3:]
    squares = np.square(forces).sum(axis=1, keepdims=True)
    arms = np.divide(np.cross(forces, moments), squares, out=np.zeros_like(forces), where=squares > 0)
    return np.asarray(scene.model.blocks.centroids + arms)


def _arrows(scene: Scene, load: FloatArray, name: str, colour: str) -> tuple[list[Shape], list[tuple[str, str]]]:
    uniform, rest = split_load(scene, load)
    shapes: list[Shape] = []
    if np.linalg.norm(uniform) > 0:
        shapes += _one_arrow(scene, uniform, colour)
    sizes = np.linalg.norm(rest[:, :3], axis=1)
    rows = np.flatnonzero(sizes > 0)
    rows = rows[np.argsort(-sizes[rows], kind="stable")[:MOST_ARROWS]]
    if len(rows):
        tips = points_of_application(scene, rest)[rows]
        length = 0.04 * scene.size * (1 + 2 * sizes[rows] / sizes.max())
        starts = tips - rest[rows, :3] / sizes[rows, None] * length[:, None]
        radii = np.full(len(rows), 0.0035 * scene.size)
        shapes.append(arrows(starts, tips, radii, np.tile(rgb(colour), (len(rows), 1))))
    return shapes, [(name, colour)] if shapes else []


def _one_arrow(scene: Scene, uniform: FloatArray, colour: str) -> list[Shape]:
    """Above the structure, over the middle of what can move."""
    direction = uniform / np.linalg.norm(uniform)
    vertices = np.vstack([scene.moved, scene.model.blocks.vertices])
    top = float(vertices[:, 2].max())
    length = 0.14 * scene.size
    middle = np.append(scene.model.blocks.centroids[scene.model.free, :2].mean(axis=0), top + 0.05 * scene.size)
    start = middle - direction * length * (0.5 if direction[2] >= -0.5 else 1.0)
    return [arrows(start[None], (start + length * direction)[None], np.array([0.006 * scene.size]), rgb(colour)[None])]


def _settlement(scene: Scene) -> list[Shape]:
    settlement = scene.case.load_case.settlement
    assert settlement is not None
    centres, ways = scene.model.blocks.centroids[settlement.blocks], settlement.motions[:, :3]
    sizes = np.linalg.norm(ways, axis=1)
    rows = np.flatnonzero(sizes > 0)
    if not len(rows):
        return []
    starts = centres[rows]
    tips = starts + 0.12 * scene.size * ways[rows] / sizes[rows].max()
    radii = np.full(len(rows), 0.005 * scene.size)
    return [arrows(starts, tips, radii, np.tile(rgb(SETTLEMENT), (len(rows), 1)))]
