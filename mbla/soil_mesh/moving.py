"""Corners of cells are moved as long as that makes the load factor smaller.

A step is that of :mod:`~mbla.soil_mesh.corner_step`, of a share of the size of the cells at each point in the first
mesh. It is kept where the program at the moved points has a smaller load factor; then the share grows, otherwise it
shrinks.

Friction makes soil dilate as it slips, and a mesh may lock: no mechanism there is dilates along its edges. Then corners
are moved at the greatest share of the friction at which the first mesh does not lock, and at growing shares from there.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.soil_mesh.corner_step import corner_step
from mbla.soil_mesh.planar_program import Mechanism, find_mechanism, with_unit_live_load
from mbla.soil_mesh.planar_scene import PlanarScene, areas_of

FLOOR = 0.1
"""of the least area: what cells at it may lose by the curvature of their area, which the linear program does not see"""


@dataclass(frozen=True)
class MovingSettings:
    """How corners are moved.

    steps     : greatest number of them, kept or not, at full friction
    share     : of the size of the cells at a point by which it may move at first
    grows, shrinks : factors of the share after a step that is kept, and after one that is not
    most, least : of the share; below the least the moving ends
    enough    : relative gain of two steps together below which it ends
    thins     : share of its area by which a cell may shrink in a step
    thinnest  : least area of a cell over that in the first mesh
    eases     : shares of the friction, descending, that are tried where a mesh locks
    eased_steps : greatest number of steps at each of them
    """

    steps: int = 60
    share: float = 0.3
    grows: float = 1.3
    shrinks: float = 0.4
    most: float = 0.6
    least: float = 2e-3
    enough: float = 3e-4
    thins: float = 0.5
    thinnest: float = 0.01
    eases: tuple[float, ...] = (0.9, 0.8, 0.6, 0.4, 0.2, 0.0)
    eased_steps: int = 20


@dataclass(frozen=True)
class MovedMesh:
    """What moving corners came to.

    points       : (n_points, 2)
    mechanism    : on these; None where nothing can move, or dead loads alone have no equilibrium
    load_factors : of the meshes kept, in order, that of the first first; at first with less friction where that locked
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
    """Points as they are moved, and what of the first mesh bounds steps.

    reach   : (n_unknowns,) size of the cells there
    thinnest : (n_cells,) least areas
    told    : load factors so far
    """

    points: FloatArray
    motions: sp.csr_array
    reach: FloatArray
    thinnest: FloatArray
    told: list[float]
    steps: int = 0


def move_corners(
    scene: PlanarScene, points: FloatArray, motions: sp.csr_array, settings: MovingSettings | None = None
) -> MovedMesh:
    """Points moved, from (n_points, 2), by what their motions allow, (2 n_points, n_unknowns)."""
    settings = MovingSettings() if settings is None else settings
    scene, unit = with_unit_live_load(scene, points)
    walk = _start(scene, points, motions, settings)
    for ease in reversed(_eases(scene, points, settings.eases)):
        _move(_with_friction(scene, ease), walk, settings, settings.eased_steps)
    mechanism = _move(scene, walk, settings, settings.steps)
    if mechanism is not None:
        mechanism = Mechanism(*(each / unit for each in vars(mechanism).values()))
    return MovedMesh(walk.points, mechanism, tuple(each / unit for each in walk.told), walk.steps)


def _eases(scene: PlanarScene, points: FloatArray, eases: tuple[float, ...]) -> tuple[float, ...]:
    """Shares of the friction down to the greatest at which something can move; none where it can at full friction."""
    if find_mechanism(scene, points) is not None:
        return ()
    for number, ease in enumerate(eases, start=1):
        if find_mechanism(_with_friction(scene, ease), points) is not None:
            return eases[:number]
    return ()


def _with_friction(scene: PlanarScene, ease: float) -> PlanarScene:
    """The scene with a share of its friction."""
    return replace(scene, friction=ease * scene.friction)


def _start(scene: PlanarScene, points: FloatArray, motions: sp.csr_array, settings: MovingSettings) -> _Walk:
    """A walk that has not begun."""
    areas = areas_of(scene.triangles, points)
    corners = scene.triangles.ravel()
    total = np.bincount(corners, np.repeat(areas, 3), len(points))
    size = np.sqrt(total / np.maximum(np.bincount(corners, minlength=len(points)), 1))
    reach = np.asarray(abs(motions).multiply(np.repeat(size, 2)[:, None]).max(axis=0).todense()).ravel()
    return _Walk(points, motions, reach, settings.thinnest * areas, [])


def _move(scene: PlanarScene, walk: _Walk, settings: MovingSettings, steps: int) -> Mechanism | None:
    """Move the points of a walk until nothing is gained any more, or by so many steps; the mechanism at its end."""
    mechanism = find_mechanism(scene, walk.points)
    if mechanism is None:
        return None
    walk.told.append(mechanism.load_factor)
    share, gains = settings.share, [np.inf, np.inf]
    for _ in range(steps):
        walk.steps += 1
        found = _step(scene, walk, mechanism, share, settings)
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


def _step(
    scene: PlanarScene, walk: _Walk, mechanism: Mechanism, share: float, settings: MovingSettings
) -> tuple[FloatArray, Mechanism] | None:
    """Points after a step and their mechanism; None where that is no better."""
    areas = areas_of(scene.triangles, walk.points)
    spare = settings.thins * np.maximum(1.0 - walk.thinnest / areas, 0.0)
    step = corner_step(scene, walk.points, mechanism, walk.motions, share * walk.reach, spare)
    if step is None:
        return None
    moved = walk.points + step
    if (areas_of(scene.triangles, moved) < FLOOR * walk.thinnest).any():
        return None
    better = find_mechanism(scene, moved)
    if better is None or not better.load_factor < mechanism.load_factor:
        return None
    return moved, better
