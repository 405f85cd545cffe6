"""Corners of cells are moved as long as that makes the load factor smaller.

A step is that of :mod:`~mbla.soil_mesh.corner_step` within a share of the least height of the triangles at each point.
It is kept where the program at the moved points has a smaller load factor; then the share grows, otherwise it shrinks.

Where the first mesh locks, or a step would have to pass through one that does, bodies may overlap at a cost, a
compressive strength: an exact penalty, which is raised until nothing overlaps.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.soil_mesh.corner_step import corner_step
from mbla.soil_mesh.planar_program import Mechanism, find_mechanism, with_unit_live_load
from mbla.soil_mesh.planar_scene import PlanarScene, areas_of, heights_at


@dataclass(frozen=True)
class MovingSettings:
    """How corners are moved.

    steps          : greatest number of them, kept or not
    share          : of the least height at a point by which it may move at first
    grows, shrinks : factors of the share after a step that is kept, and after one that is not
    most, least    : of the share; below the least the moving ends
    enough         : relative gain of two steps together below which it ends
    thinnest       : least height of a triangle, over the square root of the mean area of all
    penalties      : costs of overlaps in turn, over the greatest of cohesion, mean weight and pressure on the soil
    """

    steps: int = 60
    share: float = 0.3
    grows: float = 1.5
    shrinks: float = 0.4
    most: float = 0.5
    least: float = 2e-3
    enough: float = 1e-3
    thinnest: float = 0.01
    penalties: tuple[float, ...] = (100.0, 1000.0, 10000.0)


@dataclass(frozen=True)
class MovedMesh:
    """What moving corners came to.

    points       : (n_points, 2)
    mechanism    : on these; None where nothing can move, or dead loads alone have no equilibrium
    load_factors : of the meshes kept, in order, that of the first first; with overlaps at a cost where that locked
    steps        : tried
    """

    points: FloatArray
    mechanism: Mechanism | None
    load_factors: tuple[float, ...]
    steps: int

    @property
    def load_factor(self) -> float:
        """Upper one on the moved points, inf without a mechanism."""
        return np.inf if self.mechanism is None else self.mechanism.load_factor


@dataclass
class _Walk:
    """Points as they are moved, and the load factors so far."""

    points: FloatArray
    told: list[float]
    steps: int = 0


def move_corners(
    scene: PlanarScene, points: FloatArray, motions: sp.csr_array, settings: MovingSettings | None = None
) -> MovedMesh:
    """Points moved, from (n_points, 2), by what their motions allow, (2 n_points, n_unknowns)."""
    settings = MovingSettings() if settings is None else settings
    scene, unit = with_unit_live_load(scene, points)
    walk = _Walk(points, [])
    mechanism = find_mechanism(scene, points)
    if mechanism is None:
        for penalty in settings.penalties:
            soft = scene.crushing_at(penalty * stress_scale(scene, points))
            _walk(soft, walk, motions, settings)
            if find_mechanism(scene, walk.points) is not None:
                break
    mechanism = _walk(scene, walk, motions, settings)
    if mechanism is not None:
        mechanism = Mechanism(*(each / unit for each in vars(mechanism).values()))
    return MovedMesh(walk.points, mechanism, tuple(each / unit for each in walk.told), walk.steps)


def stress_scale(scene: PlanarScene, points: FloatArray) -> float:
    """Greatest cohesion, and weight of the soil over its extent, as force per length."""
    extent = float(np.sqrt(areas_of(scene.triangles, points).sum()))
    weights = [extent * float(np.linalg.norm(scene.dead_density, axis=1).max(initial=0.0))]
    return max(float(scene.cohesion.max(initial=0.0)), *weights)


def _walk(scene: PlanarScene, walk: _Walk, motions: sp.csr_array, settings: MovingSettings) -> Mechanism | None:
    """Move the points of a walk until nothing is gained any more; the mechanism at its end."""
    mechanism = find_mechanism(scene, walk.points)
    if mechanism is None:
        return None
    walk.told.append(mechanism.load_factor)
    share, gains = settings.share, [np.inf, np.inf]
    for _ in range(settings.steps):
        walk.steps += 1
        found = _moved(scene, walk.points, mechanism, motions, share, settings)
        if found is None:
            share *= settings.shrinks
            if share < settings.least:
                break
            continue
        walk.points, better = found
        gains.append((mechanism.load_factor - better.load_factor) / abs(mechanism.load_factor))
        mechanism, share = better, min(settings.grows * share, settings.most)
        walk.told.append(mechanism.load_factor)
        if sum(gains[-2:]) < settings.enough:
            break
    return mechanism


def _moved(
    scene: PlanarScene,
    points: FloatArray,
    mechanism: Mechanism,
    motions: sp.csr_array,
    share: float,
    settings: MovingSettings,
) -> tuple[FloatArray, Mechanism] | None:
    """Points after a step and their mechanism; None where that is no better."""
    thinnest = settings.thinnest * float(np.sqrt(areas_of(scene.triangles, points).mean()))
    heights = heights_at(scene.triangles, points)
    room = heights - thinnest
    room = np.repeat(np.where(np.isfinite(room), np.maximum(room, 0.0), 0.0), 2)
    bound = share * np.asarray(abs(motions).multiply(room[:, None]).max(axis=0).todense()).ravel()
    found = corner_step(scene, points, mechanism, motions, bound)
    if found is None:
        return None
    moved = points + found[0]
    if (heights_at(scene.triangles, moved) < np.minimum(thinnest, heights)).any():
        return None
    better = find_mechanism(scene, moved)
    if better is None or not better.load_factor < mechanism.load_factor:
        return None
    return moved, better
