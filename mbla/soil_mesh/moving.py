"""Corners of cells are moved as long as that makes load factors smaller.

A step is that of :mod:`~mbla.soil_mesh.corner_step`, of a share of the size of the cells at each point in the first
mesh. It is kept where the program at the moved points has a smaller load factor, of several scenes of one mesh their
sum, each over its size now; then the share grows, otherwise it shrinks. Where dead loads alone have no equilibrium any
more, moving ends.

Friction makes soil dilate as it slips, and a mesh may lock: no mechanism there is dilates along its edges. Then corners
are moved at the greatest share of the friction at which the first mesh does not lock, and at growing shares from there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.sparse as sp

from mbla.arrays import FloatArray
from mbla.model.soil.plane_mesh import areas_of
from mbla.soil_mesh.corner_step import LEAST, corner_step
from mbla.soil_mesh.planar_program import Mechanism, find_mechanism, with_unit_live_load
from mbla.soil_mesh.planar_scene import PlanarScene

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
    mechanisms   : on these, of each scene; empty where in one of them nothing can move
    load_factors : (n_kept, n_scenes) of the meshes kept, in order, that of the first first; at first with less friction
                   where that locked
    steps        : tried
    """

    points: FloatArray
    mechanisms: tuple[Mechanism, ...]
    load_factors: FloatArray
    steps: int

    @property
    def load_factor(self) -> float:
        """Least one on the moved points; inf without mechanisms, -inf where dead loads alone have no equilibrium."""
        return min((each.load_factor for each in self.mechanisms), default=np.inf)


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
    told: list[FloatArray]
    steps: int = 0


def move_corners(
    scenes: Sequence[PlanarScene],
    points: FloatArray,
    motions: sp.csr_array,
    settings: MovingSettings | None = None,
    first: FloatArray | None = None,
) -> MovedMesh:
    """Points moved from (n_points, 2) by what their motions allow, (2 n_points, n_unknowns), for scenes of one mesh.

    first : (n_cells,) areas of cells in the first mesh; None: it is this one
    """
    settings = MovingSettings() if settings is None else settings
    with_units = [with_unit_live_load(scene, points) for scene in scenes]
    scenes, units = [scene for scene, _ in with_units], np.array([unit for _, unit in with_units])
    walk = _start(scenes[0], points, motions, settings, first)
    for ease in reversed(_eases(scenes, points, settings.eases)):
        _move(_with_friction(scenes, ease), walk, settings, settings.eased_steps)
    found = _move(scenes, walk, settings, settings.steps)
    mechanisms = tuple(
        Mechanism(*(each / unit for each in vars(mechanism).values()))
        for mechanism, unit in zip(found or (), units, strict=bool(found))
    )
    told = np.array(walk.told).reshape(-1, len(scenes)) / units
    return MovedMesh(walk.points, mechanisms, told, walk.steps)


def find_mechanisms(scenes: Sequence[PlanarScene], points: FloatArray) -> tuple[Mechanism, ...] | None:
    """Of each scene; None where in one of them nothing can move."""
    found = []
    for scene in scenes:
        mechanism = find_mechanism(scene, points)
        if mechanism is None:
            return None
        found.append(mechanism)
    return tuple(found)


def _eases(scenes: Sequence[PlanarScene], points: FloatArray, eases: tuple[float, ...]) -> tuple[float, ...]:
    """Shares of the friction down to the greatest at which something can move; none where it can at full friction."""
    if find_mechanisms(scenes, points) is not None:
        return ()
    for number, ease in enumerate(eases, start=1):
        if find_mechanisms(_with_friction(scenes, ease), points) is not None:
            return eases[:number]
    return ()


def _with_friction(scenes: Sequence[PlanarScene], ease: float) -> list[PlanarScene]:
    """The scenes with a share of their friction."""
    return [replace(scene, friction=ease * scene.friction) for scene in scenes]


def _start(
    scene: PlanarScene, points: FloatArray, motions: sp.csr_array, settings: MovingSettings, first: FloatArray | None
) -> _Walk:
    """A walk that has not begun."""
    areas = areas_of(scene.triangles, points)
    corners = scene.triangles.ravel()
    total = np.bincount(corners, np.repeat(areas, 3), len(points))
    size = np.sqrt(total / np.maximum(np.bincount(corners, minlength=len(points)), 1))
    reach = np.asarray(abs(motions).multiply(np.repeat(size, 2)[:, None]).max(axis=0).todense()).ravel()
    return _Walk(points, motions, reach, settings.thinnest * (areas if first is None else first), [])


def _move(
    scenes: Sequence[PlanarScene], walk: _Walk, settings: MovingSettings, steps: int
) -> tuple[Mechanism, ...] | None:
    """Move the points of a walk until nothing is gained any more, or by so many steps; the mechanisms at its end."""
    mechanisms = find_mechanisms(scenes, walk.points)
    if mechanisms is None:
        return None
    walk.told.append(load_factors_of(mechanisms))
    share, gains = settings.share, [np.inf, np.inf]
    for _ in range(steps):
        if np.isneginf(walk.told[-1]).any():
            break
        walk.steps += 1
        found = _step(scenes, walk, mechanisms, share, settings)
        if found is None:
            share *= settings.shrinks
            if share < settings.least:
                break
            continue
        walk.points, better, gain = found
        gains.append(gain)
        mechanisms, share = better, min(settings.grows * share, settings.most)
        walk.told.append(load_factors_of(mechanisms))
        if sum(gains[-2:]) < settings.enough:
            break
    return mechanisms


def load_factors_of(mechanisms: Sequence[Mechanism]) -> FloatArray:
    """(n_scenes,)."""
    return np.array([mechanism.load_factor for mechanism in mechanisms])


def gain_of(before: FloatArray, after: FloatArray) -> float:
    """By how much load factors, (n_scenes,), became smaller, each over its size before; their mean."""
    sizes = np.abs(before)
    return float(np.mean((before - after) / np.maximum(sizes, LEAST * sizes.max())))


def _step(
    scenes: Sequence[PlanarScene],
    walk: _Walk,
    mechanisms: Sequence[Mechanism],
    share: float,
    settings: MovingSettings,
) -> tuple[FloatArray, tuple[Mechanism, ...], float] | None:
    """Points after a step, their mechanisms and the gain; None where that is no better."""
    areas = areas_of(scenes[0].triangles, walk.points)
    spare = settings.thins * np.maximum(1.0 - walk.thinnest / areas, 0.0)
    step = corner_step(scenes, walk.points, mechanisms, walk.motions, share * walk.reach, spare)
    if step is None:
        return None
    moved = walk.points + step
    if (areas_of(scenes[0].triangles, moved) < FLOOR * walk.thinnest).any():
        return None
    better = find_mechanisms(scenes, moved)
    gain = -np.inf if better is None else gain_of(walk.told[-1], load_factors_of(better))
    return None if better is None or gain <= 0.0 else (moved, better, gain)
