"""Contact points in the same place, between the same bodies, with the same normal and joint law: one stands for all.

They arise where several interfaces of one pair of bodies meet in a plane. All that does not move is one body here, so
that a brick on two fixed ones has two points under its middle. Such points move alike, under every flow rule, and their
forces sum up: m cones of one law make the same cone, with m times the strength.

Each carries the same part of the force. In x_k = y/√m the spring of y is as stiff as the m springs of the points
together and Σ ‖x_k‖² = ‖y‖², so that what is chosen by stiffness or by the least forces stays the same; strengths of y
are √m times those of one point. Points of unlike strength, and those of refined interfaces, which are as stiff as their
shares (:mod:`mbla.program.reductions.shares`), are left as they are.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from mbla.arrays import FloatArray, IntArray
from mbla.program.reductions.points import several_of_a_pair
from mbla.program.reductions.restrict import block_matrix, chosen_limits, restricted
from mbla.program.reductions.scene import Scene, part_of

COINCIDENT = 1e-9
"""Relative to block size: distance of points, and difference of normals, that is rounding."""

SAME_LAW = 1e-9
"""Relative difference of coefficients and strengths that is rounding."""


def with_merged_points(scene: Scene) -> Scene:
    """The scene with one point for all that coincide; the same one where none do."""
    group = _groups(scene)
    if group is None:
        return scene
    kept = np.unique(group, return_index=True)[1]
    kept = np.sort(kept)
    number = np.empty(len(group), dtype=np.int64)
    number[group[kept]] = np.arange(len(kept))
    column = number[group]
    count = np.bincount(column)
    first = kept[column]
    turned = np.where((scene.bodies == scene.bodies[first]).all(axis=1), 1.0, -1.0)[:, None, None]
    maps = turned * np.einsum("pix,pjx->pij", scene.frames, scene.frames[first])
    maps /= np.sqrt(count[column])[:, None, None]
    maps[kept] = np.eye(3) / np.sqrt(count)[:, None, None]
    forces = block_matrix(maps, np.arange(len(group)), column, (len(group), len(kept)))
    limits = chosen_limits(scene.program.limits, kept)
    root = np.sqrt(count)
    limits = replace(
        limits, cohesion=root * limits.cohesion, tension=root * limits.tension, compression=root * limits.compression
    )
    rows = sp.eye_array(len(scene.program.dead_load), format="csr")
    program = restricted(scene.program, sp.csr_array(rows), forces, limits)
    merged = part_of(scene, program, np.arange(len(scene.centroids)), kept)
    areas = np.bincount(column, scene.areas) / count
    return replace(merged, areas=areas, refined=scene.refined_points[kept], allowed=scene.allowed)


def _groups(scene: Scene) -> IntArray | None:
    """Number of the place of every point, (n_points,), equal for those that coincide; None where none do."""
    candidates = np.flatnonzero(np.isin(scene.interfaces, several_of_a_pair(scene)) & ~scene.refined_points)
    if not len(candidates):
        return None
    from scipy.spatial import cKDTree  # late: few structures have such points

    pairs = cKDTree(_features(scene, candidates)).query_pairs(COINCIDENT, output_type="ndarray")
    pairs = candidates[pairs]
    pairs = pairs[_same_law(scene, pairs)]
    if not len(pairs):
        return None
    n = len(scene.points)
    graph = sp.coo_array((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(n, n))
    return np.asarray(connected_components(graph, directed=False)[1], dtype=np.int64)


def _features(scene: Scene, points: IntArray) -> FloatArray:
    """Position, pair of bodies and normal (from the lower body to the higher one), as coordinates."""
    bodies = scene.bodies[points]
    turned = np.where(bodies[:, 0] <= bodies[:, 1], 1.0, -1.0)[:, None]
    position = (scene.points[points] - scene.centroids.mean(axis=0)) / scene.length
    return np.column_stack([position, np.sort(bodies, axis=1), scene.frames[points, 0] * turned])


def _same_law(scene: Scene, pairs: IntArray) -> FloatArray:
    """Whether both points of each pair (n, 2) have the same law and strength, (n,)."""
    limits = scene.program.limits
    laws = np.column_stack([limits.friction, limits.dilatancy, limits.cohesion, limits.tension, limits.compression])
    a, b = laws[pairs[:, 0]], laws[pairs[:, 1]]
    return np.asarray(np.isclose(a, b, rtol=SAME_LAW, atol=0.0).all(axis=1))
