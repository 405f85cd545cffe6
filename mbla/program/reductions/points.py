"""Contact points that cannot matter under associative flow.

Over the common plane of two bodies the velocity is affine, and v_N ≥ μ ‖v_T‖ describes a convex set: where it holds at
the corners of the convex hull it holds inside. So with dry friction only the corners of the hull of all common surfaces
in one plane need unknowns, and the forces of the others are zero. Without normality this does not hold: there points
inside share the load.
"""

from __future__ import annotations

import numpy as np
from scipy.spatial import ConvexHull, QhullError

from mbla.arrays import BoolArray, FloatArray, IntArray
from mbla.program.reductions.restrict import chosen_limits, restricted, selection
from mbla.program.reductions.scene import COPLANAR, STRAIGHT_ON, Scene, part_of, turns


def without_inner_points(scene: Scene) -> Scene:
    """The scene with the corners of the hulls alone; the same one where there is nothing to leave out."""
    limits = scene.program.limits
    dry = (limits.cohesion == 0) & (limits.tension == 0) & np.isinf(limits.compression)
    kept = np.ones(len(scene.points), dtype=bool)
    for group in _groups(scene, dry):
        kept[group] = _on_hull(scene, group)
    if kept.all():
        return scene
    points = np.flatnonzero(kept)
    n = len(scene.centroids)
    program = restricted(
        scene.program,
        selection(np.arange(n), n, 6),
        selection(points, scene.program.n_points, 3),
        chosen_limits(limits, points),
    )
    return part_of(scene, program, np.arange(n), points)


def _groups(scene: Scene, dry: BoolArray) -> list[IntArray]:
    """Points of one pair of bodies, one plane and one joint law, where they may hold more than corners of a hull."""
    candidates = np.flatnonzero(dry & np.isin(scene.interfaces, _suspicious(scene)))
    if not len(candidates):
        return []
    normal = scene.frames[candidates, 0]
    offset = ((scene.points[candidates] - scene.centroids.mean(axis=0)) * normal).sum(axis=1) / scene.length
    places = round(-np.log10(COPLANAR)) - 1
    planes = np.round(np.column_stack([normal, offset]), places) + 0.0
    friction = scene.program.limits.friction[candidates]
    keys = np.column_stack([np.sort(scene.bodies[candidates], axis=1), planes, friction])
    _, group = np.unique(keys, axis=0, return_inverse=True)
    order = np.argsort(group, kind="stable")
    return np.split(candidates[order], np.flatnonzero(np.diff(group[order])) + 1)


def _suspicious(scene: Scene) -> IntArray:
    """Interfaces that share their pair of bodies with another one, or do not turn strictly left at each point."""
    return np.union1d(several_of_a_pair(scene), scene.interfaces[turns(scene) <= STRAIGHT_ON])


def several_of_a_pair(scene: Scene) -> IntArray:
    """Interfaces that share their pair of bodies with another one; all that does not move is one body."""
    first = np.flatnonzero(np.diff(scene.interfaces, prepend=-1))
    number, pair = scene.interfaces[first], np.sort(scene.bodies[first], axis=1)
    _, which, count = np.unique(pair, axis=0, return_inverse=True, return_counts=True)
    return np.asarray(number[count[which] > 1])


def _on_hull(scene: Scene, group: IntArray) -> BoolArray:
    flat = (scene.points[group] - scene.points[group[0]]) @ scene.frames[group[0], 1:].T / scene.length
    kept = np.zeros(len(group), dtype=bool)
    try:
        kept[ConvexHull(flat).vertices] = True
    except (QhullError, ValueError):  # all on one line, or fewer than three
        kept[_ends(flat)] = True
    return kept


def _ends(flat: FloatArray) -> IntArray:
    direction = np.linalg.svd(flat - flat.mean(axis=0), full_matrices=False)[2][0]
    along = flat @ direction
    return np.array([along.argmin(), along.argmax()])
